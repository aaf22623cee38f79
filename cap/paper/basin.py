"""fig:basin: which states around the elliptic orbit turn or stick, and the basin entropies."""

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics import entropy
from cap.floats.diagnostics.fate import Fate, fate
from cap.floats.diagnostics.grid import Box, around, grid
from cap.floats.diagnostics.stops import stops
from cap.floats.findings import Floats
from cap.paper.figure import Found, Refined, Run, elliptic, percent
from cap.parameters import PAPER

REACH = 0.10, 0.07
SIDE, PERIODS, BOX = 60, 25, 5
PAPERS = {"cells": (814, 0), "mean": (0.189, 0.001), "boundary": (0.349, 0.001)}  # and last digits
NOISE = 1e-8  # of the starts: as large as an error of another integrator may become
RUNS = 40
SIZES = 2, 3, 4, 5, 6, 8, 10, 12, 15, 20  # of boxes


def box() -> Box:
    """Return the box of the paper's partition."""
    return around(PAPER, elliptic(), REACH)


@cache
def _paper() -> Fate:
    """Reproduce the paper's partition."""
    return fate(PAPER, orbit=elliptic(), box=box(), points=SIDE, periods=PERIODS)


@cache
def _finer(run: Run, periods: int) -> Fate:
    """Compute a partition with more states."""
    return fate(
        PAPER,
        orbit=elliptic(),
        box=box(),
        points=run.size(360, 120),
        periods=min(periods, run.size(periods, 50)),
        runner=run.runner,
        briefly=not run.drawn,
    )


def data(run: Run) -> Refined[Fate]:
    """Compute both partitions."""
    return Refined(_paper(), _finer(run, 200))


def _parts(lost: NDArray[np.bool_]) -> dict[str, float]:
    """Return the share that never turns and the entropies, in boxes of the paper's size."""
    own = entropy.entropy(lost, BOX * len(lost) // SIDE)
    return {"share": 100 * float((~lost).mean()), "mean": own.mean, "boundary": own.boundary}


@cache
def _moved(run: Run) -> dict[str, Floats]:
    """Return the cells that never turn and the entropies, (N,) each, of starts moved by `NOISE`."""
    cells = grid(PAPER, box(), SIDE)
    states, found = cells.states(slice(0, cells.count)), []
    for seed in range(run.size(RUNS, 4)):
        moved = states + NOISE * np.random.default_rng(seed).standard_normal(states.shape)
        never = stops(PAPER, moved, PERIODS).never.reshape(cells.shape)
        found.append(_parts(~never) | {"cells": float(never.sum())})
    return {name: np.array([each[name] for each in found]) for name in PAPERS}


def counted(run: Run) -> Found:
    """Count the paper's cells, find the entropies, and how far chance changes them."""
    moved = _moved(run)
    ends = {name: (each.min(), each.max()) for name, each in moved.items()}
    within = [
        low - digit <= stated <= high + digit
        for (low, high), (stated, digit) in zip(ends.values(), PAPERS.values(), strict=True)
    ]
    return {
        **_parts(_paper().dissipates),
        "never": _paper().counts["never turns"],
        "log_2": math.log(2),
        "noise": NOISE,
        "runs": len(moved["cells"]),
        "ends": ends,
        "within": all(within),
    }


def finer(run: Run, periods: str) -> Found:
    """Look at more states."""
    return _parts(_finer(run, int(periods)).dissipates)


def exponent(run: Run) -> Found:
    """Fit the uncertainty exponent."""
    early = _finer(run, PERIODS).dissipates
    sizes = [size for size in SIZES if size <= len(early) // 6]
    means = [entropy.entropy(early, size).mean for size in sizes]
    return {
        "slope": float(np.polyfit(np.log(sizes), np.log(means), 1)[0]),
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
        "share": percent(lost, len(states)),
    }
