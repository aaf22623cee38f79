"""Stops followed backwards and forwards: areas against orbits in floats, the text of the trees."""

import base64
import math
import zlib
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from support import seeded

from cap.areas.folded.constants import system_of
from cap.areas.folded.contraction import hoped
from cap.areas.folded.cuts import PARTS, cheapest, dearest
from cap.areas.folded.missing import Known
from cap.areas.folded.next_event import next_event
from cap.areas.folded.regions import Limits, Region, followed, measure
from cap.areas.folded.stops import Releases, search
from cap.areas.folded.trees import Plan
from cap.areas.listing import written
from cap.checker.folded.basins import Basins
from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.parameters import PAPER, Parameters
from cap.runner import Runner

# compiled anew in a fresh clone: tens of seconds; the checker has its own code
pytestmark = pytest.mark.slow

V, WIDTH = Fraction(3), 2.0
SYSTEM, THETA = system_of(PAPER), system_of(PAPER, forwards=True).theta
STICKS = SYSTEM.theta - math.pi / 2
ARCS = (-math.pi / 2, STICKS), (math.pi / 2, STICKS), (0.0, THETA)  # late, early, turns
TURNS = 2
LIMITS = Limits(3.0, 60, 3.0)
GRAIN = Fraction(1, 2**40)
# places with each fate, as if they were known: those in these parts of [0, 2]
ENDS = np.array([0.0, 0.6, 1.1, 1.9, 2.0])
WITH = np.array([[True, False, True, True], [False, True, False, False], [True, True, True, True]])
PLAN = Plan(worth=1e-2, onwards=1e-2)


def known(have):
    """Return what is known of places, if these parts have the fates."""
    masses = np.where(have, 0.0, np.diff(ENDS))
    return Known(ENDS, masses, np.cumsum(np.pad(masses, ((0, 0), (1, 0))), axis=1))


RELEASES = Releases(Basins(), known(WITH))


@pytest.fixture(scope="module")
def trees():
    """Return coarse trees."""
    return search(PAPER, V, RELEASES, PLAN, Runner())


def integers(text):
    """Give the integers of a text."""
    z = power = 0
    for byte in zlib.decompress(base64.b85decode(text)):
        z += byte % 128 << power
        power += 7
        if byte < 128:
            yield z // 2 if z % 2 == 0 else -(z + 1) // 2
            z = power = 0


def regions(text, *, nested=False):
    """Give (low, high, first and last z, flights, parts) of the leaves, with exact edges.

    Each is a list, of the parts without these, those followed forwards having 1 flight.
    """
    numbers = iter(integers(text))
    zero, lowest = (Fraction(0),) * 3, (Fraction(-2), Fraction(0), Fraction(0))
    yield from below(numbers, (lowest, zero, (Fraction(-1), Fraction(1))), nested)
    assert next(numbers, None) is None


def below(numbers, found, nested):
    """Give the leaves of a node."""
    low, high, times = found
    kind = next(numbers)
    if kind == 1:
        middle = sum(times) / 2
        for side, part in ((-1, (times[0], middle)), (1, (middle, times[1]))):
            yield from below(numbers, (half(low, side), half(high, side), part), nested)
    elif kind == 2:
        mean = [(a + b) / 2 // GRAIN * GRAIN for a, b in zip(low, high, strict=True)]
        edge = tuple(m + next(numbers) * GRAIN for m in mean)
        yield from below(numbers, (low, edge, times), nested)
        yield from below(numbers, (edge, high, times), nested)
    else:
        parts = list(below(numbers, found, False)) if nested and kind else []
        yield low, high, times, kind and kind - 2, [part for part in parts if part[3]]


def half(e, side):
    """Return an edge over half of its times."""
    return e[0] + side * e[1] / 2 + e[2] / 4, e[1] / 2 + side * e[2] / 2, e[2] / 4


def value(e, Y):
    """Return q on an edge."""
    return float(e[0] + Y * (e[1] + Y * e[2]))


def region(found, kind):
    """Return the region of a leaf of a text."""
    low, high, (first, last), *_ = found
    middle, size = ARCS[kind]
    edges = (tuple(map(float, edge)) for edge in (low, high))
    return Region(*edges, middle + size * float(first + last) / 2, size * float(last - first) / 2)


def leaves(tree):
    """Return which nodes are followed if all that is seen is worth it."""
    return tree.best(tree.areas, 0.0)


def read(tree):
    """Return the leaves that count, as a reader finds them."""
    return [found for found in regions(tree.text(leaves(tree))) if found[3]]


def test_text_gives_the_regions(trees):
    """Read on its own, it gives the leaves, with edges in order, and the same areas."""
    for kind, tree in enumerate(trees):
        chosen, counted = leaves(tree), read(tree)
        assert [found[3] for found in counted] == tree.flights[chosen].tolist()
        for found, area in zip(counted, tree.areas[chosen], strict=True):
            if area > 0.02:
                limits = LIMITS._replace(flights=found[3])
                seen = followed(SYSTEM, region(found, kind), limits)
                assert seen.area == pytest.approx(area, rel=1e-9)
            for Y in (-1, Fraction(-1, 3), Fraction(1, 2), 1):
                assert value(found[0], Y) < value(found[1], Y)


@pytest.mark.parametrize("kind", ["late", "early"])
def test_spans_bound_the_places_of_each_part(trees, kind):
    """At every time."""
    tree = getattr(trees, kind)
    spans = tree.spans(8)[leaves(tree)]
    for (low, high, *_), parts in zip(read(tree), spans, strict=True):
        for k, (least, most) in enumerate(parts):
            for Y in (Fraction(k, 4) - 1, Fraction(3 * k + 1, 12) - 1, Fraction(k + 1, 4) - 1):
                places = [2 + value(e, Y) if kind == "late" else -value(e, Y) for e in (low, high)]
                assert least <= min(places)
                assert max(places) <= most


def test_parts_are_followed_below_what_is_followed_backwards(trees):
    """The text has them where they are, with the measures that the tree says."""
    turns = trees.turns
    back = leaves(turns)
    ahead = turns.best(turns.onwards(back), 1e-3)
    found = [found for found in regions(turns.text(back, ahead), nested=True) if found[3]]
    assert [leaf[3] for leaf in found] == turns.flights[back].tolist()
    inner = [part for leaf in found for part in leaf[4]]
    assert len(inner) == ahead.sum() > len(found) / 2
    assert max(len(leaf[4]) for leaf in found) > 2
    for part, (least, most) in zip(inner, turns.measures[ahead], strict=True):
        ends = measure(SYSTEM, region(part, TURNS))
        assert ends == pytest.approx((least, most), rel=1e-9)
        assert least <= most <= least * 1.01
    areas = turns.areas_of(back, ahead)
    assert (areas[:, 0] + areas[:, 1] <= areas[:, 2] + 1e-12).all()
    assert (areas[:, 2] <= turns.areas[back]).all()
    assert 0.3 * turns.areas[back].sum() < areas[:, 2].sum()
    whole = turns.strobes[back] * turns.measures[back, 1]
    assert turns.lost(back) == pytest.approx((whole - turns.areas[back]).sum())


def test_fates_are_those_of_orbits(trees):
    """Never more has a fate than of orbits in floats, and nearly as much."""
    random, turns = seeded("turns ahead"), trees.turns
    back = leaves(turns)
    ahead = turns.best(turns.onwards(back), 1e-3)
    leaf = [leaf for leaf in regions(turns.text(back, ahead), nested=True) if leaf[3]]
    parts = list(
        zip([part for each in leaf for part in each[4]], np.flatnonzero(ahead), strict=True)
    )
    said = told = 0.0
    for part, n in random.sample(parts, 60):
        counts = shares(random, region(part, TURNS), 150)
        mu = turns.measures[n, 1]
        spread = 4 * np.sqrt(counts * (1 - counts) / 150)
        assert (turns.fated[n] <= mu * (counts + spread) + 1e-9).all()
        said, told = said + turns.fated[n, :2].sum(), told + mu * counts[:2].sum()
    assert 0.8 * told < said < 1.02 * told


def shares(random, r, count):
    """Return which parts of the measure of a region of turns come to places with each fate."""
    found, total = np.zeros(3), 0.0
    for _ in range(count):
        Y = random.uniform(-1, 1)
        low, high = value(r.low, Y), value(r.high, Y)
        q, t = random.uniform(low, high), r.middle + r.half * Y
        weight = (math.cos(t) + SYSTEM.a) * (high - low)
        total += weight
        x = released(q, -t)
        if x is not None:
            found += weight * WITH[:, min(max(np.searchsorted(ENDS, x) - 1, 0), 3)]
    return found / total


def released(q, t):
    """Return the distance to the wall ahead at the release after a turn, forwards in floats."""
    a, p, s = -SYSTEM.a, q, 0.0
    for _ in range(60):
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(a, THETA, A, B, t, t)
        d = T - t
        s, p = math.sin(T) + a * d + A, (A + 0.5 * a * d) * d + B - math.cos(T)
        if kind == 1 and s < 1e-6:
            return WIDTH
        if kind == 2 and math.cos(T) > a:
            return -p if math.sin(T) < 0 else WIDTH + p
        s, p = (s, -WIDTH) if kind == 1 else (0.0, -WIDTH - p)
        t = T + math.pi - 2 * math.pi * math.floor((T + math.pi) / (2 * math.pi) + 0.5)
    return None


def test_all_that_sticks_has_a_fate_if_all_places_have(trees):
    """Then nothing is missing of what is followed; if no place has one, nothing is left."""
    everywhere = Releases(Basins(), known(np.ones((3, 4), bool)))
    plan = Plan(worth=3e-2, onwards=3e-2)
    turns = search(PAPER, V, everywhere, plan, Runner()).turns
    seen = turns.fated[:, 0] > 0
    assert seen.sum() > 50
    assert turns.fated[seen, 0] == pytest.approx(turns.measures[seen, 0], rel=1e-6)
    nowhere = Releases(Basins(), known(np.zeros((3, 4), bool)))
    assert not search(PAPER, V, nowhere, plan, Runner()).turns.fated.any()


def test_what_is_not_followed_is_not_in_the_text(trees):
    """And what is cut in vain is not cut."""
    tree = trees[0]
    chosen = leaves(tree)
    kept = chosen & (np.arange(len(chosen)) % 3 == 0)
    found = [found[3] for found in regions(tree.text(kept)) if found[3]]
    assert found == tree.flights[kept].tolist()
    assert tree.text(np.zeros_like(chosen)) == written([0])


def test_best_nodes(trees):
    """They are worth most at their price, among all choices: recomputed from the definition."""
    tree = trees.turns
    for price in (0.0, 1e-3, 0.1, 100.0):
        chosen = tree.best(tree.areas, price)
        past, worth = tree.past, list(np.maximum(tree.areas - price, 0))
        for n in range(len(worth))[::-1]:
            if tree.kinds[n]:
                worth[n] = max(worth[n], worth[n + 1] + worth[past[n + 1]])
        assert np.sum(tree.areas[chosen] - price) == pytest.approx(worth[0])
        for n in np.flatnonzero(chosen):
            assert not chosen[n + 1 : past[n]].any()
    price = dearest(trees, [tree.areas for tree in trees], 100)
    assert 50 < sum(tree.best(tree.areas, price).sum() for tree in trees) <= 100


def test_no_more_nodes_than_enough(trees):
    """At a price that is a little higher, less than enough is left."""
    areas = [tree.areas for tree in trees]

    def found(price):
        chosen = [tree.best(area, price) for tree, area in zip(trees, areas, strict=True)]
        return sum(area[mask].sum() for area, mask in zip(areas, chosen, strict=True))

    enough = 0.8 * found(0.0)
    price = cheapest(trees, areas, enough)
    assert found(price) >= enough > found(price * (1 + 1e-4))
    assert cheapest(trees, areas, 2 * found(0.0)) < 1e-6


def test_leaves_cover_the_arc(trees):
    """Those that count and the others together have the area of all stops."""
    for tree in trees:
        area = sum(
            (high[0] - low[0] + (high[2] - low[2]) / 3) * (last - first)
            for low, high, (first, last), *_ in regions(tree.text(leaves(tree)))
        )
        assert area == 4


def test_areas_are_below_those_of_orbits(trees):
    """Never above, and close where all is certain: the mean over orbits in floats."""
    random = seeded("stops")
    for kind, tree in enumerate(trees):
        known = read(tree)
        for found in random.sample(known, min(12, len(known))):
            r = region(found, kind)
            seen, (near, _) = followed(SYSTEM, r, LIMITS), hoped(SYSTEM, r, 3.0, 60, 4)
            assert 0 < seen.area < near * 1.02
    parts = []
    for _ in range(60):
        small = Region(*tiny(random), 1e-5)
        seen, (near, _) = followed(SYSTEM, small, LIMITS), hoped(SYSTEM, small, 3.0, 60, 12)
        assert seen.area <= min(near * 1.05, seen.weight * 1e-5)  # of points, 1/12 may be at V
        if near and all(followed(SYSTEM, small, at(V)).area == seen.area for V in (2.95, 3.05)):
            parts.append(seen.area / near)
            assert seen.weight * 1e-5 <= 1.2 * seen.area
    assert len(parts) > 20  # of the others, a part is faster than V
    assert max(parts) < 1.001
    assert np.quantile(parts, 0.75) > 0.9999  # the others pass a strobe less, or so


def at(V):
    """Return the limits for another speed."""
    return LIMITS._replace(V=V)


def tiny(random):
    """Return edges 1e-5 apart, and a time at which masses stop."""
    q = random.uniform(-1.9, -0.1)
    middle, size = random.choice(ARCS)
    t = middle + 0.9 * size * random.uniform(-1, 1)
    return (q, 0.1, 0.0), (q + 1e-5, 0.1, 0.0), t


def test_states_stop_where_the_trees_say(trees):
    """Random states, followed forwards by another flow, stop first in leaves at least so often."""
    random, inside, count = seeded("states that stop"), 0, 250
    known = [read(tree) for tree in trees]
    for _ in range(count):
        found = first_stop(random.uniform(-1, 1), random.uniform(-3, 3))
        inside += found is not None and any(
            first <= found[2] <= last and value(low, Y) <= found[1] <= value(high, Y)
            for low, high, (first, last), *_ in known[found[0]]
            for Y in [(2 * found[2] - first - last) / (last - first)]
        )
    share = sum(tree.areas[leaves(tree)].sum() for tree in trees) / 12
    assert share > 0.8
    assert inside / count > share - 3 * math.sqrt(share * (1 - share) / count)


def first_stop(x, v):
    """Return the tree, q and z of the first stop of the orbit of a state; None if there is none."""
    direction = math.copysign(1, v)
    for event in swarm.itinerary(PAPER, (x, v), 12):
        kind, *side = event.word.split()
        if kind == "hit":
            direction = -1.0 if side == ["r"] else 1.0
        elif kind in ("turn", "stick"):
            t = (math.pi if direction > 0 else 0.0) - event.time
            t -= 2 * math.pi * math.floor(t / (2 * math.pi) + 0.5)
            q = -1 - event.x if direction > 0 else event.x - 1
            n = TURNS if kind == "turn" else int(t > 0)
            middle, size = ARCS[n]
            return n, q, (t - middle) / size
        else:
            return None
    return None


def test_next_events_are_those_of_the_flow():
    """An orbit in floats, followed back from a stop, comes to where it started."""
    random, compared = seeded("stops back"), 0
    while compared < 20:
        x, v = random.uniform(-1, 1), random.uniform(-2, 2)
        events = swarm.itinerary(PAPER, (x, v), 12)
        found = first_stop(x, v)
        if found is None:
            continue
        end = [event.word.split()[0] in ("turn", "stick") for event in events].index(True)
        times = [event.time for event in events[: end + 1]]
        assert backward(found, times) == pytest.approx([b - a for a, b in pairwise(times)][::-1])
        compared += 1


def backward(found, times):
    """Return the lengths of as many flights back from a stop as there are before it."""
    kind, q, z = found
    middle, size = ARCS[kind]
    t = middle + size * z
    p, s, lengths, a = q, 0.0, [], SYSTEM.a
    for _ in times[1:]:
        A, B = s - math.sin(t), p + math.cos(t)
        event, T = next_event(a, SYSTEM.theta, A, B, t, t)
        assert event == 1
        d = T - t
        lengths.append(d)
        s, p = math.sin(T) + a * d + A, -WIDTH
        t = T + math.pi - 2 * math.pi * math.floor((T + math.pi) / (2 * math.pi) + 0.5)
    return lengths


def test_jobs_do_not_matter(trees):
    """Nor does the number of parts: there are as many as a power of 2."""
    assert PARTS & (PARTS - 1) == 0
    others = search(PAPER, V, RELEASES, PLAN, Runner(jobs=2))
    for tree, other in zip(trees, others, strict=True):
        assert tree.root == other.root
        assert np.array_equal(tree.kinds, other.kinds)
        assert np.array_equal(tree.edges, other.edges)
        assert np.array_equal(tree.areas, other.areas)
    assert np.array_equal(trees.turns.fated, others.turns.fated)


def test_other_systems_are_refused():
    """With losses at the walls, or walls so far apart that edges are not doubles."""
    unit = dict.fromkeys(("F", "omega"), Fraction(1)) | {"f": Fraction(2, 5), "l": Fraction(-1)}
    for other in ({"r": Fraction(1), "e": Fraction(1, 2)}, {"r": Fraction(9)}):
        with pytest.raises(BadInput, match="walls nearer than 8"):
            search(Parameters(**unit, **other), V, RELEASES, Plan(), Runner())
