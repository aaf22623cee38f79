"""Square root, arcsine and sin x/x, of balls, jets and Taylor models.

A function g is given by its Taylor coefficients: ``taylor(c, n)`` encloses g⁽ᵏ⁾(ξ)/k! for k <= n
and all ξ in c.  For jets over Taylor models c itself is a Taylor model.
"""

from collections.abc import Callable
from fractions import Fraction
from math import comb, factorial
from typing import Any

from cap.sets.interval import Ball, ball, working_bits
from cap.sets.jet import Jet
from cap.sets.taylor_model import TaylorModel

Taylor = Callable[[Any, int], list[Any]]


def composed(z: Any, taylor: Taylor) -> Any:
    """Return g(z)."""
    if isinstance(z, TaylorModel):
        return z.series(taylor)
    if isinstance(z, Jet):
        return z.series(taylor(z.coefficients[0] + Ball(0), z.space.order))
    return taylor(z, 0)[0]


def sqrt(x: Any) -> Any:
    """Return the square root; it is indeterminate where x may be negative."""
    return composed(x, _sqrt)


def asin(x: Any) -> Any:
    """Return the arcsine; it is indeterminate unless |x| < 1 is certain."""
    return composed(x, _asin)


def sinc(x: Any) -> Any:
    """Return sin x/x, which is 1 at 0; assumes |x| <= 2."""
    return composed(x, _sinc)


def _sqrt(c: Any, order: int) -> list[Any]:
    """The k-th coefficient is binom(1/2, k) sqrt(c)/cᵏ."""
    taylor = [sqrt(c) if isinstance(c, TaylorModel) else c.sqrt()]
    for k in range(order):
        taylor.append(taylor[-1] / c * ball((Fraction(1, 2) - k) / (k + 1)))
    return taylor


def _asin(c: Any, order: int) -> list[Any]:
    """The derivative y = (1 - x²)^(-1/2) solves (1 - x²) y' = x y, coefficient by coefficient."""
    rest = 1 - c * c
    y, before = 1 / sqrt(rest), 0
    taylor = [asin(c) if isinstance(c, TaylorModel) else c.asin()]
    for k in range(order):
        taylor.append(y / (k + 1))
        y, before = (c * y * (2 * k + 1) + before * k) / (rest * (k + 1)), y
    return taylor


def _sinc(c: Any, order: int) -> list[Any]:
    """Of a Taylor model each coefficient is the composition with s_k, which has its own series."""
    if isinstance(c, TaylorModel):
        return [c.series(_raised(k)) for k in range(order + 1)]
    return [_sinc_coefficient(c, k) for k in range(order + 1)]


def _raised(k: int) -> Callable[[Ball, int], list[Ball]]:
    """Return the series of s_k = sinc⁽ᵏ⁾/k!: s_k⁽ᵐ⁾/m! = binom(k + m, k) s_(k+m)."""
    return lambda c, n: [_sinc_coefficient(c, k + m) * comb(k + m, k) for m in range(n + 1)]


def _sinc_coefficient(c: Ball, k: int) -> Ball:
    """Return s_k(c) = Σ binom(k + m, k) s_(k+m)(0) cᵐ, where s_n(0) is 0 or ±1/(n + 1)!.

    As binom(k + m, k)/(k + m + 1)! <= 1/(k! m!), the terms from m = M on, M > 2|c|, are together at
    most 2 |c|ᴹ/(k! M!).
    """
    terms = 20 + working_bits() // 4
    size = c.abs_upper()
    if not 2 * size < terms:
        return Ball("nan")
    total = Ball(0, 2 * size**terms) / (factorial(k) * factorial(terms))
    power = Ball(1)
    for m in range(terms):
        n = k + m
        if n % 2 == 0:
            total = total + power * comb(n, k) * (-1) ** (n // 2) / factorial(n + 1)
        power = power * c
    return total
