"""The schematic figures: drawn from computed orbits where there is something to compute."""

import math
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from cap.floats.diagnostics.attractor import Attractor, attractors
from cap.floats.diagnostics.fate import Fate, fate
from cap.floats.diagnostics.portrait import Portrait, portrait
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.findings import Floats, State
from cap.floats.search import periodic
from cap.paper.figure import Found, Run, elliptic, percent
from cap.parameters import PAPER

# the cover


class Lifted(NamedTuple):
    """An orbit, its lift q(t), and x over q."""

    orbit: Trajectory
    q: Floats
    wave: tuple[Floats, Floats]


def wave(q: Floats) -> Floats:
    """Return the triangular wave W(q) of eq:Wq."""
    part = np.mod(q, 2)
    return np.asarray(np.where(part < 1, part, 2 - part))


def folded(q: Floats) -> Floats:
    """Return the positions x that have these lifts."""
    return np.asarray(float(PAPER.l) + float(PAPER.R) * wave(q))


@cache
def lifted(_run: Run) -> Lifted:
    """Lift the elliptic orbit."""
    orbit = trajectory(PAPER, orbit=elliptic(), exactly=True, periods=3)
    length = float(PAPER.R)
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(orbit.x)))]) / length
    shown = np.linspace(0, 7, 701)
    return Lifted(orbit, (orbit.x[0] - float(PAPER.l)) / length + way, (shown, folded(shown)))


def cover(run: Run) -> Found:
    """Look at the lift where the orbit hits a wall."""
    orbit, q, _ = lifted(run)
    force = float(PAPER.F) * abs(math.cos(float(PAPER.omega) * float(orbit.times[0])))
    return {
        "period": 2.0 if np.allclose(wave(q + 2), wave(q)) else math.nan,
        "back": np.abs(folded(q) - orbit.x).max(),
        "growth": float(q[-1] - q[0]) / 3,
        "jump": 2 * force / float(PAPER.R),
    }


# the decomposition


@dataclass(frozen=True)
class Decomposition:
    """Who turns in the whole plane, curves around both elliptic points, saddles, attractors."""

    basin: Fate
    islands: tuple[Portrait, Portrait]
    points: dict[str, list[State]]
    attractors: tuple[Attractor, ...]


@cache
def _orbits(_run: Run) -> dict[str, list[State]]:
    found = periodic.orbits(PAPER, 2)
    return {
        kind: [(each.x, each.v) for each in found if each.kind == kind]
        for kind in ("elliptic", "saddle")
    }


@cache
def _basin(run: Run) -> Fate:
    return fate(
        PAPER,
        box=(-1.0, 1.0, -1.6, 1.6),
        points=run.size(400, 60),
        periods=run.size(100, 30),
        runner=run.runner,
        briefly=not run.drawn,
    )


@cache
def _attractors(run: Run) -> tuple[Attractor, ...]:
    transient = run.size(1000, 100)
    return attractors(PAPER, points=run.size(24, 6), transient=transient, periods=130).found


def decomposition(run: Run) -> Decomposition:
    """Compute what the sketch shows."""
    orbits = _orbits(run)
    islands = [
        portrait(PAPER, orbit=state, radius=0.022, orbits=run.size(60, 10), periods=200)
        for state in orbits["elliptic"]
    ]
    turning = tuple(each for each in _attractors(run) if each.kind != "never turns")
    return Decomposition(_basin(run), (islands[0], islands[-1]), orbits, turning)


def points(run: Run) -> Found:
    """Count the orbits that never turn."""
    return {kind: len(states) for kind, states in _orbits(run).items()}


def turning(run: Run) -> Found:
    """Count the states that turn, and those that do so late."""
    basin = _basin(run)
    never = basin.counts["never turns"]
    first = basin.first[np.isfinite(basin.first)]
    late = int((first > 2 * math.pi / float(PAPER.omega)).sum())
    return {
        "late": percent(late, len(first)),
        "never": percent(never, basin.fate.size),
        "periods": basin.periods,
    }


def ends(run: Run) -> Found:
    """Tell the attractors apart."""
    kinds = [f"{each.kind} ({each.share:.1%} of the seeds)" for each in _attractors(run)]
    return {"kinds": "; ".join(kinds), "number": len(kinds)}
