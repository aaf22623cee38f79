"""fig:sali: the smaller alignment index around the elliptic orbit."""

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics import alignment
from cap.floats.diagnostics.alignment import CHAOTIC, REGULAR, THRESHOLD, TURNED, Alignment
from cap.floats.diagnostics.grid import Box, around, grid
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.floats.search import periodic
from cap.paper.figure import Found, Refined, Run, differences, elliptic, percent
from cap.parameters import PAPER

REACH = 0.07, 0.05
SIDE, PERIODS = 22, 15
CELLS = SIDE**2
PAPERS = {"chaotic": 62, "regular": 165}  # cells
ALIGNED = 1e-8  # SALI of chaotic orbits after many periods
SADDLE = 0.3435, 0.7753  # a state nearby
SEEDS = 20  # of the random deviations
LEAST = 1e-17  # SALI that is told from 0


class Derivatives(NamedTuple):
    """Φ' along orbits (N, K, 2, 2) by differences and exactly, and which orbits turn."""

    rough: Floats
    exact: Floats
    turned: NDArray[np.bool_]


def box() -> Box:
    """Return the box of the paper's map."""
    return around(PAPER, elliptic(), REACH)


@cache
def coarse(periods: int) -> Alignment:
    """Compute the paper's map, for some periods."""
    return alignment.sali(PAPER, orbit=elliptic(), box=box(), points=SIDE, periods=periods)


@cache
def _better(run: Run) -> Alignment:
    side, periods = run.size(300, 40), run.size(200, 30)
    return alignment.sali(
        PAPER, orbit=elliptic(), box=box(), points=side, periods=periods, runner=run.runner
    )


def data(run: Run) -> Refined[Alignment]:
    """Compute both maps."""
    return Refined(coarse(PERIODS), _better(run))


def frames(angle: Floats) -> Floats:
    """Return orthonormal deviations (N, 2, 2), one in each row."""
    cos, sin = np.cos(angle), np.sin(angle)
    return np.stack([np.stack([cos, sin], -1), np.stack([-sin, cos], -1)], axis=1)


@cache
def _on_the_grid() -> Derivatives:
    """Follow the paper's states."""
    cells = grid(PAPER, box(), SIDE)
    states = cells.states(slice(0, cells.count))
    found = swarm.follow(PAPER, states, PERIODS, every=True, derivative=True)
    rough = np.stack([differences(found.states[:, k]) for k in range(PERIODS)], axis=1)
    return Derivatives(rough, found.derivatives, found.stopped)


def as_the_paper(_run: Run) -> Found:
    """Count regular and chaotic cells, and find the ends of log10 SALI, in several runs.

    In each the paper's procedure is repeated with other random deviations.
    """
    rough, _, turned = _on_the_grid()
    found: dict[str, list[float]] = {"regular": [], "chaotic": [], "low": [], "high": []}
    for seed in range(SEEDS):
        angle = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(rough))
        units, _ = swarm.stretch(rough, frames(angle))
        index = alignment.smaller(units[:, :, 0], units[:, :, 1])[:, -1]
        log = np.log10(np.maximum(index[~turned], LEAST))
        regular = int((log > THRESHOLD).sum())
        numbers = regular, len(log) - regular, float(log.min()), float(log.max())
        for values, number in zip(found.values(), numbers, strict=True):
            values.append(number)
    return found


def turned(_run: Run) -> Found:
    """Count the cells that turn or stick."""
    return {"cells": int(_on_the_grid().turned.sum())}


def ranges(_run: Run) -> Found:
    """Count the values that lie where they are said to lie."""
    found = coarse(PERIODS)
    with np.errstate(divide="ignore"):
        log = np.log10(np.maximum(found.index, LEAST))
    regular, chaotic = log[found.kinds == REGULAR], log[found.kinds == CHAOTIC]
    top, bottom = int((regular >= -2).sum()), int((chaotic <= -4).sum())
    return {"top": top, "regular": len(regular), "bottom": bottom, "chaotic": len(chaotic)}


def doubled(_run: Run) -> Found:
    """Compare the kinds after N and 2N periods."""
    once, twice = coarse(PERIODS).kinds, coarse(2 * PERIODS).kinds
    changed = int((once != twice).sum())
    gone = int(((once != TURNED) & (twice == TURNED)).sum())
    return {"changed": changed, "cells": once.size, "gone": gone}


def differences_taken(_run: Run) -> Found:
    """Measure the error of the paper's differences."""
    rough, exact, turned = _on_the_grid()
    error = np.abs(rough[~turned] - exact[~turned]).max(axis=(1, 2, 3))
    return {"median": np.median(error), "most": error.max()}


def revolutions(_run: Run) -> Found:
    """Return how often a regular orbit goes around P_*."""
    matrix = swarm.follow(PAPER, [elliptic()], 1, derivative=True).derivatives[0]
    return {"number": float(PERIODS * np.arccos(np.trace(matrix) / 2) / (2 * np.pi))}


def stretched(_run: Run) -> Found:
    """Return the logarithm of the growth along chaotic orbits."""
    chaotic = coarse(PERIODS).kinds.ravel() == CHAOTIC
    _, logs = swarm.stretch(_on_the_grid().exact[chaotic], [[0.6, 0.8]])
    total = logs[..., 0].sum(axis=1)
    exponent = np.arccosh(periodic.near(PAPER, *SADDLE).trace / 2)
    growth = float(np.median(total)) if len(total) else np.nan
    return {"growth": growth, "saddle": PERIODS * exponent}


def power(run: Run) -> Found:
    """Fit how SALI falls along regular orbits."""
    periods, (x, v) = run.size(10_000, 1000), elliptic()
    distance = np.linspace(0.02, 0.04, 24)
    starts = np.stack([x + distance, np.full_like(distance, v)], axis=-1)
    found = swarm.follow(PAPER, starts, periods, every=True, derivative=True)
    units, _ = swarm.stretch(found.derivatives, frames(np.zeros(len(starts))))
    curves = alignment.smaller(units[:, :, 0], units[:, :, 1])
    regular = ~found.stopped & (curves[:, -1] > 1e-11)
    late = slice(periods // 10, None)
    n = np.log(np.arange(1, periods + 1)[late])
    slopes = [np.polyfit(n, np.log(curve[late]), 1)[0] for curve in curves[regular]]
    slope = float(np.median(slopes)) if slopes else np.nan
    return {"slope": slope, "orbits": len(slopes), "periods": periods}


def later(run: Run) -> Found:
    """Say what is left later, on a finer grid."""
    index = _better(run).index
    known = index[np.isfinite(index)]
    chaotic, regular = int((known <= ALIGNED).sum()), int((known > ALIGNED).sum())
    return {
        "chaotic": percent(chaotic, index.size),
        "same": abs(chaotic / index.size - PAPERS["chaotic"] / CELLS) < 0.005,
        "regular": percent(regular, index.size),
        "stated": percent(PAPERS["regular"], CELLS),
    }
