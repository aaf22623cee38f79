"""Words about the claims on an island."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cap.checker.tori import between, rotation

BITS = 96


def turns(claims: dict[str, Any]) -> str:
    """Return alpha as [0;3,(1)]."""
    head, period = (",".join(map(str, claims["rotation_number"][k])) for k in ("head", "period"))
    return f"[0;{head},({period})]"


def gap(claims: dict[str, Any]) -> tuple[Fraction, Fraction] | None:
    """Return numbers between the rotation numbers of P* and the curve, if they are known to differ.

    None if they are not, or that of P* is not claimed.
    """
    if "orbits" not in claims:
        return None
    alpha, centre = (
        rotation.value(**claims["rotation_number"], bits=BITS),
        claims["orbits"]["centre"],
    )
    below, above = (alpha.upper, centre.lower), (centre.upper, alpha.lower)
    return below if below[0] < below[1] else above if above[0] < above[1] else None


def fraction(claims: dict[str, Any]) -> Fraction | None:
    """Return a fraction of small denominator between both."""
    found = gap(claims)
    return found and between.simplest(*found)


def orbits(claims: dict[str, Any]) -> str:
    """Return what is said of periodic orbits, if they are claimed."""
    least = fraction(claims)
    if least is None:
        return ""
    return _ORBITS.format(map=claims["map"], centre=claims["orbits"]["centre"], least=least)


_ORBITS = (
    "; at P* the rotation number of {map}, in the sense in which that of the curve is alpha, lies "
    "in {centre}; for each fraction p/q in lowest terms between both (as {least}) the disk "
    "contains at least two periodic orbits of {map}, of minimal period q, that turn around P* p "
    "times in q steps"
)
