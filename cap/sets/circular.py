"""Sine, cosine and arccosine of intervals of doubles, without the C library.

*Reduction.*  Let π/2 = P1 + P2 + P3 + ε, P1 and P2 of 33 bits, P3 the nearest double to the rest,
so |ε| <= 2^-121.  For |x| <= 2^20 and k the integer near 2x/π, |k| <= 667544 < 2^20.  Then k P1
and k P2 are exact.  x - k P1 is exact: k = 0, or x and k P1 are within a factor of two of each
other (Sterbenz), as |x - kπ/2| <= (π/4)(1 + 2^-30) and P1/2 < (π/4)(1 - 2^-35).  Knuth's sum of
that and -k P2 is exact in its two parts, a and the rest; b is the rest - k P3.  So
x - kπ/2 = a + b with an error below

    2^20 ε + rounding of k P3 and of b  <=  2^-101 + 3 * 2^-53 * 1.4e-15  <  5e-31,

where |a| <= 0.7855 and |b| <= 2^-54 + k P3 <= 1.5e-15.

*Polynomials.*  Taylor's, to a^17 for the sine and a^16 for the cosine: the remainders are below
a^19/19! < 9e-20 and a^18/18! < 2.1e-18.  With u = 2^-53 = 1.11e-16 and z = fl(a²) the computed

    c = 1 - ((z/2 - z² w) + b (a + a z q)),      s = a + (a z q + b c)

have the following errors.  In c: z/2 <= 0.309 has a relative one of u, z² w <= 0.0159 of 7u; the
difference and the sum in brackets, below 0.31, are rounded by at most 2^-55 each; b times the sine
of a has 10 roundings, the second order in b is below b²; the last difference, in [0.7, 1], is
rounded by at most 2^-54.  So |c - cos| <= 3.5e-17 + 1.3e-17 + 5.6e-17 + 5.6e-17 + 2.1e-18 + 1e-29 <
1.7e-16.  In s: |a z q| <= 0.0787 has a relative error of 7u; b c one of 2u beside that of c; their
sum is rounded by at most u 0.079, that with a, below 0.7073, by at most 2^-54; the second order in
b is below b².  So |s - sin| <= 6.2e-17 + 8.8e-18 + 5.6e-17 + 1e-19 < 1.3e-16.

`ERROR` = 2^-52 = 2.2e-16 is more than both.
"""

import math

from cap.sets.doubles import (
    GROWTH,
    Interval,
    clipped,
    is_positive,
    lower,
    magnitude,
    widened,
)

LIMIT = 2.0**20
ERROR = 2.0**-52
WIDE = 0.125  # a radius from which it is worth to remember that |sin| and |cos| are at most 1
QUARTER_1 = float.fromhex("0x1.921fb54400000p+0")  # 33 bits of π/2
QUARTER_2 = float.fromhex("0x1.0b4611a600000p-34")  # the next 33
QUARTER_3 = float.fromhex("0x1.3198a2e037073p-69")  # the nearest double to the rest
PER_QUARTER = 2 / math.pi  # it only chooses k

PI = Interval(math.pi, 2.0**-52)  # |π - its double| < 1.23e-16
TURN = Interval(2 * math.pi, 2.0**-51)


def sin_cos_of_double(x: float) -> tuple[float, float]:
    """Return sin x and cos x up to `ERROR` for |x| <= `LIMIT`, else NaN."""
    if not abs(x) <= LIMIT:
        return math.nan, math.nan
    k = math.floor(x * PER_QUARTER + 0.5)
    n = float(k)
    y, p = x - n * QUARTER_1, n * QUARTER_2
    a = y - p
    t = a - y
    b = ((y - (a - t)) - (p + t)) - n * QUARTER_3
    z = a * a
    tail = a * z * _sine_tail(z)
    c = 1.0 - ((0.5 * z - z * z * _cosine_tail(z)) + b * (a + tail))
    s = a + (tail + b * c)
    even = k & 1 == 0
    sine, cosine = (s, c) if even else (c, s)
    return (sine if k & 2 == 0 else -sine), (cosine if (k + 1) & 2 == 0 else -cosine)


def _sine_tail(z: float) -> float:
    """Return q: sin a = a + a z q, z = a²."""
    high = 1 / 6227020800 - z * (1 / 1307674368000 - z * (1 / 355687428096000))
    low = 1 / 5040 - z * (1 / 362880 - z * (1 / 39916800 - z * high))
    return -1 / 6 + z * (1 / 120 - z * low)


def _cosine_tail(z: float) -> float:
    """Return w: cos a = 1 - (z/2 - z² w)."""
    high = 1 / 479001600 - z * (1 / 87178291200 - z * (1 / 20922789888000))
    low = 1 / 40320 - z * (1 / 3628800 - z * high)
    return 1 / 24 - z * (1 / 720 - z * low)


def sin_cos(x: Interval) -> tuple[Interval, Interval]:
    """Return the sines and the cosines of the points; NaN if |mid| > `LIMIT`.

    |sin(m + d) - sin m| <= |cos m| |d| + |sin m| d²/2, and likewise for the cosine.
    """
    s, c = sin_cos_of_double(x.mid)
    r = x.rad * GROWTH
    first, second = (abs(s) + ERROR) * r, (abs(c) + ERROR) * r
    half = 0.5 * r
    sine = Interval(s, (ERROR + (second + first * half)) * GROWTH)
    cosine = Interval(c, (ERROR + (first + second * half)) * GROWTH)
    if r < WIDE:
        return sine, cosine
    return clipped(sine, -1.0, 1.0), clipped(cosine, -1.0, 1.0)


def shifted(sine: Interval, cosine: Interval, by: Interval) -> tuple[Interval, Interval]:
    """Return sin(t + d) and cos(t + d), from sin t and cos t: the remainders are at most d²/2."""
    size = magnitude(by)
    rest = 0.5 * size * size
    return widened(sine + cosine * by, rest), widened(cosine - sine * by, rest)


def acos(x: Interval) -> Interval:
    """Return the arccosines; NaN if this is not certain: x may be too near -1 or 1.

    Let y be near acos(mid) and D >= |x - cos y| for all x of the interval.  If [y - r, y + r] lies
    in (0, π), sin >= σ > 0 there and D/σ <= r, then |acos x - y| <= D/σ: the mean value theorem.
    """
    y = _near_acos(x.mid)
    far = magnitude(x - sin_cos(Interval(y, 0.0))[1])
    window = Interval(y, 2 * far / math.sqrt(abs(1 - x.mid * x.mid) + far))
    least = lower(sin_cos(window)[0])
    if not (is_positive(window) and is_positive(PI - window) and least > 0):
        return Interval(math.nan, math.nan)
    r = far / least * GROWTH
    return Interval(y, r) if r <= window.rad else Interval(math.nan, math.nan)


def _near_acos(x: float) -> float:
    """Return a double near acos x (Abramowitz and Stegun 4.4.45, then Newton): it needs no trust.

    NaN for |x| > 1.
    """
    size = abs(x)
    if not size <= 1:
        return math.nan
    cubic = 1.5707288 - size * (0.2121144 - size * (0.0742610 - size * 0.0187293))
    y = math.sqrt(1 - size) * cubic
    if x < 0:
        y = math.pi - y
    for _ in range(3):
        sine, cosine = sin_cos_of_double(y)
        if sine > 0:
            y = y + (cosine - x) / sine
    return y


BRANCHING = (
    *(sin_cos_of_double, sin_cos, shifted, acos),
    *(_sine_tail, _cosine_tail, _near_acos),
)
