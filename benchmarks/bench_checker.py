"""The checker's time: of the stored certificates, and of the worst that its limits admit.

    python -m pytest -n0 benchmarks/bench_checker.py --benchmark-columns=min

The worst known, made of true certificates: as many bits as the format allows with their events,
order and cells (certificates/FORMAT.md), and for `persistence` as many cells.
"""

import json
from fractions import Fraction
from itertools import pairwise
from math import isqrt
from pathlib import Path

import pytest

from cap.checker.flow.itinerary import MAX_WORK, work
from cap.checker.theorems import branch
from cap.checker.verdict import check
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import theorems
from cap.proofs.fixed_point import Setting

STORED = Path(__file__).parents[1] / "certificates"
P_STAR = Start.non_sticking(0.10027988984, 0.54194330676, (1.0991729107, 3.5160904414))


def stored(name):
    """Return a stored certificate."""
    return json.loads((STORED / f"{name}.json").read_text())


def checked(benchmark, certificate):
    """Measure the check of a certificate, which must succeed, once."""
    data = json.dumps(certificate).encode()
    benchmark.extra_info["bits"] = certificate["hints"]["bits"]
    benchmark.pedantic(check, (data, lambda _: None), rounds=1)


def with_most_bits(certificate, events, order=0, cells=0):
    """Give a certificate as many bits as it may have."""
    room = MAX_WORK - work(events, 0, order, cells)
    certificate["hints"]["bits"] = str(min(4096, room // work(events, 1, order)))
    return certificate


@pytest.mark.parametrize("path", sorted(STORED.glob("*.json")), ids=lambda path: path.stem)
def test_stored(benchmark, path):
    """Every stored certificate."""
    checked(benchmark, json.loads(path.read_text()))


def test_worst_elliptic(benchmark):
    """Two hits, order 9."""
    ask = Setting(PAPER, P_STAR, 30, order=9)
    certificate = theorems.accepted(theorems.THEOREMS["elliptic"], ask)
    checked(benchmark, with_most_bits(certificate, 2, 9))


def test_worst_periodic(benchmark):
    """Six events with losses."""
    checked(benchmark, with_most_bits(stored("periodic-7"), 6))


def test_worst_persistence(benchmark):
    """Rectangles cut in two until there are 360."""
    certificate = stored("persistence")
    grid, hints = certificate["claims"]["range"], certificate["hints"]
    marks = {"epsilon": halved(grid["epsilon"], 12), "mu": halved(grid["mu"], 3)}
    width = len(grid["mu"]) - 1
    kept = [i * width + j for i, _ in marks["epsilon"] for j, _ in marks["mu"]]
    hints["cells"] = [hints["cells"][n] for n in kept]
    grid["boxes"] = [grid["boxes"][n] for n in kept]
    for name, ends in marks.items():
        grid[name] = [*(str(q) for _, q in ends), grid[name][-1]]
    checked(benchmark, with_most_bits(certificate, 2, cells=len(kept)))


def halved(marks, count):
    """Return intervals, each by its number and its lower end, the first ones cut in two."""
    ends = list(map(Fraction, marks))
    return [
        (n, a + (b - a) * k / 2)
        for n, (a, b) in enumerate(pairwise(ends))
        for k in range(2 if n < count else 1)
    ]


def test_worst_branch(benchmark):
    """On the cells of a stored certificate."""
    certificate = stored("branch-2")
    pieces = len(certificate["claims"]["cells"]) + len(certificate["hints"]["twist_zeros"])
    certificate["hints"]["bits"] = str(isqrt(branch.MAX_WORK // pieces))
    checked(benchmark, certificate)


@pytest.mark.parametrize("name", ["symmetric", "pitchfork"])
def test_worst_closed_form(benchmark, name):
    """The most bits."""
    certificate = stored(name)
    certificate["hints"]["bits"] = "4096"
    checked(benchmark, certificate)
