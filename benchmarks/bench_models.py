"""Speed of the float flow of the examples, made from their models, in processor time.

    python -m pytest -n0 benchmarks/bench_models.py --benchmark-columns=min,median

Extra information: states times periods in a second of one core.  States are where orbits from all
over are after a while; the wall clock of a machine that does other work, too, says nothing.
"""

import time
from pathlib import Path

import numpy as np
import pytest

from cap.floats.models.subject import Subject
from cap.system.files import load

EXAMPLES = Path(__file__).parents[1] / "examples"
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.py") if path.stem != "billiard")
STATES, PERIODS = 4000, 5


@pytest.mark.parametrize("name", NAMES)
def test_example(benchmark, name):
    model = Subject(load(EXAMPLES / f"{name}.py"))
    seeds = model.seeds(STATES, model.box)
    settled = model.engine.follow(seeds, periods=100)
    well = np.isfinite(settled.states).all(axis=1)
    states, modes = settled.states[well], settled.modes[well]
    spent = []

    def follow():
        begin = time.process_time()
        ends = model.engine.follow(states, modes, periods=PERIODS)
        spent.append(time.process_time() - begin)
        return ends

    ends = benchmark(follow)
    benchmark.extra_info["states x periods / s"] = round(len(states) * PERIODS / np.median(spent))
    events = ends.counts.sum() / (len(states) * PERIODS)
    benchmark.extra_info["events a period"] = round(float(events), 2)
