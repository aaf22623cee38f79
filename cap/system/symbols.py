"""Expressions of sympy as terms of polynomials; a model that has none does not load sympy."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy

from cap.errors import BadInput


def terms(expression: Any) -> dict[tuple[tuple[str, int], ...], Fraction]:
    """Return the terms of a polynomial in symbols and pi; refuse all else, decimals as well."""
    names = {symbol: symbol.name for symbol in expression.free_symbols} | {sympy.pi: "pi"}
    if len(set(names.values())) < len(names):
        raise BadInput(f"two symbols have one name, or that of pi: {expression}")
    try:
        found = sympy.Poly(expression, *names).terms()
        exact = [(powers, Fraction(int(c.p), int(c.q))) for powers, c in found]
    except (sympy.PolynomialError, AttributeError):
        raise BadInput(
            f"not a polynomial with rational coefficients: {expression} (cos wt and sin wt of the "
            "clock are the names cos and sin; other functions are out of reach)"
        ) from None
    return {_monomial(names.values(), powers): c for powers, c in exact}


def parts(expression: Any) -> tuple[Any, Any]:
    """Return numerator and denominator of a rational function."""
    numerator, denominator = sympy.fraction(sympy.together(expression))
    return numerator, denominator


def _monomial(names: Any, powers: Any) -> tuple[tuple[str, int], ...]:
    """Return the names that occur, with their powers, sorted."""
    return tuple(sorted((name, int(k)) for name, k in zip(names, powers, strict=True) if k))
