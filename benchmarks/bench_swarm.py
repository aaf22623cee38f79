"""Speed of the float flow of many orbits, against one without compiler in the same run.

    python -m pytest -n0 benchmarks/bench_swarm.py --benchmark-columns=min,median

The states are spread over [-1, 1] x [-2, 2] at the paper's parameters.  Extra information:
states times periods in a second; the peer is `cap.flow.itinerary`, in pure Python.
"""

import subprocess
import sys
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.engine import swarm
from cap.floats.models.engine import Engine
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER
from cap.system.friction import oscillator as model

ELLIPTIC = 0.1002798898441954, 0.5419433067664584
DAMPED = replace(PAPER, e=Fraction(9, 10), mu=Fraction(1, 20))


def spread(count):
    random = np.random.default_rng(0)
    return random.uniform([-1, -2], [1, 2], size=(count, 2))


def report(benchmark, work):
    if benchmark.stats:  # not with --benchmark-disable
        benchmark.extra_info["states x periods / s"] = round(work / benchmark.stats.stats.median)


@pytest.mark.parametrize("p", [PAPER, DAMPED], ids=["paper", "damped"])
def test_from_the_model(benchmark, p):
    """The engine made from the model: to be compared with one thread below."""
    engine, states = Engine(model(p)), spread(10_000)
    engine.follow(states[:1])  # compiles
    benchmark(engine.follow, states, periods=5)
    report(benchmark, 50_000)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("p", [PAPER, DAMPED], ids=["paper", "damped"])
def test_swarm(benchmark, monkeypatch, p, threads):
    monkeypatch.setattr("os.cpu_count", lambda: threads)
    states = spread(10_000)
    swarm.follow(p, states[:1], 1)
    benchmark.pedantic(swarm.follow, (p, states, 100), rounds=3)
    report(benchmark, len(states) * 100)


def test_swarm_with_derivatives(benchmark):
    states = spread(10_000)
    benchmark.pedantic(
        swarm.follow, (PAPER, states, 100), {"every": True, "derivative": True}, rounds=3
    )
    report(benchmark, len(states) * 100)


def test_swarm_without_turning(benchmark):
    """The elliptic orbit, 10000 times: compare with the peer."""
    states = np.tile(ELLIPTIC, (10_000, 1))
    result = benchmark.pedantic(swarm.follow, (PAPER, states, 10), rounds=3)
    report(benchmark, len(states) * 10)
    assert not result.turned.any()


def test_peer_pure_python(benchmark):
    benchmark(itinerary, PAPER, *ELLIPTIC, end=2 * np.pi)
    report(benchmark, 1)


@pytest.mark.parametrize("cache", ["cold", "warm"])
def test_first_orbit_of_a_process(benchmark, tmp_path, monkeypatch, cache):
    """Import, compile or load from the cache, one orbit."""
    program = "from cap.floats import swarm, flow; from cap.parameters import PAPER; "
    program += "swarm.follow(PAPER, [(0.1, 0.5)], 1)"
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    run = [sys.executable, "-c", program]
    if cache == "warm":
        subprocess.run(run, check=True)  # noqa: S603 (our own program)
    benchmark.pedantic(subprocess.run, (run,), {"check": True}, rounds=1 if cache == "cold" else 3)
