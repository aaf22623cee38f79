"""Pi, and the arccosine of intervals, from the series of the arctangent.

For an alternating series of decreasing terms the remainder is at most the first term left out.

*Arccosine* decreases; arccos y = 2 arctan sqrt((1 - y)/(1 + y)).  For x >= 0, arctan x = 2 arctan(x
/ (1 + sqrt(1 + x^2))) makes the argument at most tan(pi/4) = 1 after one step and then less than
half of itself at each step.
"""

from __future__ import annotations

from functools import cache

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

_HALVINGS = 9  # then x <= 2^-8, so each term of the arctangent is 16 bits smaller than the last


@cache
def pi(bits: int) -> Interval:
    """Return an enclosure of pi, at most two units 2^-bits wide."""
    p = bits + bits.bit_length() + 16  # the p/16 terms are three units wide each, or less
    return (_arctan(Interval(1 << p, 1 << p, p)) * 4).with_bits(bits)


def arccos(y: Interval) -> Interval:
    """Return an enclosure of {arccos t : t in y}; y must lie in the open interval (-1, 1)."""
    need(y.magnitude().is_before(1), "arccosine of an interval that is not in (-1, 1)")
    return Interval(_arccos_at(y.hi, y.bits).lo, _arccos_at(y.lo, y.bits).hi, y.bits)


def _arccos_at(a: int, bits: int) -> Interval:
    """Return an enclosure of the arccosine of the point a 2^-bits."""
    y = Interval(a, a, bits).with_bits(2 * bits + 16)  # the square root may halve the precision
    return (_arctan(((y.integer(1) - y) / (y.integer(1) + y)).sqrt()) * 2).with_bits(bits)


def _arctan(x: Interval) -> Interval:
    """Return an enclosure of arctan x for x >= 0, after halvings: x - x^3/3 + x^5/5 - ..."""
    for _ in range(_HALVINGS):
        x = x / ((x.square() + 1).sqrt() + 1)
    square, power, total, j = x.square(), x, x.integer(0), 0
    while power.hi > 1:
        total = total + power / ((-1) ** j * (2 * j + 1))
        power = power * square
        j += 1
    return (total + Interval(-power.hi, power.hi, x.bits)) * (1 << _HALVINGS)
