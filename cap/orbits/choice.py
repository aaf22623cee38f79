"""Motions near an orbit go on in the same modes: after its contacts all other modes are closed.

A guard may name several modes to go on in.  One is closed if one of its guards is negative just
after the contact, or vanishes there and falls.
"""

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.along import Leg
from cap.orbits.periodic import Prover


def without_choice(prover: Prover, box: Box) -> None:
    """Raise `NotProved` unless all other modes are closed after the contacts in a box."""
    system, contacts = prover.itinerary.system, prover.itinerary.contacts
    for leg in prover.legs(box):
        mode, guard, to = contacts[leg.number]
        for other in system.guard(mode, guard).to:
            if other != to and not _is_closed(prover, leg, other):
                reason = (
                    f"after contact {leg.number + 1} ('{guard}') the mode '{other}' may be open "
                    f"as '{to}' is: which one motions near the orbit go on in is not decided"
                )
                raise NotProved("choice", reason, {"t": leg.start.time})


def _is_closed(prover: Prover, leg: Leg, mode: str) -> bool:
    """Return whether a mode is closed where a leg begins."""
    at = *leg.start.clock, *leg.start.state
    for name in prover.itinerary.system.modes[mode].guards:
        watch = prover.equations.kinds.watch(mode, name)
        zero = prover.itinerary.zeros_in(leg.number, mode, name) > 0
        if leg.of.of(watch.rate if zero else watch.at)(*at)[0] < 0:
            return True
    return False
