"""Values of real functions on the circle: at places, and over all of it."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.fourier import Function
from cap.checker.kernel.interval import Interval

PLACES = 256
BITS = 96


def values(u: Function, places: Iterable[int], count: int, error: int, bits: int) -> list[Interval]:
    """Return enclosures at 2 pi place/count of the values of all real functions within an error.

    exp(ik theta) depends there on k modulo the count only: such coefficients are added up.
    """
    parts = [[0, 0] for _ in range(count)]
    for k, (re, im) in enumerate(u.coefficients):
        part = parts[k % count]
        part[0] += re * (2 if k else 1)
        part[1] += im * (2 if k else 1)
    unit = u.circle.unit
    pairs = [tuple(Interval.enclosing(Fraction(n, unit), Fraction(n, unit), bits) for n in part)
             for part in parts]  # fmt: skip
    turns = [cos_sin(pi(bits) * (2 * j) / count) for j in range(count)]
    far = Fraction(u.error + error, unit)
    found = []
    for place in places:
        total = Interval.enclosing(-far, far, bits)
        for k, (a, b) in enumerate(pairs):
            cos, sin = turns[k * place % count]
            total = total + cos * a - sin * b
        found.append(total)
    return found


def extent(u: Function) -> tuple[Fraction, Fraction]:
    """Return bounds of the values of a real polynomial.

    Between two of the places the function differs from the nearer one by at most |u'| pi/256, and
    |u'| <= 2 sum of k |u_k|.
    """
    there = values(u, range(PLACES), PLACES, 0, BITS)
    steepness = Fraction(2 * sum(k * size for k, size in enumerate(u.sizes)), u.circle.unit)
    far = steepness * pi(BITS).upper / PLACES
    return min(v.lower for v in there) - far, max(v.upper for v in there) + far
