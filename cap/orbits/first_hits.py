"""The first hits of a wall, from a box of states: each in a window of times, in balls.

A window is looked for around the hit of the motion from the middle of the box; that all motions of
the box have their next hit in it, and nothing else before, is proved by Lemma B
(`cap.orbits.pieces`).  Flights are those of the one mode in which h falls and rises.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from cap.errors import NotProved
from cap.orbits.along import Along, End, Leg
from cap.orbits.capture import Entry, Start, Window, clock, value
from cap.orbits.leg import Kinds
from cap.orbits.numbers import Balls
from cap.orbits.pieces import cuts_of
from cap.orbits.wall import Wall
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.polynomial import variable

STEPS, PERIODS = 128, 2  # in a period of the clock, in which a hit is looked for; so long
PLACES, WIDEST = 12, Fraction(1, 2)  # decimals of a window; how far from its middle it may go
WIDER = Fraction(3, 2)  # for the checker, whose formulas are others
HALVINGS = 40


class Place(NamedTuple):
    """A wall, with the functions of its flights."""

    wall: Wall
    kinds: Kinds
    balls: Balls

    @classmethod
    def of(cls, wall: Wall) -> Place:
        """Return it."""
        return cls(wall, Kinds(wall.system), Balls(wall.system))


def hits(place: Place, start: Start) -> Iterator[tuple[Window, Entry]]:
    """Give the windows of the hits, one after the other, with how the motions begin at them."""
    wall = place.wall
    if wall.rising != wall.falling or wall.system.guard(wall.falling, wall.guard).to != (
        wall.falling,
    ):
        raise NotProved("hits", "hits are followed in one mode alone")
    t = interval.ball(start.time)
    sides = [interval.hull(*map(interval.ball, start.box[z])) for z in wall.system.state]
    begin, hit = End(t, place.balls.clock(t), sides), False
    while True:
        window, entry = _next(place, begin, 1 if hit else 0)
        yield window, entry
        begin, hit = _after(place, window, entry), True


def _next(place: Place, begin: End, vanishing: int) -> tuple[Window, Entry]:
    """Return the window of the next hit; so many of h, h' are zero at the beginning."""
    window = _window(place, begin)
    wall, (first, last) = place.wall, map(interval.ball, window)
    time = interval.hull(first, last)
    end = End(time, place.balls.clock(time), [])
    leg = Leg(0, begin, end, place.balls)
    h = Along(leg, wall.guard, place.kinds.watch(wall.falling, wall.guard), vanishing, last=True)
    rate = h.line(time)[1]
    if not (rate < 0 and h.height(first) > 0 > h.height(last)):
        raise NotProved("hits", "a hit is not certain to be in its window", {"window": time})
    known = {z: _along(place, begin, time, z) for z in wall.system.state}
    end = end._replace(state=list(known.values()))
    for name in wall.system.modes[wall.falling].guards:
        watch = place.kinds.watch(wall.falling, name)
        own = name == wall.guard
        along = Along(leg._replace(end=end), name, watch, vanishing if own else 0, last=own)
        cuts_of(along, place.kinds.longest(wall.falling))
    others = {z: interval.ends(known[z]) for z in wall.others}
    return window, Entry(window, None, rate, others)


def _window(place: Place, begin: End) -> Window:
    """Return a window around the hit of the motion from the middle, wide enough for all of them."""
    wall, middle = place.wall, interval.point(begin.time)
    state = [interval.point(z) for z in begin.state]
    point = End(middle, place.balls.clock(middle), state)
    watch = place.kinds.watch(wall.falling, wall.guard)
    of = [
        Along(Leg(0, at, at, place.balls), wall.guard, watch, 0, last=True) for at in (point, begin)
    ]
    step = interval.midpoint(place.balls.period) / STEPS
    start = interval.midpoint(middle)
    low, high = start, start + step
    while not of[0].height(interval.ball(high)) < 0:
        low, high = high, high + step
        if high > start + PERIODS * STEPS * step:
            raise NotProved("hits", "no hit is found", {"from": middle})
    for _ in range(HALVINGS):
        m = (low + high) / 2
        low, high = (low, m) if of[0].height(interval.ball(m)) < 0 else (m, high)
    t, ends = round(high, PLACES), []
    for sign in (-1, 1):
        far = Fraction(1, 10**8)
        while not sign * of[1].height(interval.ball(t + sign * far)) < 0:
            far *= Fraction(5, 4)
            if far > WIDEST:
                raise NotProved("hits", "the box is too large to follow", {"hit near": middle})
        ends.append(round(t + sign * far * WIDER, PLACES))
    return ends[0], ends[1]


def _along(place: Place, begin: End, time: Ball, z: str) -> Ball:
    """Return a variable of the state at all times in a ball."""
    wall = place.wall
    motion, of = place.kinds.motion(wall.falling), place.balls
    function = place.kinds.state(wall.falling)
    d = time - begin.time
    inputs = [*begin.clock, *begin.state, d, *of.clock(time)]
    inputs += of.exponential(motion, d) if motion.generator else []
    found: Ball = of.of(function)(*inputs)[wall.system.state.index(z)]
    return found


def _after(place: Place, window: Window, entry: Entry) -> End:
    """Return where the motions are after a hit."""
    wall, (a, b) = place.wall, map(interval.ball, window)
    time = interval.hull(a, b)
    others = {z: interval.hull(*map(interval.ball, ends)) for z, ends in entry.others.items()}
    known = {"(h)": Ball(0), "(h')": -interval.ball(wall.e) * entry.rate, **others}
    known |= clock(wall.system, time)
    state = [value(wall.solved.get(z, variable(z)), known) for z in wall.system.state]
    return End(time, place.balls.clock(time), state)
