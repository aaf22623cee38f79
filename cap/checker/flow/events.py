"""The events of an orbit, each certified for all orbits from the box.

*A hit.*  Let [a, b] contain the end of the last event and the end of the time window W of the hit,
a < W.  If s v > 0 after the start of the flight up to b, x is monotone there, and if moreover s (x
- wall) is negative at the beginning of W and positive at its end, then every orbit reaches the wall
exactly once in [a, b], inside W, with a speed that is not zero, and touches nothing before.

*A stop* (a turn or the beginning of a stick).  If s v > 0 after the start of the flight up to the
beginning of W, p = e^(mu t) s v decreases on W, that is s F cos wt < f there, and s v < 0 at the
end of W, then v has exactly one zero up to the end of W, inside W, and v' = F cos wt - s f is not
zero there.  Until then x is monotone.  The flight begins between the walls, or at one of them away
from it; so if x lies strictly between the walls at the stop, no wall is met before.  With a = F cos
wt at the stop, motion goes on to the right if a > f, to the left if a < -f (a turn: s a < f
excludes the direction s), and the mass sticks if |a| < f.

*A release after a stick.*  |a| < f holds on arcs of length (pi - 2 theta)/w of time, theta =
arccos(f/F), that end with a = -f decreasing or a = f increasing: at a time at which p has a minimum
for s = -1 or s = 1, to which side the motion begins.  So if such a time comes certainly after the
stop, and less than the length of an arc later, it is the end of the arc of the stop.

*A release after a capture*, at the right wall say, a > f at the time t_d: the mass rests at the
wall until a = -f, for the first time after t_d, where a decreases: a time of a minimum of p for s =
-1, which recur with the period.  The mirror image holds at the left wall.

*Event times as jets.*  Let g(t) = x(t) - wall for a hit, v(t) for a stop; g' = v, or g' = F cos wt
- s f - mu v.  Let t_0 be the event time at a point of the box and t_<k the jet of the event time
below degree k.  As g(t_<k + h) = g(t_<k) + g'(t_0) h + ... and g of the event time is zero, the
terms of degree k of the event time are -1/g'(t_0) times those of g(t_<k).  At first t_0 is only
known to lie in W: at the centre, the interval Newton operator mid - g(mid)/g'(t) narrows it; over
the box, the mean value form does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.flow.mechanics import Ends, Flight, Mechanics, Moment
from cap.checker.kernel.elementary import arccos, cos_sin, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, cos_sin_jet, lift, tightened
from cap.checker.kernel.rejection import Rejected, need


class Event(NamedTuple):
    """An event: its moment, the forcing F cos wt there, before a hit the speed, and its flight.

    A capture has the interval from the beginning to the end of the hits, and the forcing over the
    window of the lemma.
    """

    word: str
    moment: Moment
    forcing: Interval
    speed: Centred | None = None
    flight: Flight | None = None

    @property
    def hit_speed(self) -> Interval:
        """The speed before a hit."""
        if self.speed is None:
            raise Rejected("an event is not a hit")
        return self.speed.value


class Rest(NamedTuple):
    """Rest at x from a time on, less than ``longest`` before motion to one of these sides."""

    x: Centred
    since: Interval
    longest: Interval
    sides: tuple[int, ...]


def windowed(M: Mechanics, flight: Flight, window: Ends) -> tuple[Moment, Moment]:
    """Return the ends of a window, which must lie after the start of the flight and before T."""
    first, last = (M.moment(M.constant(M.number(t))) for t in window)
    start = flight.start.t.value
    need(start.is_before(first.t.value), "a window begins before the event before it")
    need(last.t.value.is_before(M.horizon), "a window ends after T")
    return first, last


def hit(M: Mechanics, flight: Flight, side: int, window: Ends) -> tuple[Event, Flight]:
    """Prove that the flight ends with a hit in the window; return it and the flight after it."""
    s, wall = flight.s, M.walls[flight.s]
    need(side == s, "a hit of the wall from which the mass moves away")
    first, last = windowed(M, flight, window)
    need(M.least_speed(flight, last).is_positive(), "the velocity may vanish before a hit")
    before, after = ((M.place(flight, m).value - wall) * s for m in (first, last))
    need((-before).is_positive(), "the wall may be reached before a window begins")
    need(after.is_positive(), "the wall may not be reached when a window ends")
    moment = M.moment(event_time(M, flight, window, wall))
    speed = M.speed(flight, moment)
    v = lift(lambda u, e: u * e * -s, speed, M.e)
    event = Event(f"hit {'r' if s > 0 else 'l'}", moment, moment.cos.value * M.F, speed, flight)
    return event, M.flight(-s, moment, M.constant(wall), v, M.minima[-s])


def stop(M: Mechanics, flight: Flight, word: str, window: Ends) -> tuple[Event, Centred]:
    """Prove that v vanishes in the window, strictly between the walls; return x there, too."""
    s = flight.s
    first, last = windowed(M, flight, window)
    need(M.least_speed(flight, first).is_positive(), "the velocity may vanish before a stop")
    need((-M.speed(flight, last).value).is_positive(), "the velocity may not vanish in a window")
    falling = M.f - span(M, window) * s
    need(falling.is_positive(), "the velocity may vanish more than once in a window")
    moment = M.moment(event_time(M, flight, window, None))
    x = M.place(flight, moment)
    need(M.is_between_walls(x.value), "the mass may stop at or beyond a wall")
    return Event(word, moment, moment.cos.value * M.F, None, flight), x


def span(M: Mechanics, window: Ends) -> Interval:
    """Return an enclosure of F cos wt over a window."""
    return M.moment(M.constant(Interval.enclosing(*window, M.bits))).cos.value * M.F


def turn(M: Mechanics, flight: Flight, side: int, word: str, window: Ends) -> tuple[Event, Flight]:
    """Prove that the flight ends with a turn to this side; return it and the flight after it."""
    event, x = stop(M, flight, word, window)
    need(side == -flight.s, "a turn to the side to which the mass moves")
    need((event.forcing * side - M.f).is_positive(), "the force may be too weak for a turn")
    v = M.constant(M.period.integer(0))
    return event, M.flight(side, event.moment, x, v, M.minima[side], at_rest=True)


def stick(M: Mechanics, flight: Flight, word: str, window: Ends) -> tuple[Event, Rest]:
    """Prove that the flight ends and the mass sticks; return the event and the rest after it."""
    event, x = stop(M, flight, word, window)
    held = (M.f - event.forcing.magnitude()).is_positive()
    need(held, "the force may be too strong for a stick")
    arc = (pi(M.bits) - arccos(M.f / M.F) * 2) / M.omega
    return event, Rest(x, event.moment.t.value, arc, (1, -1))


def release(M: Mechanics, rest: Rest, side: int, word: str, window: Ends) -> tuple[Event, Flight]:
    """Return the end of a rest, and the flight after it."""
    need(side in rest.sides, "a release into the wall")
    moments = M.minima[side]
    waits = [m.t.value - rest.since for m in moments]
    ends = [n for n, w in enumerate(waits) if w.is_positive() and w.is_before(rest.longest)]
    need(len(ends) == 1, "no release to this side certainly follows")
    at, later = moments[ends[0]], moments[ends[0] + 1 :]
    need(at.t.value.lies_in(*window), "a release is not in its window")
    start = M.flight(side, at, rest.x, M.constant(M.period.integer(0)), later, at_rest=True)
    return Event(word, at, at.cos.value * M.F), start


# the event times as jets


def event_time(M: Mechanics, flight: Flight, window: Ends, wall: Interval | None) -> Centred:
    """Return the time of the event whose existence in the window is proved: a hit, or a stop."""
    arc = M.arc(flight)
    centre, box = [q.centre for q in arc], [q.box for q in arc]
    coarse_box = [q.truncated(1) for q in box]
    t0 = Interval.enclosing(*window, M.bits)
    at_centre = implicit(M, flight.s, centre, root(M, flight.s, centre, t0, wall), wall)
    while True:
        coarse = implicit(M, flight.s, coarse_box, t0, wall)
        narrowed = tightened(coarse, at_centre, M.offsets).constant
        if 10 * narrowed.width >= 9 * t0.width:
            whole = implicit(M, flight.s, box, narrowed, wall)
            return Centred(at_centre, whole, M.offsets)
        t0 = narrowed


def gap(M: Mechanics, arc: Sequence[RealJet], t: RealJet, wall: Interval | None) -> RealJet:
    """Return x(t) - wall, or v(t) if there is no wall, on a flight."""
    when = t, *cos_sin_jet(t * M.omega)
    if wall is None:
        return M.velocity(arc, when)
    return M.position(arc, when) - Jet(t.order, {t.origin: wall})


def slope_of_gap(
    M: Mechanics, s: int, arc: Sequence[RealJet], t: Interval, wall: Interval | None
) -> Interval:
    """Return an enclosure of the derivative of x(t) - wall, or of v(t), over t."""
    point = [q.truncated(0) for q in arc]
    v = gap(M, point, Jet(0, {arc[0].origin: t}), None).constant
    if wall is not None:
        return v
    return cos_sin(t * M.omega)[0] * M.F - M.f * s - v * arc[4].constant


def root(
    M: Mechanics, s: int, arc: Sequence[RealJet], t: Interval, wall: Interval | None
) -> Interval:
    """Return an enclosure of the event time of the orbit of m, which lies in t."""
    point = [q.truncated(0) for q in arc]
    while True:
        mid = t.midpoint()
        value = gap(M, point, Jet(0, {arc[0].origin: mid}), wall).constant
        narrowed = t.intersection(mid - value / slope_of_gap(M, s, point, t, wall))
        if 2 * narrowed.width >= t.width:
            return narrowed
        t = narrowed


def implicit(
    M: Mechanics, s: int, arc: Sequence[RealJet], t0: Interval, wall: Interval | None
) -> RealJet:
    """Return the jet of the event time from an enclosure of its constant term."""
    order, slope = arc[0].order, slope_of_gap(M, s, arc, t0, wall)
    t = Jet(order, {arc[0].origin: t0})
    for k in range(1, order + 1):
        g = gap(M, arc, t.truncated(k), wall).coefficients
        t = t + Jet(order, {power: -c / slope for power, c in g.items() if sum(power) == k})
    return t
