"""Polynomials of intervals of doubles, in an order of variables that is given once."""

from __future__ import annotations

from collections.abc import Sequence

from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.system.polynomial import Polynomial

_ZERO = Double(0.0)


class Sum:
    """A polynomial: coefficients, and for each the places of its factors among the variables."""

    def __init__(self, q: Polynomial, names: Sequence[str]) -> None:
        terms = q.terms.items()
        self.terms = [(enclosing(c), [names.index(z) for z in m]) for m, c in terms]

    def at(self, values: Sequence[Double]) -> Double:
        """Return its values."""
        total = _ZERO
        for product, places in self.terms:
            for k in places:
                product = product * values[k]  # noqa: PLW2901
            total = total + product
        return total

    def bound(self, values: Sequence[float]) -> float:
        """Return a bound of its size, by bounds of the sizes of variables, up to 2^-40 of it."""
        total = 0.0
        for c, places in self.terms:
            product = c.magnitude
            for k in places:
                product *= values[k]
            total += product
        return total * (1 + 2.0**-40)
