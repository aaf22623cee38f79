"""Alignment indices, which tell regular from chaotic orbits: SALI, and GALI of two vectors."""

import math
from dataclasses import dataclass
from typing import TypedDict, Unpack

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics.grid import Box, grid, require_followed
from cap.floats.diagnostics.stops import stops
from cap.floats.engine import swarm
from cap.floats.engine.pieces import in_pieces
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.fixed_point import region
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

THRESHOLD = -2.5  # of log10 of the index: regular above
REACH = 0.035, 0.025  # half-widths of the box around the fixed point, in units of R and Rω
CURVES = 5  # orbits, from the middle of the box to its right edge, whose index is kept …
LONG = 1000  # … after each of at least so many periods

LOST, TURNED, REGULAR, CHAOTIC = -1, 0, 1, 2


@dataclass(frozen=True, kw_only=True)
class Alignment(Findings):
    """An alignment index over the states (x_j, v_i).

    ``index`` (M, N) after the last period: nan where the orbit turned, stuck or was captured, and
    where it was ``lost`` (M, N), or not followed.  ``starts`` (L, 2) are some of the states,
    ``curves`` (L, K) their indices after each period.
    """

    name: str
    periods: int
    x: Floats
    v: Floats
    index: Floats
    lost: NDArray[np.bool_]
    starts: Floats
    curves: Floats
    centre: State | None

    @property
    def kinds(self) -> NDArray[np.int8]:
        """Which cells, (M, N), are `LOST`, `TURNED`, `REGULAR` or `CHAOTIC`."""
        with np.errstate(divide="ignore"):
            regular = np.log10(self.index) > THRESHOLD
        kinds = np.where(regular, REGULAR, CHAOTIC)
        kinds = np.where(np.isnan(self.index), TURNED, kinds)
        return np.where(self.lost, LOST, kinds).astype(np.int8)

    @property
    def counts(self) -> dict[str, int]:
        """How many cells are regular, chaotic, how many turned, and were lost if any was."""
        kinds = self.kinds
        names = {"regular": REGULAR, "chaotic": CHAOTIC, "turned": TURNED}
        names |= {"lost or not done": LOST} if self.lost.any() else {}
        return {name: int((kinds == kind).sum()) for name, kind in names.items()}

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the states and the index."""
        return {"x": self.x[None, :], "v": self.v[:, None], self.name: self.index}

    def lines(self) -> list[str]:
        """Return the counts and the range."""
        name = self.name.upper()
        counts = ", ".join(f"{count} {kind}" for kind, count in self.counts.items())
        known = self.index[np.isfinite(self.index)]
        with np.errstate(divide="ignore"):
            ends = np.log10([known.min(), known.max()]) if len(known) else [np.nan, np.nan]
        return [
            f"{name} after {self.periods} periods at {described(self.parameters)}",
            f"  {self.index.size} cells: {counts} (threshold log10 {name} = {THRESHOLD})",
            f"  log10 {name} from {ends[0]:.4g} to {ends[1]:.4g}",
        ]


class Options(TypedDict, total=False):
    """The options of both indices: see `_map`."""

    orbit: State | None
    box: Box | None
    points: int
    periods: int
    seed: int
    runner: Runner | None


def sali(p: Parameters, **options: Unpack[Options]) -> Alignment:
    """Return the smaller alignment index, min |w1 ± w2|, over a grid: see `_map`."""
    return _map("sali", p, **options)


def gali(p: Parameters, **options: Unpack[Options]) -> Alignment:
    """Return the generalised one, the area |w1 ∧ w2|, over a grid: see `_map`.

    The plane has room for two vectors; of three, the volume is 0.
    """
    return _map("gali", p, **options)


def _map(  # noqa: PLR0913 (the options of the command)
    name: str,
    p: Parameters,
    *,
    orbit: State | None = None,
    box: Box | None = None,
    points: int = 200,
    periods: int = 15,
    seed: int = 0,
    runner: Runner | None = None,
) -> Alignment:
    """Carry two deviations, orthonormal in (x, v), turned at random, the same for all orbits.

    Without a box the states are those around the fixed point near ``orbit``.
    """
    runner = runner or Runner()
    box, centre = region(p, orbit, box, REACH)
    cells = grid(p, box, points)
    require_followed(p, cells.sample())
    angle = float(np.random.default_rng(seed).uniform(0, 2 * np.pi))
    index = np.full(cells.count, np.nan)
    lost = np.full(cells.count, fill_value=True)

    def follow(part: slice) -> None:
        found, lost[part] = _indices(name, p, cells.states(part), periods, angle)
        index[part] = found[:, -1]

    in_pieces(runner, cells.count, follow, name, periods)
    starts = _ray(box)
    curves, _ = _indices(name, p, starts, max(periods, LONG), angle)
    return Alignment(
        parameters=p,
        complete=not runner.interrupted,
        name=name,
        periods=periods,
        x=cells.x,
        v=cells.v,
        index=index.reshape(cells.shape),
        lost=lost.reshape(cells.shape),
        starts=starts,
        curves=curves,
        centre=centre,
    )


def _ray(box: Box) -> Floats:
    left, right, low, high = box
    x = (left + right) / 2 + (right - left) / 2 * (np.arange(CURVES) + 0.5) / CURVES
    return np.stack([x, np.full(CURVES, (low + high) / 2)], axis=-1)


def _indices(
    name: str, p: Parameters, states: Floats, periods: int, angle: float
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the index (N, K) after each period, and which orbits (N,) were lost.

    nan if the orbit turns, or is lost, within all of them; one that turns soon is not followed on.
    """
    early = stops(p, states, periods // 4)  # most of those that stop do so soon
    found = swarm.follow(p, states[early.never], periods, every=True, derivative=True)
    cos, sin = math.cos(angle), math.sin(angle)
    units, _ = swarm.stretch(found.derivatives, [[cos, sin], [-sin, cos]])
    measure = smaller if name == "sali" else area
    own = measure(units[:, :, 0], units[:, :, 1])
    own[found.stopped | found.lost] = np.nan
    index, lost = np.full((len(states), periods), np.nan), early.lost.copy()
    index[early.never], lost[early.never] = own, found.lost
    return index, lost


def smaller(first: Floats, second: Floats) -> Floats:
    """Return SALI of unit vectors (…, 2)."""
    ends = (np.hypot(*np.moveaxis(first + side * second, -1, 0)) for side in (1, -1))
    return np.asarray(np.minimum(*ends))


def area(first: Floats, second: Floats) -> Floats:
    """Return GALI of two unit vectors (…, 2)."""
    return np.asarray(np.abs(first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]))
