"""Where orbits end: the attractors of Φ, from many seeds, with their basins.

Exponents are per time.  That of a cycle is exact but for rounding, of its multipliers.  Others are
means over `BLOCKS` parts of all orbits that end there, after a first part in which the deviation
turns into its direction, with the standard error of the mean.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.diagnostics.grid import Box, grid, require_followed, whole
from cap.floats.engine import swarm
from cap.floats.engine.pieces import cut
from cap.floats.findings import Findings, Floats
from cap.floats.search.attracting import attracting, first_alike, growth
from cap.floats.words import described, with_error
from cap.parameters import Parameters
from cap.runner import Runner

LONGEST = 64  # of the periods that are looked for
CLOSE = 1e-6  # a state that returns, in units of R and Rω
SAME = 1e-4  # states of one attractor, in the same units
CHAOTIC = 2e-4  # least exponent, per time, of a chaotic attractor, and …
CERTAIN = 3  # … it is so many standard errors above 0
BLOCKS = 10  # parts of an orbit, of which each has its exponent
CELLS = 12  # per side, by which aperiodic attractors are told apart
NONE = -1
PIECE = 200  # seeds at a time
MOST = 20_000_000  # states kept


@dataclass(frozen=True)
class Attractor:
    """One attractor: ``period`` in units of T, and a sample of states (K, 2).

    The period is 0 if there is none, or `cap.floats.search.attracting` does not find the cycle.

    ``share`` of the seeds; ``hits`` right and left, ``turns`` and ``sticks`` per period T;
    ``exponent`` the larger one, per time, and its standard ``error``, nan for a cycle.
    """

    kind: str
    period: int
    share: float
    hits: tuple[float, float]
    turns: float
    sticks: float
    exponent: float
    error: float
    states: Floats

    def line(self) -> str:
        """Return it in words."""
        x, v = self.states[0]
        return (
            f"{self.share:7.2%}  {self.kind:<24} hits r {self.hits[0]:.4g}, l {self.hits[1]:.4g}, "
            f"turns {self.turns:.4g}, sticks {self.sticks:.4g} per T; exponent "
            f"{with_error(self.exponent, self.error)} per time; through ({x:.8g}, {v:.8g})"
        )


@dataclass(frozen=True, kw_only=True)
class Attractors(Findings):
    """The attractors (L) that seeds (x_j, v_i) end on, the largest share first.

    ``label`` (M, N) is the place of each seed's attractor in ``found``, -1: none.
    """

    x: Floats
    v: Floats
    label: NDArray[np.int64]
    found: tuple[Attractor, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the seeds and where they end."""
        return {"x": self.x[None, :], "v": self.v[:, None], "attractor": self.label}

    def lines(self) -> list[str]:
        """Return the attractors."""
        head = f"attractors at {described(self.parameters)} from {self.label.size} seeds"
        rows = [f"  {k}  {each.line()}" for k, each in enumerate(self.found, 1)]
        lost = int((self.label == NONE).sum())
        return [head, *rows, *([f"  {lost} seeds were lost, or not done"] if lost else [])]


@dataclass(frozen=True)
class Ends:
    """The ends of N orbits: states (N, K, 2) once a period, what happened per period.

    ``exponent`` (N, `BLOCKS`): per time, in each part of an orbit after the first.
    """

    states: Floats
    counts: Floats
    exponent: Floats
    period: NDArray[np.int64]
    turned: NDArray[np.bool_]


def attractors(
    p: Parameters,
    *,
    box: Box | None = None,
    points: int = 40,
    transient: int = 2000,
    periods: int = 200,
    runner: Runner | None = None,
) -> Attractors:
    """Follow the seeds of a box, or of the whole plane, and tell their attractors apart."""
    runner = runner or Runner()
    cells = grid(p, box or whole(p), points)
    seen = max(periods, 2 * LONGEST)
    if cells.count * seen > MOST:
        raise BadInput(f"too many states: {cells.count} seeds x {seen} periods (at most {MOST})")
    require_followed(p, cells.sample())
    ends = runner.map(
        lambda part: settle(p, cells.states(part), transient, seen),
        cut(cells.count, transient + seen, PIECE),
        "attractors",
    )
    label, found = sort(p, ends)
    full = np.full(cells.count, NONE)
    full[: len(label)] = label
    return Attractors(
        parameters=p,
        complete=not runner.interrupted,
        x=cells.x,
        v=cells.v,
        label=full.reshape(cells.shape),
        found=found,
    )


def settle(p: Parameters, seeds: Floats, transient: int, periods: int) -> Ends:
    """Follow seeds (N, 2) through a transient, and then for some periods."""
    late = swarm.follow(p, seeds, transient).states
    found = swarm.follow(p, late, periods, every=True, derivative=True)
    _, growth = swarm.stretch(found.derivatives, [[0.6, 0.8]])
    unit = np.array([float(p.R), float(p.R * p.omega)])
    return Ends(
        found.states,
        found.counts / periods,
        _exponents(growth[..., 0]) / (2 * math.pi / float(p.omega)),
        _least_period(found.states / unit),
        found.stopped,
    )


def _exponents(growth: Floats) -> Floats:
    """Return the means (N, `BLOCKS`) per period of growth (N, K), after the first part."""
    first = growth.shape[1] // (BLOCKS + 1)
    parts = np.array_split(growth[:, first:], BLOCKS, axis=1)
    return np.stack([part.mean(axis=1) for part in parts], axis=1)


def _least_period(states: Floats) -> NDArray[np.int64]:
    """Return the least n after which states (N, K, 2) seem to come back, at the end; else 0."""
    period = np.zeros(len(states), dtype=np.int64)
    tail = states[:, -LONGEST:]
    backs = [states[:, -LONGEST - n : -n] for n in range(1, LONGEST + 1)]
    distance = np.stack([np.abs(tail - back).max(axis=(1, 2)) for back in backs], axis=1)
    settled = (distance < CLOSE).any(axis=1)
    period[settled] = 1 + (distance[settled] < SAME).argmax(axis=1)
    return period


def sort(p: Parameters, ends: list[Ends]) -> tuple[NDArray[np.int64], tuple[Attractor, ...]]:
    """Return the attractor (N,) of each orbit, -1 if it was lost, and the attractors."""
    if not ends:
        return np.empty(0, dtype=np.int64), ()
    joined = Ends(*(np.concatenate([getattr(e, name) for e in ends]) for name in _NAMES))
    label, marks, chosen = _labelled(p, joined)
    cycles = [_cycle(p, joined, *each) for each in zip(marks, chosen, strict=True)]
    first = first_alike(p, cycles)  # two marks may be of one cycle
    label = np.append(first, NONE)[label]  # the last is that of the label -1
    shares = {k: float((label == k).mean()) for k in first}
    order = sorted(shares, key=lambda k: (-shares[k], k))
    found = tuple(
        _attractor(p, joined, chosen[k], marks[k].name, cycles[k], label == k) for k in order
    )
    place = np.full(len(marks) + 1, NONE)
    place[order] = range(len(order))
    return place[label], found


_NAMES = ("states", "counts", "exponent", "period", "turned")


@dataclass(frozen=True)
class _Mark:
    """What tells one attractor from another: a state of a cycle, or the cells that are visited."""

    name: str
    period: int = 0
    state: tuple[float, float] = (0.0, 0.0)
    cells: frozenset[tuple[int, int]] = frozenset()

    def fits(self, other: "_Mark") -> bool:
        """Return whether both are of one attractor."""
        if (self.name, self.period) != (other.name, other.period):
            return False
        if self.name == "other":
            shared = len(self.cells & other.cells)
            return shared > 0.2 * min(len(self.cells), len(other.cells))
        return max(abs(a - b) for a, b in zip(self.state, other.state, strict=True)) < SAME


def _labelled(p: Parameters, ends: Ends) -> tuple[NDArray[np.int64], list[_Mark], list[int]]:
    """Return a label for each orbit, and of each label its mark and its first orbit."""
    unit = np.array([float(p.R), float(p.R * p.omega)])
    aperiodic = ends.states[ends.period == 0]
    spread = np.nanmax(aperiodic, axis=(0, 1)) - np.nanmin(aperiodic, axis=(0, 1)) if len(
        aperiodic) and np.isfinite(aperiodic).any() else unit  # fmt: skip
    marks: list[_Mark] = []
    chosen: list[int] = []
    label = np.full(len(ends.states), NONE)
    for i in np.flatnonzero(np.isfinite(ends.states[:, -1, 0])).tolist():
        mark = _mark(ends, i, unit, np.maximum(unit, spread), conserves=p.conserves)
        k = next((k for k, other in enumerate(marks) if mark.fits(other)), len(marks))
        if k == len(marks):
            marks.append(mark)
            chosen.append(i)
        label[i] = k
    return label, marks, chosen


def _mark(ends: Ends, i: int, unit: Floats, spread: Floats, *, conserves: bool) -> _Mark:
    """Return the mark of one end; where areas are kept unless it turns, it may be no attractor."""
    period = int(ends.period[i])
    if conserves and not ends.turned[i]:
        return _Mark("conservative")
    if ends.counts[i, :2].sum() == 0:
        return _Mark("free")
    if period:
        own = ends.states[i, -period:] / unit
        first = np.lexsort((own[:, 1], np.round(own[:, 0], 5)))[0]
        return _Mark("cycle", period, (float(own[first, 0]), float(own[first, 1])))
    cells = np.floor(ends.states[i] / spread * CELLS).astype(int)
    return _Mark("other", cells=frozenset((a, b) for a, b in cells.tolist()))


def _cycle(p: Parameters, ends: Ends, mark: _Mark, i: int) -> Floats | None:
    """Return the attracting cycle that an orbit seems to be on, if Newton's method finds it."""
    if mark.name != "cycle":
        return None
    return attracting(p, ends.states[i, -mark.period], mark.period)


def _attractor(
    p: Parameters, ends: Ends, i: int, name: str, cycle: Floats | None, own: NDArray[np.bool_]
) -> Attractor:
    """Return the attractor of the orbit i and of those that are its ``own``."""
    period, counts = int(ends.period[i]), ends.counts[i].tolist()
    if cycle is not None:
        period, states = len(cycle), cycle
        exponent, error = growth(p, cycle), math.nan
    else:
        states = ends.states[own][:400].reshape(-1, 2)
        exponent, error = _mean(ends.exponent[own])
    return Attractor(
        kind=_kind(name, period, exponent, error, confirmed=cycle is not None),
        period=0 if cycle is None else period,
        share=float(own.mean()),
        hits=(counts[0], counts[1]),
        turns=counts[2] + counts[3],
        sticks=counts[4],
        exponent=exponent,
        error=error,
        states=states,
    )


def _mean(exponents: Floats) -> tuple[float, float]:
    """Return the mean of exponents (M, `BLOCKS`) and its standard error: nan if it is infinite."""
    if not np.isfinite(exponents).all():
        return float(exponents.min()), math.nan
    return float(exponents.mean()), float(exponents.std(ddof=1) / math.sqrt(exponents.size))


def _kind(name: str, period: int, exponent: float, error: float, *, confirmed: bool) -> str:
    """Return the kind of an end in words."""
    if name == "cycle":
        return f"period {period}" if confirmed else f"comes back after {period} T"
    chaotic = exponent > max(CHAOTIC, CERTAIN * error)
    names = {"conservative": "never turns", "free": "never hits a wall"}
    return names.get(name, "chaotic" if chaotic else "no short period")


def strongest(p: Parameters, points: int = 12) -> Attractor | None:
    """Return the attractor of the largest share of seeds all over the plane."""
    found = attractors(p, points=points, transient=5000, periods=2 * LONGEST).found
    return found[0] if found else None
