"""Speed of the theorem on the branch: cells examined per second, on one core.

    python -m pytest -n0 benchmarks/bench_branch.py --benchmark-columns=min,median,ops

One round is one cell, so ``ops`` are cells per second per core.  A cell that is too long to be
decided is halved: what counts is how many of them a branch needs, and how long each takes.
"""

from fractions import Fraction

import pytest

from cap.parameters import PAPER
from cap.proofs import branch
from cap.runner import Runner
from cap.subdivision import UNDECIDED, Cell, cells_between, subdivide

RHO = PAPER.R * PAPER.omega**2 / PAPER.F
CELLS = {
    "near the birth": Cell(Fraction(1, 1000), Fraction(11, 10000)),
    "in the middle": Cell(Fraction(1, 4), Fraction(27, 100)),
    "near the end": Cell(Fraction(45, 100), Fraction(46, 100)),
}
where = pytest.mark.parametrize("name", CELLS)


@where
def test_monotone(benchmark, name):
    """Trace and least speed decrease: second derivatives over Taylor models."""
    assert benchmark(branch.examine_monotone, RHO, CELLS[name]) != UNDECIDED


@where
def test_twist(benchmark, name):
    """The sign of the twist: jets of order 3 over Taylor models."""
    assert benchmark(branch.examine_twist, RHO, CELLS[name]) != UNDECIDED


def test_subdivision(benchmark):
    """What the bookkeeping adds to each cell: 1000 cells that are decided at once."""
    cells = cells_between([Fraction(k, 1000) for k in range(1001)])
    found = benchmark(subdivide, lambda _cell: "+", cells, Fraction(1, 10**9), Runner(), "")
    assert len(found) == 1000


@pytest.mark.parametrize("order", [6, 10, 14])
def test_order_of_the_taylor_models(benchmark, monkeypatch, order):
    """The whole branch without its ends: a higher order costs more and needs fewer cells."""
    monkeypatch.setattr(branch, "ORDER", order)
    counts = []

    def examined(cell):
        counts[-1] += 1
        return branch.examine_twist(RHO, cell)

    def whole():
        counts.append(0)
        ends = [Fraction(k, 50) for k in range(1, 24)]
        return subdivide(examined, cells_between(ends), Fraction(1, 10**4), Runner(), "")

    found = benchmark.pedantic(whole, rounds=1)
    benchmark.extra_info["cells"] = counts[-1]
    assert {verdict[0] == "-" for _, verdict in found if verdict != UNDECIDED} == {True, False}
