"""Theorems that the tables ask for: proved when they are asked for, not read from files."""

from contextlib import suppress
from fractions import Fraction
from functools import cache
from typing import Any

from cap.errors import NotProved
from cap.floats.findings import State
from cap.floats.search.cycles import Cycle
from cap.floats.search.request import Request
from cap.maps.fixed_point import Start
from cap.parameters import Parameters, at
from cap.proofs import theorems
from cap.proofs.fixed_point import Setting

DIGITS, FEW = 25, 12


@cache
def theorem(
    kind: str,
    orbit: State,
    F: str = "1",
    f: str = "2/5",
    R: str = "2",
    digits: int = DIGITS,
) -> dict[str, Any]:
    """Return the claims of a theorem on the orbit near a state; the checker accepts them."""
    half, proof = Fraction(R) / 2, theorems.THEOREMS[kind]
    request = Request(kind, at(F=F, f=f, l=str(-half), r=str(half)), orbit)
    start = proof.search(request).candidates[0].start
    found = theorems.accepted(proof, Setting(request.parameters, start, digits))
    claims: dict[str, Any] = found["claims"]
    return claims


def proves(p: Parameters, cycle: Cycle) -> bool:
    """Return whether an orbit that was found is proved; the checker accepts it."""
    start = Start(cycle.x, cycle.v, cycle.events, cycle.periods)
    with suppress(NotProved):
        setting = Setting(p, start, FEW, widest=False)
        return bool(theorems.accepted(theorems.THEOREMS["periodic"], setting))
    return False
