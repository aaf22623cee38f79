"""Polynomials whose variables are jets."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from operator import add, mul

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, RealJet
from cap.checker.system.polynomial import Monomial, Polynomial


def evaluate(q: Polynomial, values: Mapping[str, RealJet], like: RealJet) -> RealJet:
    """Return a polynomial of jets, of the order and precision of another one."""
    terms = [_term(monomial, c, values, like) for monomial, c in q.terms.items()]
    return reduce(add, terms) if terms else _term((), Fraction(0), values, like)


def _term(monomial: Monomial, c: Fraction, values: Mapping[str, RealJet], like: RealJet) -> RealJet:
    """Return a term; a product by an integer is exact."""
    bits = like.constant.bits
    if not monomial:
        return Jet(like.order, {like.origin: Interval.enclosing(c, c, bits)})
    total = reduce(mul, (values[z] for z in monomial))
    if c == 1:
        return total
    return total * (c.numerator if c.denominator == 1 else Interval.enclosing(c, c, bits))
