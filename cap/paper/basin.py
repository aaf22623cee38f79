"""fig:basin: which states around the elliptic orbit turn or stick, and the basin entropies."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics import entropy
from cap.floats.diagnostics.entropy import Entropy
from cap.floats.diagnostics.fate import Fate, fate
from cap.floats.diagnostics.grid import Box, around, grid
from cap.floats.diagnostics.stops import stops
from cap.paper.figure import Found, Run, elliptic, percent
from cap.parameters import PAPER

REACH = 0.10, 0.07
SIDE, PERIODS, BOX = 60, 25, 5
PAPERS = {"cells": 814, "mean": 0.189, "boundary": 0.349}
UNIT = 0.001  # of its last digits
NOISE = 1e-8  # of the starts: as large as an error of another integrator may become
RUNS = 40
SIZES = 2, 3, 4, 5, 6, 8, 10, 12, 15, 20  # of boxes


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


def box() -> Box:
    """Return the box of the paper's partition."""
    return around(PAPER, elliptic(), REACH)


@cache
def _spread(run: Run) -> Spread:
    """Repeat the paper's computation with starts moved at random by `NOISE`."""
    cells = grid(PAPER, box(), SIDE)
    states = cells.states(slice(0, cells.count))
    found = []
    for seed in range(run.size(RUNS, 4)):
        moved = states + NOISE * np.random.default_rng(seed).standard_normal(states.shape)
        lost = ~stops(PAPER, moved, PERIODS).never.reshape(cells.shape)
        own = entropy.entropy(lost, BOX)
        found.append((float((~lost).sum()), own.mean, own.boundary))
    return Spread(*np.array(found).T)


@cache
def _paper() -> Fate:
    """Reproduce the paper's partition."""
    return fate(PAPER, orbit=elliptic(), box=box(), points=SIDE, periods=PERIODS)


def _finer(run: Run, periods: int) -> Fate:
    """Compute a partition with more states."""
    return fate(
        PAPER,
        orbit=elliptic(),
        box=box(),
        points=run.size(360, 120),
        periods=periods,
        runner=run.runner,
        briefly=not run.drawn,
    )


@cache
def _better(run: Run) -> Fate:
    """Compute one with more states and more periods."""
    return _finer(run, run.size(200, 50))


@cache
def _early(run: Run) -> NDArray[np.bool_]:
    """Return which of more states turn or stick within the paper's periods."""
    return _finer(run, PERIODS).dissipates


def data(run: Run) -> Basins:
    """Compute both partitions."""
    return Basins(_paper(), _better(run))


def counted(run: Run) -> Found:
    """Count the paper's cells, find the entropies, and how far chance changes them."""
    paper, moved = _paper(), _spread(run)
    own, never = entropy.entropy(paper.dissipates, BOX), paper.counts["never turns"]
    ranges = {name: (getattr(moved, name).min(), getattr(moved, name).max()) for name in PAPERS}
    return {
        "never": never,
        "share": 100 * never / paper.fate.size,
        "mean": own.mean,
        "boundary": own.boundary,
        "noise": NOISE,
        "runs": len(moved.cells),
        "low": ranges["cells"][0],
        "high": ranges["cells"][1],
        "means": ranges["mean"],
        "boundaries": ranges["boundary"],
        "within": all(
            low - unit <= PAPERS[name] <= high + unit
            for (name, (low, high)), unit in zip(ranges.items(), (0, UNIT, UNIT), strict=True)
        ),
    }


def _parts(lost: NDArray[np.bool_]) -> Found:
    """Return the share that never turns and the entropies, in boxes of the paper's size."""
    own = entropy.entropy(lost, BOX * len(lost) // SIDE)
    return {"share": 100 * float((~lost).mean()), "mean": own.mean, "boundary": own.boundary}


def finer(run: Run) -> Found:
    """Look at more states."""
    return _parts(_early(run))


def longer(run: Run) -> Found:
    """Look at more states, for more periods."""
    return _parts(_better(run).dissipates)


def against_log_2(_run: Run) -> Found:
    """Compare the entropies with log 2."""
    own: Entropy = entropy.entropy(_paper().dissipates, BOX)
    log_2 = math.log(2)
    below = own.boundary < log_2
    return {"mean": own.mean, "boundary": own.boundary, "log_2": log_2, "below": below}


def exponent(run: Run) -> Found:
    """Fit the uncertainty exponent."""
    early = _early(run)
    sizes = [size for size in SIZES if size <= len(early) // 6]
    means = [entropy.entropy(early, size).mean for size in sizes]
    slope = float(np.polyfit(np.log(sizes), np.log(means), 1)[0])
    return {
        "slope": slope,
        "fractal": slope < 0.9,
        "smallest": sizes[0],
        "largest": sizes[-1],
        "side": len(early),
    }


def blue_cells(run: Run) -> Found:
    """Say what becomes of the cells that do not turn within the paper's periods."""
    paper, periods = _paper(), run.size(5000, 500)
    rows, columns = np.nonzero(paper.fate == 0)
    states = np.stack([paper.x[columns], paper.v[rows]], axis=-1)
    lost = int((~stops(PAPER, states, periods).never).sum())
    return {
        "lost": lost,
        "cells": len(states),
        "periods": periods,
        "none": lost == 0,
        "share": percent(lost, len(states)),
    }
