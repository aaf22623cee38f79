"""Areas of states at t = 0, found backwards from their first sticks.

*Sticks.*  A mass sticks at a place and a time with |cos t| < a.  Backwards it begins there at rest,
folded: at the distance q <= 0 to the wall ahead, in the arc (theta, pi - theta) or (theta - pi,
-theta) of times; its next release, forwards, is at the distance -q to the wall ahead in the first
arc, and W + q in the second.  A state at t = 0 that sticks is given by its first stick and by how
many multiples of pi, in the folded time, are passed backwards from there to it (odd or even: the
mass arrives from the left or from the right): different states by different pairs.  So the areas of
these states, for all regions of sticks and all multiples of pi passed, add up.

*Regions* (`cap.checker.folded.regions`): z is from -1 to 1 over an arc, and the edges are those of
q.  All sticks of an arc are the region between -W (or a little above) and 0.

*What is counted.* At each multiple of pi that is passed in a flight, for certain before the next
event, the integral of the density over where the speed is below V, from below.  The same at one, t,
up to the end of the next event, if that is certain, whatever comes after it; the density only
grows.  For states with the event at T < t the speed is then at most s(t) + 2 (t - T): it grows by
less than 1 + a a unit of time, is the same before and after a hit and 0 at a turn, and s(t),
continued, falls by less than 1 - a.  Subtracted is what lies over places without the fate in
question; for either fate, with none of both.  Let there be places of the measure m at most within
the bounds of the edges over one of `PARTS` equal parts of Y, and h half the width of the region:
the integral is at most the mean of 2 m sup(density)/inf(h).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import count
from typing import NamedTuple, Protocol

from cap.checker.folded.backward import Flight, System
from cap.checker.folded.events import BackEvent, after, event
from cap.checker.folded.numbers import TURN, UP, Pair
from cap.checker.folded.regions import CUT, UNIT, Leaf, Region
from cap.checker.folded.table import ATTRACTOR, EITHER, SEGMENT
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.parabolas import Edge
from cap.checker.kernel.polynomials import LAST, Model
from cap.checker.kernel.rejection import Rejected

PARTS = 16  # of Y, in which places are bounded
_ROUND = 8 * TURN  # more than the errors of times here

FATES = ATTRACTOR, SEGMENT, EITHER


class Strobe(NamedTuple):
    """A multiple of pi, counted from the first flight on; the speed is then at most ``most``.

    It is between ``speeds``.
    """

    number: int
    speeds: Pair
    most: Model


class Fates(Protocol):
    """What tells of places how many do not have a fate."""

    def missing(self, ends: Pair, fate: int) -> float:
        """Return a bound of the measure of the places between these without a fate."""


class Start(NamedTuple):
    """A region as it begins: its flight, and the least of half its width."""

    flight: Flight
    least: float


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


def begun(begin: Pair, ref: float, A: Model, B: Model, density: Model) -> Flight:
    """Return the first flight."""
    R = A[LAST], B[LAST]
    return Flight(begin, ref, q.exact(A), q.exact(B), (1.0, 0.0, 0.0, 1.0), R, R, 1, density, 0)


def all_sticks(y: System) -> Region:
    """Return the region of all sticks of an arc."""
    bottom = math.ceil(-(y.width[0] - y.width[1]) / UNIT / CUT) * CUT
    return Region((bottom, 0, 0), (0, 0, 0))


def sticks(y: System, region: Region, *, late: bool) -> Start:
    """Return the flight backwards from sticks, in the first arc or the second."""
    place, wide = across(region)
    z, r = along(region)
    half = y.pi[0] / 2 - y.theta[0]
    ref, r = (-y.pi[0] if late else y.pi[0]) / 2 + half * z, half * r
    d = q.model(_ROUND, Y=r)
    cos, sin = q.trigonometric(q.with_constant(d, ref))
    A = q.total(q.scaled(sin, -1.0), q.scaled(d, -y.a, y.a_error))
    B = q.total(place, y.start(A, d, cos))
    density = q.scaled(q.product(q.moved(cos, y.a, y.a_error), wide), r, _ROUND)
    ends = ref - r - 2 * _ROUND, ref + r + 2 * _ROUND
    return Start(begun(ends, ref, A, B, density), q.ends(wide)[0])


def places_of(y: System, region: Region, *, late: bool) -> list[Pair]:
    """Return bounds of the places of releases over the `PARTS`, as distances to the wall ahead."""
    W, e = y.width
    e += 4 * TURN * (W + 1)
    return [(W + a - e, W + b + e) if late else (-b, -a) for a, b in spans(region)]


class Areas(NamedTuple):
    """Areas, from below: for the attractor, the segment, either of them, and of all that stick."""

    attractor: float = 0.0
    segment: float = 0.0
    either: float = 0.0
    stops: float = 0.0


def areas(y: System, fates: Fates, V: float, task: tuple[Leaf, bool]) -> Areas:
    """Return the areas of the states at t = 0, slower than V, that come to a region of sticks."""
    leaf, late = task
    start, found = sticks(y, leaf.region, late=late), [0.0] * len(Areas._fields)
    places = places_of(y, leaf.region, late=late)
    missing = [*(without(fates, places, fate) for fate in FATES), 0.0]
    for density, strobes in backwards(y, start.flight, leaf.flights if start.least > 0 else 0):
        most = q.ends(density)[1]
        lost = [2 * m * most / start.least * UP if m else 0.0 for m in missing]
        for area in (q.integral_below(density, strobe.most, V) for strobe in strobes):
            for k, less in enumerate(lost):
                found[k] += max(0.0, (area - less) * (1 - TURN))
    return Areas(*(area * (1 - 64 * TURN) for area in found))


def without(fates: Fates, places: Sequence[Pair], fate: int) -> float:
    """Return the mean of the measures of places without a fate, or infinity if none is known."""
    low, high = min(low for low, _ in places), max(high for _, high in places)
    if fates.missing((low, high), fate) >= high - low:
        return math.inf
    return sum(fates.missing(part, fate) for part in places) / PARTS * UP


def backwards(y: System, f: Flight, flights: int) -> Iterator[tuple[Model, list[Strobe]]]:
    """Give the densities in so many flights, and the multiples of pi that are passed in each.

    There are fewer, if it is not certain what comes next.
    """
    for _ in range(flights):
        strobes, e = list(flown(y, f)), None
        try:
            e = event(y, f)
            strobes += at_event(y, f, e, len(strobes))
            yield f.density, strobes
            f = after(y, f, e)
        except Rejected:
            if e is None:
                yield f.density, strobes
            return


def flown(y: System, f: Flight) -> Iterator[Strobe]:
    """Give the multiples of pi that all orbits pass before anything happens."""
    for k in count(first(f)):
        t, error = multiple(y, k)
        try:
            y.moving(f, t + error)
        except Rejected:
            return
        p, s = y.at(f, t, error)
        s = q.widened(s, f.errors[0])
        speeds = q.ends(s)
        nearest = q.ends(q.widened(p, y.influence(f, t, error)))[1]
        if not (speeds[0] > 0 and nearest < 0):
            return
        yield Strobe(k + f.passed, speeds, s)


def at_event(y: System, f: Flight, e: BackEvent, flown: int) -> list[Strobe]:
    """Return the multiples of pi up to the end of the next event, but for those ``flown``."""
    found, (low, high), (least, most) = list[Strobe](), e.ends, e.speeds
    k = first(f) + flown
    while sum(multiple(y, k)) <= high:
        t, error = multiple(y, k)
        more, later = 2 * (high - min(t - error, low)) * UP, 2 * max(0.0, t + error - low) * UP
        s = q.moved(y.at(f, t, error)[1], later, f.errors[0])
        found.append(Strobe(k + f.passed, (least - more, most + more), s))
        k += 1
    return found


def first(f: Flight) -> int:
    """Return the number of the first multiple of pi certainly after the start of a flight."""
    return math.ceil(f.begun[1] / math.pi + 1e-9)


def multiple(y: System, k: int) -> Pair:
    """Return a multiple of pi, and a bound of its error."""
    return k * y.pi[0], abs(k) * (y.pi[1] + TURN)
