"""Where a branch of the release map ends: the condition that is met there, and at one place only.

Between two branches the events change, and a function of the place x changes its sign:

    graze       the distance from the wall ahead at which the velocity vanishes, if there were no
                wall: the mass reaches it or turns back before
    stop        |F cos ωt| - f when the velocity vanishes: the mass turns or sticks
    slow        the velocity at a time at which F cos ωt = f sgn v, where exp(μt) |v| has a minimum:
                the mass stops there, or goes on
    horizon     an event, counted up to a time, comes before or after it
    capture     captures begin near here: the number of hits changes at infinitely many places

The first three are proved: the events before are the same for all places of the gap, the function
has certainly opposite signs at its ends, and a derivative of one sign: so it has exactly one zero.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple, cast

from cap.errors import BadInput, NotProved
from cap.flow.event import (
    BALLS,
    TAYLOR_MODELS,
    Enclosure,
    Expected,
    NoCertainEvent,
    rest_time,
    slow_numbers,
)
from cap.flow.itinerary import itinerary
from cap.flow.model import Flight, Moment, Oscillator
from cap.flow.orbit import PartialOrbit
from cap.flow.strobe import oscillator
from cap.flow.windows import Itinerary, windows_for
from cap.parameters import Parameters
from cap.release.passage import RIGHT, resting
from cap.release.table import Branch, Table
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

BITS = 128
ORDER = 2  # of the Taylor models
WIDER = 8  # time windows tried for a stop
NEAR = Fraction(1, 50)  # of a period: so near to a slow moment a stop may be due to it

Gap = tuple[tuple[Fraction, Fraction], Callable[[Ball, Ball], tuple[Any, Enclosure[Any]]]]
"""The ends of a gap, and how all its places are enclosed."""


@dataclass(frozen=True)
class Border:
    """The gap [lower, upper] between two branches.

    ``kind`` as above, or `same` if the events on both sides are, or `unknown`.  After so many
    ``events`` that are the same the next ones differ.  ``proved``: the condition is met at exactly
    one place of the gap.
    """

    lower: Fraction
    upper: Fraction
    kind: str
    events: int
    proved: bool


class _Sides(NamedTuple):
    """Values of a function at both ends of a gap, and its derivative in between."""

    lower: Ball
    upper: Ball
    slope: Ball

    @property
    def one_zero(self) -> bool:
        """Whether there is exactly one zero."""
        changes = self.lower < 0 < self.upper or self.upper < 0 < self.lower
        return bool(changes and (self.slope > 0 or self.slope < 0))


def borders(found: Table) -> list[Border]:
    """Return the borders between the branches of a table that follow each other."""
    p, gaps = found.parameters, {upper: lower for lower, upper in found.gaps}
    done = []
    with interval.workprec(BITS):
        osc = oscillator(p)
        for left, right in zip(found.branches, found.branches[1:], strict=False):
            if right.lower in gaps:
                done.append(border(osc, p, left, right))
    return done


def border(osc: Oscillator[Any], p: Parameters, left: Branch, right: Branch) -> Border:
    """Return what is known of the border between two branches."""
    n = _common(left.itinerary, right.itinerary)
    ends = left.upper, right.lower
    if left.itinerary == right.itinerary:
        return Border(*ends, "same", n, proved=False)
    nexts = [branch.itinerary[n] for branch in (left, right) if n < len(branch.itinerary)]
    if len(nexts) < 2:
        return Border(*ends, "horizon", n, proved=False)
    if any(word.startswith(("settle", "capture")) for word in nexts):
        return Border(*ends, "capture", n, proved=False)
    if not any(word.startswith(("turn", "stick")) for word in nexts):
        return Border(*ends, "unknown", n, proved=False)
    stops = left if left.itinerary[n].startswith(("turn", "stick")) else right
    for over in (_ball, _model):
        with suppress(NotProved, BadInput):
            kind = _Gap(osc, p, (ends, over), stops, n).kind()
            if kind:
                return Border(*ends, kind, n, proved=True)
    return Border(*ends, "unknown", n, proved=False)


def _ball(lower: Ball, upper: Ball) -> tuple[Any, Enclosure[Any]]:
    """Return all places of a gap as a ball: quick."""
    return interval.hull(lower, upper), BALLS


def _model(lower: Ball, upper: Ball) -> tuple[Any, Enclosure[Any]]:
    """Return all places of a gap as a Taylor model: tight."""
    whole = interval.hull(lower, upper)
    m = interval.point(whole)
    (x,) = Domain((whole - m,), ORDER).variables((m,))
    return x, TAYLOR_MODELS


def _common(one: tuple[str, ...], other: tuple[str, ...]) -> int:
    """Return how many words at the beginning are the same."""
    both = zip(one, other, strict=False)
    return next((n for n, (a, b) in enumerate(both) if a != b), min(len(one), len(other)))


class _Gap:
    """The flights of all masses from a gap after their common events."""

    def __init__(
        self, osc: Oscillator[Any], p: Parameters, gap: Gap, stops: Branch, common: int
    ) -> None:
        ends, over = gap
        self.osc, lower, upper = osc, interval.ball(ends[0]), interval.ball(ends[1])
        inner = ends[0] if stops.upper == ends[0] else ends[1]
        begin = 0.75 * float(osc.T.mid())
        duration = float(osc.T.mid()) * (len(stops.itinerary) + 2)
        path = itinerary(p, float(inner), 0.0, begin + duration, start=begin)
        events = path.events[: common + 2]
        if tuple(e.word for e in events[1:]) != stops.itinerary[: common + 1]:
            raise NotProved("border", "floats see other events")
        self.stop = events[-1].time
        self.expected = (RIGHT, *(Expected(e.word, Ball(e.time)) for e in events[1:-1]))
        self.whole = self._after(*over(lower, upper))
        self.points = [self._after(end, BALLS) for end in (lower, upper)]
        self.bound = self.whole.bound

    def _after(self, x: Any, kind: Enclosure[Any]) -> PartialOrbit[Any]:
        """Prove the common events of all masses from a set of places; they fly after them."""

        def attempt(events: Itinerary) -> PartialOrbit[Any]:
            orbit = PartialOrbit(self.osc, resting(self.osc, x), kind)
            for number, event in enumerate(events, 1):
                orbit.meet(event, number)
            return orbit

        _, found = windows_for(attempt, self.expected, kind.bound)
        return found

    def kind(self) -> str:
        """Return the kind of the border if it is proved, else nothing."""
        tests = ("slow", self._slow), ("graze", self._graze), ("stop", self._stopped)
        found = ((kind, sides()) for kind, sides in tests)
        return next((kind for kind, sides in found if sides and sides.one_zero), "")

    def _slow(self) -> _Sides | None:
        """Return the velocity at the slow moment next to the stop, if that is near."""
        osc, flight = self.osc, _flight(self.whole)
        reach = interval.ball(NEAR) * osc.T
        around = Ball(self.stop) - reach, Ball(self.stop) + reach
        for k in slow_numbers(osc, flight.s, *around):
            at = osc.slow(flight.s, k)
            if around[0] < at.t < around[1] and self.whole.now < at.t and k != self.whole.released:
                values = [osc.velocity(_flight(orbit), at) for orbit in self.points]
                return _Sides(values[0], values[1], self.bound(self._derivative(at)[1]))
        return None

    def _graze(self) -> _Sides:
        """Return the place where the velocity vanishes, less that of the wall ahead."""
        osc, s = self.osc, _flight(self.whole).s
        values = [osc.position(_flight(y), self._rest(y, BALLS)) - osc.wall(s) for y in self.points]
        return _Sides(values[0], values[1], self.bound(self._derivative(self._stop_of_all())[0]))

    def _stopped(self) -> _Sides:
        """Return the force against the motion when the velocity vanishes, less f."""
        osc, flight, at = self.osc, _flight(self.whole), self._stop_of_all()
        values = [-flight.s * osc.forcing(self._rest(y, BALLS)) - osc.f for y in self.points]
        late = -self._derivative(at)[1] / osc.acceleration(flight, at)
        return _Sides(
            values[0], values[1], self.bound(flight.s * osc.F * osc.omega * at.sin * late)
        )

    def _stop_of_all(self) -> Moment[Any]:
        kind = BALLS if isinstance(self.whole.place, Ball) else TAYLOR_MODELS
        return self._rest(self.whole, cast("Enclosure[Any]", kind))

    def _rest(self, orbit: PartialOrbit[Any], kind: Enclosure[Any]) -> Moment[Any]:
        """Return when the velocity of the flights vanishes, whatever walls there are."""
        window = Ball(self.stop) + interval.symmetric(interval.ball(NEAR) * self.osc.T / 100)
        for _ in range(WIDER):
            try:
                return rest_time(self.osc, _flight(orbit), Expected("stop", window), kind, 0)
            except NoCertainEvent as miss:
                window = interval.hull(miss.window, miss.newton)
                window += interval.symmetric(window - interval.point(window)) / 4
        raise NotProved("border", "when the velocity vanishes is too uncertain", {"at": window})

    def _derivative(self, at: Moment[Any]) -> tuple[Any, Any]:
        """Return the derivatives of x and v at a moment of the flights by the place."""
        (a, _), (c, _) = self.osc.drift(self.whole.monodromy, at.t - self.whole.before)
        return a, c


def _flight(orbit: PartialOrbit[Any]) -> Flight[Any]:
    """Return the flight after the common events."""
    if orbit.flight is None:
        raise NotProved("border", "the masses rest")
    return orbit.flight
