"""Theorem (islands).  At each of several values of f, the theorem of `cap.proofs.island`: an
invariant curve around an elliptic orbit that never stops, and the area inside.

The values of f are equidistant in a range.  At each the orbits with one hit of each wall per period
are searched for; the curve is one well inside the last that floats show: nearer and nearer to P*,
until a proof succeeds.  Where none does, nothing is claimed, and the reason is told: there is no
elliptic orbit; it is near a resonance of order 3 or 4, where the islands shrink to nothing; or
none of the curves tried is proved.

Proof.  That of `cap.proofs.island`, at each f.
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import pi
from typing import Any

from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.floats.candidates import Request
from cap.option import Option, count
from cap.parameters import Parameters
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.island import island
from cap.proofs.island_centre import located
from cap.proofs.options import JOBS, JOURNAL, RANGE_OF_F, whole_range_of_f
from cap.proofs.rotation_choice import INWARDS, within
from cap.runner import Plan

SUMMARY = "invariant curves around elliptic orbits at many values of f, and the areas inside"
GROUP = "family"
SEARCH = candidates.range_of_f
CHECK = whole_range_of_f

COUNT = Option("count", count(2, 64), "so many values of f (default 20)", "N", default=20)
OPTIONS = (*RANGE_OF_F, COUNT, JOBS, JOURNAL)

NEAR = 0.02  # of a resonance, in turns
NO_ORBIT, NO_CURVE = "no elliptic orbit", "no curve"


@dataclass(frozen=True)
class AtF:
    """The proof at one f, to be done in any process; all else is in it."""

    parameters: Parameters
    digits: int

    def __call__(self, f: Fraction) -> dict[str, Any]:
        """Return claims and hints at f; or the reason why there are none."""
        p = replace(self.parameters, f=f)
        try:
            found = candidates.elliptic(Request("elliptic", p))
            setting = Setting(p, found.candidates[0].start, self.digits)
            place = located(setting)
        except (BadInput, NotProved):
            return {"reason": NO_ORBIT}
        for sought in within(place):
            try:
                claims, hints = island(setting, place, sought)
            except NotProved:
                continue
            return {"claims": claims, "hints": hints}
        return {"reason": reason(place.centre.angle / (2 * pi))}


def prove(setting: Setting) -> Proof:
    """Prove the theorem at each f; there is no size left to choose."""
    low, high = whole_range_of_f(setting.options, setting.parameters)
    strings = setting.parameters.elastic_strings()
    del strings["f"]
    number = setting.of(COUNT)
    values = [low + (high - low) * Fraction(k, number - 1) for k in range(number)]
    found = dict(_found(setting, values))
    proved = {f: found[f] for f in values if "claims" in found[f]}
    if not proved:
        reasons = {str(f): found[f]["reason"] for f in values}
        raise NotProved("islands", "nothing is proved at any f", reasons)
    claims = {"islands": [{"f": str(f), **each["claims"]} for f, each in proved.items()]}
    hints = {
        "islands": [each["hints"] for each in proved.values()],
        "open": [{"f": str(f), **found[f]} for f in values if f not in proved],
    }
    return settled("islands", setting, strings, (claims, hints))


def _found(
    setting: Setting, values: list[Fraction]
) -> Iterator[tuple[Fraction, Mapping[str, Any]]]:
    """Give what is found at each f, in any order."""
    at_f = AtF(setting.parameters, setting.digits)
    plan = Plan[Fraction, dict[str, Any]](
        key=f"islands at {setting.parameters}, {setting.digits} digits, {INWARDS}",
        encode=json.dumps,
        decode=json.loads,
        total=len(values),
        words="islands are proved",
    )
    return setting.runner.run(at_f, values, plan)


def reason(turns: float) -> str:
    """Return why there is no curve, in floats: where the orbit is near a resonance, this."""
    for order in (3, 4):
        if abs(turns - 1 / order) < NEAR:
            return f"resonance of order {order}"
    return NO_CURVE
