"""Quotient, square root, cosine and sine of jets whose coefficients are intervals or Taylor models.

A jet is c + h, with h without constant term; h^k has no terms of degree below k.  With e = h/c

    1/(c + h) = (1/c) (1 - e + e^2 - ...),
    sqrt(c + h) = sqrt(c) (sum of b_k e^k),    b_0 = 1,    b_k = b_(k-1) (3 - 2k)/(2k).

*Cosine and sinc* at x + d, d the variable of the jet, |x| <= 2.  With z = (x + d)^2

    cos = 1 - z/2! + z^2/4! - ...,        sinc = sin/id = 1 - z/3! + z^2/5! - ...

What follows the power z^m has at d^k a coefficient of at most

    sum over j > m of binom(2j, k) 2^(2j-k) / (2j)!  <=  sum over j > m of 16^j / (2j)!
                                                     <=  2 * 16^(m+1) / (2m+2)!    for m >= 2,

because 16/((2j+1)(2j+2)) <= 1/2 for j >= 3.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import factorial
from typing import Protocol, TypeVar

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet


class Field(Protocol):
    """What a coefficient can do: an interval, or a Taylor model."""

    @property
    def bits(self) -> int:
        """The unit is 2^-bits."""

    def __add__(self: K, other: K | int, /) -> K: ...
    def __sub__(self: K, other: K | int, /) -> K: ...
    def __mul__(self: K, other: K | int, /) -> K: ...
    def __truediv__(self: K, other: K | int, /) -> K: ...
    def __neg__(self: K) -> K: ...
    def sqrt(self: K) -> K:
        """Return the square root."""

    def integer(self: K, n: int) -> K:
        """Return the constant n."""


K = TypeVar("K", bound=Field)


def plus(jet: Jet[K], c: K | int) -> Jet[K]:
    """Return the jet with c added to its constant term."""
    return Jet(jet.order, {**jet.coefficients, jet.origin: jet.constant + c})


def divided(jet: Jet[K], n: int) -> Jet[K]:
    """Return jet/n."""
    return Jet(jet.order, {power: c / n for power, c in jet.coefficients.items()})


def nilpotent(jet: Jet[K]) -> Jet[K]:
    """Return the jet without its constant term."""
    return Jet(jet.order, {power: c for power, c in jet.coefficients.items() if any(power)})


def reciprocal(jet: Jet[K]) -> Jet[K]:
    """Return 1/jet."""
    one, origin = jet.constant.integer(1), jet.origin
    first = one / jet.constant
    e, term = nilpotent(jet) * -first, Jet(jet.order, {origin: first})
    total = term
    for _ in range(jet.order):
        term = term * e
        total = total + term
    return total


def square_root(jet: Jet[K]) -> Jet[K]:
    """Return the square root of the jet."""
    c, origin = jet.constant, jet.origin
    e, term = nilpotent(jet) * (c.integer(1) / c), Jet(jet.order, {origin: c.sqrt()})
    total = term
    for k in range(1, jet.order + 1):
        term = divided(term * e * (3 - 2 * k), 2 * k)
        total = total + term
    return total


def cos_sinc(x: Jet[K], embed: Callable[[Interval], K]) -> tuple[Jet[K], Jet[K]]:
    """Return cos and sinc of x + d, |x| <= 2; ``embed`` makes a coefficient of an interval."""
    bits, m = x.constant.bits, 2
    while 2 * 16 ** (m + 1) << bits > factorial(2 * m + 2):
        m += 1
    square = x * x
    unit = embed(Interval(-1, 1, bits))  # the remainder is below 2^-bits
    series = []
    for first in (0, 1):
        total = Jet(x.order, {x.origin: x.constant.integer(1)})
        for n in range(2 * m + first, first, -2):  # n (n - 1) is the quotient of two factorials
            total = plus(-divided(square * total, n * (n - 1)), 1)
        series.append(total + Jet(x.order, dict.fromkeys(total.coefficients, unit)))
    return series[0], series[1]


def composed(derivatives: Sequence[Interval], jet: Jet[Interval]) -> Jet[Interval]:
    """Return g(jet) from g and its derivatives at the constant term, as many as the order.

    Of c + h, h without constant term, it is the sum of g^(k)(c) h^k/k!.
    """
    h, one = nilpotent(jet), derivatives[0].integer(1)
    term, total = Jet(jet.order, {jet.origin: one}), Jet(jet.order, {jet.origin: derivatives[0]})
    for k in range(1, jet.order + 1):
        term = divided(term * h, k)
        total = total + term * derivatives[k]
    return total
