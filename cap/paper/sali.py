"""fig:sali: the smaller alignment index around the elliptic orbit."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.audit.comparison import Comparison, among, claim, count, number, percent
from cap.floats.diagnostics import alignment
from cap.floats.diagnostics.alignment import CHAOTIC, REGULAR, THRESHOLD, TURNED, Alignment
from cap.floats.diagnostics.grid import around, grid
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.search import periodic
from cap.paper.figure import Figure, Result, Run, differences, elliptic
from cap.parameters import PAPER

REACH = 0.07, 0.05
SIDE, PERIODS = 22, 15
ALIGNED = 1e-8  # SALI of chaotic orbits after many periods
SADDLE = 0.3435, 0.7753  # a state nearby
SEEDS = 20  # of the random deviations


class Counts(NamedTuple):
    """How many cells are of which kind, and the least and largest log10 of SALI."""

    regular: int
    chaotic: int
    turned: int
    low: float
    high: float


@dataclass(frozen=True)
class Maps:
    """The paper's map, by its own procedure, and one with more states and periods."""

    paper: Alignment
    better: Alignment


def frames(angle: Floats) -> Floats:
    """Return orthonormal deviations (N, 2, 2), one in each row."""
    cos, sin = np.cos(angle), np.sin(angle)
    return np.stack([np.stack([cos, sin], -1), np.stack([-sin, cos], -1)], axis=1)


def _monodromies(states: Floats, periods: int) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Return Φ' along orbits (N, K, 2, 2) by differences and exactly, and which orbits turn."""
    found = swarm.follow(PAPER, states, periods, every=True, derivative=True)
    if found.monodromy is None:  # it was asked for
        raise TypeError
    rough = np.stack([differences(found.states[:, k]) for k in range(periods)], axis=1)
    return rough, found.monodromy, found.turned | found.stuck | found.captured


def _index(monodromy: Floats, seed: int) -> Floats:
    angle = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(monodromy))
    units, _ = swarm.stretch(monodromy, frames(angle))
    return np.asarray(alignment.smaller(units[:, :, 0], units[:, :, 1])[:, -1])


def _counts(index: Floats, turned: NDArray[np.bool_]) -> Counts:
    with np.errstate(divide="ignore"):
        log = np.log10(np.maximum(index[~turned], 1e-17))
    regular = int((log > THRESHOLD).sum())
    return Counts(
        regular, len(log) - regular, int(turned.sum()), float(log.min()), float(log.max())
    )


def compute(run: Run) -> Result:
    """Reproduce the paper's map from its description, and compute a better one."""
    centre = elliptic()
    box = around(PAPER, centre, REACH)
    cells = grid(PAPER, box, SIDE)
    states = cells.states(slice(0, cells.count))
    rough, exact, turned = _monodromies(states, PERIODS)
    paper = [_counts(_index(rough, seed), turned) for seed in range(SEEDS)]
    side = run.size(300, 40)
    better = alignment.sali(
        PAPER, orbit=centre, box=box, points=side, periods=run.size(200, 30), runner=run.runner
    )
    coarse = alignment.sali(PAPER, orbit=centre, box=box, points=SIDE, periods=PERIODS)
    twice = alignment.sali(PAPER, orbit=centre, box=box, points=SIDE, periods=2 * PERIODS)
    good = ~turned
    error = np.abs(rough[good] - exact[good]).max(axis=(1, 2, 3))
    rows = [
        among("regular cells of 484", "165", [c.regular for c in paper],
              "", note="the deviations are random: the number is one of many"),
        among("chaotic cells", "62", [c.chaotic for c in paper], "", note="as above"),
        count("cells in Omega_dissip", 257, paper[0].turned,
              "the grid is 22 x 22 with its edges on the box; cells near the border are chaotic"),
        among("least log10 SALI", "-13.4", [c.low for c in paper],
              "random deviations; on cells that aligned only rounding errors are left"),
        among("largest log10 SALI", "0.14", [c.high for c in paper],
              "random deviations", note="at most log10 sqrt 2 = 0.1505"),
        *_ranges(coarse),
        _doubled(coarse, twice),
        claim("differences with h = 1e-6 agree with the saltation product",
              "to machine precision",
              f"to {np.median(error):.1e} (median), {error.max():.1e} (most)",
              bool(error.max() < 1e-14),
              "a central difference loses half the digits: rounding/h = 1e-10, times Φ'"),
        number("revolutions of a regular orbit in 15 periods", "4.3",
               PERIODS * _rotation(centre)),
        _stretched(exact, coarse),
        _power(centre, run.size(10_000, 1000)),
        _later(better),
    ]  # fmt: skip
    return Result(tuple(rows), Maps(coarse, better))


def _rotation(centre: State) -> float:
    found = swarm.follow(PAPER, [centre], 1, derivative=True).monodromy
    if found is None:  # it was asked for
        raise TypeError
    return float(np.arccos(np.trace(found[0]) / 2) / (2 * np.pi))


def _exponent() -> float:
    """Return the logarithm of the multiplier of the saddle whose manifolds bound the island."""
    return float(np.arccosh(periodic.near(PAPER, *SADDLE).trace / 2))


def _ranges(findings: Alignment) -> list[Comparison]:
    """Compare where the values are said to lie."""
    kinds = findings.kinds
    with np.errstate(divide="ignore"):
        log = np.log10(np.maximum(findings.index, 1e-17))
    regular, chaotic = log[kinds == REGULAR], log[kinds == CHAOTIC]
    top, low = int((regular >= -2).sum()), int((chaotic <= -4).sum())
    why = "the two ranges do not separate: values go on without a gap across the threshold -2.5"
    return [
        claim("log10 SALI of regular orbits", "in [-2, 0]",
              f"{top} of {len(regular)} are", top == len(regular), why),
        claim("log10 SALI of chaotic orbits", "in [-13, -4]",
              f"{low} of {len(chaotic)} are at most -4", low == len(chaotic), why),
    ]  # fmt: skip


def _doubled(once: Alignment, twice: Alignment) -> Comparison:
    """Compare the kinds after N and 2N periods."""
    changed = once.kinds != twice.kinds
    gone = int(((once.kinds != TURNED) & (twice.kinds == TURNED)).sum())
    return claim(
        "kinds with N = 30 instead of 15", "the same in every case (spot checks)",
        f"{int(changed.sum())} of {changed.size} change, {gone} of them turn or stick",
        not changed.any(),
        "spot checks miss the orbits that leave between 15 and 30 periods",
    )  # fmt: skip


def _stretched(exact: Floats, findings: Alignment) -> Comparison:
    """Compare the logarithm of the growth along chaotic orbits."""
    chaotic = findings.kinds.ravel() == CHAOTIC
    _, growth = swarm.stretch(exact[chaotic], [[0.6, 0.8]])
    total = growth[..., 0].sum(axis=1)
    return number(
        "log of the growth along chaotic orbits in 15 periods (median)", "5",
        float(np.median(total)) if len(total) else np.nan,
        f"the exponent of the saddle nearby would give {PERIODS * _exponent():.1f}",
    )  # fmt: skip


def _power(centre: State, periods: int) -> Comparison:
    """Fit how SALI falls along regular orbits."""
    distance = np.linspace(0.02, 0.04, 24)
    starts = np.stack([centre[0] + distance, np.full_like(distance, centre[1])], axis=-1)
    found = swarm.follow(PAPER, starts, periods, every=True, derivative=True)
    if found.monodromy is None:  # it was asked for
        raise TypeError
    units, _ = swarm.stretch(found.monodromy, frames(np.zeros(len(starts))))
    curves = alignment.smaller(units[:, :, 0], units[:, :, 1])
    regular = ~(found.turned | found.stuck | found.captured) & (curves[:, -1] > 1e-11)
    late = slice(periods // 10, None)
    n = np.log(np.arange(1, periods + 1)[late])
    slopes = [np.polyfit(n, np.log(curve[late]), 1)[0] for curve in curves[regular]]
    slope = float(np.median(slopes)) if slopes else np.nan
    return claim(
        "SALI of regular orbits as N grows", "a power law, bounded away from 0",
        f"N^{slope:.2f} (median of {len(slopes)} orbits, N up to {periods})", slope > -0.05,
        "in a map of the plane both deviations turn into the direction of the curve, at a "
        "distance 1/N each: SALI falls like N^-2, and the threshold -2.5 holds for N = 15 only",
    )  # fmt: skip


def _later(fine: Alignment) -> Comparison:
    """Say what is left later, on a finer grid."""
    total, known = fine.index.size, fine.index[np.isfinite(fine.index)]
    chaotic, regular = int((known <= ALIGNED).sum()), int((known > ALIGNED).sum())
    return claim(
        f"{len(fine.x)} x {len(fine.v)} states, {fine.periods} periods: chaotic, in Omega_NS",
        f"{percent(62, 484)} (62 of 484, N = 15)", f"{percent(chaotic, total)} (SALI <= 1e-8)",
        abs(chaotic / total - 62 / 484) < 0.005,
        "most orbits that are chaotic after 15 periods turn and stick later: transients, in "
        f"Omega_dissip; regular are {percent(regular, total)} here, {percent(165, 484)} there",
    )  # fmt: skip


FIGURE = Figure("SALI map around the elliptic orbit", compute, "states:alignment", (8.6, 4.4))
