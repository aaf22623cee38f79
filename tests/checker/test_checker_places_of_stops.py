"""What sticks late, rests near a wall, or begins between bent edges: no less than all of it."""

from __future__ import annotations

import math
from types import SimpleNamespace

import pytest

from cap.checker.folded import ahead, slopes, stops
from cap.checker.folded.regions import Region
from cap.checker.kernel import polynomials as q
from checker.test_checker_folded_guards import AHEAD, flight


def delayed(monkeypatch, z):
    """Return at which places of release is looked, if some stick so much later, or none."""
    seen, M = [], math.pi
    monkeypatch.setattr(ahead, "delay", lambda *_: z)
    monkeypatch.setattr(ahead, "of_place", lambda *_: q.model(one=1.0))
    fates = SimpleNamespace(missing=lambda ends, _fate: seen.append(ends) or 0.0)
    late = SimpleNamespace(ends=(M + 1.1, M + 1.2))
    o = SimpleNamespace(y=AHEAD, fates=fates)
    ahead.stuck(o, late, q.model(one=-0.7), slopes.BEGIN)
    return min(low for low, _ in seen), max(high for _, high in seen)


def test_places_of_a_delayed_stick(monkeypatch):
    """From the place of the stop to z^3 further from the wall, and no more."""
    assert delayed(monkeypatch, 0.0) == pytest.approx((0.7, 0.7), abs=1e-12)
    low, high = delayed(monkeypatch, 0.05)
    assert low <= 0.7 < 0.7 + 0.05**3 <= high
    assert (low, high) == pytest.approx((0.7, 0.7 + 0.05**3), abs=1e-9)


def test_a_rest_near_the_wall_is_so_near(monkeypatch):
    """Where a slow hit is said to end in a rest, the fate is that of places as near to the wall."""
    seen, near = [], 0.003
    monkeypatch.setattr(ahead, "height", lambda *_: near)
    monkeypatch.setattr(ahead, "at_wall", lambda _o, low: seen.append(low) or [0.0] * 3)
    monkeypatch.setattr(ahead, "seen", lambda *_, **__: 0)
    assert list(ahead.losses(SimpleNamespace(y=AHEAD), flight(-1, 2))) == [[0.0] * 3]
    assert seen == [near]


def test_bounds_of_edges_over_parts():
    """Of bent ones, below and above: they hold for all Y of each part, and nearly are reached."""
    unit = 2**80
    for low, high in (((1, 2, 3), (2, -1, 4)), ((-2, 0, 0), (3, 1, -2)), ((0, -3, -1), (5, 2, 2))):
        region = Region(*(tuple(unit * z for z in edge) for edge in (low, high)))
        for k, (least, most) in enumerate(stops.spans(region)):
            at = [(2 * k + j / 50) / stops.PARTS - 1 for j in range(101)]
            below, above = ([a + Y * (b + Y * c) for Y in at] for a, b, c in (low, high))
            assert least <= min(below) <= least + 0.5 / stops.PARTS
            assert max(above) <= most <= max(above) + 0.5 / stops.PARTS
