"""Compiled, in doubles: backward orbits, and the direction in which they come together.

It steers; nothing rests on it.  They begin at stops (`cap.areas.folded.backward`).  With an orbit
goes the derivative of its place and speed in q and in the time of the stop.
"""

import math
from typing import NamedTuple

from cap.areas.folded.backward import Constants
from cap.areas.folded.next_event import HIT, NOTHING, TURN, next_event, speed_at
from cap.areas.folded.regions import Edge, Region
from cap.sets.compiled import kernel

EVENTS = 200
STEEPEST = 2.0
CLEAR = 3.0  # how much larger one singular value is, for its direction to be of use
DEEP = 12  # strobes after which directions do not change any more


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
def orbit(y: Constants, q: float, t: float, V: float, strobes: int) -> Orbit:
    """Follow a stop at the time t back to the one before, over so many strobes."""
    a, p, s, seen = y.a, q, 0.0, 0
    w = math.cos(t) + a
    f0, f1, g0, g1 = 0.0, -w, 1.0, 0.0
    density, slope, ratio, flights = 0.0, 0.0, 1.0, 0
    for n in range(EVENTS):
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(a, y.theta, A, B, t, t)
        if kind == NOTHING:
            break
        j = math.floor(t / math.pi + 1e-12) + 1
        while j * math.pi < T and seen < strobes:
            d = j * math.pi - t
            speed = speed_at(t + d, a, A, t)
            seen, j = seen + 1, j + 1
            if speed < V:
                density, flights = density + w, n + 1
                slope, ratio = _contracted(f0 + f1 * d, f1, g0 + g1 * d, g1)
        if seen >= strobes or kind != HIT:
            break
        d = T - t
        f0, g0 = f0 + f1 * d, g0 + g1 * d
        s, p = speed_at(T, a, A, t), -y.width
        if s > V + 2:
            break
        change = -2 * math.cos(T) / s
        f1, g1 = f1 + change * f0, g1 + change * g0
        t = T + math.pi - TURN * math.floor((T + math.pi) / TURN + 0.5)
    return Orbit(density, flights, slope, ratio)


@kernel
def value(edge: Edge, Y: float) -> float:
    """Return q on an edge."""
    return edge[0] + Y * (edge[1] + Y * edge[2])


@kernel
def hoped(y: Constants, r: Region, V: float, strobes: int, points: int) -> tuple[float, int]:
    """Return the area of the states from a region, nearly, and the flights that it takes."""
    area, flights = 0.0, 0
    for i in range(points):
        Y = (2.0 * i + 1.0) / points - 1.0
        low, high = value(r.low, Y), value(r.high, Y)
        for j in range(points):
            q = low + (high - low) * (j + 0.5) / points
            found = orbit(y, q, r.middle + r.half * Y, V, strobes)
            area += found.density * (high - low)
            flights = max(flights, found.flights)
    return area * 2 * r.half / (points * points), flights


@kernel
def contracted(y: Constants, q: float, t: float, V: float, strobes: int) -> float:
    """Return the slope dq/dt that is contracted, if it is of use."""
    inside = min(max(q, 1e-9 - y.width), -1e-9)
    found = orbit(y, inside, t, V, min(strobes, DEEP))
    return min(max(found.slope, -STEEPEST), STEEPEST) if found.ratio > CLEAR else 0.0
