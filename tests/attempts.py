"""Attempts to certify a box of states with an itinerary, and how they are to fail."""

from fractions import Fraction

import pytest

from cap.errors import NotProved
from cap.flow.event import BALLS, Expected
from cap.flow.strobe import oscillator, strobe
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

BITS = 200
HAIR = Fraction(1, 10**9)
P_STAR = Fraction("0.1002798898441954"), Fraction("0.5419433067664584")
TIMES = Fraction("1.0991729107"), Fraction("3.5160904414")


def hits(v, times, width=HAIR):
    """Return the itinerary of alternating hits that begins in the direction of ``v``."""
    words = ("hit r", "hit l") if v > 0 else ("hit l", "hit r")
    windows = [t if isinstance(t, Ball) else interval.around(t, Fraction(width)) for t in times]
    return tuple(Expected(words[k % 2], window) for k, window in enumerate(windows))


def box(state, kind, radius=0, order=2):
    """Return the box of half-width ``radius`` around a state, over balls or Taylor models."""
    if kind is BALLS:
        return tuple(interval.around(c, Fraction(radius)) for c in state)
    domain = Domain((interval.ball(Fraction(radius)),) * 2, order)
    return domain.variables([interval.ball(c) for c in state])


def attempt(p, state, times, kind, *, radius=0, width=HAIR):
    """Certify the box of half-width ``radius``, with hits in windows of half-width ``width``."""
    expected = hits(state[1], times, width)
    return strobe(oscillator(p), box(state, kind, radius), expected, kind)


def refused(step, reason, *arguments, **options):
    """Check that the attempt fails at this step, for this reason; return the exception."""
    with interval.workprec(BITS), pytest.raises(NotProved) as caught:
        attempt(*arguments, **options)
    assert (caught.value.step, reason in caught.value.reason) == (step, True), str(caught.value)
    assert caught.value.sets
    return caught.value
