"""Bounds of entropy and periodic orbits from cells of an interval, against maps that are known."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product

import pytest

from cap.checker.kernel.rejection import Rejected
from cap.checker.system import laps

FULL = [range(2), range(2)]  # the tent map
GOLDEN = [range(1, 2), range(2)]  # 0 -> 1, 1 -> 0 or 1
ROOT = Fraction(1618033988, 10**9)  # less than the golden ratio


def primitive(edges, m):
    """Return how many cyclic paths of m edges repeat no shorter one."""
    paths = [
        p
        for p in product(range(len(edges)), repeat=m)
        if all(b in edges[a] for a, b in pairwise([*p, p[0]]))
    ]
    return sum(all(p != p[d:] + p[:d] for d in range(1, m)) for p in paths) // m


@pytest.mark.parametrize("edges", [FULL, GOLDEN, [range(1, 3), range(2), range(1, 2)]])
def test_orbits_are_counted_as_by_hand(edges):
    """Paths are listed one by one."""
    found = laps.orbits(laps.closed_paths(edges, 8))
    assert found == [primitive(edges, m) for m in range(1, 9)]


def test_cells_that_cover_none_are_left_out():
    """They lie on no closed path; the work is that of the others."""
    edges = [range(0), range(1, 4), range(0), range(1, 4), range(3, 3)]
    assert laps.closed_paths(edges, 3, 12) == [2, 4, 8]
    with pytest.raises(Rejected, match="too much"):
        laps.closed_paths(edges, 3, 11)


def test_the_order_of_sharkovsky():
    """Its beginning and its end, up to 24."""
    listed = sorted(range(1, 25), key=laps.rank)
    assert listed[:11] == [3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23]
    assert listed[11:] == [6, 10, 14, 18, 22, 12, 20, 24, 16, 8, 4, 2, 1]


def test_the_bound():
    """The same from above; two laps count twice; weights are positive."""
    weights = [1000000000, 1618033989]
    laps.confirm_bound(GOLDEN, [1, 1], weights, ROOT + Fraction(2, 10**9))
    for turns, bound in (([1, 1], ROOT), ([1, 2], ROOT + Fraction(2, 10**9))):
        with pytest.raises(Rejected, match="grow faster"):
            laps.confirm_bound(GOLDEN, turns, weights, bound)
    with pytest.raises(Rejected, match="not positive"):
        laps.confirm_bound([range(0), range(2)], [1, 1], [0, 1], Fraction(2))
