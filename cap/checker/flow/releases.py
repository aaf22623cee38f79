"""From one release to the next: where it is, mirrored if it is to the left, and how much later."""

from __future__ import annotations

from cap.checker.flow.events import LossyMap
from cap.checker.flow.hits import SIDES
from cap.checker.flow.mechanics import Flight, Mechanics
from cap.checker.kernel.jet import Centred, lift
from cap.checker.kernel.rejection import Rejected, need


def next_release(M: Mechanics, phi: LossyMap, start: Flight) -> tuple[Centred, int]:
    """Prove the itinerary; return where the release at its end is, mirrored if to the left.

    And how many half-periods it comes after the release to the right in the first period.
    """
    earlier = any(word.startswith("release") for word in phi.itinerary[:-1])
    need(not earlier, "the release at the end is not the only release")
    events, flight = phi.follow(M, start)
    verb, _, side = phi.itinerary[-1].partition(" ")
    if verb != "release" or not isinstance(flight, Flight):
        raise Rejected("the itinerary does not end with a release")
    number, last = SIDES[side], events[-1].moment
    k = next(n for n, moment in enumerate(M.minima[number]) if moment is last)
    taken = 2 * k - (number < 0)
    x = M.place(flight, last)
    mirror = M.constant(M.walls[1] + M.walls[-1])
    return x if number > 0 else lift(lambda y, z: y - z, mirror, x), taken
