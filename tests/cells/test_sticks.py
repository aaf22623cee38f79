"""Sticks followed backwards: areas against orbits in floats, and the text of the trees."""

import base64
import math
import zlib
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from support import seeded

from cap.cells.constants import system_of
from cap.cells.contraction import hoped
from cap.cells.cuts import PARTS, cheapest, dearest
from cap.cells.entries import NOWHERE
from cap.cells.listing import written
from cap.cells.next_event import next_event
from cap.cells.regions import Limits, Region, followed
from cap.cells.sticks import search
from cap.cells.trees import Plan
from cap.errors import BadInput
from cap.floats import swarm
from cap.parameters import PAPER, Parameters
from cap.runner import Runner

V, WIDTH = Fraction(3), 2.0
SYSTEM = system_of(PAPER)
LIMITS = Limits(3.0, 60, 3.0)
GRAIN = Fraction(1, 2**40)


@pytest.fixture(scope="module")
def trees():
    """Return coarse trees."""
    return search(PAPER, V, Plan(worth=1e-2), Runner())


def integers(text):
    """Give the integers of a text."""
    z = power = 0
    for byte in zlib.decompress(base64.b85decode(text)):
        z += byte % 128 << power
        power += 7
        if byte < 128:
            yield z // 2 if z % 2 == 0 else -(z + 1) // 2
            z = power = 0


def regions(text):
    """Give (low, high, first and last z, flights) of the leaves, with exact edges."""
    numbers = iter(integers(text))
    zero, lowest = (Fraction(0),) * 3, (Fraction(-2), Fraction(0), Fraction(0))
    yield from below(numbers, lowest, zero, (Fraction(-1), Fraction(1)))
    assert next(numbers, None) is None


def below(numbers, low, high, times):
    """Give the leaves of a node."""
    kind = next(numbers)
    if kind == 1:
        middle = sum(times) / 2
        for side, part in ((-1, (times[0], middle)), (1, (middle, times[1]))):
            yield from below(numbers, half(low, side), half(high, side), part)
    elif kind == 2:
        mean = [(a + b) / 2 // GRAIN * GRAIN for a, b in zip(low, high, strict=True)]
        edge = tuple(m + next(numbers) * GRAIN for m in mean)
        yield from below(numbers, low, edge, times)
        yield from below(numbers, edge, high, times)
    else:
        yield low, high, times, kind and kind - 2


def half(e, side):
    """Return an edge over half of its times."""
    return e[0] + side * e[1] / 2 + e[2] / 4, e[1] / 2 + side * e[2] / 2, e[2] / 4


def value(e, Y):
    """Return q on an edge."""
    return float(e[0] + Y * (e[1] + Y * e[2]))


def region(found, second):
    """Return the region of a leaf of a text."""
    low, high, (first, last), _ = found
    middle, size = math.pi / 2 * (-1 if second else 1), SYSTEM.theta - math.pi / 2
    edges = (tuple(map(float, edge)) for edge in (low, high))
    return Region(*edges, middle + size * float(first + last) / 2, size * float(last - first) / 2)


def test_text_gives_the_regions(trees):
    """Read on its own, it gives the leaves, with edges in order, and the same areas."""
    for second, tree in enumerate(trees):
        chosen = leaves(tree)
        counted = read(tree)
        assert [found[3] for found in counted] == tree.flights[chosen].tolist()
        for found, area, place in zip(
            counted, tree.areas[chosen], tree.places[chosen], strict=True
        ):
            if area > 0.02:
                seen = followed(SYSTEM, region(found, second), LIMITS)
                assert seen.area == pytest.approx(area, rel=1e-9)
            low, high = found[:2]
            for Y in (-1, Fraction(-1, 3), Fraction(1, 2), 1):
                ends = value(low, Y), value(high, Y)
                assert ends[0] < ends[1]
                places = [2 + q for q in ends] if second else [-q for q in ends]
                assert place[0] <= min(places)
                assert max(places) <= place[1]


def test_spans_bound_the_places_of_each_part(trees):
    """At every time; and they are not wider than they have to be."""
    for second, tree in enumerate(trees):
        spans = tree.spans(8)[leaves(tree)]
        assert np.diff(spans).mean() < np.diff(tree.places[leaves(tree)]).mean()
        for (low, high, *_), parts in zip(read(tree), spans, strict=True):
            for k, (least, most) in enumerate(parts):
                for Y in (Fraction(k, 4) - 1, Fraction(3 * k + 1, 12) - 1, Fraction(k + 1, 4) - 1):
                    ends = value(low, Y), value(high, Y)
                    places = [2 + q for q in ends] if second else [-q for q in ends]
                    assert least <= min(places)
                    assert max(places) <= most


def leaves(tree):
    """Return which nodes are followed if all that is seen is worth it."""
    return tree.best(tree.areas, 0.0)


def read(tree):
    """Return the leaves that count, as a reader finds them."""
    return [found for found in regions(tree.text(leaves(tree))) if found[3]]


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
    tree = trees[1]
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
    """Those that count and the others together have the area of all sticks."""
    for tree in trees:
        area = sum(
            (high[0] - low[0] + (high[2] - low[2]) / 3) * (last - first)
            for low, high, (first, last), _ in regions(tree.text(leaves(tree)))
        )
        assert area == 4


def test_areas_are_below_those_of_orbits(trees):
    """Never above, and close where all is certain: the mean over orbits in floats."""
    random = seeded("sticks")
    for second, tree in enumerate(trees):
        for found in random.sample(read(tree), 12):
            r = region(found, second)
            seen, (near, _) = followed(SYSTEM, r, LIMITS), hoped(SYSTEM, NOWHERE, r, 3.0, 60, 4)
            assert 0 < seen.area < near * 1.02
    parts = []
    for _ in range(40):
        small = Region(*tiny(random), 1e-5)
        seen, (near, _) = (
            followed(SYSTEM, small, LIMITS),
            hoped(SYSTEM, NOWHERE, small, 3.0, 60, 12),
        )
        assert seen.area <= min(near * 1.05, seen.weight * 1e-5)  # of points, 1/12 may be at V
        if all(followed(SYSTEM, small, at(V)).area == seen.area for V in (2.95, 3.05)):
            parts.append(seen.area / near)
            assert seen.weight * 1e-5 <= 1.2 * seen.area
    assert len(parts) > 20  # of the others, a part is faster than V
    assert max(parts) < 1.001
    assert np.quantile(parts, 0.75) > 0.9999  # the others pass a strobe less, or so


def at(V):
    """Return the limits for another speed."""
    return LIMITS._replace(V=V)


def tiny(random):
    """Return edges 1e-5 apart, and a time at which masses stick."""
    q = random.uniform(-1.9, -0.1)
    t = random.choice((-1, 1)) * (math.pi / 2 + 0.4 * random.uniform(-1, 1))
    return (q, 0.1, 0.0), (q + 1e-5, 0.1, 0.0), t


def test_states_stick_where_the_trees_say(trees):
    """Random states, followed forwards by another flow, stick in leaves at least so often."""
    random, inside, count = seeded("states that stick"), 0, 250
    known = [read(tree) for tree in trees]
    for _ in range(count):
        found = stick(random.uniform(-1, 1), random.uniform(-3, 3))
        inside += found is not None and any(
            first <= found[2] <= last and value(low, Y) <= found[1] <= value(high, Y)
            for low, high, (first, last), _ in known[found[0]]
            for Y in [(2 * found[2] - first - last) / (last - first)]
        )
    share = sum(tree.areas[leaves(tree)].sum() for tree in trees) / 12
    assert share > 0.4
    assert inside / count > share - 3 * math.sqrt(share / count)


def stick(x, v):
    """Return the arc, q and z of the first stick of the orbit of a state; None if a wall has it."""
    direction = math.copysign(1, v)
    for event in swarm.itinerary(PAPER, (x, v), 12):
        kind, *side = event.word.split()
        if kind == "hit":
            direction = -1.0 if side == ["r"] else 1.0
        elif kind == "turn":
            direction = 1.0 if side == ["right"] else -1.0
        elif kind == "stick":
            t = (math.pi if direction > 0 else 0.0) - event.time
            t -= 2 * math.pi * math.floor(t / (2 * math.pi) + 0.5)
            q = -1 - event.x if direction > 0 else event.x - 1
            second = t < 0
            z = (abs(t) - math.pi / 2) / (SYSTEM.theta - math.pi / 2)
            return second, q, -z if second else z
        else:
            return None
    return None


def test_next_events_are_those_of_the_flow():
    """An orbit in floats, followed back from a stick, comes to where it started."""
    random, compared = seeded("sticks back"), 0
    while compared < 20:
        x, v = random.uniform(-1, 1), random.uniform(-2, 2)
        events = swarm.itinerary(PAPER, (x, v), 12)
        words = [event.word for event in events]
        if "stick" not in words:
            continue
        end = words.index("stick")
        times = [event.time for event in events[: end + 1]]
        found = stick(x, v)
        assert backward(found, times) == pytest.approx([b - a for a, b in pairwise(times)][::-1])
        compared += 1


def backward(found, times):
    """Return the lengths of as many flights back from a stick as there are before it."""
    second, q, z = found
    t = (-math.pi if second else math.pi) / 2 + (SYSTEM.theta - math.pi / 2) * z
    p, s, lengths, a = q, 0.0, [], SYSTEM.a
    for _ in times[1:]:
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(a, SYSTEM.theta, A, B, t, t)
        d = T - t
        lengths.append(d)
        s, p = math.sin(T) + a * d + A, (A + 0.5 * a * d) * d + B - math.cos(T)
        s, p = (s, -WIDTH) if kind == 1 else (0.0, -WIDTH - p)
        t = T + math.pi - 2 * math.pi * math.floor((T + math.pi) / (2 * math.pi) + 0.5)
    return lengths


def test_jobs_do_not_matter(trees):
    """Nor does the number of parts: there are as many as a power of 2."""
    assert PARTS & (PARTS - 1) == 0
    others = search(PAPER, V, Plan(worth=1e-2), Runner(jobs=2))
    for tree, other in zip(trees, others, strict=True):
        assert tree.root == other.root
        for name in ("kinds", "edges", "areas", "weights", "flights", "places"):
            assert np.array_equal(getattr(tree, name), getattr(other, name))


def test_other_systems_are_refused():
    """With losses at the walls, or walls so far apart that edges are not doubles."""
    unit = dict.fromkeys(("F", "omega"), Fraction(1)) | {"f": Fraction(2, 5), "l": Fraction(-1)}
    for other in ({"r": Fraction(1), "e": Fraction(1, 2)}, {"r": Fraction(9)}):
        with pytest.raises(BadInput, match="walls nearer than 8"):
            search(Parameters(**unit, **other), V, Plan(), Runner())
