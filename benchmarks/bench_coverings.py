"""Speed of coverings: all those of a stored certificate, compiled and as the checker sees them.

    python -m pytest -n0 benchmarks/bench_coverings.py -s

Each line ends with boxes a second on one core; the checker's are those of every tenth set.
"""

import json
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.areas.parallelograms import planar
from cap.areas.parallelograms.covering import Engine, numbers
from cap.checker.coverings import formulas
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.half_period import HalfPeriod
from cap.checker.kernel.shapes import matched
from cap.system.files import planar as read

ROOT = Path(__file__).parents[1]
MAPS = {"horseshoe-1": "", "map_horseshoe-1": "henon.py", "map_horseshoe-2": "standard.py"}


def maps(name, parameters):
    """Return the map for the checker, and compiled."""
    if not MAPS[name]:
        q = {key: Fraction(text) for key, text in parameters.items()}
        a = (q["r"] - q["l"]) * q["omega"] ** 2 / (2 * q["F"])
        return HalfPeriod(q["f"] / q["F"], a), planar.half_period(q["f"] / q["F"], a)
    exact = formulas.Map(formulas.formulas(matched(parameters, formulas.FORMULAS, "the map")))
    return exact, planar.formulas(read(ROOT / "examples/maps" / MAPS[name]))


@pytest.mark.parametrize("name", MAPS)
def test_coverings(name):
    """The aim is 10^5 boxes a second in compiled code."""
    stored = json.loads((ROOT / f"certificates/{name}.json").read_text(encoding="utf-8"))
    sets = [[Fraction(q) for q in row] for row in stored["hints"]["sets"]]
    edges = [[int(j) for j in row] for row in stored["hints"]["coverings"]]
    exact, compiled = maps(name, stored["parameters"])
    engine, known = Engine(compiled), np.array([numbers(one) for one in sets])
    engine.covered(known[0], known[edges[0]])  # compiles it
    engine.boxes, start = 0, time.process_time()
    assert all(engine.covered(known[i], known[of_i]).all() for i, of_i in enumerate(edges))
    fast = engine.boxes / (time.process_time() - start)
    start, some = time.process_time(), range(0, len(sets), 10)
    shapes = [Parallelogram(one) for one in sets]
    boxes = sum(covers(exact, shapes[i], [shapes[j] for j in edges[i]]) for i in some)
    slow = boxes / (time.process_time() - start)
    print(f"\n{name}: {engine.boxes} boxes, {fast:.2g} a second; the checker {slow:.2g}")
