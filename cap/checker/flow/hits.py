"""Hits of a wall, each certified for all orbits from the box; and event times as jets.

*A hit.*  Let [a, b] contain the end of the last event and the end of the time window W of the hit,
a < W.  If s v > 0 after the start of the flight up to b, x is monotone there, and if moreover s (x
- wall) is negative at the beginning of W and positive at its end, then every orbit reaches the wall
exactly once in [a, b], inside W, with a speed that is not zero, and touches nothing before.

*Event times as jets.*  Let g come to a level along the flight, x to a wall or v to zero, and let g'
be its derivative in time.  Let t_0 be the event time at a point of the box and t_<k the jet of the
event time below degree k.  As g(t_<k + h) = g(t_<k) + g'(t_0) h + ... and g of the event time is
constant, the terms of degree k of the event time are -1/g'(t_0) times those of g(t_<k).  At first
t_0 is only known to lie in W: at the centre, the interval Newton operator mid - (g(mid) -
level)/g'(t) narrows it; over the box, the mean value form does.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from cap.checker.flow.mechanics import Ends, Flight, Formula, Mechanics, Moment
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, cos_sin_jet, lift, tightened
from cap.checker.kernel.rejection import need

HITS = {1: "hit r", -1: "hit l"}  # of the wall ahead


class Hit(NamedTuple):
    """A hit: its moment, the forcing F cos wt there, the speed before it, and its flight."""

    word: str
    moment: Moment
    forcing: Interval
    speed: Centred
    flight: Flight


def windowed(M: Mechanics, flight: Flight, window: Ends) -> tuple[Moment, Moment]:
    """Return the ends of a window, which must lie after the start of the flight and before T."""
    first, last = (M.at(M.number(t)) for t in window)
    start = flight.start.t.value
    need(start.is_before(first.t.value), "a window begins before the event before it")
    need(last.t.value.is_before(M.horizon), "a window ends after T")
    return first, last


def hit(M: Mechanics, flight: Flight, window: Ends) -> tuple[Hit, Flight]:
    """Prove that the flight ends with a hit in the window; return it and the flight after it."""
    s, wall = flight.s, M.walls[flight.s]
    first, last = windowed(M, flight, window)
    need(M.least_speed(flight, last).is_positive(), "the velocity may vanish before a hit")
    before, after = ((M.place(flight, m).value - wall) * s for m in (first, last))
    need((-before).is_positive(), "the wall may be reached before a window begins")
    need(after.is_positive(), "the wall may not be reached when a window ends")
    moment = M.moment(event_time(M, flight.arc, window, Zero(*M.course(s), wall)))
    speed = M.speed(flight, moment)
    v = lift(lambda u, e: u * e * -s, speed, M.e)
    found = Hit(HITS[s], moment, moment.cos.value * M.F, speed, flight)
    return found, M.flight(-s, moment, M.constant(wall), v)


# the event times as jets


class Zero(NamedTuple):
    """A function of a flight and a time, its derivative in t, and the level of it at an event."""

    value: Formula
    slope: Formula
    level: Interval


def event_time(M: Mechanics, arc: Sequence[Centred], window: Ends, zero: Zero) -> Centred:
    """Return the time of the zero whose existence in the window is proved."""
    whole = Interval.enclosing(*window, M.bits)
    point, coarse = [q.centre.truncated(0) for q in arc], [q.box.truncated(1) for q in arc]

    def newton(t: Interval) -> Interval:
        mid = t.midpoint()
        value = zero.value(point, instant(M, Jet(0, {point[0].origin: mid}))).constant - zero.level
        return t.intersection(mid - value / slope(M, point, t, zero))

    at_centre = implicit(M, [q.centre for q in arc], narrowed(newton, whole), zero)

    def mean_value(t: Interval) -> Interval:
        return tightened(implicit(M, coarse, t, zero), at_centre, M.offsets).constant

    over_box = implicit(M, [q.box for q in arc], narrowed(mean_value, whole), zero)
    return Centred(at_centre, over_box, M.offsets)


def narrowed(step: Callable[[Interval], Interval], t: Interval) -> Interval:
    """Return what is left of an enclosure after steps, each giving one in it, while they help."""
    while 10 * (smaller := step(t)).width < 9 * t.width:
        t = smaller
    return smaller


def instant(M: Mechanics, t: RealJet) -> Sequence[RealJet]:
    """Return t, cos wt, sin wt."""
    return t, *cos_sin_jet(t * M.omega)


def slope(M: Mechanics, arc: Sequence[RealJet], t: Interval, zero: Zero) -> Interval:
    """Return an enclosure of the derivative over t."""
    point = [q.truncated(0) for q in arc]
    return zero.slope(point, instant(M, Jet(0, {arc[0].origin: t}))).constant


def implicit(M: Mechanics, arc: Sequence[RealJet], t0: Interval, zero: Zero) -> RealJet:
    """Return the jet of the event time from an enclosure of its constant term."""
    order, steepness = arc[0].order, slope(M, arc, t0, zero)
    t = Jet(order, {arc[0].origin: t0})
    for k in range(1, order + 1):
        g = zero.value([q.truncated(k) for q in arc], instant(M, t.truncated(k))).coefficients
        t = t + Jet(order, {power: -c / steepness for power, c in g.items() if sum(power) == k})
    return t
