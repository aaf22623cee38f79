"""Time windows for the events of an itinerary, found by widening: what they lead to is proved."""

from collections.abc import Callable, Sequence
from typing import Any, Protocol, TypeVar

from cap.errors import NotProved
from cap.flow.event import Enclosure, Event, Expected, NoCertainEvent
from cap.flow.model import Oscillator
from cap.flow.orbit import Orbit
from cap.flow.strobe import strobe
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.scalar import S

Itinerary = tuple[Expected, ...]


class Path(Protocol):
    """What is proved with windows: it has their events."""

    @property
    def events(self) -> Sequence[Event[Any]]:
        """The events, one in each window."""


Proved = TypeVar("Proved", bound=Path)


def is_capture(event: Expected) -> bool:
    """Return whether an event is a capture: its window ends where its lemma does."""
    return event.word.startswith("capture")


def find_windows(
    osc: Oscillator[Any],
    state: tuple[S, S],
    expected: Itinerary,
    kind: Enclosure[S],
    periods: int = 1,
) -> tuple[Itinerary, Orbit[S]]:
    """Return time windows near the ``expected`` ones for which `strobe` succeeds, and its orbit.

    A window that does not contain its Newton image is widened to hold it (epsilon inflation).
    """
    return windows_for(
        lambda events: strobe(osc, state, events, kind, periods), expected, kind.bound
    )


def windows_for(
    attempt: Callable[[Itinerary], Proved], expected: Itinerary, bound: Callable[[Any], Ball]
) -> tuple[Itinerary, Proved]:
    """Return windows with which ``attempt`` succeeds, and still does if they are enlarged.

    Also return what it proves with them, so that it need not be repeated.
    """
    events = list(expected)
    for _ in range(20 * len(events) + 20):
        windows = tuple(events)
        try:
            orbit = attempt(windows)
        except NoCertainEvent as miss:
            window = _inflated(interval.hull(miss.window, miss.newton))
            events[miss.number - 1] = events[miss.number - 1]._replace(window=window)
        else:
            return _with_slack(attempt, orbit, windows, bound) or (windows, orbit)
    raise NotProved("windows", "the event times vary too much on the box", {"windows": events})


def _with_slack(
    attempt: Callable[[Itinerary], Proved],
    orbit: Path,
    expected: Itinerary,
    bound: Callable[[Any], Ball],
) -> tuple[Itinerary, Proved] | None:
    """Return windows a little larger than the event times of ``orbit``, if they succeed."""
    events: list[Expected] = []
    for new, old in zip(orbit.events, expected, strict=True):
        window = _inflated(bound(new.time))
        if is_capture(old):  # from before the hit until an end that is known to be late enough
            hit = events[-1].window
            window = interval.hull(interval.hull(window, old.window), hit)
        events.append(old._replace(window=window))
    windows = tuple(events)
    try:
        return windows, attempt(windows)
    except NotProved:
        return None


def _inflated(window: Ball) -> Ball:
    """Return a ball a little larger than ``window``, even if that is a point."""
    tenth = interval.symmetric(window - interval.point(window)) / 10
    return window + tenth + interval.symmetric(window) * interval.rounding()
