"""Theorems that the tables ask for: proved when they are asked for, not read from files."""

from fractions import Fraction
from functools import cache
from typing import Any

from cap.floats import candidates
from cap.floats.candidates import Request
from cap.floats.findings import State
from cap.parameters import at
from cap.proofs import theorems
from cap.proofs.fixed_point import Setting

DIGITS = 25


@cache
def theorem(
    kind: str,
    orbit: State | None = None,
    F: str = "1",
    f: str = "2/5",
    R: str = "2",
    digits: int = DIGITS,
) -> dict[str, Any]:
    """Return the claims of a theorem, on the orbit near a state if one is named.

    The checker accepts them.
    """
    half, proof = Fraction(R) / 2, theorems.THEOREMS[kind]
    request = Request(kind, at(F=F, f=f, l=str(-half), r=str(half)), orbit)
    search = proof.search if orbit else candidates.closed_form
    start = search(request).candidates[0].start
    found = theorems.accepted(proof, Setting(request.parameters, start, digits))
    claims: dict[str, Any] = found["claims"]
    return claims
