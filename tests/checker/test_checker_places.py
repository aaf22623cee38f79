"""The places of release: followed as orbits in floats are, and their measures."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import pytest

from cap.checker.folded import settled
from cap.checker.folded.basins import Basins
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import Releases
from cap.checker.folded.paths import next_release
from cap.checker.folded.portions import Node, Piece, portion
from cap.checker.folded.table import ATTRACTOR, EITHER, SEGMENT, divided
from cap.checker.folded.tree import nodes
from cap.checker.kernel import line
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters
from cap.floats.engine import swarm
from cap.parameters import Parameters as Given

SYSTEMS = {
    "paper": Parameters(*map(Fraction, (1, 1, "2/5", -1, 1))),
    "other": Parameters(*map(Fraction, (3, 2, "4/3", "-1/2", "3/4"))),
    "weak": Parameters(*map(Fraction, (1, 1, "1/5", -1, 1))),
}
NOWHERE = Basins()
ZEROS = (0.0,) * (line.DEGREE - 1)


def nexts(p, places):
    """Return the distances to the wall ahead at the next releases, in floats."""
    given = Given(p.F, p.omega, p.f, p.l, p.r)
    scale = float(p.omega**2 / p.F)
    first = (math.pi - math.acos(p.f / p.F)) / 2 / math.pi - 1e-9  # to the left
    states = [(float(p.l) + place / scale, 0.0) for place in places]
    found = [math.nan] * len(places)
    for n in range(1, 60):
        t0 = (first + (n - 1) / 2) * 2 * math.pi / float(p.omega)
        states = swarm.follow(given, states, 0.5, t0).states
        for k, (x, v) in enumerate(states):
            if v == 0 and math.isnan(found[k]):
                found[k] = scale * (float(p.r) - x if n % 2 else x - float(p.l))
    return found


@pytest.mark.parametrize("name", SYSTEMS)
def test_next_releases_of_orbits_in_floats(name):
    """Values and difference quotients, from intervals of several sizes."""
    p, rng, compared = SYSTEMS[name], random.Random(7), 0  # noqa: S311
    y = Releases(p)
    for n in range(60):
        width = y.width[0] * 10 ** -(2 + n % 5)
        low = rng.uniform(0, y.width[0] - width)
        try:
            found = next_release(y, NOWHERE, (low, low + width))
        except Rejected:
            continue
        at = (-0.99, -0.4, 0.5, 0.99)
        gaps = nexts(p, [low + width * (x + 1) / 2 for x in at])
        c, e = found
        for x, gap in zip(at, gaps, strict=True):
            assert abs(sum(a * x**k for k, a in enumerate(c)) - gap) <= e + 1e-7
        slopes = line.slopes(found)
        rate = (gaps[2] - gaps[1]) / (at[2] - at[1])
        assert slopes[0] - 1e-6 <= rate <= slopes[1] + 1e-6
        compared += 1
    assert compared > 15


def test_nothing_is_followed_across_a_border():
    """An interval whose orbits meet other events; all places at once."""
    y = Releases(SYSTEMS["paper"])
    for ends in ((0.0, 2.0), (0.5, 1.0), (1.2, 1.3)):
        with pytest.raises(Rejected):
            next_release(y, NOWHERE, ends)


def doubling(hole, times=1):
    """Return what is known if x goes to 2 x, [1/2, 1] is attracted, and a node is not followed."""
    below = [n for n in (Node(k, 6) for k in range(32)) if n != hole]
    pieces = [Piece(n, ((4 * n.k + 2) / 128, 1 / 64, *ZEROS)) for n in below]
    pieces = [Piece(n, (c, 1e-15)) for n, c in pieces]
    return Places([(0.5, 1.0)], 1.0, 10, pieces * times)


def test_measures_of_places():
    """A hole, its preimage of half the size, and so on; and a neighbourhood of the fixed point."""
    hole = Node(16, 6)
    found = doubling(hole)
    size = 1 / 64
    assert found.missing((0.25, 0.25 + size), ATTRACTOR) == pytest.approx(size)
    assert found.missing((0.0, 1.0), ATTRACTOR) == pytest.approx(2 * size, rel=1e-2)
    for k in range(2, 5):
        low = 2.0**-k
        part = found.missing((low, 2 * low), ATTRACTOR)
        assert part == pytest.approx(size * 4 * low, rel=1e-6)
        assert found.missing((low * 1.5, 2 * low), ATTRACTOR) == pytest.approx(0, abs=1e-12)
        assert found.fate((low * 1.5, low * 1.9)) == ATTRACTOR
        assert found.fate((low, low * 1.9)) == 0
    assert found.missing((0.0, 1.0), SEGMENT) == pytest.approx(1)


def test_measures_of_places_that_go_to_the_segment():
    """What has the other fate is missing; what has none is missing for both."""
    pieces = [Piece(Node(0, 2), SEGMENT), Piece(Node(1, 2), ((0.125, 0.125, *ZEROS), 0.0))]
    found = Places([(0.75, 1.0)], 1.0, 6, pieces)
    assert found.fate((0.0, 0.5)) == SEGMENT
    assert found.missing((0.0, 1.0), SEGMENT) == pytest.approx(0.5)
    assert found.missing((0.0, 1.0), ATTRACTOR) == pytest.approx(0.75)
    assert found.missing((0.6, 0.8), ATTRACTOR) == pytest.approx(0.15)
    assert found.missing((0.0, 1.0), EITHER) == pytest.approx(0.25)


def test_a_fold_has_a_share_without_a_slope():
    """At a critical point of the next place nothing is known of the slope."""
    bend = (0.5, 0.0, 0.25, *ZEROS[1:])
    found = [portion(Node(0, 0), (bend, 0.0), 0.0, 1.0)]
    for _ in range(8):
        found = [half for part in found for half in part.halves(1.0)]
    flat = [part for part in found if part.c == 0]
    assert 0 < sum(b - a for (a, b) in (part.ends for part in flat)) < 0.05
    for part in found:
        for x in part.ends:
            low, high = part.image
            assert low <= 0.5 + 0.25 * (2 * x - 1) ** 2 <= high
            assert abs(4 * 0.25 * (2 * x - 1)) >= part.c


def test_portions_are_halved_where_fates_differ():
    """A piece of which the upper part goes to what is attracted, the lowest to what is unknown."""
    piece = Piece(Node(1, 2), ((0.5, 0.3, *ZEROS), 1e-12))  # [1/4, 1/2] to [0.2, 0.8]
    found = {level: Places([(0.5, 1.0)], 1.0, level, [piece]) for level in (2, 6, 16)}
    assert [found[level].fate((0.4, 0.49)) for level in found] == [0, ATTRACTOR, ATTRACTOR]
    rate = 0.25 / 0.6
    true = 0.05 * rate / (1 - rate)  # what comes to [0.2, 0.25], at once or later
    assert found[16].missing((0.25, 0.5), ATTRACTOR) == pytest.approx(true, rel=1e-3)
    assert found[16].missing((0.4, 0.5), ATTRACTOR) < 1e-9
    assert found[2].missing((0.4, 0.5), ATTRACTOR) > 0.01


def test_portions_are_not_halved_without_end(monkeypatch):
    """If there are too many, they are left as they are."""
    monkeypatch.setattr(settled, "_MOST", 0)
    piece = Piece(Node(1, 2), ((0.5, 0.3, *ZEROS), 1e-12))
    assert Places([(0.5, 1.0)], 1.0, 16, [piece]).fate((0.4, 0.49)) == 0


def test_pieces_that_overlap():
    """What is in two of them counts once, and as what is attracted, if one is."""
    once, twice = doubling(Node(16, 6)), doubling(Node(16, 6), 2)
    assert (once.ends, once.masses) == (twice.ends, twice.masses)
    piece = Piece(Node(1, 2), ((0.5, 0.3, *ZEROS), 1e-12))
    both = Places([(0.4, 1.0)], 1.0, 2, [piece, Piece(Node(0, 2), ATTRACTOR)])
    assert both.ends == [0.0, 0.25, 0.4, 1.0]
    assert both.missing((0.0, 1.0), ATTRACTOR) == pytest.approx(0.15)


def test_divided():
    """Gaps have no fate; of two that overlap the first counts; equal neighbours are one."""
    known = [((0.5, 0.7), 2), ((0.1, 0.3), 1), ((0.2, 0.4), 1), ((0.2, 0.25), 2), ((0.6, 0.8), 1)]
    assert divided(1.0, known) == ([0.0, 0.1, 0.4, 0.5, 0.7, 0.8, 1.0], [0, 1, 0, 2, 1, 0])
    assert divided(1.0, []) == ([0.0, 1.0], [0])
    assert divided(1.0, [((0.0, 1.0), 1)]) == ([0.0, 1.0], [1])


def test_what_goes_beyond_the_walls_is_nothing():
    """There are no places: nothing is missing of them."""
    found = Places([(0.5, 1.0)], 1.0, 3, [Piece(Node(0, 3), ((-1.0, 0.1, *ZEROS), 1e-12))])
    assert found.missing((0.0, 0.125), ATTRACTOR) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("tree", "complaint"),
    [
        ("2", "not whole"),
        ("21", "not whole"),
        ("2101", "after its end"),
        ("11", "after its end"),
        ("2" * 31 + "1" * 32, "too deep"),
    ],
)
def test_trees_that_are_none(tree, complaint):
    """Letters missing, or too many; too deep."""
    with pytest.raises(Rejected, match=complaint):
        nodes(tree)


def test_a_tree():
    """Nodes that are followed, in order."""
    assert nodes("1") == [Node(0, 0)]
    assert nodes("0") == []
    assert nodes("2210211") == [Node(0, 2), Node(2, 2), Node(3, 2)]
    assert Node(2, 2).ends(2.0) == (1.0, 1.5)


def test_nothing_is_shown_of_a_place_that_is_no_number():
    """Its part is as one in which the next place may turn back, of any fate."""
    node = Node(0, 1)
    after = (math.nan, math.nan, *ZEROS), 0.0
    assert portion(node, after, 0.0, 1.0).c == 0
    places = Places([(0.75, 1.0)], 1.0, 6, [Piece(node, after)])
    assert places.missing((0.0, 0.5), ATTRACTOR) >= 0.5
