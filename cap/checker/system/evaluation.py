"""Polynomials whose variables are jets, intervals, or intervals with first derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import Generic, Protocol, TypeVar

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, RealJet
from cap.checker.kernel.rejection import need
from cap.checker.system.polynomial import Monomial, Polynomial

V = TypeVar("V", bound="Value")


class Value(Protocol):
    """What may stand for a variable."""

    def __add__(self: V, other: V, /) -> V: ...
    def __mul__(self: V, other: V | Fraction, /) -> V: ...


class Values(Generic[V]):
    """Values of variables; products of them are computed once.  ``one`` is a 1 like them."""

    def __init__(self, values: Mapping[str, V], one: V) -> None:
        self.known: dict[Monomial, V] = {(name,): value for name, value in values.items()}
        self.known[()] = one

    def of(self, q: Polynomial) -> V:
        """Return a polynomial in them."""
        terms = [self._product(m) * c for m, c in q.terms.items()]
        return reduce(add, terms) if terms else self.known[()] * Fraction(0)

    def _product(self, monomial: Monomial) -> V:
        if monomial not in self.known:
            need(len(monomial) > 1, "a polynomial has variables that are not known")
            self.known[monomial] = self._product(monomial[:-1]) * self._product(monomial[-1:])
        return self.known[monomial]


def evaluate(q: Polynomial, values: Mapping[str, RealJet]) -> RealJet:
    """Return a polynomial of jets, which all have one order and precision."""
    need(q.variables <= values.keys(), "a polynomial has variables that are not known")
    like = next(iter(values.values()))
    number = Interval.enclosing(q.number, q.number, like.constant.bits)
    terms = [Jet(like.order, {like.origin: number})]
    for monomial, c in q.terms.items():
        if monomial:
            factor = Interval.enclosing(c, c, number.bits) if c.denominator > 1 else c.numerator
            terms.append(reduce(mul, (values[z] for z in monomial)) * factor)
    return reduce(add, terms)
