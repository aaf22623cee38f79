"""Two masses, the second one anywhere in a set: the parameters of `second_mass`."""

from fractions import Fraction

from cap.sets import interval
from cap.sets.interval import Ball

Values = dict[str, Ball]


def values(m: Fraction, q: Ball) -> Values:
    """Return k = 1/q, a = 2q/(m + q), b = 2m/(m + q), c = (q - m)/(m + q), for all q of a set."""
    ratio = interval.ball(m) / q
    a, b = 2 / (1 + ratio), 2 / (1 + 1 / ratio)
    return {"k": 1 / q, "a": a, "b": b, "c": 1 - b}


def rates(m: Fraction, q: Ball) -> Values:
    """Return their derivatives by q."""
    whole = interval.ball(m) + q
    a = 2 * interval.ball(m) / (whole * whole)
    return {"k": -1 / (q * q), "a": a, "b": -a, "c": a}
