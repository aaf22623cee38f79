"""Planar maps given by formulas: yardsticks, for which others have published bounds.

*The Henon map* (x, y) -> (1 - a x^2 + y, b x).

*The standard map* (x, y) -> (x + y', y'), y' = y + K sin x, x and y modulo 2 pi, on the square |x|,
|y| < pi: where x + y' or y' is a multiple of 2 pi plus pi the square is cut, and the map is not
defined.  An orbit that stays in the square is one of the map of the torus, so a compact invariant
set of the one is one of the other, with the same entropy.
"""

from __future__ import annotations

import math
from fractions import Fraction

from cap.checker.coverings.planar import Image
from cap.checker.kernel.doubles import PI, Double, cos_sin, enclosing
from cap.checker.kernel.rejection import need

_ZERO, _ONE = Double(0.0), Double(1.0)


class Henon:
    """The Henon map."""

    def __init__(self, a: Fraction, b: Fraction) -> None:
        need(b != 0, "the map is not injective")
        self.a, self.b = enclosing(a), enclosing(b)

    def image(self, x: Double, y: Double) -> Image:
        """Enclose the map and its derivative."""
        derivative = (self.a * x * -2.0, _ONE), (self.b, _ZERO)
        return Image(_ONE - self.a * x * x + y, self.b * x, derivative)


class Standard:
    """The standard map, cut open."""

    def __init__(self, K: Fraction) -> None:
        self.K = enclosing(K)

    def image(self, x: Double, y: Double) -> Image:
        """Enclose the map and its derivative; reject what may be at a cut."""
        need(_within(x) and _within(y), "a state that may be at a cut")
        cos, sin = cos_sin(x)
        v, k = y + self.K * sin, self.K * cos
        v = _reduced(v)
        return Image(_reduced(x + v), v, ((k + 1.0, _ONE), (k, _ONE)))


def _within(x: Double) -> bool:
    """Return whether -pi < x < pi is certain."""
    return (PI - x).is_positive() and (PI + x).is_positive()


def _reduced(x: Double) -> Double:
    """Return x modulo 2 pi, in (-pi, pi); reject what may be at a cut."""
    turns = float(math.floor(x.mid / (2 * math.pi) + 0.5))
    result = x - PI * (2.0 * turns)
    need(_within(result), "an image that may be at a cut")
    return result
