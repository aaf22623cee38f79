"""fig:impulse-bound: the elliptic orbit as F falls, and a forcing that holds no such orbit."""

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from cap.floats.diagnostics.grid import grid, whole
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.one_one import asymmetry, pair_member, root, symmetric_member, turn
from cap.floats.search import periodic
from cap.floats.search.periodic import Guess
from cap.paper.figure import Found, Run, elliptic
from cap.paper.rows import Row, Rows
from cap.parameters import PAPER, at

PANELS = {"0.95": "a", "0.85": "b"}
LOW, START = "0.62", (0.0, 0.7)
SHIFT, ITERATES = 0.005, 800


class Near(NamedTuple):
    """The elliptic orbit at F, what it is, and iterates of a state beside it."""

    own: Guess
    kind: str
    start: State
    iterates: Floats
    leaves: bool


@cache
def _near(F: str) -> Near:
    p, (x, v) = at(F=F), elliptic(F)
    own = periodic.near(p, x, v)
    start = x, v + SHIFT
    seen = swarm.follow(p, [start], ITERATES, every=True)
    half = own.hit_times[1] - own.hit_times[0]
    symmetric = abs(half - math.pi / float(p.omega)) < 1e-6
    kind = "symmetric orbit" if symmetric else "asymmetric, one of a pair"
    return Near(own, kind, start, seen.states[0], bool(seen.turned[0] or seen.stuck[0]))


def data(_run: Run) -> Rows:
    """Follow the orbits of the three panels."""
    low = trajectory(at(F=LOW), orbit=START, exactly=True, periods=4)
    shown = *map(_row, PANELS), Row(low, f"(c) $F = {LOW}$: from $(0, 0.7)$")
    return Rows(shown, "Towards the bound $F = \\pi f/2$", ("F",))


def _row(F: str) -> Row:
    near = _near(F)
    picture = trajectory(at(F=F), orbit=near.start, exactly=True, periods=4)
    words = f"({PANELS[F]}) $F = {F}$: {near.kind}, tr $= {near.own.trace:.3f}$"
    return Row(picture, words, near.iterates)


def panel(_run: Run, F: str) -> Found:
    """Find the orbit of a panel, and how far iterates stray from a curve."""
    near = _near(F)
    off = thickness(near.iterates - np.array(elliptic(F)))
    strays = f"never turns, strays {off:.0e} of the distance from a curve"
    return {
        "trace": near.own.trace,
        "turn": float(turn(near.own.trace)),
        "hits": len(near.own.hit_times),
        "strays": "turns" if near.leaves else strays,
        "stays": not near.leaves,
        "kind": near.kind,
    }


def thickness(points: Floats) -> float:
    """Return how far points are from a curve given by some harmonics of their angle."""
    points = points - points.mean(axis=0)
    axes = np.linalg.svd(points, full_matrices=False)[2]
    plane = points @ axes.T / (points @ axes.T).std(axis=0)
    angle, radius = np.arctan2(plane[:, 1], plane[:, 0]), np.hypot(*plane.T)
    k = np.arange(25)
    terms = np.concatenate([np.cos(np.outer(angle, k)), np.sin(np.outer(angle, k[1:]))], axis=1)
    fit, *_ = np.linalg.lstsq(terms, radius, rcond=None)
    return float(np.abs(terms @ fit - radius).max() / radius.mean())


def below(_run: Run) -> Found:
    """Follow the orbit of panel (c), below the bound."""
    events = swarm.itinerary(at(F=LOW), START, 12)
    turns, sticks, releases = (
        [event for event in events if event.word.split()[0] == kind]
        for kind in ("turn", "stick", "release")
    )
    rests = [e.time - s.time for s, e in zip(sticks, releases, strict=False)]
    return {
        "rest": sticks[0].time,
        "turn": turns[0].time,
        "rests": rests[-1],
        "last": sticks[-1].x,
        "before": sticks[-2].x,
        "drift": abs(sticks[-1].x - sticks[-3].x),
    }


def everybody(run: Run) -> Found:
    """Count the orbits below the bound that turn or stop within 20 periods."""
    p = at(F=LOW)
    cells = grid(p, whole(p), run.size(200, 40))
    seen = swarm.follow(p, cells.states(slice(0, cells.count)), 20)
    return {"lost": seen.stopped.sum(), "count": cells.count}


def resonances(_run: Run) -> Found:
    """Find the F at which the orbits take the rotation numbers that the paper names."""
    f, length = float(PAPER.f), float(PAPER.R)

    def birth(F: float) -> float:
        return 2 * F / math.pi * math.sqrt(1 - (2 * length / F / (math.pi**2 - 4)) ** 2) - f

    def identity(F: float) -> float:  # of Φ' = -1: S = ρ/(π² - 2)
        return math.sqrt(1 - (math.pi * f / (2 * F)) ** 2) - length / F / (math.pi**2 - 2)

    def pair(F: float) -> float:
        return pair_member(asymmetry(f / F, length / F), length / F).trace

    def plus(F: float) -> float:
        return symmetric_member(f / F, length / F, 1).trace

    def passes(trace: Callable[[float], float], turn: float, low: float, high: float) -> float:
        return root(lambda F: trace(F) - 2 * math.cos(2 * math.pi * turn), low, high)

    fork, half = root(birth, 0.75, 1.0), root(identity, 0.629, 0.8)
    return {
        "fork": fork,
        "smooth": not 0.85 < fork < 1,
        "quarter": [
            passes(pair, 1 / 4, fork + 1e-6, 1.0),
            passes(plus, 1 / 4, half, fork - 1e-6),
        ],
        "third": passes(plus, 1 / 3, half, fork - 1e-6),
        "half": half,
    }
