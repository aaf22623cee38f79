"""Attempts to certify a box of states in given windows, and how they are to fail."""

from fractions import Fraction

import pytest

from cap import interval
from cap.errors import NotProved
from cap.flow import BALLS, oscillator, over, strobe
from cap.interval import Ball
from cap.taylor_model import Domain, TaylorModel

BITS = 200
HAIR = Fraction(1, 10**9)
P_STAR = Fraction("0.1002798898441954"), Fraction("0.5419433067664584")
TIMES = Fraction("1.0991729107"), Fraction("3.5160904414")


def attempt(p, state, times, kind, *, radius=0, width=HAIR):
    """Certify the box of half-width ``radius`` in windows of half-width ``width``."""
    osc = oscillator(p)
    windows = tuple(t if isinstance(t, Ball) else interval.around(t, width) for t in times)
    if kind is BALLS:
        return strobe(
            osc, tuple(interval.around(c, Fraction(radius)) for c in state), windows, kind
        )
    domain = Domain((interval.ball(Fraction(radius)),) * 2, 2)
    state = domain.variables([interval.ball(c) for c in state])
    return strobe(over(osc, TaylorModel), state, windows, kind)


def refused(step, reason, *arguments, **options):
    """Check that the attempt fails at this step, for this reason; return the exception."""
    with interval.workprec(BITS), pytest.raises(NotProved) as caught:
        attempt(*arguments, **options)
    assert (caught.value.step, reason in caught.value.reason) == (step, True), str(caught.value)
    assert caught.value.sets
    return caught.value
