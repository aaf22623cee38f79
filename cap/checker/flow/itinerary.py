"""Itineraries: the events of all orbits from a box, in their order, and the map over a period.

Each word of an itinerary is proved, here by ``hits``: on the flight after the last event (or the
rest, before a release), this is the next event, and it lies in its time window.

*The end.*  All events certified lie before nT, n = 1 here.  If after the last event s v > 0 up
to nT, and x(nT) lies strictly between the walls, there are no more events.

*Smoothness.*  An event time is a zero of g with g' /= 0, so near the box it is an analytic function
of the initial state, of e and of mu; so is the state after the event.  A release is at a constant
time, after a stick at the place where it began; after a capture the state is constant.  So with
such an itinerary Phi^n is real analytic on the box, and jets with the chain rule give its
derivative.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from cap.checker.flow.hits import Hit, hit
from cap.checker.flow.mechanics import Box, Ends, Flight, Mechanics, least
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, lift
from cap.checker.kernel.rejection import need
from cap.checker.system.walls import Parameters

MAX_EVENTS = 64
MAX_WORK = 3 << 18


def work(events: int, bits: int, order: int = 0) -> int:
    """Return a measure of the time: 10 to 50 microseconds for each unit.  Jets have order >= 4."""
    return events * bits * (max(order, 4) + 1) ** 2


def limit_work(needed: int) -> None:
    """Reject what would take too long to check."""
    need(needed <= MAX_WORK, f"bits, order, events and cells are too much: {needed} > {MAX_WORK}")


class Passage(NamedTuple):
    """The orbits from a box over n periods: the events, the last flight, the state at the end."""

    mechanics: Mechanics
    events: list[Any]
    last: Flight
    x: Centred
    v: Centred

    @property
    def jacobian(self) -> list[list[Interval]]:
        """The derivative of the state at the end by that at the beginning."""
        return [[z[1, 0], z[0, 1]] for z in (self.x, self.v)]

    @property
    def least_speed(self) -> Interval:
        """The least speed, if all events are hits and mu = 0."""
        M = self.mechanics
        slowest = [M.least_speed(hit.flight, hit.moment) for hit in self.events]
        return least([*slowest, M.least_speed(self.last, M.at(M.horizon))])


def passage(M: Mechanics, events: list[Any], last: Flight) -> Passage:
    """Return the orbits after all their events; on return, the final states are between the walls,
    and of constant sign of v.
    """
    end = M.at(M.horizon)
    moves = M.least_speed(last, end).is_positive()
    need(moves, "the velocity may vanish between the last event and T")
    x, speed = M.place(last, end), M.speed(last, end)
    need(M.is_between_walls(x.value), "x(T) is not certainly between the walls")
    return Passage(M, events, last, x, lift(lambda u: u * last.s, speed))


@dataclass(frozen=True)
class PeriodMap:
    """Phi near an orbit of hits, with a time window for each that is to be proved."""

    p: Parameters
    windows: Sequence[Ends]

    def over(self, box: Box, m: Box, order: int) -> Passage:
        """Return the orbits from a box; on return, all of them have exactly these hits.

        Their initial and final states are strictly between the walls, of constant sign of v.
        """
        M = Mechanics(self.p, box, m, order)
        flight, hits = M.launch(), list[Hit]()
        for window in self.windows:
            found, flight = hit(M, flight, window)
            hits.append(found)
        return passage(M, hits, flight)
