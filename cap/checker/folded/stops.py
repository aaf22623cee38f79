"""Areas of states at t = 0, found backwards from their first stops.

*Stops.*  A mass that stops does it at a place and a time where, backwards, it begins at rest:
folded, at the distance q <= 0 to the wall ahead, at a time with cos t > -a.  A state at t = 0 that
stops is given by its first stop and by how many multiples of pi, in the folded time, are passed
backwards from there to it (odd or even: the mass arrives from the left or from the right):
different states by different pairs, as a state has one orbit, so one first stop, and the number of
multiples of pi between them.  So the areas of these states, for any regions of stops that do not
overlap and all multiples of pi passed, add up, if none is counted twice for a region.  Backwards it
ends where the mass is at rest: a stop before.

*None is counted twice.*  The multiples of pi that are counted in a flight follow each other from
`first` on, the first one after the latest start of the flight.  The last of them are not after the
latest end of the flight, which is the latest start of the next one, where `first` is larger.  So
the numbers, which are counted from the stop on (``passed``), increase from flight to flight.

*Kinds of stops.*  If |t| < theta, cos t > a: the mass turns, and sets out from there, at the place
q and the time -t of the flow forwards.  If cos t < a, it sticks: late, in the arc (theta - pi,
-theta), its next release is in the direction of the flight, at the distance W + q to the wall
ahead; early, in the arc (theta, pi - theta), it is against that, at the distance -q.

*Regions* (`cap.checker.folded.regions`): z is from -1 to 1 over an arc, and the edges are those of
q.  All stops of an arc are the region between -W (or a little above) and 0.  The area of the states
at a multiple of pi is the integral of |s'| dq dt at the stops.

*What is counted.* At each multiple of pi that is passed in a flight, for certain before the next
event, the area of the states slower than V, from below.  The same at one, t, up to the end of the
next event, if that is a hit, whether it comes before t or not.  For states with the hit at T < t
the speed is then at most s(t) + 2 (t - T): it grows by less than 1 + a a unit of time, is the same
before and after the hit, and s(t), continued, falls by less than 1 - a.  So no mass stops between T
and t if the speed at T is more than t - T for all.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import count
from typing import NamedTuple

from cap.checker.folded.events import Event, after, event
from cap.checker.folded.flights import Flight
from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import TURN, UP, Pair
from cap.checker.folded.regions import CUT, UNIT, Region
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.parabolas import Edge
from cap.checker.kernel.polynomials import LAST, Model
from cap.checker.kernel.rejection import Rejected

PARTS = 16  # of Y, in which places are bounded
LATE, EARLY = -1, 1  # sticks, and the signs of their times
_ROUND = 8 * TURN  # more than the errors of times here


class Strobe(NamedTuple):
    """A multiple of pi, counted from the first flight on; it counts where ``excess`` < 0."""

    number: int
    excess: Model


class Start(NamedTuple):
    """A region as it begins: its flight, the density of |s'| dq dt, and a bound of |s'| |dt/dY|."""

    flight: Flight
    density: Model
    rate: float


def across(region: Region) -> tuple[Model, Model]:
    """Return models of the quantity that has the edges of a region, and of half its width."""
    unit = UNIT / 2
    both = list(zip(region.low, region.high, strict=True))
    a, b, c = (unit * (low + high) for low, high in both)
    A, B, C = (unit * (high - low) for low, high in both)
    error = 4 * TURN * sum(map(abs, (a, b, c, A, B, C)))
    place = q.model(error, one=a, Y=b, YY=c, X=A, XY=B, XYY=C)
    return place, q.model(error, one=A, Y=B, YY=C)


def along(region: Region) -> Pair:
    """Return the middle of z in a region, and half its length there: exact."""
    return (2 * region.j + 1) * 0.5**region.n - 1, 0.5**region.n


def spans(region: Region) -> Iterator[Pair]:
    """Give bounds of the edges over the `PARTS` of -1 <= Y <= 1."""
    half = 1 / PARTS
    for k in range(PARTS):
        Y = half * (2 * k + 1) - 1
        yield reach(region.low, Y, half)[0], reach(region.high, Y, half)[1]


def reach(edge: Edge, Y: float, half: float) -> Pair:
    """Return bounds of an edge within ``half`` of Y."""
    a, b, c = (UNIT * z for z in edge)
    value, far, bend = a + Y * (b + Y * c), abs(b + 2 * Y * c) * half, c * half * half
    more = 16 * TURN * (abs(a) + abs(b) + abs(c))
    return value - far + min(0.0, bend) - more, value + far + max(0.0, bend) + more


def all_stops(y: Direction) -> Region:
    """Return the region of all stops of an arc."""
    bottom = math.ceil(-(y.width[0] - y.width[1]) / UNIT / CUT) * CUT
    return Region((bottom, 0, 0), (0, 0, 0))


def sticks(y: Direction, side: int, region: Region) -> Start:
    """Return the flight backwards from `LATE` or `EARLY` sticks."""
    return at_rest(y, region, side * y.pi[0] / 2, y.pi[0] / 2 - y.rest[0])


def turns(y: Direction, region: Region) -> Start:
    """Return the flight from turns, backwards or forwards."""
    return at_rest(y, region, 0.0, math.copysign(y.rest[0], y.a))


def at_rest(y: Direction, region: Region, middle: float, half: float) -> Start:
    """Return the flight from rest at the times middle + half z, up to rounding."""
    place, wide = across(region)
    z, r = along(region)
    ref, r = middle + half * z, half * r
    d = q.model(_ROUND, Y=r)
    cos, sin = q.trigonometric(q.with_constant(d, ref))
    A = y.from_rest(d, q.scaled(sin, -1.0))
    B = q.total(place, y.start(A, d, cos))
    force = q.scaled(q.moved(cos, abs(y.a), y.a_error), abs(r), _ROUND)
    far = abs(r) + 2 * _ROUND
    errors = A[LAST], B[LAST]
    C, exact = (1.0, 0.0, 0.0, 1.0), (q.exact(A), q.exact(B))
    f = Flight((ref - far, ref + far), ref, *exact, C, errors, errors, 1, 0)
    return Start(f, q.product(force, wide), q.ends(force)[1])


def places_of(y: Direction, side: int, region: Region) -> list[Pair]:
    """Return bounds of the places of releases over the `PARTS`, as distances to the wall ahead."""
    W, e = y.width
    e += 4 * TURN * (W + 1)
    if side == EARLY:
        return [(-b - e, -a + e) for a, b in spans(region)]
    return [(W + a - e, W + b + e) for a, b in spans(region)]


def backwards(y: Direction, f: Flight, flights: int, V: float) -> Iterator[tuple[Flight, Strobe]]:
    """Give the multiples of pi that are passed in so many flights, each with its flight.

    There are fewer flights, if it is not certain what comes next, and none before a stop.
    """
    for _ in range(flights):
        flying = list(flown(y, f, V))
        yield from ((f, strobe) for strobe in flying)
        try:
            e = event(y, f)
            if e.p:
                return
            yield from ((f, strobe) for strobe in at_hit(y, f, e, len(flying), V))
            f = after(y, f, e)
        except Rejected:
            return


def flown(y: Direction, f: Flight, V: float) -> Iterator[Strobe]:
    """Give the multiples of pi that all orbits pass before anything happens."""
    for k in count(first(f)):
        t, error = y.multiple(k)
        try:
            y.moving(f, t + error)
        except Rejected:
            return
        p, s = y.states(f, t, error)
        if not (q.ends(s)[0] > 0 and q.ends(p)[1] < 0):
            return
        yield Strobe(k + f.passed, q.moved(s, -V, 0.0))


def at_hit(y: Direction, f: Flight, e: Event, flown: int, V: float) -> list[Strobe]:
    """Return the multiples of pi up to the end of the next hit, but for those ``flown``."""
    found, k = list[Strobe](), first(f) + flown
    while sum(y.multiple(k)) <= e.ends[1]:
        t, error = y.multiple(k)
        later = max(0.0, t + error - e.ends[0]) * UP
        if not later < q.ends(e.s)[0]:
            break
        excess = q.moved(y.at(f, t, error)[1], 2 * later - V, f.errors[0])
        found.append(Strobe(k + f.passed, excess))
        k += 1
    return found


def first(f: Flight) -> int:
    """Return the number of the first multiple of pi certainly after the start of a flight."""
    return math.ceil(f.begun[1] / math.pi + 1e-9)
