"""What can be proved, and how: each theorem with its search and its proof, up to the checker.

The proof of a theorem is in ``proofs/NAME.py``, which is imported when it is asked for: it takes
longer to load all of them than to prove one.
"""

import time
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib import import_module
from typing import Any

from cap.certificate import writer as certificate
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check
from cap.errors import NotProved, TooFewDigits
from cap.floats import candidates
from cap.floats.candidates import Search
from cap.proofs.fixed_point import Proof, Setting

PARTS = [Fraction(n, 100) for n in (90, 70, 50, 30, 10, 3, 1)]  # of the largest box found
GUARDS = (15, 30, 60)  # digits computed beyond those claimed


@dataclass(frozen=True)
class Theorem:
    """What a theorem says, where its proof is, and the search for orbits that it may be about."""

    name: str
    summary: str
    search: Search

    def prove(self, setting: Setting) -> Proof:
        """Prove the theorem up to the size of its box; return the rest of the proof."""
        proof: Proof = import_module(f"cap.proofs.{self.name}").prove(setting)
        return proof


THEOREMS = {
    theorem.name: theorem
    for theorem in (
        Theorem(
            "elliptic",
            "an elliptic non-sticking T-periodic orbit exists, with twist, inside invariant curves",
            candidates.non_sticking,
        ),
        Theorem(
            "saddle",
            "a hyperbolic non-sticking T-periodic orbit exists",
            candidates.non_sticking,
        ),
        Theorem(
            "periodic",
            "an nT-periodic orbit exists, with any events; its type; the basin of a sink",
            candidates.cyclic,
        ),
        Theorem(
            "persistence",
            "an elliptic orbit survives as a sink with inelastic walls and viscous friction",
            candidates.continued,
        ),
        Theorem(
            "capture",
            "infinitely many impacts with a wall accumulate, for all orbits from a box",
            candidates.capturing,
        ),
        Theorem(
            "symmetric",
            "symmetric orbits that never turn, one hit of each wall per period; where they "
            "bifurcate",
            candidates.closed_form,
        ),
        Theorem(
            "pitchfork",
            "the asymmetric orbits that never turn, one hit of each wall per period, are born",
            candidates.closed_form,
        ),
        Theorem(
            "branch",
            "these orbits for all f of a range: trace, resonances, twist, end, invariant curves",
            candidates.closed_form,
        ),
        Theorem(
            "impulse",
            "for f > 2F/pi every motion comes to rest, within an explicit time; 2F/pi is sharp",
            candidates.every_motion,
        ),
    )
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
