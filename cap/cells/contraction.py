"""Compiled, in doubles: backward orbits, and the direction in which they come together.

It steers; nothing rests on it.  They begin at sticks (`cap.cells.backward`), or in a strip
(`cap.cells.entries`).  With an orbit goes the derivative of its place and speed in q and in the
time of the stick, or the speed in the strip.
"""

import math
from typing import NamedTuple

from cap.cells.backward import System
from cap.cells.entries import Strip
from cap.cells.next_event import HIT, NOTHING, TURN, next_event, place_at, speed_at
from cap.cells.regions import Edge, Region
from cap.sets.compiled import kernel

EVENTS = 200
STEEPEST = 2.0
CLEAR = 3.0  # how much larger one singular value is, for its direction to be of use
STEPS = 3  # along an edge, to each side
DEEP = 12  # strobes after which directions do not change any more
INSIDE = 0.1  # of the distance of its neighbours an edge is away from them


class Orbit(NamedTuple):
    """The density at all strobes that count, the slope dq/dt that is contracted, and how much.

    ``flights``: up to the last strobe that counts.
    """

    density: float
    flights: int
    slope: float
    ratio: float


@kernel
def _contracted(f0: float, f1: float, g0: float, g1: float) -> tuple[float, float]:
    """Return the slope -sin/cos that a matrix with columns f, g contracts, and a ratio."""
    E, G, F = f0 * f0 + f1 * f1, g0 * g0 + g1 * g1, f0 * g0 + f1 * g1
    angle = 0.5 * math.atan2(2 * F, E - G)
    large = 0.5 * (E + G) + math.sqrt(0.25 * (E - G) * (E - G) + F * F)
    sine, det = math.sin(angle), abs(f0 * g1 - f1 * g0)
    slope = -math.cos(angle) / sine if abs(sine) > 1e-3 else 1e3
    return slope, large / max(det, 1e-300)


@kernel
def _inside(y: System, strip: Strip, p: float, s: float) -> bool:
    """Return whether a state is in a strip."""
    x, w = strip.edge - y.width - p, s - strip.slow
    both = x + strip.k * w
    held = strip.left < x < strip.right and strip.left < both < strip.right
    return held and abs(w) < strip.d


@kernel
def orbit(y: System, strip: Strip, q: float, z: float, V: float, strobes: int) -> Orbit:
    """Follow a stick at the time z back over so many strobes; or a state of a strip, of speed z.

    In a strip only every other strobe counts, until the orbit is in it.
    """
    a, p, seen, passed, entering = y.a, q, 0, 0, strip.d > 0
    s, t = (z, math.pi) if entering else (0.0, z)
    drive = -1.0 if entering else math.cos(t) + a
    f0, f1, g0, g1 = 0.0, -drive, 1.0, 0.0
    w, density, slope, ratio, flights = abs(drive), 0.0, 0.0, 1.0, 0
    for n in range(EVENTS):
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(a, y.theta, A, B, t, t)
        if kind == NOTHING:
            break
        j = math.floor(t / math.pi + 1e-12) + 1
        while j * math.pi < T and seen < strobes:
            d = j * math.pi - t
            speed, odd = speed_at(t + d, a, A, t), (j + passed) % 2 == 1
            seen, j = seen + 1, j + 1
            if odd and entering and _inside(y, strip, place_at(t + d, a, A, B, t), speed):
                seen = strobes
            elif speed < V and (odd or not entering):
                density, flights = density + w, n + 1
                slope, ratio = _contracted(f0 + f1 * d, f1, g0 + g1 * d, g1)
        if seen >= strobes:
            break
        d = T - t
        f0, g0 = f0 + f1 * d, g0 + g1 * d
        s, p = speed_at(T, a, A, t), place_at(T, a, A, B, t)
        before, after = math.cos(T) + a, a - math.cos(T)
        if kind == HIT:
            if s > V + 2:
                break
            f1, g1 = f1 + (after - before) * f0 / s, g1 + (after - before) * g0 / s
            p = -y.width
        else:
            f0, f1, g0, g1 = -f0, after * f1 / before, -g0, after * g1 / before
            w *= abs(after / before)
            p, s = -y.width - p, 0.0
        t = T + math.pi - TURN * math.floor((T + math.pi) / TURN + 0.5)
        passed += round((T - t) / math.pi)
    return Orbit(density, flights, slope, ratio)


@kernel
def value(edge: Edge, Y: float) -> float:
    """Return q on an edge."""
    return edge[0] + Y * (edge[1] + Y * edge[2])


@kernel
def hoped(
    y: System, strip: Strip, r: Region, V: float, strobes: int, points: int
) -> tuple[float, int]:
    """Return the area of the states from a region, nearly, and the flights that it takes."""
    area, flights = 0.0, 0
    for i in range(points):
        Y = (2.0 * i + 1.0) / points - 1.0
        low, high = value(r.low, Y), value(r.high, Y)
        for j in range(points):
            q = low + (high - low) * (j + 0.5) / points
            found = orbit(y, strip, q, r.middle + r.half * Y, V, strobes)
            area += found.density * (high - low)
            flights = max(flights, found.flights)
    return area * 2 * r.half / (points * points), flights


@kernel
def _slope(y: System, strip: Strip, q: float, t: float, V: float, strobes: int) -> float:
    """Return a slope of use."""
    inside = min(max(q, 1e-9 - y.width), -1e-9)
    found = orbit(y, strip, inside, t, V, min(strobes, DEEP))
    return min(max(found.slope, -STEEPEST), STEEPEST) if found.ratio > CLEAR else 0.0


@kernel
def _along(y: System, strip: Strip, r: Region, V: float, strobes: int, side: float) -> float:
    """Return where a contracted line from the middle of a region leaves it: the midpoint rule."""
    q = 0.5 * (r.low[0] + r.high[0])
    t, step = r.middle, side * r.half / STEPS
    for _ in range(STEPS):
        first = _slope(y, strip, q, t, V, strobes)
        q += step * _slope(y, strip, q + 0.5 * step * first, t + 0.5 * step, V, strobes)
        t += step
    return q


@kernel
def between(low: Edge, edge: Edge, high: Edge) -> bool:
    """Return whether an edge is well between two others."""
    for Y in (-1.0, -0.5, 0.5, 1.0):
        under, over = value(low, Y), value(high, Y)
        if not INSIDE < (value(edge, Y) - under) / (over - under) < 1 - INSIDE:
            return False
    return True


@kernel
def edge(y: System, strip: Strip, r: Region, V: float, strobes: int, curved: float) -> Edge:
    """Return an edge that cuts a region across X, along a contracted line if that fits."""
    e0, m1 = 0.5 * (r.low[0] + r.high[0]), 0.5 * (r.low[1] + r.high[1])
    m2 = 0.5 * (r.low[2] + r.high[2])
    left = _along(y, strip, r, V, strobes, -1.0)
    right = _along(y, strip, r, V, strobes, 1.0)
    most = curved * (r.high[0] - r.low[0])
    e2 = min(max(0.5 * (right + left) - e0, m2 - most), m2 + most)
    found = e0, 0.5 * (right - left), e2
    return found if between(r.low, found, r.high) else (e0, m1, m2)
