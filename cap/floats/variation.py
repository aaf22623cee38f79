"""Parameters that vary, exactly."""

from dataclasses import replace
from fractions import Fraction

from cap.errors import BadInput
from cap.parameters import Parameters

VARIABLE = ("F", "omega", "f", "R", "e", "mu")
"""The parameters that may vary; R moves both walls, their middle stays."""


def varied(p: Parameters, name: str, value: float | Fraction) -> Parameters:
    """Return the parameters with one of `VARIABLE` changed to ``value``, exactly."""
    if name not in VARIABLE:
        raise BadInput(f"no such parameter: {name!r} (one of {', '.join(VARIABLE)})")
    exact = Fraction(value)
    if name == "R":
        middle = (p.l + p.r) / 2
        return replace(p, l=middle - exact / 2, r=middle + exact / 2)
    return replace(p, **{name: exact})


def value_of(p: Parameters, name: str) -> float:
    """Return one of `VARIABLE` as a float."""
    if name not in VARIABLE:
        raise BadInput(f"no such parameter: {name!r} (one of {', '.join(VARIABLE)})")
    return float(getattr(p, name))
