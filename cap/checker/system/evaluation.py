"""Polynomials whose variables are jets."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from operator import add, mul

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, RealJet
from cap.checker.kernel.rejection import need
from cap.checker.system.polynomial import Polynomial


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
