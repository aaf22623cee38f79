"""Compiled: a region of stops followed backwards, and the areas of the states it comes from.

It is followed to the stop before, where the states have another first stop: so nothing is counted
from there on, nor at a strobe that may be there.

A region lies between two edges q = e_0 + e_1 Y + e_2 Y² over times t = middle + half Y; X goes from
one edge to the other.  See `cap.areas.folded.backward`.
"""

import math
from typing import NamedTuple

from cap.areas.folded.backward import (
    PI_ERROR,
    ROUND,
    Constants,
    Event,
    Flight,
    at,
    from_rest,
    hit,
    influence,
    moving,
    start,
    turn,
)
from cap.areas.folded.mirrored import after_hit
from cap.areas.folded.next_event import HIT, TURNS, next_event
from cap.areas.folded.polynomials import (
    LAST,
    UP,
    Model,
    between,
    ends,
    exact,
    integral,
    integral_below,
    moved,
    product,
    scaled,
    total,
    trigonometric,
    widened,
)
from cap.sets.compiled import kernel

Edge = tuple[float, float, float]

EDGE = 2.0**-44  # more than the errors of an edge in doubles: see `cap.areas.folded.trees`
TIME = 2.0**-48  # more than those of rounding of a time in an arc
LARGE = 1.0  # errors above which nothing more is certain
APART = 1e-12  # between a strobe and the start of a flight
NONE = 0.0, 0.0, 0.0


class Region(NamedTuple):
    """The stops between two edges over times."""

    low: Edge
    high: Edge
    middle: float
    half: float


class Limits(NamedTuple):
    """What counts, and how long: speeds below V, flights, and the range of A and B together."""

    V: float
    flights: int
    size: float


class Seen(NamedTuple):
    """What is seen of a region.

    ``area``: a lower bound of the area of the states at all strobes that count; ``weight``: an
    upper bound of what of it comes from sticks at places of measure 1; ``strobes``: how many count;
    ``flights``: up to the last of these; the ranges ``across`` and ``along`` at last: by X, and by
    Y alone.
    """

    area: float
    weight: float
    strobes: int
    flights: int
    across: float
    along: float


@kernel
def sides(r: Region) -> tuple[Model, Model]:
    """Return q, and half the distance of the edges."""
    (a0, a1, a2), (b0, b1, b2) = r.low, r.high
    c, c1, c2 = 0.5 * (a0 + b0), 0.5 * (a1 + b1), 0.5 * (a2 + b2)
    h, h1, h2 = 0.5 * (b0 - a0), 0.5 * (b1 - a1), 0.5 * (b2 - a2)
    middle, half = (c, c1, c2), (h, h1, h2)
    return between(middle, half, EDGE), between(half, NONE, EDGE)


@kernel
def launched(y: Constants, r: Region) -> tuple[Flight, Model, float]:
    """Return the flight from rest, its density in X and Y, and the least of half the width."""
    e, z = y.theta_error + TIME, 0.0
    d = between((z, r.half, z), NONE, e)
    cos, sin = trigonometric(moved(d, r.middle, z))
    q, wide = sides(r)
    A = from_rest(y, d, scaled(sin, -1.0, z))
    B = total(q, start(y, A, d, cos))
    density = scaled(product(moved(cos, y.a, y.a_error), wide), r.half, e)
    errors, far = (A[LAST], B[LAST]), r.half + 2 * e
    begun = r.middle - far, r.middle + far
    f = Flight(exact(A), exact(B), (1.0, 0.0, 0.0, 1.0), errors, errors, r.middle, begun, 1)
    return f, density, ends(wide)[0]


@kernel
def first(f: Flight) -> int:
    """Return the number of the first multiple of pi certainly after the start of a flight."""
    return math.floor((f.begun[1] + APART) / math.pi) + 1


@kernel
def passing(y: Constants, f: Flight, j: int) -> tuple[bool, Model, Model]:
    """Return whether all flights are certain to be under way at j pi, and p and s."""
    t = j * math.pi
    e = abs(j) * PI_ERROR + abs(t) * ROUND
    p, s = at(y, f, (t, e), -1.0 if j % 2 else 1.0, 0.0)
    s, p = widened(s, f.errors[0]), widened(p, influence(f, t - f.ref, e))
    flying = f.begun[1] < t - e and ends(s)[0] > 0 and ends(p)[1] < 0
    return flying and moving(y, f, t + e), p, s


@kernel
def spread(f: Flight) -> tuple[float, float]:
    """Return the ranges of A and B by X, and by Y alone: they steer."""
    across, along = 0.0, 0.0
    for p in (f.A, f.B):
        along += abs(p[1]) + abs(p[3]) + abs(p[6]) + abs(p[10])
        across += abs(p[2]) + abs(p[4]) + abs(p[5]) + abs(p[7]) + abs(p[8])
        across += abs(p[9]) + abs(p[11]) + abs(p[12]) + abs(p[13]) + abs(p[14])
    return across, along


@kernel
def known(f: Flight, size: float) -> bool:
    """Return whether enough is known of a flight to go on."""
    across, along = spread(f)
    return max(f.errors[0], f.errors[1]) <= LARGE and across + along <= size


@kernel
def underway(y: Constants, f: Flight, density: Model, V: float) -> tuple[float, int, int]:
    """Return the area slower than V at the strobes that all flights are certain to pass.

    And at how many there is some, and the next strobe.
    """
    area, count, j = 0.0, 0, first(f)
    while True:
        flying, _p, s = passing(y, f, j)
        if not flying:
            return area, count, j
        got = integral_below(density, s, V)
        area, count, j = area + got, count + (got > 0), j + 1


@kernel
def slow_at(y: Constants, f: Flight, density: Model, event: Event, j: int, V: float) -> float:
    """Return the area slower than V at j pi, where an event may be before.

    After it the speed grows by less than 1 + a a unit of time; that of the flight, continued, falls
    by less than 1 - a.
    """
    t = j * math.pi
    e = abs(j) * PI_ERROR + abs(t) * ROUND
    s = at(y, f, (t, e), -1.0 if j % 2 else 1.0, 0.0)[1]
    most = moved(s, 2 * max(0.0, t + APART - event.ends[0]) * UP, f.errors[0])
    return integral_below(density, most, V)


@kernel
def during(
    y: Constants, f: Flight, density: Model, event: Event, j: int, V: float
) -> tuple[float, int]:
    """Return the area slower than V at the strobes from j pi on that are not after a hit.

    And at how many there is some.  After a hit at T the speed falls by less than 1 - a a unit of
    time: no mass stops before a strobe at t if it hits with a speed above t - T.
    """
    area, count = 0.0, 0
    while j * math.pi <= event.ends[1] and j * math.pi + APART - event.ends[0] < event.least:
        got = slow_at(y, f, density, event, j, V)
        area, count, j = area + got, count + (got > 0), j + 1
    return area, count


@kernel
def next_of(y: Constants, f: Flight) -> tuple[int, Event]:
    """Return the kind of the next event, and the event."""
    begun = 0.5 * (f.begun[0] + f.begun[1])
    kind, near = next_event(y.a, y.theta, f.A[0], f.B[0], f.ref, begun)
    if kind == TURNS:
        return kind, turn(y, f, near)
    return kind, hit(y, f, near)


@kernel
def measure(y: Constants, r: Region) -> tuple[float, float]:
    """Return bounds of the measure of a region."""
    density = launched(y, r)[1]
    return max(0.0, integral(density)), -integral(scaled(density, -1.0, 0.0))


@kernel
def followed(y: Constants, r: Region, limits: Limits) -> Seen:
    """Follow a region backwards to the stop before, as long as it is certain what happens."""
    f, density, wide = launched(y, r)
    area, strobes, last = 0.0, 0, 0
    for n in range(limits.flights):
        if not known(f, limits.size):
            break
        got, count, j = underway(y, f, density, limits.V)
        kind, event = next_of(y, f)
        if event.why == 0 and kind == HIT:
            more, others = during(y, f, density, event, j, limits.V)
            got, count = got + more, count + others
        if got > 0 and wide > 0:
            area, strobes, last = area + got, strobes + count, n + 1
        if event.why != 0 or event.least > limits.V + 2 or kind == TURNS:
            break
        f = after_hit(y, f, event)
    across, along = spread(f)
    weight = 2 * strobes * ends(density)[1] / wide if strobes > 0 else 0.0
    return Seen(area / UP, weight * UP, strobes, last, across, along)
