"""Compiled: a region of sticks followed backwards, and the areas of the states it comes from.

A region lies between two edges q = e_0 + e_1 Y + e_2 Y² over times t = middle + half Y; X goes from
one edge to the other.  See `cap.cells.backward`.
"""

import math
from typing import NamedTuple

from cap.cells.backward import (
    PI_ERROR,
    ROUND,
    Event,
    Flight,
    System,
    at,
    gain,
    hit,
    influence,
    moving,
    start,
    turn,
)
from cap.cells.mirrored import after_hit, after_turn
from cap.cells.next_event import HIT, TURNS, next_event
from cap.cells.polynomials import (
    LAST,
    UP,
    Model,
    between,
    ends,
    exact,
    integral,
    moved,
    product,
    scaled,
    total,
    trigonometric,
    widened,
)
from cap.sets.compiled import kernel

Edge = tuple[float, float, float]

EDGE = 2.0**-44  # more than the errors of an edge in doubles: see `cap.cells.trees`
TIME = 2.0**-48  # more than those of rounding of a time in an arc
LARGE = 1.0  # errors above which nothing more is certain
APART = 1e-12  # between a strobe and the start of a flight
NONE = 0.0, 0.0, 0.0
ERRORS, SIZE, FAST = 9, 10, 11  # reasons besides those of events


class Region(NamedTuple):
    """The sticks between two edges over times."""

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
    upper bound of what of it comes from sticks at places of measure 1; ``flights``: up to the last
    strobe that counts; ``why`` it ended; the ranges ``across`` and ``along``: by X, and by Y alone.
    """

    area: float
    weight: float
    flights: int
    why: int
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
def launched(y: System, r: Region) -> tuple[Flight, Model, float]:
    """Return the flight from rest, its density in X and Y, and the least of half the width."""
    e, z = y.theta_error + TIME, 0.0
    d = between((z, r.half, z), NONE, e)
    cos, sin = trigonometric(moved(d, r.middle, z))
    q, wide = sides(r)
    A = total(scaled(sin, -1.0, z), scaled(d, -y.a, y.a_error))
    B = total(q, start(y, A, d, cos))
    density = scaled(product(moved(cos, y.a, y.a_error), wide), r.half, e)
    errors, far = (A[LAST], B[LAST]), r.half + 2 * e
    begun = r.middle - far, r.middle + far
    f = Flight(exact(A), exact(B), (1.0, 0.0, 0.0, 1.0), errors, errors, r.middle, begun, 1)
    return f, density, ends(wide)[0]


@kernel
def passes(y: System, f: Flight, j: int, V: float) -> int:
    """Return 1 or 2 if all flights are certain to be under way at j pi, and 2 if slower than V."""
    t = j * math.pi
    e = abs(j) * PI_ERROR + abs(t) * ROUND
    if not f.begun[1] < t - e:
        return 0
    p, s = at(y, f, (t, e), -1.0 if j % 2 else 1.0, 0.0)
    least, most = ends(widened(s, f.errors[0]))
    if not least > 0 or not moving(y, f, t + e):
        return 0
    if not ends(widened(p, influence(f, t - f.ref, e)))[1] < 0:
        return 0
    return 2 if most < V else 1


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
def underway(y: System, f: Flight, V: float) -> tuple[int, int]:
    """Return how many strobes that count all flights are certain to pass, and the next one."""
    count, j = 0, math.floor((f.begun[1] + APART) / math.pi) + 1
    while True:
        found = passes(y, f, j, V)
        if found == 0:
            return count, j
        count, j = count + found - 1, j + 1


@kernel
def during(event: Event, j: int, V: float) -> int:
    """Return how many strobes from j pi on count that are not after an event.

    s changes at a rate below 2.
    """
    count, t = 0, j * math.pi
    while t <= event.ends[1]:
        fastest = event.most + 2 * (event.ends[1] - min(t, event.ends[0]) + APART)
        if fastest * UP < V:
            count += 1
        j += 1
        t = j * math.pi
    return count


@kernel
def next_of(y: System, f: Flight) -> tuple[int, Event]:
    """Return the kind of the next event, and the event."""
    begun = 0.5 * (f.begun[0] + f.begun[1])
    kind, near = next_event(y.a, y.theta, f.A[0], f.B[0], f.ref, begun)
    if kind == TURNS:
        return kind, turn(y, f, near)
    return kind, hit(y, f, near)


@kernel
def followed(y: System, r: Region, limits: Limits) -> Seen:
    """Follow a region backwards as long as it is certain what happens."""
    f, density, wide = launched(y, r)
    area, weight, last, why = 0.0, 0.0, 0, 0
    for n in range(limits.flights):
        across, along = spread(f)
        if not max(f.errors[0], f.errors[1]) <= LARGE:
            why = ERRORS
            break
        if across + along > limits.size:
            why = SIZE
            break
        count, j = underway(y, f, limits.V)
        kind, event = next_of(y, f)
        why = event.why
        if why == 0:
            count += during(event, j, limits.V)
        got = count * integral(density)
        if got > 0 and wide > 0:
            area, weight = area + got, weight + 2 * count * ends(density)[1] / wide
            last = n + 1
        if why == 0 and event.least > limits.V + 2:
            why = FAST
        if why != 0:
            break
        if kind == HIT:
            f = after_hit(y, f, event)
        else:
            density = product(density, gain(y, event))
            f = after_turn(y, f, event)
    across, along = spread(f)
    return Seen(area / UP, weight * UP, last, why, across, along)
