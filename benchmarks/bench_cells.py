"""Speed of sweeps over cells of states in compiled, outward-rounded doubles, in processor time.

    python -m pytest -n0 benchmarks/bench_cells.py --benchmark-columns=min,median

The cells are equal parts of a rectangle, 10^5 of them, each followed from hit to hit until it
rests, flies at the end, or nothing is certain any more.  Extra information: cells in a second of
one core, and the shares of the cells that rest, and that fly; the checker's cells in a second.
"""

import json
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.areas.resting.asked import Rectangle, driven, numbers
from cap.areas.resting.fates import FLIES, RESTS, fates
from cap.areas.resting.pull import table
from cap.checker.verdict import check
from cap.orbits.wall import wall
from cap.sets import interval
from cap.sets.compiled import PROBE
from cap.system.files import read

ROOT = Path(__file__).parents[1]
CASES = {  # amplitude, rectangle, start and end
    "a slow table": ("3/10", ("0", "2", "-2", "2"), "0", "6"),
    "a faster one": ("6/5", ("1/5", "6/5", "-1", "1"), "3", "7"),
    "two periods": ("6/5", ("0", "1", "-1", "1"), "0", "14"),
}
ROWS, COLUMNS = 400, 250


def places():
    """Return the cells by their ends."""
    x, y = np.arange(ROWS) / ROWS, np.arange(COLUMNS) / COLUMNS
    x, y = (z.ravel() for z in np.meshgrid(x, y))
    return np.stack([x, x + 1 / ROWS, y, y + 1 / COLUMNS], axis=1)


@pytest.mark.parametrize("name", CASES)
def test_cells(benchmark, name):
    amplitude, ends, start, until = CASES[name]
    place = wall(read(ROOT / "examples/ball.py", {"A": Fraction(amplitude)}))
    a, b, c, d = map(Fraction, ends)
    asked = Rectangle(Fraction(start), Fraction(until), {"y": (a, b), "v": (c, d)})
    with interval.workprec(128):
        pull, sides = numbers(place, driven(place), asked)
    grid, cells = table(pull), places()
    found, spent = np.empty(len(cells), dtype=np.int8), []

    def sweep():
        begin = time.process_time()
        fates(pull, grid, PROBE, sides, cells, found)
        spent.append(time.process_time() - begin)

    benchmark.pedantic(sweep, rounds=5, warmup_rounds=1)
    benchmark.extra_info["cells / s"] = round(len(cells) / np.median(spent))
    for key, fate in (("rest", RESTS), ("fly", FLIES)):
        benchmark.extra_info[key] = round(float((found == fate).mean()), 3)


def test_the_checker(benchmark):
    data = (ROOT / "certificates/contact_basin-1.json").read_bytes()
    tree, spent = json.loads(data)["hints"]["tree"], []

    def verify():
        begin = time.process_time()
        check(data, lambda _: None)
        spent.append(time.process_time() - begin)

    benchmark.pedantic(verify, rounds=3, warmup_rounds=1)
    cells = tree.count("r") + tree.count("f")
    benchmark.extra_info["cells / s"] = round(cells / np.median(spent))
