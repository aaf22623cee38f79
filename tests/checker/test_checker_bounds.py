"""Bounds of rounding of the folded flow, against exact fractions, where there is nothing else."""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest
from support import rounds, seeded

from cap.checker.folded import ahead, areas
from cap.checker.folded.ahead import FATES, Found
from cap.checker.folded.regions import UNIT, Leaf, Region
from cap.checker.folded.stops import reach
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.angles import of
from cap.checker.kernel.interval import Interval

H = 2.0**-53
LEAF = Leaf(Region((0, 0, 0), (0, 0, 0)), 1)
COUNTS = [  # areas seen, the whole, and of its parts the areas and what is missing of them
    ([1.0, 1.5 * H], 0.0, []),
    ([H, 1.0, 1.5 * H], 0.0, []),
    ([0.75 * H] * 7 + [1.0], 0.0, []),
    ([1.0] + [1.01 * H] * 60, 0.0, []),
    ([2.0**-60], 1.0, [(1.0, H / 2)]),
    ([2.0**-60, 1.0], 1.0, [(0.5, 0.0), (0.5, H / 4)]),
    ([0.1, 0.2, 0.3], 0.3, [(0.1, 0.0), (0.2, 1e-9)]),
]


@pytest.mark.parametrize(("seen", "whole", "parts"), COUNTS)
def test_areas_that_are_counted_are_not_more_than_there_are(seen, whole, parts, monkeypatch):
    """Sums that are rounded upwards, and losses that are rounded to nothing."""
    strobes = [(None, SimpleNamespace(excess=area)) for area in seen]
    known = SimpleNamespace(
        integral=lambda _: -whole,
        scaled=lambda *_: None,
        integral_below=lambda _density, area, _v: area,
    )
    monkeypatch.setattr(areas, "backwards", lambda *_: strobes)
    monkeypatch.setattr(areas, "q", known)
    found = [Found(area, (missing,) * len(FATES)) for area, missing in parts]
    start = SimpleNamespace(density=None, flight=None)
    counted = areas.counted(None, 1.0, LEAF, start, found)
    good = sum(max(Fraction(0), Fraction(a) - Fraction(m)) for a, m in parts)
    lost = max(Fraction(0), Fraction(whole) - good)
    most = sum(max(Fraction(0), Fraction(area) - lost) for area in seen)
    for area in counted[:3]:
        assert most * (1 - Fraction(2) ** -40) - Fraction(2) ** -45 <= Fraction(area) <= most
    assert Fraction(counted.stops) <= sum(map(Fraction, seen))


def test_edges_are_within_their_bounds():
    """Also straight ones, for which only rounding is in the bounds."""
    random = seeded("edges")
    for n in range(rounds(400)):
        a, b, c = (random.randrange(-(2**80), 2**80) for _ in range(3))
        c = 0 if n % 2 else c
        Y, half = random.randrange(-15, 16, 2) / 16, 1 / 16
        low, high = reach((a, b, c), Y, half)
        ends = [Fraction(Y) - Fraction(half), Fraction(Y) + Fraction(half)]
        if c and ends[0] < Fraction(-b, 2 * c) < ends[1]:
            ends.append(Fraction(-b, 2 * c))
        values = [Fraction(UNIT) * (a + y * (b + y * c)) for y in ends]
        assert Fraction(low) <= min(values)
        assert max(values) <= Fraction(high)


def test_places_of_sticks_after_turns_are_within_their_bounds(monkeypatch):
    """The places -p + [0, z^3] are in what is looked at, also where -p is z^3/2."""
    random, looked = seeded("sticks"), list[q.Model]()
    monkeypatch.setattr(ahead, "over", lambda x: looked.append(x) or [])
    monkeypatch.setattr(ahead, "of_place", lambda *_: q.model())
    o = SimpleNamespace(y=SimpleNamespace(width=(9.0, 0.0), a=-0.4))
    e, g = SimpleNamespace(ends=(4.0, 4.1)), SimpleNamespace(A=q.model(one=1.0))
    for n in range(rounds(400)):
        z = random.uniform(1e-9, 0.05)
        p = (z * z * z / 2, 0.0, -random.random())[n % 3]
        monkeypatch.setattr(ahead, "delay", lambda *_, z=z: z)
        looked.clear()
        ahead.stuck(o, e, q.model(one=p), g)
        c, r = Fraction(looked[0][0]), Fraction(looked[0][q.LAST])
        assert c - r <= -Fraction(p)
        assert Fraction(z) ** 3 - Fraction(p) <= c + r


def test_the_double_next_to_an_interval_is_as_far_from_both_ends_as_is_said():
    """Wide or narrow, whichever end is farther from the double."""
    random, farther = seeded("ends"), set[bool]()
    for _ in range(rounds(400)):
        lo = random.randrange(-(2**67), 2**67)
        z = Interval(lo, lo + random.choice([0, 1, 100, 10**4]), 64)
        a, e = (Fraction(x) for x in of(z))
        far = [abs(end - a) for end in (z.lower, z.upper)]
        assert max(far) <= e
        farther.add(far[0] < far[1])
    assert farther == {False, True}
