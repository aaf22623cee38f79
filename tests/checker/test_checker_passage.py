"""Impacts of a ball that the checker follows: against the prover's, and against the energy."""

from fractions import Fraction
from math import cos, sin

import pytest

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.tori import passage
from cap.checker.tori.passage import Impact
from cap.errors import NotProved
from cap.sets import interval
from cap.tori.bouncing import impact

BITS = 200
STATES = [
    ("1/5", "1", "3/2"), ("9/10", "11/7", "1/50"), ("9/10", "47/10", "1/3"), ("1/2", "-4", "20"),
    ("99/100", "3/2", "1/1000"), ("1/1000", "6", "1/8"),
]  # fmt: skip


def exactly(q, bits=BITS):
    """Return an interval of one point, or nearly."""
    return Interval.enclosing(Fraction(q), Fraction(q), bits)


@pytest.mark.parametrize("state", STATES)
def test_next_impact(state):
    """It meets the prover's; it is the ball's: over the table before it, under it after it."""
    a, t, v = state
    found = passage.following(exactly(a), Impact(exactly(t), exactly(v)))
    with interval.workprec(BITS):
        ends = impact(*(interval.ball(Fraction(q)) for q in state))
        for mine, other in zip(found, map(interval.ends, ends), strict=True):
            assert mine.lower <= other[1]
            assert other[0] <= mine.upper
            assert mine.width < 1 << BITS - 150
    a, t, v = (float(Fraction(q)) for q in state)
    s = float(found.t.lower) - t

    def height(s):
        return a * sin(t) + (v + a * cos(t)) * s - s * s / 2 - a * sin(t + s)

    assert all(height(s * n / 50) > 0 for n in range(1, 50))
    assert height(1.001 * s) < 0


def test_it_returns():
    """Time reversed, with the table as it was: t -> pi - t."""
    a = exactly("1/2", 600)
    start = Impact(exactly("1", 600), exactly("2", 600))
    at = start
    for _ in range(40):
        at = passage.following(a, at)
    back = Impact(pi(600) - at.t, at.v)
    for _ in range(40):
        back = passage.following(a, back)
    again = Impact(pi(600) - back.t, back.v)
    for mine, first in zip(again, start, strict=True):
        assert (mine - first).contains_zero()
        assert mine.width < 1 << 400


def test_wide_states():
    """Where they are too far apart, nothing is concluded."""

    def flown(high):
        wide = Interval.enclosing(Fraction(1, 1000), Fraction(high, 10**4), BITS)
        return passage.flight(exactly("1/1000"), Impact(exactly("1"), wide))

    assert flown(15).lower < Fraction(2, 1000)
    assert flown(15).upper > Fraction(3, 1000)
    with pytest.raises(Rejected, match="no time"):
        flown(40)


@pytest.mark.parametrize(("guess", "why"), [("9", "earlier"), ("1/100", "not followed")])
def test_a_wrong_guess(monkeypatch, guess, why):
    """Of the time of a flight, too late or much too early."""
    monkeypatch.setattr(passage, "near", lambda *_: exactly(guess))
    with pytest.raises(Rejected, match=why):
        passage.flight(exactly("1/2"), Impact(exactly("1"), exactly("1")))


def test_the_prover_notices():
    """A ball too wide to be followed."""
    with interval.workprec(BITS):
        wide = interval.hull(interval.ball(Fraction(1, 10)), interval.ball(Fraction(2)))
        with pytest.raises(NotProved, match="motion"):
            impact(interval.ball(Fraction(1, 2)), interval.ball(1), wide)
