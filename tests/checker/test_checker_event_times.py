"""Times of hits over boxes of states contain those of all orbits, after other events, too."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from types import SimpleNamespace

import pytest

from cap.checker.flow.events import LossyMap
from cap.checker.flow.hits import Zero, event_time
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet
from cap.checker.system.walls import Parameters

BITS = 100
PAPER = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)))
WORDS = ["hit r", "hit l"]
WINDOWS = [(Fraction(a), Fraction(b)) for a, b in (("0.9", "1.4"), ("3.0", "4.0"))]
STATE = Fraction("0.1003"), Fraction("0.5419")


def times(x, v, centre):
    """Return the times of the events from a box."""
    phi = LossyMap(PAPER, WINDOWS, WORDS, 1)
    passage = phi.over([Interval.enclosing(*z, BITS) for z in (x, v)], centre, 2)
    return [event.moment.t for event in passage.events]


@pytest.mark.parametrize("size", ["0.01", "0.001"])
def test_times_over_a_box(size):
    """They contain those from its corners, and the derivatives by the state all quotients."""
    r, (x, v) = Fraction(size), STATE
    centre = [Interval.enclosing(z, z, BITS) for z in STATE]
    whole = times((x - r, x + r), (v - r, v + r), centre)
    for a, b in product((-1, 0, 1), repeat=2):
        z = (x + a * r, v + b * r)
        alone = times(*((q, q) for q in z), [Interval.enclosing(q, q, BITS) for q in z])
        for found, t in zip(whole, alone, strict=True):
            assert found.value.lower <= t.value.lower
            assert t.value.upper <= found.value.upper
            for power in ((1, 0), (0, 1)):
                box, point = found.box.coefficients[power], t.box.coefficients[power]
                assert box.lower <= point.lower
                assert point.upper <= box.upper


def test_the_derivative_over_all_of_a_box_counts():
    """t = s^2 within r of the middle: by the derivative there r^2 would be missed."""
    s, r = Fraction(1), Fraction(1, 4)

    def jet(low, high, order):
        number = Interval.enclosing(low, high, BITS)
        one = Interval.enclosing(1, 1, BITS)
        return Jet(order, {(0,): number, (1,): one}) * Jet(order, {(0,): number, (1,): one})

    offset = Interval.enclosing(-r, r, BITS)
    known = Centred(jet(s, s, 1), jet(s - r, s + r, 2), [offset])
    M = SimpleNamespace(bits=BITS, offsets=[offset], omega=offset.integer(1))
    one = Jet(0, {(0,): offset.integer(1)})
    zero = Zero(lambda a, t: t[0] - a[0], lambda _a, _t: one, offset.integer(0))
    found = event_time(M, [known], (Fraction(0), Fraction(4)), zero).value
    assert found.lower <= (s - r) ** 2 < (s + r) ** 2 <= found.upper
