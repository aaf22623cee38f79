"""Cosines and sines of doubles, and doubles next to numbers, with bounds of what is wrong.

*Rounding.*  Doubles are those of IEEE 754, rounded to nearest (``rounding``): what is computed for
a sum, a product or a quotient is wrong by at most h = 2^-53 of the result, plus 2^-1075 if it
underflows.

*Cosine and sine of a double.*  pi/2 = P + Q + r, P with 33 bits, Q a double, |r| < 2^-80.  With k
the integer next to a/(pi/2), |k| < 2^16, k P is exact, and d = (a - k P) - k Q is at most 0.7855 in
size and wrong by at most 3 h.  The series end with d^15/15! and d^16/16!: what is left out is
below 0.7855^17/17! < 2^-54.  Horner's rule ends in d + d z and 1 + z, |z| < 0.11 or 0.31, with z
wrong by less than 6 h of itself, as the coefficients are by 2 h at most, however they were rounded
when this was loaded: together, less than 3 h + 2 h + 2 h + 2^-54 < 2^-50.
"""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

_UP, _TINY = 1 + 2.0**-40, 2.0**-900
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


def rounded(q: Fraction) -> tuple[float, float]:
    """Return the double next to a number, and a bound of the difference."""
    a = float(q)
    return a, float(abs(q - Fraction(a))) * _UP + _TINY


def of(z: Interval) -> tuple[float, float]:
    """Return a double in or next to an interval, and a bound of its distance from each point."""
    a = float((z.lower + z.upper) / 2)
    far = max(abs(z.lower - Fraction(a)), abs(z.upper - Fraction(a)))
    return a, float(far) * _UP + _TINY
