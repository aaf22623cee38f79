"""How a velocity relaxes under viscosity: D = exp(-μd), h = (1 - D)/μ and k = (d - h)/μ.

h is the integral of D and k that of h, from 0 to d.  With the entire functions

    φ1(z) = (e^z - 1)/z = ∫ e^(zu) du,      φ2(z) = (e^z - 1 - z)/z² = ∫ (1 - u) e^(zu) du

over [0, 1], h = d φ1(z) and k = d² φ2(z) for z = -μd, also where μ = 0.  Their derivatives,

    φ1⁽ⁿ⁾(z) = ∫ uⁿ e^(zu) du = M(n+1, n+2, z)/(n+1),
    φ2⁽ⁿ⁾(z) = ∫ (1 - u) uⁿ e^(zu) du = M(n+1, n+3, z)/((n+1)(n+2)),

M Kummer's function, increase with z, so their values at the ends of a ball enclose all of them.
"""

import math
from collections.abc import Callable
from typing import Any

from cap.sets.elementary import composed
from cap.sets.interval import Ball, hull, lower, upper
from cap.sets.taylor_model import TaylorModel

Series = Callable[[Ball, int], list[Ball]]


def of_floats(mu: float, d: float) -> tuple[float, float, float]:
    """Return (D, h, k) in floats."""
    z = -mu * d
    if abs(z) < 0.1:  # the terms left out are below 2^-53 of the first
        tail = sum(z**n / math.factorial(n + 2) for n in range(12))
        return math.exp(z), d * (1 + z * tail), d * d * tail
    h = -math.expm1(z) / mu
    return math.exp(z), h, (d - h) / mu


def relax(mu: Any, d: Any) -> tuple[Any, Any, Any]:
    """Return (D, h, k) for balls, jets, Taylor models or jets over these; μ may be of any type."""
    z = -mu * d
    series = (_EXP, _PHI1, _PHI2)
    decay, first, second = (composed(z, taylor) for taylor in series)
    return decay, d * first, d * d * second


def _over_models(taylor: Series) -> Callable[[Any, int], list[Any]]:
    """Return a series whose argument may be a Taylor model, too, as in jets over these.

    Its k-th coefficient a_k is then a composition, with the series a_k⁽ᵐ⁾/m! = binom(k+m, k) a_k+m.
    """

    def raised(k: int) -> Series:
        return lambda c, n: [a * math.comb(k + m, k) for m, a in enumerate(taylor(c, k + n)[k:])]

    def series(c: Any, order: int) -> list[Any]:
        if isinstance(c, TaylorModel):
            return [c.series(raised(k)) for k in range(order + 1)]
        return taylor(c, order)

    return series


def _exp(c: Ball, order: int) -> list[Ball]:
    value = c.exp()
    return [value / math.factorial(n) for n in range(order + 1)]


def _phi1(c: Ball, order: int) -> list[Ball]:
    return [_kummer(c, n, 2) / math.factorial(n + 1) for n in range(order + 1)]


def _phi2(c: Ball, order: int) -> list[Ball]:
    return [_kummer(c, n, 3) / (math.factorial(n) * (n + 1) * (n + 2)) for n in range(order + 1)]


def _kummer(c: Ball, n: int, b: int) -> Ball:
    """Return an enclosure of M(n+1, n+b, z) for all z in the ball."""
    low, high = (end.hypgeom_1f1(n + 1, n + b) for end in (lower(c), upper(c)))
    return hull(low, high)


_EXP, _PHI1, _PHI2 = map(_over_models, (_exp, _phi1, _phi2))
