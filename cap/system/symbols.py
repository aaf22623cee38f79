"""Expressions of sympy as polynomials; nothing else of this package loads sympy for a model."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy

from cap.errors import BadInput
from cap.system.polynomial import PI, Polynomial, Quotient


def polynomial(expression: Any) -> Polynomial:
    """Return a polynomial in the symbols and pi; refuse anything else, decimals as well."""
    names = {symbol: symbol.name for symbol in expression.free_symbols} | {sympy.pi: PI}
    try:
        terms = sympy.Poly(expression, *names).terms()
        exact = {tuple(m): Fraction(int(c.p), int(c.q)) for m, c in terms}
    except (sympy.PolynomialError, AttributeError):
        raise BadInput(f"not a polynomial with rational coefficients: {expression}") from None
    order = list(names.values())
    return Polynomial(
        {
            tuple(sorted((name, k) for name, k in zip(order, powers, strict=True) if k)): c
            for powers, c in exact.items()
        }
    )


def quotient(expression: Any) -> Quotient:
    """Return a rational function of the symbols and pi."""
    return Quotient(*map(polynomial, sympy.fraction(sympy.together(expression))))
