"""Speed of exploring, against a plain event-driven solve_ivp in the same run.

    python -m pytest -n0 benchmarks/bench_explore.py --benchmark-columns=min,median

The states are spread over [-1, 1] x [-2, 2] at the paper's parameters.  The peer is scipy's DOP853
with events at the walls and at v = 0, at the tolerance at which it agrees with us to 1e-9.
Needs scipy.
"""

import math
import time
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.diagnostics import alignment, fate
from cap.floats.engine import swarm
from cap.floats.search.orbits import search
from cap.parameters import PAPER
from cap.runner import Runner

solve_ivp = pytest.importorskip("scipy.integrate").solve_ivp

TOLERANCE = 1e-11
PERIODS = 5
FASTER = 100
F, OMEGA, FRICTION, WALL = float(PAPER.F), float(PAPER.omega), float(PAPER.f), float(PAPER.r)
PLANE = -1.0, 1.0, -2.0, 2.0


def crossing(function):
    function.terminal = True
    return function


def peer(x, v, end):
    """Return the state at ``end``: flights by solve_ivp, and what happens at its events."""
    t, arc = 0.0, math.acos(FRICTION / F)
    direction = math.copysign(1.0, v)
    while t < end:
        if direction == 0:  # it sticks until the forcing exceeds friction
            phases = [(-arc, 1.0), (math.pi - arc, -1.0)]
            waits = [((phase - OMEGA * t) % (2 * math.pi), side) for phase, side in phases]
            wait, direction = min(waits)
            t = min(end, t + wait / OMEGA)
            continue
        s = direction
        events = [
            crossing(lambda _, y, s=s: y[0] - s * WALL),
            crossing(lambda t, y, s=s, t0=t: s * y[1] if t > t0 + 1e-12 else 1.0),
        ]
        flight = solve_ivp(
            lambda t, y, s=s: (y[1], F * math.cos(OMEGA * t) - s * FRICTION),
            (t, end),
            (x, v),
            method="DOP853",
            rtol=TOLERANCE,
            atol=TOLERANCE,
            events=events,
            max_step=0.5,
        )
        t, (x, v) = flight.t[-1], flight.y[:, -1]
        if len(flight.t_events[0]):
            x, v, direction = s * WALL, -v, -s
        elif len(flight.t_events[1]):
            force = F * math.cos(OMEGA * t)
            v, direction = 0.0, -s if -s * force > FRICTION else 0.0
    return x, v


def spread(count):
    random = np.random.default_rng(1)
    return random.uniform([-0.9, 0.4], [0.9, 2], size=(count, 2))


def test_against_solve_ivp(benchmark):
    """States times periods in a second, ours over the peer's; the same states at the end."""
    few, many = spread(20), spread(20_000)
    swarm.follow(PAPER, few, 1)
    began = time.perf_counter()
    theirs = np.array([peer(x, v, PERIODS * 2 * math.pi / OMEGA) for x, v in few])
    slow = len(few) * PERIODS / (time.perf_counter() - began)
    benchmark.pedantic(swarm.follow, (PAPER, many, PERIODS), rounds=3)
    began = time.perf_counter()
    swarm.follow(PAPER, many, PERIODS)
    fast = len(many) * PERIODS / (time.perf_counter() - began)
    ours = swarm.follow(PAPER, few, PERIODS)
    # chaos multiplies the peer's errors: those of the well-conditioned orbits are compared
    error = np.abs(ours.states - theirs).max(axis=1)
    assert np.median(error) < 1e-9
    assert fast > FASTER * slow
    benchmark.extra_info["states x periods / s"] = round(fast)
    benchmark.extra_info["of solve_ivp"] = round(slow)
    benchmark.extra_info["times faster"] = round(fast / slow)


def test_a_basin_of_a_million_states(benchmark):
    """1000 x 1000 states, 100 periods, two cores."""
    options = {"box": PLANE, "points": 1000, "periods": 100, "runner": Runner(2)}
    result = benchmark.pedantic(fate.fate, (PAPER,), options, rounds=1)
    assert (result.fate >= 0).all()
    if benchmark.stats:  # not with --benchmark-disable
        assert benchmark.stats.stats.max < 60


def test_sali(benchmark):
    """300 x 300 states, 15 periods, with the derivative."""
    options = {"points": 300, "runner": Runner(2)}
    benchmark.pedantic(alignment.sali, (PAPER,), options, rounds=2)


def test_search(benchmark):
    """All T-periodic orbits at F = 3: seeds over the plane, a transient, mirror images."""
    strong = replace(PAPER, F=Fraction(3))
    found = benchmark.pedantic(search, (strong,), rounds=3)
    assert len(found.isolated) == 25
