"""Taylor models: a polynomial and a remainder over a box, closed under arithmetic.

A Taylor model (p, I) on the domain D = {δ : |δ_i| <= reach_i} encloses every function g with
g(δ) - q(δ) in I for all δ in D, for some polynomial q whose coefficients lie in those of p
(Makino and Berz 1996; Joldes 2011, Definition 2.1.3).  Operations keep this: they drop what exceeds
the order into the remainder, bounded over D.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from cap.sets.interval import Ball, symmetric
from cap.sets.jet import Jet, Space, reciprocal_series, sin_cos_series
from cap.sets.scalar import Ring


class Domain:
    """The symmetric box |δ_i| <= ``reach[i]``, and the ranges of the monomials on it."""

    def __init__(self, reach: Sequence[Ball], order: int) -> None:
        self.space = Space(len(reach), order)
        self.reach = [symmetric(r) for r in reach]
        self.monomials = [self._range(exponent) for exponent in self.space.exponents]

    def _range(self, exponent: tuple[int, ...]) -> Ball:
        result = Ball(1)
        for reach, power in zip(self.reach, exponent, strict=True):
            for _ in range(power):
                result = result * reach
        even = all(power % 2 == 0 for power in exponent)
        return result.abs_upper().union(0) if even and any(exponent) else result

    def variables(self, centre: Sequence[Ball]) -> tuple[TaylorModel, ...]:
        """Return the Taylor models of the coordinates ``centre[i]`` + δ_i."""
        jets = Jet.variables(centre, self.space.order)
        if self.space.order:
            return tuple(TaylorModel(self, jet, Ball(0)) for jet in jets)
        return tuple(TaylorModel(self, jet, r) for jet, r in zip(jets, self.reach, strict=True))


class TaylorModel(Ring):
    """A ``polynomial`` (jet over balls) and a ``remainder`` (ball) on a ``domain``."""

    __slots__ = ("domain", "polynomial", "remainder")

    def __init__(self, domain: Domain, polynomial: Jet, remainder: Ball) -> None:
        self.domain, self.polynomial, self.remainder = domain, polynomial, remainder

    def degree_ranges(self) -> list[Ball]:
        """Return enclosures on the domain of the homogeneous parts of the polynomial."""
        ranges = [Ball(0)] * (self.domain.space.order + 1)
        terms = zip(
            self.domain.space.exponents,
            self.polynomial.coefficients,
            self.domain.monomials,
            strict=True,
        )
        for exponent, coefficient, monomial in terms:
            ranges[sum(exponent)] = ranges[sum(exponent)] + monomial * coefficient
        return ranges

    def bound(self) -> Ball:
        """Return a ball that contains all values on the domain."""
        return sum(self.degree_ranges(), self.remainder)

    def widened(self, by: Ball) -> TaylorModel:
        """Return the model whose functions differ from those of this one by values in ``by``."""
        return TaylorModel(self.domain, self.polynomial, self.remainder + by)

    def __add__(self, other: Any) -> TaylorModel:
        if isinstance(other, TaylorModel):
            self._same_domain(other)
            polynomial = self.polynomial + other.polynomial
            return TaylorModel(self.domain, polynomial, self.remainder + other.remainder)
        return TaylorModel(self.domain, self.polynomial + other, self.remainder)

    def __neg__(self) -> TaylorModel:
        return TaylorModel(self.domain, -self.polynomial, -self.remainder)

    def __mul__(self, other: Any) -> TaylorModel:
        if not isinstance(other, TaylorModel):
            return TaylorModel(self.domain, self.polynomial * other, self.remainder * other)
        self._same_domain(other)
        p, q = self.degree_ranges(), other.degree_ranges()
        order = self.domain.space.order
        dropped = sum(
            (p[i] * q[j] for i in range(1, order + 1) for j in range(order + 1 - i, order + 1)),
            Ball(0),
        )
        mixed = sum(p, self.remainder) * other.remainder + sum(q, Ball(0)) * self.remainder
        return TaylorModel(self.domain, self.polynomial * other.polynomial, dropped + mixed)

    def __truediv__(self, other: Any) -> TaylorModel:
        """Return the quotient; its remainder is indeterminate if the divisor may vanish."""
        if isinstance(other, TaylorModel):
            return self.__mul__(other.reciprocal())
        return TaylorModel(self.domain, self.polynomial / other, self.remainder / other)

    def _same_domain(self, other: TaylorModel) -> None:
        """Raise `ValueError` if the other model is one on another domain."""
        if self.domain is not other.domain:
            raise ValueError("Taylor models on different domains do not mix")

    def series(self, taylor: Callable[[Ball, int], Sequence[Ball]]) -> TaylorModel:
        """Return g(self), where ``taylor(c, n)`` encloses g⁽ᵏ⁾(ξ)/k! for k <= n and all ξ in c.

        With c the constant term and h the rest, g(c + h) is its Taylor polynomial in h plus
        g⁽ⁿ⁺¹⁾(ξ)/(n+1)! hⁿ⁺¹ for some ξ between c and c + h (Lagrange).
        """
        order = self.domain.space.order
        constant = self.polynomial.coefficients[0] + Ball(0)
        h = TaylorModel(self.domain, self.polynomial.above(0), self.remainder)
        size = h.bound()
        coefficients = taylor(constant, order)
        last = Jet.constant(coefficients[order], self.domain.space)
        result = TaylorModel(self.domain, last, Ball(0))
        for coefficient in reversed(coefficients[:order]):
            result = result * h + coefficient
        lagrange = taylor((constant + size).union(constant), order + 1)[order + 1]
        for _ in range(order + 1):
            lagrange = lagrange * size
        return result.widened(lagrange)

    def reciprocal(self) -> TaylorModel:
        """Return 1/self."""
        return self.series(reciprocal_series)

    def sin_cos(self) -> tuple[TaylorModel, TaylorModel]:
        """Return the Taylor models of sine and cosine."""
        sin = self.series(lambda c, n: sin_cos_series(c, n)[0])
        return sin, self.series(lambda c, n: sin_cos_series(c, n)[1])
