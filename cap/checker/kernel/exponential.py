"""The exponential and its integrals over intervals, from their series.

*The exponential's integrals* are, for n >= 1, the entire functions

    phi_n(z) = integral of (1 - u)^(n-1)/(n-1)! e^(zu) over 0 < u < 1,    and phi_0(z) = e^z.

The k-th derivatives have the further factor u^k in the integral, so they increase with z: the ends
of an interval suffice.  They are the sums of

    c_j z^j,      c_j = (j + k)!/(j! (j + k + n)!),      c_(j+1)/c_j <= 1/(j + 1).

At a point z, with a = |z| and m = 2 floor(a) + 2, the loop computes u_j near c_j a^j in units 2^-p,
each from the last one and rounded down: the errors e_j <= e_(j-1) a/j + 1 are at most the sum of
a^i/i!, so below e^a < 2^m.  It ends with u_j = 0 and j >= m; as a <= m/2, the terms from there on
are each at most half of the one before, so together below 2^(m+1).  With N terms before, the error
is below (N + 2) 2^m.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

BITS = 256  # of the exponential of a fraction


def exp(x: Fraction) -> Interval:
    """Return an enclosure of the exponential at a point; rejects |x| > 200."""
    return phi(0, Interval.enclosing(x, x, BITS))


def phi(n: int, z: Interval, k: int = 0) -> Interval:
    """Return an enclosure of the k-th derivative of phi_n over z, n >= 0; rejects |z| > 200."""
    need(max(abs(z.lo), abs(z.hi)) <= 200 << z.bits, "an exponent is too large")
    low = _phi_at(n, k, z.lo, z.bits)
    high = low if z.lo == z.hi else _phi_at(n, k, z.hi, z.bits)
    return Interval(low.lo, high.hi, z.bits)


def _phi_at(n: int, k: int, z: int, bits: int) -> Interval:
    """Return an enclosure of the k-th derivative of phi_n at the point z 2^-bits."""
    m = 2 * (abs(z) >> bits) + 2
    p = bits + m + 16
    term, total, j = (factorial(k) << p) // factorial(k + n), 0, 0
    while term or j < m:
        total += -term if z < 0 and j % 2 else term
        term = (term * abs(z) * (j + k + 1) >> bits) // ((j + 1) * (j + k + 1 + n))
        j += 1
    error = (j + 2) << m
    return Interval(total - error, total + error, p).with_bits(bits)
