"""Compiled, in doubles: what becomes of an orbit up to its first release, in one number.

It steers; nothing rests on it.  Folded as in `cap.checker.folded`: units 1/ω and F/ω², the mass
moves to the right, the wall ahead is at p = 0, the other one at p = -W; after a hit and after a
turn the picture is mirrored and time shifted by π.

A *journey* is the number of a sequence of events, equal for neighbouring orbits with the same ones.
"""

import math

import numpy as np
from numpy.typing import NDArray

from cap.sets.compiled import compiled, kernel

Floats = NDArray[np.float64]

TURN = 2 * math.pi
OPEN = 0  # no journey: it is longer than asked for
HIT, BACK, ON, TURNED, CAUGHT, HELD = range(1, 7)
SLOW = 0.1  # speed of a hit for which a capture is looked for
ARCS = 12  # of a flight

ALPHA, WIDTH, MOST, LEFT, RIGHT, SPEED, FAR, DRIFT = range(8)
"""Entries of the array y: f/F, W, how many events, and the strip about the segment."""


@kernel
def _speed(t: float, A: float, a: float, since: float) -> float:
    return math.sin(t) - a * (t - since) + A


@kernel
def _place(t: float, A: float, B: float, a: float, since: float) -> float:
    d = t - since
    return (A - 0.5 * a * d) * d + B - math.cos(t)


@kernel
def _stop(A: float, a: float, since: float, low: float, high: float) -> float:
    """Return when the speed vanishes: it falls from low to high, where it is not positive."""
    t = high
    for _ in range(60):
        s = _speed(t, A, a, since)
        if s > 0:
            low = t
        else:
            high = t
        slope = math.cos(t) - a
        new = t - s / slope if slope < 0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) < 1e-15 * max(1.0, abs(t)) or high - low < 1e-15:
            return new
        t = new
    return t


@kernel
def _arrival(A: float, B: float, a: float, since: float, low: float, high: float) -> float:
    """Return when the wall ahead is reached, between two times."""
    t = high
    for _ in range(60):
        p, s = _place(t, A, B, a, since), _speed(t, A, a, since)
        if p >= 0:
            high = t
        else:
            low = t
        new = t - p / s if s > 0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) < 1e-15 * max(1.0, abs(t)) or high - low < 1e-15:
            return new
        t = new
    return t


@kernel
def _next(A: float, B: float, a: float, since: float) -> tuple[bool, float]:
    """Return whether the next event is a hit, and when; or else a stop.  Never: the time is NaN."""
    theta = math.acos(a)
    k = math.floor((since + theta) / TURN)
    rising = since - k * TURN < theta
    low = since
    for _ in range(ARCS):
        end = k * TURN + theta if rising else (k + 1) * TURN - theta
        stops = not rising and _speed(end, A, a, since) <= 0
        if stops:
            end = _stop(A, a, since, low, end)
        if _place(end, A, B, a, since) >= 0:
            return True, _arrival(A, B, a, since, low, end)
        if stops:
            return False, end
        if not rising:
            k += 1
        rising = not rising
        low = end
    return False, math.nan


@kernel
def _held(A: float, B: float, since: float, until: float, y: Floats) -> bool:
    """Return whether at a multiple of 2π the state is in the basin of the segment."""
    t = math.ceil(since / TURN - 1e-12) * TURN
    while t < until:
        w = _speed(t, A, y[ALPHA], since) - y[SPEED]
        x = _place(t, A, B, y[ALPHA], since) + y[WIDTH]
        if abs(w) < y[FAR] and y[LEFT] < x < y[RIGHT] and y[LEFT] < x + y[DRIFT] * w < y[RIGHT]:
            return True
        t += TURN
    return False


@kernel
def _caught(t: float, speed: float, a: float) -> bool:
    """Return whether a capture follows a hit, nearly."""
    force = math.cos(t) - a
    phase = t - TURN * round(t / TURN)
    return speed < SLOW and force > 0 and phase + 4 * speed / force < math.acos(a)


@kernel
def journey(x: float, y: Floats) -> int:
    """Return the journey of a release at the distance x to the wall ahead."""
    a, W = y[ALPHA], y[WIDTH]
    theta = math.acos(a)
    p, s, t = -x, 0.0, -theta
    number = 1
    for _ in range(int(y[MOST])):
        A, B = s - math.sin(t), p + math.cos(t)
        hits, T = _next(A, B, a, t)
        if math.isnan(T):
            return OPEN
        if _held(A, B, t, T, y):
            return number * 7 + HELD
        if hits:
            s, p = max(0.0, _speed(T, A, a, t)), -W
            if _caught(T, s, a):
                return number * 7 + CAUGHT
            number = number * 7 + HIT
        else:
            phase = T % TURN
            if phase < math.pi - theta:
                return number * 7 + BACK
            if phase > math.pi + theta:
                return number * 7 + ON
            s, p = 0.0, -W - _place(T, A, B, a, t)
            number = number * 7 + TURNED
        t = (T + math.pi) % TURN
    return OPEN


@compiled
def journeys(x: Floats, y: Floats, found: NDArray[np.int64]) -> None:
    """Write the journeys of releases at these distances to the wall ahead."""
    for k in range(len(x)):
        found[k] = journey(x[k], y)
