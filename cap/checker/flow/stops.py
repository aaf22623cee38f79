"""Stops, turns, sticks and releases, each certified for all orbits from the box.

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

*The time of a stop* is a zero of v, with v' = F cos wt - s f - mu v.  That a turn goes on
to the side s where s F cos wt > f, and a rest ends where s F cos wt comes above f, is read from the
model (``one_mass``).
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from cap.checker.flow.hits import Zero, event_time, windowed
from cap.checker.flow.losses import Lossy
from cap.checker.flow.mechanics import Ends, Flight, Mechanics, Moment
from cap.checker.flow.one_mass import MODES
from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred
from cap.checker.kernel.rejection import need
from cap.checker.system.polynomial import variable

SIDES = {"r": 1, "right": 1, "l": -1, "left": -1}


class Rest(NamedTuple):
    """Rest at x from a time on, less than ``longest`` before motion to one of these sides."""

    x: Centred
    since: Interval
    longest: Interval
    sides: tuple[int, ...]


class Event(NamedTuple):
    """An event that is no hit: its moment, and the forcing F cos wt there.

    A capture has the interval from the beginning to the end of the hits, and the forcing over the
    window of the lemma.
    """

    word: str
    moment: Moment
    forcing: Interval


def rest_of(M: Lossy, s: int) -> Zero:
    """Return v and its Lie derivative on the flights of a direction; v is zero at a stop."""
    rate = M.laws.model.lie(MODES[s], variable("v"))
    return Zero(M.course(s)[1], M.along(s, rate), M.number(Fraction(0)))


def stop(M: Lossy, flight: Flight, word: str, window: Ends) -> tuple[Event, Centred]:
    """Prove that v vanishes in the window, strictly between the walls; return x there, too."""
    s = flight.s
    first, last = windowed(M, flight, window)
    need(M.least_speed(flight, first).is_positive(), "the velocity may vanish before a stop")
    need((-M.speed(flight, last).value).is_positive(), "the velocity may not vanish in a window")
    falling = M.f - span(M, window) * s
    need(falling.is_positive(), "the velocity may vanish more than once in a window")
    moment = M.moment(event_time(M, flight.arc, window, rest_of(M, s)))
    x = M.place(flight, moment)
    need(M.is_between_walls(x.value), "the mass may stop at or beyond a wall")
    return Event(word, moment, moment.cos.value * M.F), x


def span(M: Mechanics, window: Ends) -> Interval:
    """Return an enclosure of F cos wt over a window."""
    return M.at(Interval.enclosing(*window, M.bits)).cos.value * M.F


def turn(M: Lossy, flight: Flight, word: str, window: Ends) -> tuple[Event, Flight]:
    """Prove that the flight ends with a turn to this side; return it and the flight after it."""
    event, x = stop(M, flight, word, window)
    side = SIDES[word.split()[1]]
    need(side == -flight.s, "a turn to the side to which the mass moves")
    need((event.forcing * side - M.f).is_positive(), "the force may be too weak for a turn")
    v = M.constant(M.period.integer(0))
    return event, M.flight(side, event.moment, x, v)._replace(at_rest=True)


def stick(M: Lossy, flight: Flight, word: str, window: Ends) -> tuple[Event, Rest]:
    """Prove that the flight ends and the mass sticks; return the event and the rest after it."""
    event, x = stop(M, flight, word, window)
    held = (M.f - event.forcing.magnitude()).is_positive()
    need(held, "the force may be too strong for a stick")
    arc = (pi(M.bits) - arccos(M.f / M.F) * 2) / M.omega
    return event, Rest(x, event.moment.t.value, arc, (1, -1))


def release(M: Mechanics, rest: Rest, word: str, window: Ends) -> tuple[Event, Flight]:
    """Return the end of a rest, and the flight after it."""
    side = SIDES[word.split()[1]]
    need(side in rest.sides, "a release into the wall")
    moments = M.minima[side]
    waits = [m.t.value - rest.since for m in moments]
    ends = [n for n, w in enumerate(waits) if w.is_positive() and w.is_before(rest.longest)]
    need(len(ends) == 1, "no release to this side certainly follows")
    at, later = moments[ends[0]], moments[ends[0] + 1 :]
    need(at.t.value.lies_in(*window), "a release is not in its window")
    start = M.flight(side, at, rest.x, M.constant(M.period.integer(0)))
    start = start._replace(minima=later, at_rest=True)
    return Event(word, at, at.cos.value * M.F), start
