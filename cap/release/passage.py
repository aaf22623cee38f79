"""The release map G, certified: from one release to the next, over sets of places.

A mass that has stuck between the walls leaves to the right at a time `Oscillator.slow` (1, k), or
to the left half a period earlier or later.  The symmetry (x, v, t) -> (l + r - x, -v, t + T/2)
takes the one to the other: so let x be the place of a release to the right, and G(x) the place of
the next release, mirrored if that is to the left.  G takes a whole number of half-periods.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, cast

from cap.errors import BadInput, NotProved
from cap.flow.event import BALLS, E, Enclosure, Event, Expected
from cap.flow.itinerary import itinerary
from cap.flow.itinerary import oscillator as of_floats
from cap.flow.model import Moment, Oscillator
from cap.flow.orbit import PartialOrbit, State
from cap.flow.windows import Itinerary, windows_for
from cap.parameters import Parameters
from cap.release.halt import HaltingOrbit
from cap.sets import interval
from cap.sets.interval import Ball

LONGEST = 16  # periods without a release
RIGHT = Expected("release right", Ball(0))


@dataclass(frozen=True, slots=True)
class Passage(Generic[E]):
    """What is proved of all releases to the right from a set of places.

    ``events`` up to the next release; G and G' over the set; how many ``half_periods`` G takes.
    """

    events: tuple[Event[E], ...]
    value: E
    slope: E
    half_periods: int

    def times(self, bound: Callable[[E], Ball]) -> tuple[Expected, ...]:
        """Return the events with enclosures of their times over the set."""
        return tuple(Expected(event.word, bound(event.time)) for event in self.events)


def resting(osc: Oscillator[Any], x: E) -> State[E]:
    """Return the mass at rest between the walls at 3T/4, where F cos ωt = 0, before its release."""
    return State(Moment(3 * osc.T / 4, Ball(-1), Ball(0)), x, cast(E, Ball(0)))


def passage(osc: Oscillator[Any], x: E, expected: Itinerary, kind: Enclosure[E]) -> Passage[E]:
    """Prove that all orbits released to the right at x have the ``expected`` events, no others.

    The last event is the next release.  Raises `NotProved` with the event that is undecided.
    """
    found = arrival(osc, resting(osc, x), (RIGHT, *expected), kind)
    return replace(found, events=found.events[1:])


def arrival(
    osc: Oscillator[Any], start: State[E], expected: Itinerary, kind: Enclosure[E]
) -> Passage[E]:
    """Prove that all orbits from a box of states have the ``expected`` events, up to a release.

    ``value`` is where they are then, mirrored if it is to the left, ``slope`` the derivative of
    that by x; ``half_periods`` are counted from the release to the right in the first period.
    """
    orbit = HaltingOrbit(osc, start, kind)
    for number, event in enumerate(expected, 1):
        orbit.meet(event, number)
    side, k = next_release(orbit)
    place, slope = cast("tuple[Any, Any]", (orbit.place, orbit.monodromy[0][0]))
    if side < 0:
        place, slope = osc.l + osc.r - place, -slope
    return Passage(tuple(orbit.events), place, slope, 2 * k - (side < 0))


def next_release(orbit: PartialOrbit[E]) -> tuple[int, int]:
    """Return the side and the number of the slow moment of the release that came last."""
    last = orbit.events[-1].word if orbit.events else ""
    verb, _, side = last.partition(" ")
    if verb != "release" or orbit.released is None:
        raise NotProved("release map", "the events do not end with a release")
    return (1 if side == "right" else -1), orbit.released


def foreseen(p: Parameters, x: float) -> tuple[Itinerary, float, float]:
    """Return the events up to the next release, G(x) and G'(x), in floats.

    Raises `BadInput` if there is none in `LONGEST` periods, or x is not between the walls.
    """
    o = of_floats(p)
    return _foreseen(p, o, (x, 0.0), 0.75 * o.T)


def foreseen_from(p: Parameters, state: tuple[float, float]) -> Itinerary:
    """Return the events from a state at t = 0 up to the next release, in floats."""
    return _foreseen(p, of_floats(p), state, 0.0)[0]


def _foreseen(
    p: Parameters, o: Oscillator[float], state: tuple[float, float], begin: float
) -> tuple[Itinerary, float, float]:
    first = int(state[1] == 0)  # the release itself
    for periods in (2, 4, 8, LONGEST):
        end = begin + periods * o.T
        events = itinerary(p, *state, end, start=begin).events[first:]
        last = next((n for n, e in enumerate(events) if e.word.startswith("release")), None)
        if last is not None:
            break
    else:
        raise BadInput(f"the mass from {state!r} does not stick in {LONGEST} periods")
    release, side = events[last], 1 if events[last].word == "release right" else -1
    resting = (events[last - 1].time + release.time) / 2
    slope = itinerary(p, *state, resting, start=begin).monodromy[0][0]
    place = release.x if side > 0 else o.l + o.r - release.x
    return tuple(Expected(e.word, Ball(e.time)) for e in events[: last + 1]), place, side * slope


def words(events: Itinerary) -> tuple[str, ...]:
    """Return the words of an itinerary."""
    return tuple(event.word for event in events)


def windows(osc: Oscillator[Any], x: E, expected: Itinerary, kind: Enclosure[E]) -> Itinerary:
    """Return time windows, near the ``expected`` ones, for which `passage` succeeds; it steers."""

    start = resting(osc, x)

    def attempt(events: Itinerary) -> Any:
        return arrival(osc, start, events, kind)

    bound = cast("Callable[[Any], Ball]", kind.bound)
    found, _ = windows_for(attempt, (RIGHT, *expected), bound)
    return found[1:]


def image(osc: Oscillator[Any], x: Ball, expected: Itinerary) -> tuple[Ball, Ball]:
    """Return enclosures of G, in mean value form, and of G' over a ball."""
    whole = passage(osc, x, windows(osc, x, expected, BALLS), BALLS)
    m = interval.point(x)
    here = whole if x.is_exact() else passage(osc, m, windows(osc, m, expected, BALLS), BALLS)
    return here.value + whole.slope * (x - m), whole.slope
