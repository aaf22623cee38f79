"""Next releases from intervals of places, compiled: what `.paths` encloses, step by step.

An interval is followed only as long as the same happens to all its orbits.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.folded.backward import PI_ERROR, ROUND, Constants
from cap.areas.folded.basins import Basins, anything, compiled_basins, fate_of_lines
from cap.areas.folded.lines import Line
from cap.areas.folded.next_event import HIT, NOTHING, next_event, place_at, speed_at
from cap.areas.folded.paths import LOST, RELEASED, Path, Step, hit, lost, released, seen, stop
from cap.checker.folded import basins
from cap.checker.folded.table import NONE
from cap.flow.kernels import velocity
from cap.sets.circular import sin_cos_of_double
from cap.sets.compiled import PROBE, compiled, kernel, require_ieee, rounds_to_nearest

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

HELD = 3  # and the fate, besides `LOST` and `RELEASED`: all come to a basin before
EVENTS = 64
STROBES = 8  # multiples of pi of a flight
DEGREE = 6
STEEP = 2e-6  # of speeds at stops: for less, times may not be found without a bracket
_TIME, _SLOPE, _RATE, _COS, _SIN, ROWS = range(6)


@kernel
def _solved(y: Constants, f: Path, near: float, m: float, room: Floats, full: bool) -> Line:
    """Return a polynomial T with T(0) = near and F(T) = 0 nearly, F = p or s, and F' = m at 0.

    By s T' + A' (T - ref) + B' = 0, or (cos T - a) T' + A' = 0, power by power: it steers.
    """
    room[_SIN, 0], room[_COS, 0] = sin_cos_of_double(near)
    room[_TIME, 0], room[_RATE, 0] = near, m
    for k in range(DEGREE):
        past = (k + 1) * (f.B[k + 1] if full else f.A[k + 1])
        if full:
            past += (k + 1) * f.A[k + 1] * (near - f.ref)
            for j in range(k):
                past += (j + 1) * f.A[j + 1] * room[_TIME, k - j]
        for j in range(1, k + 1):
            past += room[_RATE, j] * room[_SLOPE, k - j]
        room[_SLOPE, k] = -past / m
        cos, sin = 0.0, 0.0
        for j in range(k + 1):
            cos -= room[_SLOPE, j] * room[_SIN, k - j]
            sin += room[_SLOPE, j] * room[_COS, k - j]
        cos, sin, time = cos / (k + 1), sin / (k + 1), room[_SLOPE, k] / (k + 1)
        room[_COS, k + 1], room[_SIN, k + 1], room[_TIME, k + 1] = cos, sin, time
        room[_RATE, k + 1] = velocity(f.A[k + 1], time, y.a, sin) if full else cos
    t = room[_TIME]
    return (t[0], t[1], t[2], t[3], t[4], t[5], t[6], 0.0)


@kernel
def _next(y: Constants, f: Path, room: Floats) -> Step:
    """Return what follows a flight, if it is certain."""
    begun = 0.5 * (f.begun[0] + f.begun[1])
    kind, t = next_event(-y.a, y.theta, f.A[0], f.B[0], f.ref, begun)
    if kind == NOTHING:
        return lost(f)
    if kind == HIT:
        s = speed_at(t, -y.a, f.A[0], f.ref)
        if not s > 0:
            return lost(f)
        t -= place_at(t, -y.a, f.A[0], f.B[0], f.ref) / s
        return hit(y, f, _solved(y, f, t, speed_at(t, -y.a, f.A[0], f.ref), room, True))
    m = math.cos(t) - y.a
    if not m < -STEEP:
        return lost(f)
    t -= speed_at(t, -y.a, f.A[0], f.ref) / m
    return stop(y, f, _solved(y, f, t, math.cos(t) - y.a, room, False))


@kernel
def _held(y: Constants, known: Basins, f: Path, until: float) -> int:
    """Return the fate of all orbits, if they are in a basin at a multiple of pi before a time."""
    for k in range(STROBES):
        t, e = math.pi * k, k * PI_ERROR + math.pi * k * ROUND
        if anything(known, k) and f.begun[1] < t - e and t + e < until:
            p, s = seen(y, f, (t, e), -1.0 if k % 2 else 1.0, 0.0)
            fate = fate_of_lines(known, k, p, s)
            if fate != NONE:
                return fate
    return NONE


@kernel
def next_release(
    y: Constants, known: Basins, low: float, high: float, room: Floats
) -> tuple[int, Line]:
    """Return what becomes of the releases from an interval of places, and the next place."""
    f = released(y, low, high)
    for _ in range(EVENTS):
        step = _next(y, f, room)
        if step.kind == LOST:
            break
        fate = _held(y, known, f, step.until)
        if fate != NONE:
            return HELD + fate, f.A
        if step.kind == RELEASED:
            return RELEASED, step.next
        f = step.path
    return LOST, f.A


class Found(NamedTuple):
    """`LOST`, `RELEASED`, or `HELD` and the fate (N,), and models of the next places (N, 8)."""

    kinds: Integers
    models: Floats


@compiled
def _releases(
    y: Constants, known: Basins, places: Floats, probe: Floats, room: Floats, found: Found
) -> bool:
    """Write what becomes of intervals; False if the processor does not round as it should."""
    if not rounds_to_nearest(probe):
        return False
    for n in range(len(places)):
        kind, after = next_release(y, known, places[n, 0], places[n, 1], room)
        found.kinds[n] = kind
        for i in range(DEGREE + 2):
            found.models[n, i] = after[i]
    return True


def next_releases(y: Constants, known: basins.Basins, places: Floats) -> Found:
    """Return what becomes of the releases from intervals (N, 2), up to the next ones.

    A model of `cap.areas.folded.lines` encloses the distance to the wall ahead at the next release,
    as a function of the place, -1 at the lower end of the interval, and 1 at the upper one.
    """
    found = Found(np.zeros(len(places), np.int64), np.zeros((len(places), DEGREE + 2)))
    room = np.zeros((ROWS, DEGREE + 1))
    require_ieee(_releases(y, compiled_basins(known), places, PROBE, room, found))
    return found
