"""Theorems that the tables ask for: proved when they are asked for, not read from files."""

from fractions import Fraction
from functools import cache
from typing import Any

from cap.floats import candidates
from cap.floats.candidates import Request
from cap.parameters import PAPER, Parameters, at
from cap.proofs import theorems
from cap.proofs.fixed_point import Setting

DIGITS = 25


@cache
def theorem(
    kind: str,
    orbit: tuple[float, float],
    F: str = "1",
    f: str = "2/5",
    R: str = "2",
    digits: int = DIGITS,
) -> dict[str, Any]:
    """Return the claims of a theorem on the orbit near a state; the checker accepts them."""
    half = Fraction(R) / 2
    return _claims(kind, at(F=F, f=f, l=str(-half), r=str(half)), orbit, digits)


@cache
def pitchfork() -> dict[str, Any]:
    """Return the claims of the theorem `pitchfork` at the paper's F, ω and R."""
    return _claims("pitchfork", PAPER, None)


@cache
def symmetric() -> dict[str, Any]:
    """Return the claims of the theorem `symmetric` at the paper's parameters."""
    return _claims("symmetric", PAPER, None)


def _claims(
    kind: str, p: Parameters, orbit: tuple[float, float] | None, digits: int = DIGITS
) -> dict[str, Any]:
    proof = theorems.THEOREMS[kind]
    if orbit is None:
        start = candidates.closed_form(Request(kind, p)).candidates[0].start
    else:
        start = proof.search(Request(kind, p, orbit)).candidates[0].start
    found = theorems.accepted(proof, Setting(p, start, digits))
    claims: dict[str, Any] = found["claims"]
    return claims
