"""The two ways in which a step of a symbolic proof is confirmed, or fails."""

from typing import Any

import sympy as sp

from cap.errors import NotProved


def identity(name: str, left: Any, right: Any = 0) -> str:
    """Return ``name``; raise `NotProved` unless two rational functions, or matrices, are equal.

    The numerator of their difference, as a polynomial with rational coefficients, is 0.
    """
    difference = sp.Matrix([left]) - sp.Matrix([right])
    rest = [entry for entry in map(sp.cancel, difference) if entry != 0]
    if rest:
        raise NotProved("identity", f"{name}: not confirmed", {"difference": rest[0]})
    return name


def need(ok: object, name: str, **sets: object) -> str:
    """Return ``name``; raise `NotProved` unless ``ok`` is exactly True."""
    if ok is not True:
        raise NotProved("symbolic", f"{name}: not confirmed", sets)
    return name
