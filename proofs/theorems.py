"""What can be proved, and how: each theorem with its search and its proof, up to the checker."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from cap.certificate import writer as certificate
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorem import check
from cap.errors import NotProved, TooFewDigits
from cap.floats import candidates
from cap.floats.candidates import Search
from cap.proofs import (
    branch,
    capture,
    elliptic,
    impulse,
    periodic,
    persistence,
    pitchfork,
    saddle,
    symmetric,
)
from cap.proofs.fixed_point import Proof, Setting

PARTS = [Fraction(n, 100) for n in (90, 70, 50, 30, 10, 3, 1)]  # of the largest box found
GUARDS = (15, 30, 60)  # digits computed beyond those claimed


@dataclass(frozen=True)
class Theorem:
    """What a theorem says, its proof, and the search for the orbits that it may be about."""

    summary: str
    prove: Callable[[Setting], Proof]
    search: Search


THEOREMS = {
    "elliptic": Theorem(
        "an elliptic non-sticking T-periodic orbit exists, with twist, inside invariant curves",
        elliptic.prove,
        candidates.non_sticking,
    ),
    "saddle": Theorem(
        "a hyperbolic non-sticking T-periodic orbit exists", saddle.prove, candidates.non_sticking
    ),
    "periodic": Theorem(
        "an nT-periodic orbit exists, with any events; its type; the basin of a sink",
        periodic.prove,
        candidates.cyclic,
    ),
    "persistence": Theorem(
        "an elliptic orbit survives as a sink with inelastic walls and viscous friction",
        persistence.prove,
        candidates.continued,
    ),
    "capture": Theorem(
        "infinitely many impacts with a wall accumulate, for all orbits from a box",
        capture.prove,
        candidates.capturing,
    ),
    "symmetric": Theorem(
        "symmetric orbits that never turn, one hit of each wall per period; where they bifurcate",
        symmetric.prove,
        candidates.closed_form,
    ),
    "pitchfork": Theorem(
        "the asymmetric orbits that never turn, one hit of each wall per period, are born",
        pitchfork.prove,
        candidates.closed_form,
    ),
    "branch": Theorem(
        "these orbits for all f of a range: trace, resonances, twist, end, invariant curves",
        branch.prove,
        candidates.closed_form,
    ),
    "impulse": Theorem(
        "for f > 2F/pi every motion comes to rest, within an explicit time; 2F/pi is sharp",
        impulse.prove,
        candidates.every_motion,
    ),
}


def accepted(theorem: Theorem, setting: Setting) -> dict[str, Any]:
    """Return a certificate that the independent checker accepts, or raise `NotProved`.

    More guard digits are computed until all digits claimed are certain.
    """
    began = time.perf_counter()
    for guard in GUARDS:
        sharper = replace(setting, guard=guard)
        try:
            proved = _followed(theorem.prove(sharper))
            break
        except TooFewDigits:
            if guard == GUARDS[-1]:
                raise
    seconds = time.perf_counter() - began
    return {**proved, "provenance": certificate.provenance(sharper.bits, seconds)}


def _followed(proof: Proof) -> dict[str, Any]:
    """Return the certificate for the largest of the `PARTS` to which the checker can follow."""
    rejection, before = "", None
    for part in PARTS:
        proved = {**proof(part), "provenance": {}}
        if proved == before:
            break  # nothing in it depends on the part
        before = proved
        try:
            check(certificate.dumps(proved).encode(), lambda _step: None)
        except Rejected as reason:
            rejection = str(reason)
        else:
            return proved
    raise NotProved("checker", f"the independent checker rejects the certificate: {rejection}")
