"""Certified orbits from a box of states: each event is proved, and that no other happens before it.

`cap.flow.strobe.follow` applies this to an itinerary; its words are explained there.
"""

from collections.abc import Callable
from typing import Any, Generic, NamedTuple, cast

from cap.errors import BadInput, NotProved
from cap.flow import capture
from cap.flow.event import (
    E,
    Enclosure,
    Event,
    Expected,
    NoCertainEvent,
    flies,
    hit_time,
    next_slow,
    rest_time,
    slow_numbers,
)
from cap.flow.model import Flight, Moment, Oscillator
from cap.flow.words import WORDS
from cap.sets import interval
from cap.sets.interval import ONE, ZERO, Ball
from cap.sets.matrix import Matrix

SIDES = {"r": 1, "l": -1, "right": 1, "left": -1}


class State(NamedTuple, Generic[E]):
    """A box of states (x, v) at a moment.

    ``wall`` is 1 or -1 if the mass is exactly at r or l, else 0.  At a wall the enclosure of the
    wall is used in the place of x, which must overlap it.  A velocity that is exactly 0 is
    ``Ball(0)``; any other must have a sign.
    """

    at: Moment[Ball]
    x: E
    v: E
    wall: int = 0


class Orbit(NamedTuple, Generic[E]):
    """Enclosures of the orbits from a box of initial states until the end.

    ``s`` is the sign of the first flight, 0 if the mass rests.  ``events`` are in order of time.
    ``end`` encloses the states at the end, and ``monodromy`` their derivative in the initial state,
    at every state of the box.  A coordinate that is the same in the whole box, as x at a wall, or
    v = 0, has the column 0.  (At v = 0 the map need not be differentiable in v: the derivatives
    from the two sides may differ, by the factor of a turning.)  ``least_speed`` encloses the least
    |v| of orbits that neither turn nor rest, without viscosity.
    """

    s: int
    events: tuple[Event[E], ...]
    end: tuple[E, E]
    monodromy: Matrix[E]
    least_speed: Ball

    @property
    def hits(self) -> tuple[Event[E], ...]:
        """The wall hits among the events."""
        return tuple(event for event in self.events if event.word.startswith("hit"))


def placed(osc: Oscillator[Any], start: State[E], bound: Callable[[E], Ball]) -> State[E]:
    """Prove that the box is between the walls, or at one; return it, with that wall as its x.

    Between the walls it may touch one if it moves away from it.
    """
    x, v = bound(start.x), bound(start.v)
    if start.wall not in (-1, 0, 1):
        raise BadInput(f"the wall must be 1, -1 or 0: {start.wall!r}")
    if start.wall:
        if not (x.is_finite() and x.overlaps(osc.wall(start.wall))):
            raise NotProved("start", "the box is not at its wall", {"x": x})
        return start._replace(x=cast(E, osc.wall(start.wall)))
    if not (osc.l < x < osc.r or (v > 0 and osc.l <= x < osc.r) or (v < 0 and osc.l < x <= osc.r)):
        raise NotProved("start", "the box is not between the walls", {"x": x})
    return start


class PartialOrbit(Generic[E]):
    """The orbits from a box up to the last event proved; then they fly, or rest at ``place``.

    ``flight`` is None during a rest.  ``now`` encloses the time of the last event over the box;
    ``before`` is the same as a function of the state.
    """

    def __init__(self, osc: Oscillator[Any], start: State[E], kind: Enclosure[E]) -> None:
        self.osc, self.kind, self.bound = osc, kind, kind.bound
        self.flight: Flight[E] | None = None
        start = placed(osc, start, self.bound)
        self.place, self.wall, self.pending = start.x, start.wall, start.at.t
        self.released: int | None = None
        self.now, self.before = start.at.t, cast(E, start.at.t)
        velocity = self.bound(start.v)
        x_varies = ZERO if start.wall else ONE
        v_varies = ZERO if velocity.is_zero() else ONE
        self.monodromy: Matrix[Any] = (x_varies, ZERO), (ZERO, v_varies)
        self.events: list[Event[E]] = []
        self.least = abs(velocity)
        self.s = _begin(self, start)

    def meet(self, expected: Expected, number: int) -> None:
        """Prove that the next event is the one expected, and pass it."""
        if expected.word not in WORDS:
            raise NotProved(f"event {number}", f"there is no such event: {expected.word!r}")
        verb, _, side = expected.word.partition(" ")
        if verb == "release":
            self._release(SIDES[side], expected, number)
        elif verb == "capture":
            self._capture(SIDES[side], expected, number)
        elif self.flight is None:
            raise NotProved(f"event {number}", f"the mass rests: no {expected.word} is possible")
        elif verb == "hit":
            self._hit(self.flight, SIDES[side], expected, number)
        else:
            self._stop(self.flight, SIDES.get(side, 0), expected, number)

    def _fly(self, flight: Flight[E], until: E) -> None:
        """Prove that the flight lasts until its next event; the monodromy then includes it."""
        then = self.bound(until)
        slowest = flies(self.osc, flight, (self.now, then), self.bound, self.released)
        if slowest is not None:
            self.least = interval.least(self.least, slowest)
        self.monodromy = self.osc.drift(self.monodromy, until - self.before)
        self.now, self.before, self.released = then, until, None

    def _hit(self, flight: Flight[E], side: int, expected: Expected, number: int) -> None:
        if flight.s != side:
            raise NotProved(f"event {number}", f"the mass moves away: no {expected.word}")
        moment = hit_time(self.osc, flight, expected, self.kind, number)
        velocity = self.osc.velocity(flight, moment)
        speed = side * self.bound(velocity)
        if not speed > 0:
            raise NotProved(f"event {number}", "the hit may not be transverse", {"speed": speed})
        self._fly(flight, moment.t)
        self._bounce(flight, moment, velocity)
        self.flight = self.osc.reflect(flight, moment, velocity)
        self.events.append(Event(expected.word, moment.t, velocity, moment.cos))

    def _bounce(self, flight: Flight[E], moment: Moment[E], velocity: E) -> None:
        """Let the monodromy and the least speed include a hit."""
        osc, speed = self.osc, abs(self.bound(velocity))
        after = speed if osc.elastic else self.bound(osc.e * speed)
        self.least = interval.least(self.least, after)
        salt = osc.saltation(flight.s, velocity, moment.cos)
        self.monodromy = osc.hit(self.monodromy, salt)

    def _stop(self, flight: Flight[E], side: int, expected: Expected, number: int) -> None:
        """Pass a turning to a side, or the onset of sticking (side 0)."""
        osc, s = self.osc, flight.s
        moment = rest_time(osc, flight, expected, self.kind, number)
        self._fly(flight, moment.t)
        x = osc.position(flight, moment)
        gap = s * (osc.wall(s) - self.bound(x))
        if not gap > 0:
            reason = "the mass may reach the wall before its velocity vanishes"
            raise NotProved(f"event {number}", reason, {"distance": gap})
        force = self.bound(osc.forcing(moment))
        self._decide(side, force, expected, number)
        (a, b), (c, d) = self.monodromy
        zero: Any = ZERO
        if side:
            factor = osc.turning_factor(s, moment.cos)
            self.monodromy = (a, b), (factor * c, factor * d)
            self.flight = osc.launch(side, moment, x, zero)
        else:
            self.monodromy = (a, b), (zero, zero)
            self._rest(x, self.now)
        self.least = ZERO
        self.events.append(Event(expected.word, moment.t, zero, moment.cos))

    def _decide(self, side: int, force: Ball, expected: Expected, number: int) -> None:
        """Prove that a mass whose velocity vanishes turns to this side, or sticks (side 0)."""
        f = self.bound(self.osc.f)
        decided = side * force > f if side else abs(force) < f
        if not decided:
            reason = f"whether the mass turns or sticks is undecided: no certain {expected.word}"
            raise NotProved(f"event {number}", reason, {"F cos wt": force, "f": f})

    def _rest(self, x: E, since: Ball, wall: int = 0) -> None:
        self.flight, self.place, self.pending, self.wall = None, x, since, wall

    def _capture(self, side: int, expected: Expected, number: int) -> None:
        """Pass the capture at a wall by the lemma of `cap.flow.capture`; the mass has just hit
        it."""
        osc, last = self.osc, self.events[-1] if self.events else None
        wall = "r" if side > 0 else "l"
        if self.flight is None or last is None or last.word != f"hit {wall}":
            raise NotProved(f"event {number}", f"a capture must follow a hit {wall}")
        speed = osc.e * abs(self.bound(last.velocity))
        entry = capture.Entry(self.now, ZERO, speed, leaving=True)
        try:
            found = capture.accumulation(osc, side, entry, expected.window)
        except capture.TooEarly as miss:
            later = interval.hull(self.now, miss.until)
            raise NoCertainEvent(number, expected, later) from miss
        self._captured(side, found, expected)

    def _captured(self, side: int, found: capture.Accumulation, expected: Expected) -> None:
        zero: Any = ZERO
        self.monodromy = (zero, zero), (zero, zero)
        self.now, self.before, self.least = found.time, cast(E, found.time), ZERO
        self._rest(cast(E, self.osc.wall(side)), found.time, side)
        cos = cast(E, self.osc.moment(found.time).cos)
        self.events.append(Event(expected.word, cast(E, found.time), zero, cos))

    def _release(self, side: int, expected: Expected, number: int) -> None:
        if self.flight is not None:
            raise NotProved(f"event {number}", f"the mass moves: no {expected.word}")
        if self.wall == side:
            raise NotProved(f"event {number}", f"the wall is in the way: no {expected.word}")
        k = self._release_number(side, number)
        moment = cast("Moment[E]", self.osc.slow(side, k))
        self.flight = self.osc.launch(side, moment, self.place, cast(E, ZERO))
        self.now, self.before, self.released = self.bound(moment.t), moment.t, k
        self.events.append(Event(expected.word, moment.t, cast(E, ZERO), moment.cos))

    def _release_number(self, side: int, number: int) -> int:
        """Prove that the rest ends to this side; return the number of the slow moment when it does.

        In the interior it ends when |F cos ωt| reaches f; at the time since when the mass rests,
        |F cos ωt| < f, and sin ωt says where it is reached.  At a wall it ends when the forcing
        away from the wall reaches f.
        """
        osc, since = self.osc, self.pending
        sin = osc.moment(since).sin
        if not self.wall and not side * sin < 0:
            raise NotProved(f"event {number}", "the side of the release is another, or undecided")
        return next_slow(osc, side, since, self.bound)

    def finish(self, end: Moment[Ball]) -> Orbit[E]:
        """Prove that nothing more happens until the end; return all enclosures."""
        osc, flight = self.osc, self.flight
        if flight is None:
            self._rests_until(end)
            state = self.place, cast(E, ZERO)
        else:
            moment = cast("Moment[E]", end)
            state = osc.position(flight, moment), osc.velocity(flight, moment)
            x, v = state
            speed = flight.s * self.bound(v)
            if not speed > 0:
                raise NotProved("end", "the velocity may vanish before the end", {"v": speed})
            self.least = interval.least(self.least, speed)
            self._fly(flight, moment.t)
            if not osc.l < self.bound(x) < osc.r:
                reason = "the orbit may reach a wall once more before the end"
                raise NotProved("end", reason, {"x": self.bound(x)})
        return Orbit(self.s, tuple(self.events), state, self.monodromy, self.least)

    def _rests_until(self, end: Moment[Ball]) -> None:
        """Prove that the rest has begun and not ended: no slow moment to a free side is between."""
        osc, since = self.osc, self.pending
        if not since < end.t:
            sets = {"rest": since, "end": end.t}
            raise NotProved("end", "the mass may come to rest only after the end", sets)
        for side in (1, -1):
            for k in slow_numbers(osc, side, since, end.t, self.bound):
                t = self.bound(osc.slow(side, k).t)
                if side != self.wall and not (t < since or t > end.t):
                    raise NotProved("end", "the mass may be released before the end", {"at": t})


def _begin(orbit: PartialOrbit[E], start: State[E]) -> int:
    """Prove how the orbits begin; return the sign of the first flight, or 0 for a rest."""
    v = orbit.bound(start.v)
    if v > 0 or v < 0:
        s = 1 if v > 0 else -1
        if start.wall == s:
            raise NotProved("start", "the mass moves into the wall: begin with the velocity after")
        orbit.flight = orbit.osc.launch(s, start.at, start.x, start.v)
        return s
    if not v.is_zero():
        raise NotProved("start", "the velocity may vanish at the start", {"v": v})
    return _begin_at_rest(orbit, start)


def _begin_at_rest(orbit: PartialOrbit[E], start: State[E]) -> int:
    """The same for a velocity that is exactly zero: the forcing decides.

    A wall holds the mass, with the help of friction, while the force away from it is at most f.
    """
    osc, force = orbit.osc, orbit.osc.forcing(start.at)
    f = orbit.bound(osc.f)
    for side in (1, -1):
        if side * force > f and side != start.wall:
            orbit.flight = osc.launch(side, start.at, start.x, cast(E, ZERO))
            return side
    if not (start.wall * force > -f if start.wall else abs(force) < f):
        raise NotProved("start", "whether the mass moves at once is undecided", {"F cos wt": force})
    (a, b), _ = orbit.monodromy
    orbit.monodromy = (a, b), (ZERO, ZERO)
    return 0
