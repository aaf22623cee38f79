"""All kinds of events, in a system with losses; and the map over n periods.

*The determinant* of (Phi^n)': flights have exp(-mu d), hits e^2, turns at forcing a the saltation
diag(1, (|a| - f)/(|a| + f)); a stick or a capture makes it 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from cap.checker.flow.capture import capture
from cap.checker.flow.hits import HITS, Hit, hit
from cap.checker.flow.itinerary import Passage, PeriodMap, limit_work, passage, work
from cap.checker.flow.losses import Lossy
from cap.checker.flow.mechanics import Box, Ends, Flight, Mechanics
from cap.checker.flow.stops import Event, Rest, release, stick, turn
from cap.checker.kernel.exponential import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Enclosure

CELL_WORK = 1 << 10  # an event in a rectangle of persistence: 64 bits, four variables
WORDS = (
    "stick",
    *(f"{event} {wall}" for event in ("hit", "capture") for wall in "rl"),
    *(f"{event} {side}" for event in ("turn", "release") for side in ("right", "left")),
)


@dataclass(frozen=True)
class LossyMap(PeriodMap):
    """Phi^n with losses, near an orbit with any events.

    ``sets`` are intervals for e and mu in the place of those in the parameters.
    """

    itinerary: Sequence[str]
    periods: int = 1
    sets: Mapping[str, Ends] = field(default_factory=dict)

    def mechanics(self, box: Box, m: Box, order: int) -> Lossy:
        """Return the mechanics over a box."""
        return Lossy(self.p, box, m, order, self.periods, self.sets)

    def over(self, box: Box, m: Box, order: int) -> Passage:
        """Return the orbits from a box; on return, all of them have exactly the itinerary.

        Their initial and final states are strictly between the walls, of constant sign of v.
        """
        M = self.mechanics(box, m, order)
        events, last = self.follow(M, M.launch())
        return passage(M, events, moving(last))

    def follow(self, M: Lossy, now: Any) -> tuple[list[Any], Any]:
        """Prove the itinerary from a state on, and return its events and the state after it."""
        events = list[Any]()
        for word, window in zip(self.itinerary, self.windows, strict=True):
            event, now = self.event(M, events, now, word, window)
            events.append(event)
        return events, now

    def event(self, M: Any, before: list[Any], now: Any, word: str, window: Ends) -> Any:
        """Prove the next event, and return it with the state after it.

        The state None is that of a box which may touch a wall; only a capture can follow it.
        """
        kind = word.partition(" ")[0]
        if kind == "capture":
            return capture(M, before[-1] if before else None, word, window)
        if kind == "release":
            return release(M, resting(now), word, window)
        flight = moving(now)
        if kind == "hit":
            ahead = word == HITS[flight.s]
            need(ahead, "a hit of the wall from which the mass moves away")
            return hit(M, flight, window)
        return {"turn": turn, "stick": stick}[kind](M, flight, word, window)


def moving(state: Flight | Rest | None) -> Flight:
    """Return the state if it is a flight."""
    if not isinstance(state, Flight):
        raise Rejected("the mass rests, and no release follows")
    return state


def resting(state: Flight | Rest | None) -> Rest:
    """Return the state if it is a rest."""
    if not isinstance(state, Rest):
        raise Rejected("a release of a mass that does not rest")
    return state


def determinant(passage: Passage) -> Interval:
    """Return an enclosure of the determinant of (Phi^n)' by the formula above."""
    M: Any = passage.mechanics  # that of a ``LossyMap``
    events = passage.events
    result = phi(0, -(M.horizon * M.mu.value))
    for event in events:
        if event.word == "stick" or event.word.startswith("capture"):
            return result.integer(0)
        if isinstance(event, Hit):
            result = result * M.e.value.square()
        elif event.word.startswith("turn"):
            result = result * turning_factor(M, event)
    return result


def turning_factor(M: Mechanics, turn: Event) -> Interval:
    """Return (|a| - f)/(|a| + f) for the forcing a at a turn."""
    return -(M.f * 2 / (turn.forcing.magnitude() + M.f)) + 1


def limit_events(hints: dict[str, Any], claims: dict[str, Any]) -> None:
    """Reject what would take too long, and what has not as many events everywhere."""
    events, cells = len(hints["events"]), len(hints.get("cells", ()))
    limit_work(work(events, hints["bits"]) + events * CELL_WORK * cells)
    for name in ("itinerary", "event_times"):
        need(len(claims[name]) == events, f"claims.{name} is not a list of {events}")


def in_order(words: Sequence[str], times: Sequence[Enclosure]) -> None:
    """Check that the times claimed are in the order of the events, from 0 on.

    The enclosure for a capture may begin before its hit, but after the event before that.
    """
    for n, (word, t) in enumerate(zip(words, times, strict=True)):
        captured = word.startswith("capture")
        before = times[: max(0, n - captured)]
        later = not before or before[-1].upper < t.lower
        need(later, f"the time of event {n + 1} is not after that of the event before")
        need(t.lower >= 0, "the time of the first event may be negative")
        need(n == 0 or times[n - 1].upper <= t.upper, "a capture may end before its hit")
