"""Itineraries: the events of all orbits from a box, in their order, and the map over n periods.

Each word of an itinerary is proved by ``events`` or ``capture``: on the flight after the last event
(or the rest, before a release), this is the next event, and it lies in its time window.

*The end.*  All events certified lie before nT.  If after the last event s v > 0 up to nT, and x(nT)
lies strictly between the walls, there are no more events.

*Smoothness.*  An event time is a zero of g with g' /= 0, so near the box it is an analytic function
of the initial state, of e and of mu; so is the state after the event.  A release is at a constant
time, after a stick at the place where it began; after a capture the state is constant.  So with
such an itinerary Phi^n is real analytic on the box, and jets with the chain rule give its
derivative.

*The determinant* of (Phi^n)': flights have exp(-mu d), hits e^2, turns at forcing a the saltation
diag(1, (|a| - f)/(|a| + f)); a stick or a capture makes it 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from cap.checker.flow.capture import capture
from cap.checker.flow.events import Event, Rest, hit, release, stick, turn
from cap.checker.flow.mechanics import Ends, Flight, Losses, Mechanics, least
from cap.checker.kernel.elementary import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, lift
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Parameters

SIDES = {"r": 1, "right": 1, "l": -1, "left": -1}
WORDS = (
    "stick",
    *(f"{event} {wall}" for event in ("hit", "capture") for wall in "rl"),
    *(f"{event} {side}" for event in ("turn", "release") for side in ("right", "left")),
)


WITH_LOSSES_AT = (
    "x'' = F cos(omega t) - f sgn x' - mu x' with F = {F}, omega = {omega}, f = {f}, mu = {mu} and "
    "walls at l = {l} and r = {r}, where v becomes -e v with e = {e}: "
)
MAX_EVENTS = 64
MAX_WORK = 3 << 18
CELL_WORK = 1 << 10  # an event in a rectangle of persistence: 64 bits, four variables


def work(events: int, bits: int, order: int = 0, cells: int = 0) -> int:
    """Return a measure of the time: 10 to 50 microseconds for each unit.  Jets have order >= 4."""
    return events * (bits * (max(order, 4) + 1) ** 2 + CELL_WORK * cells)


def limit_work(windows: Sequence[Enclosure], hints: dict[str, Any]) -> None:
    """Reject what would take too long to check."""
    order, cells = int(hints.get("order", 0)), len(hints.get("cells", ()))
    needed = work(len(windows), hints["bits"], order, cells)
    need(needed <= MAX_WORK, f"bits, order, events and cells are too much: {needed} > {MAX_WORK}")


def limit_events(hints: dict[str, Any], claims: dict[str, Any]) -> None:
    """Reject what would take too long, and what has not as many events everywhere."""
    limit_work(hints["events"], hints)
    events = len(hints["events"])
    for name in ("itinerary", "event_times"):
        need(len(claims[name]) == events, f"claims.{name} is not a list of {events}")


class Passage(NamedTuple):
    """The orbits from a box over n periods: the events, the last flight, the state at the end."""

    mechanics: Mechanics
    events: list[Event]
    last: Flight
    x: Centred
    v: Centred

    @property
    def hits(self) -> list[Event]:
        """The hits."""
        return [e for e in self.events if e.speed is not None]

    @property
    def least_speed(self) -> Interval:
        """The least speed, if all events are hits and mu = 0."""
        M = self.mechanics
        slowest = [M.least_speed(e.flight, e.moment) for e in self.events if e.flight is not None]
        return least([*slowest, M.least_speed(self.last, M.full_turns(M.horizon))])


class PeriodMap(NamedTuple):
    """Phi^n near an orbit, with the itinerary that is to be proved, and a time window for each
    word.

    ``losses`` are a set of e and mu in the place of those in the parameters.
    """

    p: Parameters
    itinerary: Sequence[str]
    windows: Sequence[Ends]
    periods: int = 1
    losses: Losses | None = None

    def over(self, box: Sequence[Interval], m: Sequence[Interval], order: int) -> Passage:
        """Return the orbits from a box; on return, all of them have exactly the itinerary.

        Their initial and final states are strictly between the walls, of constant sign of v.
        """
        M = Mechanics(self.p, box, m, order, self.periods, self.losses)
        events, state = follow(M, M.launch(), self.itinerary, self.windows)
        last = moving(state)
        end = M.full_turns(M.horizon)
        moves = M.least_speed(last, end).is_positive()
        need(moves, "the velocity may vanish between the last event and T")
        x, speed = M.place(last, end), M.speed(last, end)
        need(M.is_between_walls(x.value), "x(T) is not certainly between the walls")
        return Passage(M, events, last, x, lift(lambda u: u * last.s, speed))


def follow(
    M: Mechanics, state: Flight | None, itinerary: Sequence[str], windows: Sequence[Ends]
) -> tuple[list[Event], Flight | Rest | None]:
    """Prove the itinerary from a flight on, and return its events and the state after it.

    The state None is that of a box which may touch a wall; only a capture can follow it.
    """
    events = list[Event]()
    now: Flight | Rest | None = state
    for word, window in zip(itinerary, windows, strict=True):
        kind, _, where = word.partition(" ")
        if kind == "release":
            event, now = release(M, resting(now), SIDES[where], word, window)
        elif kind == "capture":
            before = events[-1] if events else None
            event, now = capture(M, before, SIDES[where], word, window)
        elif kind == "stick":
            event, now = stick(M, moving(now), word, window)
        elif kind == "turn":
            event, now = turn(M, moving(now), SIDES[where], word, window)
        else:
            event, now = hit(M, moving(now), SIDES[where], window)
        events.append(event)
    return events, now


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
    M, events = passage.mechanics, passage.events
    result = phi(0, -(M.horizon * M.mu.value))
    for event in events:
        if event.word == "stick" or event.word.startswith("capture"):
            return result.integer(0)
        if event.speed is not None:
            result = result * M.e.value.square()
        elif event.word.startswith("turn"):
            result = result * turning_factor(M, event)
    return result


def turning_factor(M: Mechanics, turn: Event) -> Interval:
    """Return (|a| - f)/(|a| + f) for the forcing a at a turn."""
    return -(M.f * 2 / (turn.forcing.magnitude() + M.f)) + 1


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
