"""How a velocity relaxes under viscosity, over intervals of doubles and over doubles.

With D = exp(-μd), h = (1 - D)/μ and k = (d - h)/μ (`cap.flow.relaxation`), and z = μd,

    k = d² (1/2! - z/3! + z²/4! - ...),      h = d - μk,      D = 1 - μh,

and as h is the integral of D and k that of h, from 0 to d,

    D(2d) = D²,      h(2d) = h (1 + D),      k(2d) = k (1 + D) + d h.

So the series is only needed for |z| <= 0.26, and nothing cancels.  There, what follows its 12 terms
is at most |z|^12 e^|z|/14! < 2e-18, and the rounding of its coefficients, of which 1/2 is exact,
changes it by at most u (0.26/3! + 0.26²/4! + ...) < u/20: together less than `REST` = 2^-56.
"""

import math
from typing import Any

from cap.sets.doubles import GROWTH, TINY, Interval, magnitude, widened

REST = 2.0**-56
SHORT, REACH = 0.25, 0.26
LONGEST = 2.0**10  # of z; D is below 1e-400 then


def relax(mu: Interval, d: Interval) -> tuple[Interval, Interval, Interval]:
    """Return (D, h, k); NaN unless -1/4 <= μd <= 2^10, nearly.

    The midpoint of d is computed with.  On [d - r, d + r], |D'| <= μ D(d) exp(μr), h' = D > 0 and
    |k'| = |h|; and exp(μr) <= 1 + 2μr for μr <= 1.
    """
    doublings, part = _halved(mu.mid, d.mid)
    t = Interval(part, 0.0)
    z = mu * t
    k = t * t * widened(_series(z), REST)
    h = t - mu * k
    D = 1.0 - mu * h
    for _ in range(doublings):
        D, h, k, t = D * D, h * (1.0 + D), k * (1.0 + D) + t * h, t + t
    r = d.rad
    rate = magnitude(mu) * r * GROWTH
    if not (rate <= 1 and magnitude(z) <= REACH):
        return _nothing(), _nothing(), _nothing()
    most = magnitude(D) * (1 + 2 * rate) * GROWTH
    wide_h = widened(h, most * r * GROWTH + TINY)
    return (
        widened(D, most * rate * GROWTH + TINY),
        wide_h,
        widened(k, magnitude(wide_h) * r * GROWTH + TINY),
    )


def relax_double(mu: float, d: float) -> tuple[float, float, float]:
    """Return approximations of (D, h, k): hints, not rigorous."""
    doublings, t = _halved(mu, d)
    k = t * t * _series(mu * t)
    h = t - mu * k
    D = 1.0 - mu * h
    for _ in range(doublings):
        D, h, k, t = D * D, h * (1.0 + D), k * (1.0 + D) + t * h, t + t
    return D, h, k


def _halved(mu: float, d: float) -> tuple[int, float]:
    """Return how often d is to be halved, and what it is then; NaN if there is no such number."""
    n, z = 0, abs(mu * d)
    if not (-SHORT <= mu * d <= LONGEST):
        return 0, math.nan
    while z > SHORT:
        n, z, d = n + 1, 0.5 * z, 0.5 * d
    return n, d


def _series(z: Any) -> Any:
    """Return 1/2! - z/3! + z²/4! - ... - z^11/13! for an interval or a double."""
    high = 1 / 479001600 - z * (1 / 6227020800)
    high = 1 / 3628800 - z * (1 / 39916800 - z * high)
    middle = 1 / 40320 - z * (1 / 362880 - z * high)
    low = 1 / 720 - z * (1 / 5040 - z * middle)
    return 1 / 2 - z * (1 / 6 - z * (1 / 24 - z * (1 / 120 - z * low)))


def _nothing() -> Interval:
    return Interval(math.nan, math.nan)


def relaxed(mu: Any, d: Any) -> Any:
    """Return `relax` of intervals, `relax_double` of doubles."""
    return relax(mu, d) if isinstance(d, Interval) else relax_double(mu, d)


BRANCHING = (relax, relax_double, _halved, _series, _nothing)
