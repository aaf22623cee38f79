"""Two-parameter maps: where orbits that never turn exist, or what attracts."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.diagnostics.attractor import LONGEST, Attractor, settle, sort
from cap.floats.diagnostics.grid import grid, whole
from cap.floats.findings import Findings, Floats
from cap.floats.search import periodic
from cap.floats.variation import value_of, varied
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

ORBITS = ("none", "elliptic only", "saddle only", "elliptic and saddle")
ATTRACTORS = ("period 1", "period 2", "period 3", "period 4", "longer period", "chaotic",
              "no period found", "never hits a wall", "never turns",
              "no attractor found")  # fmt: skip
OUTSIDE, UNDONE = -1, -2  # no oscillator: f >= F, ...; not computed
SEEDS = 6  # per side, of the states that are followed to their attractor
DEFAULTS = {"f": (0.01, 0.7), "F": (1.05, 4.0), "R": (0.1, 2.25), "omega": (0.5, 2.0),
            "e": (0.5, 1.0), "mu": (0.0, 0.5)}  # fmt: skip


class Cell(NamedTuple):
    """What is found at one pair of parameters: a place in the map's list, and a number."""

    code: int
    number: float


@dataclass(frozen=True, kw_only=True)
class Plane(Findings):
    """A map over the values ``first`` (N,) and ``second`` (M,) of two parameters.

    ``code`` (M, N): places in ``names``, -1 outside, -2 not computed.  ``number`` (M, N): of orbits
    their number; of attractors the larger exponent per time.
    """

    parameter_1: str
    parameter_2: str
    what: str
    names: tuple[str, ...]
    first: Floats
    second: Floats
    code: NDArray[np.int64]
    number: Floats

    def varying(self) -> dict[str, Floats]:
        """Return the values of both parameters."""
        return {self.parameter_1: self.first, self.parameter_2: self.second}

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return both parameters and what is found."""
        return {
            self.parameter_1: self.first[None, :],
            self.parameter_2: self.second[:, None],
            "code": self.code,
            "number": self.number,
        }

    def lines(self) -> list[str]:
        """Return how often each was found."""
        names = f"({self.parameter_1}, {self.parameter_2})"
        system = described(self.parameters, self.varying())
        head = f"{self.what} over {names} at {system}: {self.code.size} points"
        counts = [(name, int((self.code == k).sum())) for k, name in enumerate(self.names)]
        return [head, *(f"  {name:<24} {count}" for name, count in counts if count)]


def plane(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    axes: tuple[str, ...] = ("f", "R"),
    first: tuple[float, ...] | None = None,
    second: tuple[float, ...] | None = None,
    points: int = 40,
    what: str = "orbits",
    runner: Runner | None = None,
) -> Plane:
    """Return a map over two parameters ``axes`` from and to given values.

    ``what``: the (1,1) orbits, whose velocity never vanishes, with one hit of each wall per period;
    or the attractor of most seeds all over the plane.
    """
    runner = runner or Runner()
    a, b = axes
    if a == b:
        raise BadInput(f"two different parameters are needed, not {a} twice")
    if what == "orbits" and not p.conserves:
        raise BadInput("orbits that never turn are mapped for e = 1 and mu = 0 only")
    if what == "orbits" and {a, b} & {"e", "mu"}:
        raise BadInput("orbits that never turn are mapped over f, F, omega and R only")
    values = [np.linspace(*_limits(p, name, given), points)
              for name, given in ((a, first), (b, second))]  # fmt: skip
    tasks = [(p, (a, b), values[0], value, what) for value in values[1].tolist()]
    rows = runner.map(_row, tasks, "plane", processes=True)
    code = np.full((points, points), UNDONE)
    number = np.full((points, points), np.nan)
    for k, row in enumerate(rows):
        code[k], number[k] = np.array(row).T
    return Plane(
        parameters=p,
        complete=not runner.interrupted,
        parameter_1=a,
        parameter_2=b,
        what=what,
        names=ORBITS if what == "orbits" else ATTRACTORS,
        first=values[0],
        second=values[1],
        code=code,
        number=number,
    )


def _limits(p: Parameters, name: str, given: tuple[float, ...] | None) -> tuple[float, float]:
    """Return the first and last value: given, or in units of F for f, of f for F, of the value."""
    value = value_of(p, name)
    if given:
        low, high = given
    else:
        low, high = DEFAULTS[name]
        unit = {"f": float(p.F), "F": max(float(p.f), value / 4), "e": 1.0, "mu": 1.0}.get(
            name, value
        )
        low, high = low * unit, high * unit
    if not low < high:
        raise BadInput(f"{name} must run from a lower to a higher value: {low:.6g} to {high:.6g}")
    varied(
        p if name not in ("f", "F") else replace(p, f=p.f * 0), name, high if name != "f" else low
    )
    return low, high


def _row(task: tuple[Parameters, tuple[str, str], Floats, float, str]) -> list[Cell]:
    p, (a, b), values, second, what = task
    return [_cell(p, ((a, value), (b, second)), what) for value in values.tolist()]


def _cell(p: Parameters, values: tuple[tuple[str, float], ...], what: str) -> Cell:
    forcing = dict(values)
    names = sorted(forcing, key=lambda name: name == "f")  # f last: it must be below F
    p = replace(p, f=p.f * 0) if "f" in forcing else p
    try:
        for name in names:
            p = varied(p, name, forcing[name])
    except BadInput:
        return Cell(OUTSIDE, np.nan)
    return _orbits(p) if what == "orbits" else _attractor(p)


def _orbits(p: Parameters) -> Cell:
    kinds = [guess.kind for guess in periodic.orbits(p, 2)]
    return Cell(("elliptic" in kinds) + 2 * ("saddle" in kinds), len(kinds))


def _attractor(p: Parameters) -> Cell:
    seeds = grid(p, whole(p), SEEDS)
    _, found = sort(p, [settle(p, seeds.states(slice(0, seeds.count)), 200, 2 * LONGEST)])
    if not found:
        return Cell(ATTRACTORS.index("no attractor found"), np.nan)
    return Cell(ATTRACTORS.index(_name(found[0])), found[0].exponent)


def _name(found: Attractor) -> str:
    if found.kind in ATTRACTORS:
        return found.kind
    if found.kind == "chaotic":
        return "chaotic"
    return "longer period" if found.period else "no period found"
