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
in [a, b], where both are 0, 1 or -1.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import isqrt

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval

CosSin = tuple[Interval, Interval]


def cos_sin(x: Interval) -> CosSin:
    """Return enclosures of {cos t : t in x} and {sin t : t in x}, a few units wider than these."""
    bits = x.bits
    magnitude = max(abs(x.lo), abs(x.hi)).bit_length()  # |t| < 2^(magnitude - bits)
    p = max(magnitude, bits) + bits.bit_length() + 16
    half_turns = x.with_bits(p) / pi(p)
    first, last = -(-2 * half_turns.lo >> p), 2 * half_turns.hi >> p
    inner = range(first, min(last, first + 3) + 1)  # four in a row are all there are
    points = [_cos_sin_at(t << (p - bits), p) for t in (x.lo, x.hi)]
    points += [_turned(x.integer(1).with_bits(p), x.integer(0).with_bits(p), n) for n in inner]
    cos, sin = (hull(values).with_bits(bits) for values in zip(*points, strict=True))
    return cos, sin


def hull(parts: Sequence[Interval]) -> Interval:
    """Return the least interval that contains all."""
    return Interval(min(q.lo for q in parts), max(q.hi for q in parts), parts[0].bits)


def _turned(cos: Interval, sin: Interval, n: int) -> CosSin:
    """Return the cosine and the sine of an angle after n quarters of a turn."""
    return ((cos, sin), (-sin, cos), (-cos, -sin), (sin, -cos))[n % 4]


@lru_cache(maxsize=1024)
def _cos_sin_at(a: int, p: int) -> CosSin:
    """Return enclosures of the cosine and the sine of the point a 2^-p."""
    half_pi = pi(p - 1)  # its ends in units 2^-p enclose pi/2
    k = (2 * a + half_pi.lo) // (2 * half_pi.lo)
    r = a - k * half_pi.lo
    sin, error = _sine_series(abs(r), p)
    error = 2 * (error + abs(k) * half_pi.width) + 1  # of the cosine; that of the sine is less
    cos, sin = isqrt((1 << 2 * p) - sin * sin), sin if r >= 0 else -sin
    c, s = Interval(cos - error, cos + error, p), Interval(sin - error, sin + error, p)
    return _turned(c, s, k)


def _sine_series(r: int, p: int) -> tuple[int, int]:
    """Return the sine of r 2^-p, 0 <= r < 2^p, in units 2^-p, and a bound of the error."""
    square, term, total, j = r * r >> p, r, 0, 0
    while term:
        total += -term if j % 2 else term
        j += 1
        term = (term * square >> p) // (2 * j * (2 * j + 1))
    return total, 2 * j + 2
