"""Intervals of doubles, rounded outwards: fast, where 10^-9 is enough.

A ``Double`` (mid, rad) is the set of the reals within rad of mid.  Every operation returns one that
contains the exact results for all points of its operands.  Python's floats are IEEE 754 doubles,
rounded to nearest (``rounding`` looks at that).  With u = 2^-53, for + - * / and sqrt,

    |fl(z) - z| <= u |fl(z)| + 2^-1075.

A radius is a sum of products of nonnegative numbers, in at most 20 roundings; each may lose a
factor 1 - u, and (1 - u)^20 GROWTH > 1.  TINY covers what underflows.  An infinity or a NaN makes
every comparison false: what is not finite proves nothing.

*Cosine and sine.*  x - k pi/2 is computed in intervals, for k near 2x/pi; let a be its midpoint,
|a| <= 0.8, z = a^2.  With the nested sums

    sin a = a (1 - z/(2 3) (1 - z/(4 5) (1 - ...))),     cos a = 1 - z/(1 2) (1 - z/(3 4) (1 - ...))

of ten factors, the first term left out is below 10^-20.  Each factor is p = 1 - c q, c = fl(z/n) <=
0.32, 0 <= q <= 1: c q has a relative error below 3u (in z, in the quotient, in the product), the
difference one of u/2, and the error of q counts c: so it is below (0.96 + 0.5) u/(1 - 0.32) < 3u.
Then a p has one below 3u + u.  ERROR = 2^-50 = 8u is more.  Over the radius r of x - k pi/2,
|sin(a + d) - sin a| <= |cos a| r + r^2/2, and likewise for the cosine.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache

from cap.checker.kernel.rejection import need

UNIT = 2.0**-53
GROWTH = 1 + 2.0**-47
TINY = 2.0**-1000
ERROR = 2.0**-50


class Double:
    """The reals within ``rad`` >= 0 of ``mid``; a float operand stands for itself, exactly."""

    __slots__ = ("mid", "rad")

    def __init__(self, mid: float, rad: float = 0.0) -> None:
        self.mid, self.rad = mid, rad

    def __add__(self, y: Double | float) -> Double:
        if y.__class__ is Double:
            mid = self.mid + y.mid
            return Double(mid, (self.rad + y.rad + UNIT * abs(mid)) * GROWTH)
        mid = self.mid + y  # type: ignore[operator]
        return Double(mid, (self.rad + UNIT * abs(mid)) * GROWTH)

    def __sub__(self, y: Double | float) -> Double:
        if y.__class__ is Double:
            mid = self.mid - y.mid
            return Double(mid, (self.rad + y.rad + UNIT * abs(mid)) * GROWTH)
        mid = self.mid - y  # type: ignore[operator]
        return Double(mid, (self.rad + UNIT * abs(mid)) * GROWTH)

    def __mul__(self, y: Double | float) -> Double:
        """Return the product: |(m + a)(n + b) - m n| <= |m| |b| + |a| (|n| + |b|)."""
        if y.__class__ is Double:
            mid = self.mid * y.mid
            spread = abs(self.mid) * y.rad + self.rad * (abs(y.mid) + y.rad)
            return Double(mid, (spread + UNIT * abs(mid) + TINY) * GROWTH)
        mid = self.mid * y  # type: ignore[operator]
        return Double(mid, (self.rad * abs(y) + UNIT * abs(mid) + TINY) * GROWTH)  # type: ignore[arg-type]

    def __neg__(self) -> Double:
        return Double(-self.mid, self.rad)

    def __truediv__(self, y: Double) -> Double:
        """Return the quotient: (m + a)/(n + b) - m/n = (a - (m/n) b)/(n + b)."""
        least = (abs(y.mid) - y.rad) * (1 - 2.0**-47)
        need(least > TINY, "division by an interval that may contain zero")
        mid = self.mid / y.mid
        spread = (self.rad + (abs(mid) + TINY) * GROWTH * y.rad + TINY) / least
        return Double(mid, (spread + UNIT * abs(mid) + TINY) * GROWTH)

    def sqrt(self) -> Double:
        """Return the square roots: |sqrt(m + a) - sqrt m| <= |a|/sqrt(m)."""
        need(self.mid > self.rad, "square root of an interval that may contain zero")
        mid = math.sqrt(self.mid)
        return Double(mid, (self.rad / mid * GROWTH + UNIT * mid + TINY) * GROWTH)

    @property
    def lower(self) -> float:
        """A double that is at most all points."""
        return math.nextafter(self.mid - self.rad, -math.inf)

    @property
    def upper(self) -> float:
        """A double that is at least all points."""
        return math.nextafter(self.mid + self.rad, math.inf)

    @property
    def magnitude(self) -> float:
        """A double that is at least the absolute values of all points."""
        return (abs(self.mid) + self.rad) * GROWTH

    def is_positive(self) -> bool:
        """Return whether all points are positive."""
        return self.mid > self.rad

    def widened(self, by: float) -> Double:
        """Return the points within ``by`` >= 0 of these."""
        return Double(self.mid, (self.rad + by) * GROWTH)


def enclosing(q: Fraction) -> Double:
    """Return an interval that contains a rational number."""
    mid = float(q)
    return Double(mid, float(abs(q - Fraction(mid))) * GROWTH + TINY)


def between(low: float, high: float) -> Double:
    """Return an interval that contains [low, high]."""
    mid = 0.5 * (low + high)
    return Double(mid, max(high - mid, mid - low) * GROWTH + TINY)


HALF_PI = Double(math.pi / 2, 2.0**-53)  # |pi/2 - its double| < 6.2e-17
PI = Double(math.pi, 2.0**-52)
_COSINE = [(2 * j + 1) * (2 * j + 2.0) for j in range(9, -1, -1)]
_SINE = [(2 * j + 2) * (2 * j + 3.0) for j in range(9, -1, -1)]


def cos_sin(x: Double) -> tuple[Double, Double]:
    """Return the cosines and the sines of the points; |x| < 1000."""
    return _cos_sin(x.mid, x.rad)


@lru_cache(maxsize=1024)
def _cos_sin(mid: float, rad: float) -> tuple[Double, Double]:
    """Return them; many launches begin at one time."""
    x = Double(mid, rad)
    k = round(x.mid / HALF_PI.mid)
    rest = x - HALF_PI * float(k)
    a, r = rest.mid, rest.rad
    need(abs(k) < 1000 and abs(a) <= 0.8, "a cosine of what is too large")
    z, c, s = a * a, 1.0, 1.0
    for n, m in zip(_COSINE, _SINE, strict=True):
        c, s = 1.0 - z / n * c, 1.0 - z / m * s
    s *= a
    second = r * r + ERROR
    cos = Double(c, (abs(s) * r + second) * GROWTH)
    sin = Double(s, (abs(c) * r + second) * GROWTH)
    return ((cos, sin), (-sin, cos), (-cos, -sin), (sin, -cos))[k % 4]
