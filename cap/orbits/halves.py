"""Half a round of a periodic orbit that a symmetry takes into itself, half a period later."""

import math
from collections.abc import Sequence

from cap.orbits.itinerary import Contact, Itinerary
from cap.system.exponential import number
from cap.system.symmetry import Symmetry, symmetries

CLOSE = 1e-6  # how near a guess has to be to its image


def half(whole: Itinerary, guess: Sequence[float], even: Sequence[str] = ()) -> Itinerary | None:
    """Return the itinerary of half a round, if the orbit of a guess is symmetric; else None.

    The guess has the time and the state just before each contact; its first half is one of half a
    round.  The symmetry leaves the variables ``even`` as they are.
    """
    system, contacts = whole.system, whole.contacts
    if len(contacts) % 2 or whole.periods % 2 == 0 or system.autonomous:
        return None
    for symmetry in symmetries(system, even):
        if _takes(symmetry, whole, guess):
            return Itinerary(system, contacts[: len(contacts) // 2], whole.periods, symmetry)
    return None


def _takes(symmetry: Symmetry, itinerary: Itinerary, guess: Sequence[float]) -> bool:
    """Return whether a symmetry takes each contact to that half a round later, up to rounding."""
    contacts, count = itinerary.contacts, len(itinerary.contacts)
    step, half = len(guess) // count, count // 2
    period = 2 * math.pi / float(number(itinerary.system.omega))
    for k in range(half):
        mode, guard, to = contacts[k]
        image = Contact(symmetry.modes[mode], symmetry.guards[mode, guard], symmetry.modes[to])
        if contacts[k + half] != image:
            return False
        t, *q = guess[step * k : step * (k + 1)]
        later, *r = guess[step * (k + half) : step * (k + half + 1)]
        moved = [t + period * itinerary.periods / 2, *(s * x for s, x in zip(symmetry.signs, q))]  # noqa: B905
        if any(abs(a - b) > CLOSE * (1 + abs(a)) for a, b in zip(moved, [later, *r], strict=True)):
            return False
    return True
