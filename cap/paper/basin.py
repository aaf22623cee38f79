"""fig:basin: which states around the elliptic orbit turn or stick, and the basin entropies."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.audit.comparison import (
    Comparison,
    claim,
    count,
    number,
    percent,
    roughly,
    taken_from,
)
from cap.floats.diagnostics import entropy
from cap.floats.diagnostics.entropy import Entropy
from cap.floats.diagnostics.fate import Fate, fate
from cap.floats.diagnostics.grid import Box, around, grid
from cap.floats.diagnostics.stops import stops
from cap.paper.figure import Figure, Result, Run, elliptic
from cap.parameters import PAPER

REACH = 0.10, 0.07
SIDE, PERIODS, BOX = 60, 25, 5
NOISE = 1e-8  # of the starts: as large as an error of another integrator may become
RUNS = 40


@dataclass(frozen=True)
class Basins:
    """The paper's partition, and one with more states and periods."""

    paper: Fate
    better: Fate


@dataclass(frozen=True)
class Spread:
    """The cells that never turn, and the entropies, for starts moved by `NOISE`: (N,) each."""

    cells: NDArray[np.float64]
    mean: NDArray[np.float64]
    boundary: NDArray[np.float64]


def spread(box: Box, runs: int) -> Spread:
    """Repeat the paper's computation with starts moved at random by `NOISE`."""
    cells = grid(PAPER, box, SIDE)
    states = cells.states(slice(0, cells.count))
    found = []
    for seed in range(runs):
        moved = states + NOISE * np.random.default_rng(seed).standard_normal(states.shape)
        lost = ~stops(PAPER, moved, PERIODS).never.reshape(cells.shape)
        own = entropy.entropy(lost, BOX)
        found.append((float((~lost).sum()), own.mean, own.boundary))
    return Spread(*np.array(found).T)


def compute(run: Run) -> Result:
    """Reproduce the paper's partition, and compute a better one."""
    centre = elliptic()
    box = around(PAPER, centre, REACH)
    paper = fate(PAPER, orbit=centre, box=box, points=SIDE, periods=PERIODS)
    side, periods = run.size(360, 120), run.size(200, 50)
    briefly = not run.drawn
    better = fate(
        PAPER,
        orbit=centre,
        box=box,
        points=side,
        periods=periods,
        runner=run.runner,
        briefly=briefly,
    )
    early = better.first <= PERIODS * 2 * math.pi / float(PAPER.omega)  # never: nan, not early
    own = entropy.entropy(paper.dissipates, BOX)
    moved = spread(box, run.size(RUNS, 4))
    rows = [
        *_counted(paper, own, moved),
        *_finer(early, better),
        claim("S_b and S_bb against log 2", "both below", f"{own.mean:.3f}, {own.boundary:.3f} < "
              f"{math.log(2):.3f}", own.boundary < math.log(2)),
        number("log 2", "0.693", math.log(2)),
        _exponent(early),
        _isolated(paper, run),
    ]  # fmt: skip
    return Result(tuple(rows), Basins(paper, better))


def _counted(paper: Fate, own: Entropy, moved: Spread) -> list[Comparison]:
    """Compare the counts and entropies, and how far chance changes them."""
    never = paper.counts["never turns"]
    low, high = moved.cells.min(), moved.cells.max()
    chance = (
        f"orbits near the border are chaotic: starts moved by {NOISE:g} give {low:.0f} to "
        f"{high:.0f} cells in {len(moved.cells)} runs, so the last digits are an integrator's"
    )

    def range_of(values: NDArray[np.float64]) -> str:
        return f"{chance}; here {values.min():.3f} to {values.max():.3f}"

    return [
        roughly(count("cells in Omega_NS of 3600", 814, never, chance)),
        number("share of Omega_NS [%]", "22.6", 100 * never / paper.fate.size, chance),
        *(roughly(row) for row in taken_from("eq:Sb-num", [
            number("S_b, boxes of 5 x 5", "0.189", own.mean, range_of(moved.mean)),
            number("S_bb", "0.349", own.boundary, range_of(moved.boundary)),
        ])),
        claim("the same with another integrator's rounding", "814; 0.189; 0.349",
              f"{low:.0f} to {high:.0f}; {moved.mean.min():.3f} to {moved.mean.max():.3f}; "
              f"{moved.boundary.min():.3f} to {moved.boundary.max():.3f}",
              bool(low <= 814 <= high) and _holds(moved.mean, 0.189)
              and _holds(moved.boundary, 0.349),
              "the paper's numbers are outside what chance explains"),
    ]  # fmt: skip


def _holds(values: NDArray[np.float64], printed: float) -> bool:
    return bool(values.min() - 0.001 <= printed <= values.max() + 0.001)


def _finer(early: NDArray[np.bool_], better: Fate) -> list[Comparison]:
    """Compare the share and the entropies with more states, and with more periods."""
    side = len(early)
    boxes = BOX * side // SIDE
    lost = early, better.dissipates
    own, late = (entropy.entropy(each, boxes) for each in lost)
    why = "60 x 60 states sample the border roughly"
    longer = (
        f"{PERIODS} periods are too few: many orbits outside the island turn later; the entropies "
        "fall with them"
    )
    states, periods = f"{side} x {side} states", f"{better.periods} periods"
    shares = [100 * float((~each).mean()) for each in lost]
    rows = [
        number(f"share of Omega_NS [%], {states}", "22.6", shares[0], why),
        number(f"S_b, {states}, boxes of the same size", "0.189", own.mean, why),
        number(f"S_bb, {states}", "0.349", own.boundary,
               f"{why}: more boxes touch the border, each less"),
        number(f"share of Omega_NS [%], {states}, {periods}", "22.6", shares[1], longer),
        number(f"S_b, {states}, {periods}", "0.189", late.mean, longer),
        number(f"S_bb, {states}, {periods}", "0.349", late.boundary,
               f"{longer}; S_bb still depends on the grid"),
    ]  # fmt: skip
    return [roughly(row) for row in rows]


def _exponent(early: NDArray[np.bool_]) -> Comparison:
    """Fit the uncertainty exponent."""
    sizes = [size for size in (2, 3, 4, 5, 6, 8, 10, 12, 15, 20) if size <= len(early) // 6]
    means = [entropy.entropy(early, size).mean for size in sizes]
    slope = float(np.polyfit(np.log(sizes), np.log(means), 1)[0])
    return claim(
        "border of Omega_NS", "fractal structure is expected at finer grids",
        f"S_b ~ size^{slope:.2f}, where a smooth border has 1", slope < 0.9,
        "S_b falls as for a smooth border",
        note=f"after {PERIODS} periods, boxes of {sizes[0]} to {sizes[-1]} cells of {len(early)}",
    )  # fmt: skip


def _isolated(paper: Fate, run: Run) -> Comparison:
    """Say what becomes of the cells outside the island."""
    periods = run.size(5000, 500)
    rows, columns = np.nonzero(paper.fate == 0)
    states = np.stack([paper.x[columns], paper.v[rows]], axis=-1)
    lost = int((~stops(PAPER, states, periods).never).sum())
    return claim(
        "blue cells", "in Omega_NS; outside the island: on stable manifolds of saddles",
        f"{lost} of {len(states)} turn or stick within {periods} periods", lost == 0,
        f"{percent(lost, len(states))} are transients: 25 periods do not show Omega_NS, and a grid "
        "point on a manifold has probability 0",
    )  # fmt: skip


FIGURE = Figure("basin partition and basin entropy", compute, "states:basins", (8.0, 4.6))
