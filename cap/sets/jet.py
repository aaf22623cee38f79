"""Jets: truncated Taylor series in several variables over any scalar.

A jet of order n in k variables holds the coefficients of all monomials of degree at most n.
Arithmetic truncates, so it is exact on Taylor coefficients: over balls, if the coefficients of the
operands enclose the Taylor coefficients of two functions (at a point, or at every point of a box),
so do those of the result.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import combinations_with_replacement
from math import factorial
from operator import add, sub
from typing import Any

from cap.sets.scalar import Ring

Exponent = tuple[int, ...]


@lru_cache(maxsize=None)
class Space:
    """The monomials of degree <= ``order`` in ``variables`` variables, by degree.

    Use ``Space(variables, order)``: equal arguments give the same object.
    """

    def __init__(self, variables: int, order: int) -> None:
        self.variables, self.order = variables, order
        self.exponents: list[Exponent] = [
            tuple(chosen.count(i) for i in range(variables))
            for degree in range(order + 1)
            for chosen in combinations_with_replacement(range(variables), degree)
        ]
        self.degrees = [sum(exponent) for exponent in self.exponents]
        self.index = {exponent: i for i, exponent in enumerate(self.exponents)}
        self.size = len(self.exponents)
        self._products: dict[tuple[int, int], Callable[[Any, Any], list[Any]]] = {}

    def truncated(self, order: int) -> Space:
        """Return the space with the same variables and another order."""
        return Space(self.variables, order)

    def product(self, p: int = 0, q: int = 0) -> Callable[[Any, Any], list[Any]]:
        """Return the truncated product of coefficient lists whose degrees start at p and at q.

        It is one expression, written out once for each space: a loop would take twice as long.
        """
        if (p, q) not in self._products:
            self._products[p, q] = self._write_product(p, q)
        return self._products[p, q]

    def _write_product(self, p: int, q: int) -> Callable[[Any, Any], list[Any]]:
        terms: list[list[str]] = [[] for _ in self.exponents]
        for i, alpha in enumerate(self.exponents):
            for j, beta in enumerate(self.exponents):
                target = self.index.get(tuple(a + b for a, b in zip(alpha, beta, strict=True)))
                if target is not None and sum(alpha) >= p and sum(beta) >= q:
                    terms[target].append(f"a{i}*b{j}")
        names = [", ".join(f"{x}{i}" for i in range(self.size)) for x in "ab"]
        body = ", ".join("+".join(term) or "0" for term in terms)
        source = f"def multiply(a, b):\n ({names[0]},) = a\n ({names[1]},) = b\n return [{body}]"
        scope: dict[str, Any] = {}
        exec(source, scope)  # noqa: S102 (the source is made of index numbers only)
        multiply: Callable[[Any, Any], list[Any]] = scope["multiply"]
        return multiply


class Jet(Ring):
    """A truncated Taylor series; ``coefficients[i]`` belongs to ``space.exponents[i]``."""

    __slots__ = ("coefficients", "space")

    def __init__(self, space: Space, coefficients: list[Any]) -> None:
        self.space, self.coefficients = space, coefficients

    @classmethod
    def constant(cls, value: Any, space: Space) -> Jet:
        """Return the jet of a constant function."""
        return cls(space, [value] + [0] * (space.size - 1))

    @classmethod
    def variables(cls, values: Sequence[Any], order: int) -> tuple[Jet, ...]:
        """Return the jets of the coordinate functions at the point, or box, ``values``."""
        space = Space(len(values), order)
        jets = [cls.constant(value, space) for value in values]
        if order:
            for i, (jet, value) in enumerate(zip(jets, values, strict=True)):
                jet.coefficients[1 + i] = value * 0 + 1  # one, but a scalar: 1/3 would be a float
        return tuple(jets)

    def __getitem__(self, exponent: Exponent) -> Any:
        """Return the coefficient of the monomial with this exponent."""
        return self.coefficients[self.space.index[exponent]]

    def truncated(self, order: int) -> Jet:
        """Return the jet without its terms above ``order``."""
        space = self.space.truncated(order)
        return Jet(space, self.coefficients[: space.size])

    def extended(self, order: int) -> Jet:
        """Return the jet with zeros as its terms up to ``order``."""
        space = self.space.truncated(order)
        return Jet(space, self.coefficients + [0] * (space.size - len(self.coefficients)))

    def above(self, order: int) -> Jet:
        """Return the jet without its terms up to ``order``: exactly zero there."""
        size = self.space.truncated(order).size
        return Jet(self.space, [0] * size + self.coefficients[size:])

    def lowest(self) -> int:
        """Return the degree below which all terms are the integer 0."""
        for coefficient, degree in zip(self.coefficients, self.space.degrees, strict=True):
            if coefficient.__class__ is not int or coefficient:
                return degree
        return self.space.order

    def derivative(self, variable: int) -> Jet:
        """Return the jet, one order lower, of the derivative by a variable."""
        space = self.space.truncated(self.space.order - 1)
        coefficients = []
        for exponent in space.exponents:
            raised = tuple(e + (i == variable) for i, e in enumerate(exponent))
            coefficients.append(self[raised] * raised[variable])
        return Jet(space, coefficients)

    def __add__(self, other: Any) -> Jet:
        if isinstance(other, Jet):
            self._same_space(other)
            return Jet(self.space, list(map(add, self.coefficients, other.coefficients)))
        first, *rest = self.coefficients
        return Jet(self.space, [first + other, *rest])

    def __sub__(self, other: Any) -> Jet:
        if isinstance(other, Jet):
            self._same_space(other)
            return Jet(self.space, list(map(sub, self.coefficients, other.coefficients)))
        first, *rest = self.coefficients
        return Jet(self.space, [first - other, *rest])

    def __neg__(self) -> Jet:
        return Jet(self.space, [-a for a in self.coefficients])

    def __mul__(self, other: Any) -> Jet:
        if isinstance(other, Jet):
            self._same_space(other)
            multiply = self.space.product(self.lowest(), other.lowest())
            return Jet(self.space, multiply(self.coefficients, other.coefficients))
        return Jet(self.space, [a * other for a in self.coefficients])

    def __truediv__(self, other: Any) -> Jet:
        if isinstance(other, Jet):
            return self.__mul__(other.reciprocal())
        if isinstance(other, int):
            return Jet(self.space, [_quotient(a, other) for a in self.coefficients])
        return Jet(self.space, [a / other for a in self.coefficients])

    def _same_space(self, other: Jet) -> None:
        """Raise `ValueError` if the other jet has other variables or another order."""
        if self.space is not other.space:
            raise ValueError("jets of different spaces do not mix")

    def powers(self) -> list[list[Any]]:
        """Return the coefficients of h, h², ..., hⁿ, where h is the jet without its value."""
        h = self.above(0).coefficients
        powers = [h]
        for k in range(1, self.space.order):
            powers.append(self.space.product(k, 1)(powers[-1], h))
        return powers

    def series(self, taylor: Sequence[Any]) -> Jet:
        """Return the composition g(self), ``taylor[k]`` = g⁽ᵏ⁾/k! at the value of the jet."""
        return self._combination(taylor, self.powers())

    def _combination(self, taylor: Sequence[Any], powers: Sequence[list[Any]]) -> Jet:
        """Return the sum of taylor[k] hᵏ, given the `powers` of h."""
        result = [taylor[0], *(taylor[1] * a for a in powers[0][1:])]
        for k, power in enumerate(powers[1:], start=2):
            start = self.space.truncated(k - 1).size
            result[start:] = [
                a + taylor[k] * b for a, b in zip(result[start:], power[start:], strict=True)
            ]
        return Jet(self.space, result)

    def reciprocal(self) -> Jet:
        """Return 1/self."""
        return self.series(reciprocal_series(self.coefficients[0], self.space.order))

    def sin_cos(self) -> tuple[Jet, Jet]:
        """Return the jets of sine and cosine."""
        sin, cos = sin_cos_series(self.coefficients[0], self.space.order)
        powers = self.powers()
        return self._combination(sin, powers), self._combination(cos, powers)


def reciprocal_series(c: Any, order: int) -> list[Any]:
    """Return g⁽ᵏ⁾(c)/k! for g(c) = 1/c and k = 0, ..., order."""
    inverse = _quotient(1, c)
    taylor = [inverse]
    for _ in range(order):
        taylor.append(-taylor[-1] * inverse)
    return taylor


def sin_cos_series(c: Any, order: int) -> tuple[list[Any], list[Any]]:
    """Return g⁽ᵏ⁾(c)/k! for g = sin and g = cos and k = 0, ..., order; c has a method sin_cos."""
    sin, cos = c.sin_cos()
    cycle = [sin, cos, -sin, -cos]
    factorials = [factorial(k) for k in range(order + 1)]
    return (
        [cycle[k % 4] / n for k, n in enumerate(factorials)],
        [cycle[(k + 1) % 4] / n for k, n in enumerate(factorials)],
    )


def _quotient(a: Any, b: Any) -> Any:
    """Return a/b; of two Python integers only 0/b, because 1/3 would be a double."""
    if isinstance(a, int) and isinstance(b, int):
        if a:
            raise TypeError("the quotient of two integers is no exact scalar")
        return 0
    return a / b
