"""Pi, cosine, sine and arccosine of intervals, from series.

For an alternating series of decreasing terms the remainder is at most the first term left out.

*Pi* = 16 arctan(1/5) - 4 arctan(1/239) (Machin).  With u_j = floor(2^p / n^(2j+1)) and each term
floor(u_j / (2j+1)), a term is wrong by less than 2 units 2^-p; the loop ends when u_j = 0, so the
remainder is below one unit.  N terms give an error below 2N + 1.

*Sine and cosine at a point a.*  With k the integer nearest to a / (pi/2), r = a - k pi/2 is at most
pi/4 in size (and a little, by the error of pi), and the quadrant k mod 4 gives cos a, sin a from
cos r, sin r.  With q = floor(r^2 2^-p) and u_0 = r >= 0, the loop

    u_j = floor(u_(j-1) q 2^-p / (2j (2j+1))),    sin r = u_0 - u_1 + u_2 - ...

has errors e_j <= (e_(j-1) + 1)/6 + 1 in units 2^-p, since q < 2^p and u_(j-1) < 2^p: so e_j < 2. It
ends with u_j = 0, so the first term left out is below 2, and N terms give an error below 2N + 2.
Then cos r = sqrt(1 - sin^2 r) > 1/2 has at most twice the error of sin r, since |tan r| < 2.

*Over an interval* [a, b], cosine and sine have their extrema at the ends or at the multiples n pi/2
in [a, b]: a maximum 1 of the sine at n = 1 mod 4, a minimum -1 at n = 3; of the cosine at 0 and 2.

*Arccosine* decreases; arccos y = 2 arctan sqrt((1 - y)/(1 + y)).  For x >= 0, arctan x = 2 arctan(x
/ (1 + sqrt(1 + x^2))) makes the argument at most tan(pi/4) = 1 after one step and then less than
half of itself at each step.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache, lru_cache
from math import isqrt

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

_HALVINGS = 9  # then x <= 2^-8, so each term of the arctangent is 16 bits smaller than the last


@cache
def pi(bits: int) -> Interval:
    """Return an enclosure of pi, at most two units 2^-bits wide."""
    p = bits + bits.bit_length() + 8  # the error is below 20 (p + 1) < 2^(p - bits - 1)
    (a, error_a), (b, error_b) = _arctan_of_inverse(5, p), _arctan_of_inverse(239, p)
    value, error = 16 * a - 4 * b, 16 * error_a + 4 * error_b
    return Interval(value - error, value + error, p).with_bits(bits)


def _arctan_of_inverse(n: int, p: int) -> tuple[int, int]:
    """Return arctan(1/n) in units 2^-p, and a bound of the error."""
    power, total, j = (1 << p) // n, 0, 0
    while power:
        total += (-1) ** j * (power // (2 * j + 1))
        power //= n * n
        j += 1
    return total, 2 * j + 1


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


def arccos(y: Interval) -> Interval:
    """Return an enclosure of {arccos t : t in y}; y must lie in the open interval (-1, 1)."""
    need(
        y.lies_inside(Fraction(-1), Fraction(1)), "arccosine of an interval that is not in (-1, 1)"
    )
    return Interval(_arccos_at(y.hi, y.bits).lo, _arccos_at(y.lo, y.bits).hi, y.bits)


def _arccos_at(a: int, bits: int) -> Interval:
    """Return an enclosure of the arccosine of the point a 2^-bits."""
    y = Interval(a, a, bits).with_bits(2 * bits + 16)  # the square root may halve the precision
    x = ((y.integer(1) - y) / (y.integer(1) + y)).sqrt()
    for _ in range(_HALVINGS):
        x = x / ((x.square() + 1).sqrt() + 1)
    return (_arctan_series(x) * (1 << _HALVINGS + 1)).with_bits(bits)


def _arctan_series(x: Interval) -> Interval:
    """Return an enclosure of arctan x for 0 <= x <= 1: x - x^3/3 + x^5/5 - ..."""
    square, power, total, j = x.square(), x, x.integer(0), 0
    while power.hi > 1:
        total = total + power / ((-1) ** j * (2 * j + 1))
        power = power * square
        j += 1
    return total + Interval(-power.hi, power.hi, x.bits)
