"""Cosine and sine of intervals, from a series.

For an alternating series of decreasing terms the remainder is at most the first term left out.

*Sine and cosine at a point a.*  With k the integer nearest to a / (pi/2), r = a - k pi/2 is at most
pi/4 in size (and a little, by the error of pi), and the quadrant k mod 4 gives cos a, sin a from
cos r, sin r.  With q = floor(r^2 2^-p) and u_0 = r >= 0, the loop

    u_j = floor(u_(j-1) q 2^-p / (2j (2j+1))),    sin r = u_0 - u_1 + u_2 - ...

has errors e_j <= (e_(j-1) + 1)/6 + 1 in units 2^-p, since q < 2^p and u_(j-1) < 2^p: so e_j < 2. It
ends with u_j = 0, so the first term left out is below 2, and N terms give an error below 2N + 2.
Then cos r = sqrt(1 - sin^2 r) > 1/2 has at most twice the error of sin r, since |tan r| < 2.

*Over an interval* [a, b], cosine and sine have their extrema at the ends or at the multiples n pi/2
in [a, b]: a maximum 1 of the sine at n = 1 mod 4, a minimum -1 at n = 3; of the cosine at 0 and 2.
"""

from __future__ import annotations

from functools import cache, lru_cache
from math import isqrt

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval


def cos_sin(x: Interval) -> tuple[Interval, Interval]:
    """Return enclosures of {cos t : t in x} and {sin t : t in x}, a few units wider than these."""
    bits = x.bits
    magnitude = max(abs(x.lo), abs(x.hi)).bit_length()  # |t| < 2^(magnitude - bits)
    p = max(magnitude, bits) + bits.bit_length() + 16
    cos_lo, sin_lo = _cos_sin_at(x.lo << (p - bits), p)
    if x.lo == x.hi:
        return cos_lo.with_bits(bits), sin_lo.with_bits(bits)
    cos_hi, sin_hi = _cos_sin_at(x.hi << (p - bits), p)
    cos, sin = _hull(cos_lo, cos_hi), _hull(sin_lo, sin_hi)
    quarters = x.with_bits(p) / _half_pi(p)  # the interval in units pi/2
    first, last = -(-quarters.lo >> p), quarters.hi >> p
    for n in range(first, min(last, first + 3) + 1):  # four in a row are all there are
        cos, sin = _with_extremum(cos, n), _with_extremum(sin, n - 1)
    return cos.with_bits(bits), sin.with_bits(bits)


def _with_extremum(cosine: Interval, n: int) -> Interval:
    """Return the hull of the interval and cos(n pi/2), if that is an extremum."""
    if n % 2:
        return cosine
    return _hull(cosine, cosine.integer(1 - n % 4))


def _hull(x: Interval, y: Interval) -> Interval:
    """Return the least interval that contains both."""
    return Interval(min(x.lo, y.lo), max(x.hi, y.hi), x.bits)


@cache
def _half_pi(p: int) -> Interval:
    """Return an enclosure of pi/2."""
    whole = pi(p)
    return Interval(whole.lo, whole.hi, p + 1).with_bits(p)


@lru_cache(maxsize=1024)
def _cos_sin_at(a: int, p: int) -> tuple[Interval, Interval]:
    """Return enclosures of the cosine and the sine of the point a 2^-p."""
    half_pi = _half_pi(p)
    k = (2 * a + half_pi.lo) // (2 * half_pi.lo)
    r = a - k * half_pi.lo
    error = abs(k) * half_pi.width
    sin, rounding = _sine_series(abs(r), p)
    error += rounding
    cos = isqrt((1 << 2 * p) - sin * sin)
    sin = sin if r >= 0 else -sin
    c, s = (
        Interval(cos - 2 * error - 1, cos + 2 * error + 1, p),
        Interval(sin - error, sin + error, p),
    )
    return ((c, s), (-s, c), (-c, -s), (s, -c))[k % 4]


def _sine_series(r: int, p: int) -> tuple[int, int]:
    """Return the sine of r 2^-p, 0 <= r < 2^p, in units 2^-p, and a bound of the error."""
    square, term, total, j = r * r >> p, r, 0, 0
    while term:
        total += -term if j % 2 else term
        j += 1
        term = (term * square >> p) // (2 * j * (2 * j + 1))
    return total, 2 * j + 2
