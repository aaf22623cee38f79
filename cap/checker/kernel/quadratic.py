"""Quadratic models in doubles: a polynomial of degree 2 in X, Y, and a bound of what is left.

A model (a, x, y, xx, xy, yy, e) of a quantity over a box says that it is, at each (X, Y) in [-1,
1]^2, a + x X + y Y + xx X^2 + xy X Y + yy Y^2 + r with |r| <= e; the first six are doubles, taken
exactly.  Each operation keeps this true for the result.

*Rounding.*  Doubles are those of IEEE 754, rounded to nearest: what is computed for a sum, a
product or a quotient is wrong by at most h = 2^-53 of the result, plus 2^-1075 if it underflows.
A coefficient of a sum is one sum, wrong by at most h of itself.  A coefficient of a product is a
sum of up to four products, wrong by at most 5 h times the sum of their sizes (n - 1 sums and a
product, and higher order): all of them by at most 5 h |p| |q|, if |p| is the sum of the sizes of
the coefficients of p.  Bounds e are sums and products of numbers that are not negative, at most 30
operations each: too small by less than 32 h of themselves.  `_UP` = 1 + 2^-40 makes up for that,
`_SUM` = 2^-51 and `_PRODUCT` = 2^-50 for 2 h and 5 h with their own rounding, `_TINY` for
underflow.

*Terms of degree 3 and 4* of a product are at most |p1| |q2| + |p2| |q1| + |p2| |q2|, p1 and p2 the
parts of degree 1 and 2.

*Cosine and sine* of a + g, |g| <= G: with c, s those of a, sin(a + g) = s + c g - s g^2/2 + r with
|r| <= G^3/6, and cos(a + g) = c - s g - c g^2/2 + r.

*Cosine and sine of a double.*  pi/2 = P + Q + r, P with 33 bits, Q a double, |r| < 2^-80.  With k
the integer next to a/(pi/2), |k| < 2^16, k P is exact, and d = (a - k P) - k Q is at most 0.7855 in
size and wrong by at most 3 h.  The series end with d^15/15! and d^16/16!: what is left out is
below 0.7855^17/17! < 2^-54.  Horner's rule ends in d + d z and 1 + z, |z| < 0.11 or 0.31, with z
wrong by less than 4 h of itself: together, less than 3 h + 2 h + 2 h + 2^-54 < 2^-50.  With the
rounding of the coefficients, at most 4 h (1 + G + G^2), this is below `_ANGLE` = 2^-49 times that.
"""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.elementary import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

Model = tuple[float, float, float, float, float, float, float]

_UP = 1 + 2.0**-40
_SUM, _PRODUCT, _ANGLE, _TINY = 2.0**-51, 2.0**-50, 2.0**-49, 2.0**-900
_BITS = 160


def _halves() -> tuple[float, float]:
    """Return P and Q, doubles with P + Q next to pi/2."""
    half = pi(_BITS).lower / 2
    first = Fraction(int(half * 2**32), 2**32)
    return float(first), float(half - first)


_P, _Q = _halves()
_QUARTERS = 1 / (_P + _Q)
_SIN = [
    (-1) ** n / float(f)
    for n, f in enumerate((6, 120, 5040, 362880, 39916800, 6227020800, 1307674368000), 1)
]
_COS = [
    (-1) ** n / float(f)
    for n, f in enumerate((2, 24, 720, 40320, 3628800, 479001600, 87178291200, 20922789888000), 1)
]


def cos_sin(a: float) -> tuple[float, float]:
    """Return doubles next to the cosine and the sine of a double, wrong by at most 2^-50."""
    k = round(a * _QUARTERS)
    need(abs(k) < 65536, "an angle is too large")
    d = (a - k * _P) - k * _Q
    q = d * d
    z = 0.0
    for c in reversed(_SIN):
        z = (z + c) * q
    s = d + d * z
    z = 0.0
    for c in reversed(_COS):
        z = (z + c) * q
    c = 1 + z
    k &= 3
    if k == 0:
        return c, s
    if k == 1:
        return -s, c
    return (-c, -s) if k == 2 else (s, -c)


def constant(a: float, e: float = 0.0) -> Model:
    """Return the model of a number within e of a double."""
    return a, 0.0, 0.0, 0.0, 0.0, 0.0, e


def rounded(q: Fraction) -> tuple[float, float]:
    """Return the double next to a number, and a bound of the difference."""
    a = float(q)
    return a, float(abs(q - Fraction(a))) * _UP + _TINY


def of(z: Interval) -> tuple[float, float]:
    """Return a double in or next to an interval, and a bound of its distance from each point."""
    a = float((z.lower + z.upper) / 2)
    far = max(abs(z.lower - Fraction(a)), abs(z.upper - Fraction(a)))
    return a, float(far) * _UP + _TINY


def moved(p: Model, a: float, e: float) -> Model:
    """Return p plus a number within e of a."""
    c = p[0] + a
    return c, p[1], p[2], p[3], p[4], p[5], (p[6] + e + abs(c) * _SUM) * _UP


def widened(p: Model, e: float) -> Model:
    """Return the model of what differs from p by at most e."""
    return p[0], p[1], p[2], p[3], p[4], p[5], (p[6] + e) * _UP


def total(p: Model, q: Model) -> Model:
    """Return p + q."""
    a0, a1, a2, a3, a4, a5, e = p
    b0, b1, b2, b3, b4, b5, f = q
    a0 += b0
    a1 += b1
    a2 += b2
    a3 += b3
    a4 += b4
    a5 += b5
    size = abs(a0) + abs(a1) + abs(a2) + abs(a3) + abs(a4) + abs(a5)
    return a0, a1, a2, a3, a4, a5, (e + f + size * _SUM) * _UP


def scaled(p: Model, c: float, d: float = 0.0) -> Model:
    """Return p times a number within d of c."""
    a0, a1, a2, a3, a4, a5, e = p
    size = abs(a0) + abs(a1) + abs(a2) + abs(a3) + abs(a4) + abs(a5)
    most = abs(c) * _SUM + d
    rest = (size * most + e * (abs(c) + d) + _TINY) * _UP
    return a0 * c, a1 * c, a2 * c, a3 * c, a4 * c, a5 * c, rest


def product(p: Model, q: Model) -> Model:
    """Return p q."""
    a0, a1, a2, a3, a4, a5, e = p
    b0, b1, b2, b3, b4, b5, f = q
    p1, p2 = abs(a1) + abs(a2), abs(a3) + abs(a4) + abs(a5)
    q1, q2 = abs(b1) + abs(b2), abs(b3) + abs(b4) + abs(b5)
    p0, q0 = abs(a0) + p1 + p2, abs(b0) + q1 + q2
    rest = p1 * q2 + p2 * (q1 + q2) + e * (q0 + f) + f * p0 + p0 * q0 * _PRODUCT + _TINY
    return (
        a0 * b0,
        a0 * b1 + a1 * b0,
        a0 * b2 + a2 * b0,
        a0 * b3 + a3 * b0 + a1 * b1,
        a0 * b4 + a4 * b0 + a1 * b2 + a2 * b1,
        a0 * b5 + a5 * b0 + a2 * b2,
        rest * _UP,
    )


def inverse(p: Model) -> Model:
    """Return 1/p: with p c = 1 + g for a double c and |g| <= G < 1/2, it is c (1 - g + g^2 - r).

    |r| <= G^3/(1 - G) <= 2 G^3.
    """
    need(p[0] != 0, "a model that may vanish is inverted")
    c = 1 / p[0]
    g = moved(scaled(p, c), -1.0, 0.0)
    size = bound(g)
    need(size < 0.5, "a model that may vanish is inverted")
    series = moved(total(scaled(g, -1.0), product(g, g)), 1.0, 2 * size * size * size * _UP)
    return scaled(series, c)


def bound(p: Model) -> float:
    """Return a bound of |p|."""
    size = abs(p[0]) + abs(p[1]) + abs(p[2]) + abs(p[3]) + abs(p[4]) + abs(p[5])
    return (size + p[6]) * _UP + _TINY


def ends(p: Model) -> tuple[float, float]:
    """Return a lower and an upper bound of p; X^2 and Y^2 are in [0, 1]."""
    a, x, y, xx, xy, yy, e = p
    spread = abs(x) + abs(y) + abs(xy) + e
    low, high = spread, spread
    if xx > 0:
        high += xx
    else:
        low -= xx
    if yy > 0:
        high += yy
    else:
        low -= yy
    more = (abs(a) + low + high) * _SUM + _TINY
    return a - (low + more) * _UP, a + (high + more) * _UP


def trigonometric(p: Model) -> tuple[Model, Model]:
    """Return the cosine and the sine of p."""
    a, x, y, xx, xy, yy, e = p
    c, s = cos_sin(a)
    first, second = abs(x) + abs(y), abs(xx) + abs(xy) + abs(yy)
    size = first + second + e
    left = (second + e) * (size + first) * 0.5  # of g^2/2, but for (x X + y Y)^2/2
    left = (left + e + size * size * size / 6 + (1 + size + size * size) * _ANGLE) * _UP
    hx, hxy, hy = x * x * 0.5, x * y, y * y * 0.5
    cos = c, -s * x, -s * y, -s * xx - c * hx, -s * xy - c * hxy, -s * yy - c * hy, left
    sin = s, c * x, c * y, c * xx - s * hx, c * xy - s * hxy, c * yy - s * hy, left
    return cos, sin


def half(p: Model, along: int, side: float) -> Model:
    """Return p on half of the box: X in [-1, 0] or [0, 1] for the side -1 or 1; or, 1, Y."""
    a, x, y, xx, xy, yy, e = p
    size = abs(a) + abs(x) + abs(y) + abs(xx) + abs(xy) + abs(yy)
    e = (e + size * _PRODUCT) * _UP
    if along:
        return (
            a + side * 0.5 * y + 0.25 * yy,
            x + side * 0.5 * xy,
            0.5 * y + side * 0.5 * yy,
            xx,
            0.5 * xy,
            0.25 * yy,
            e,
        )
    return (
        a + side * 0.5 * x + 0.25 * xx,
        0.5 * x + side * 0.5 * xx,
        y + side * 0.5 * xy,
        0.25 * xx,
        0.5 * xy,
        yy,
        e,
    )
