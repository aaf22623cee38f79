"""Compiled, in doubles: what becomes of an orbit up to its first release, in one number.

It steers; nothing rests on it.  Folded as in `cap.checker.folded`: units 1/ω and F/ω², the mass
moves to the right, the wall ahead is at p = 0, the other one at p = -W; after a hit and after a
turn the picture is mirrored and time shifted by π.

A *journey* is the number of a sequence of events, equal for neighbouring orbits with the same ones.
"""

import math

import numpy as np
from numpy.typing import NDArray

from cap.cells.next_event import HIT as HITS
from cap.cells.next_event import NOTHING, TURN, next_event, place_at, speed_at
from cap.sets.compiled import compiled, kernel

Floats = NDArray[np.float64]

OPEN = 0  # no journey: it is longer than asked for
HIT, BACK, ON, TURNED, CAUGHT, HELD = range(1, 7)
SLOW = 0.1  # speed of a hit for which a capture is looked for

ALPHA, WIDTH, MOST, LEFT, RIGHT, SPEED, FAR, DRIFT = range(8)
"""Entries of the array y: f/F, W, how many events, and the strip about the segment."""


@kernel
def _held(A: float, B: float, since: float, until: float, y: Floats) -> bool:
    """Return whether at a multiple of 2π the state is in the basin of the segment."""
    t = math.ceil(since / TURN - 1e-12) * TURN
    while t < until:
        w = speed_at(t, -y[ALPHA], A, since) - y[SPEED]
        x = place_at(t, -y[ALPHA], A, B, since) + y[WIDTH]
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
        kind, T = next_event(-a, theta, A, B, t, t)
        if kind == NOTHING:
            return OPEN
        if _held(A, B, t, T, y):
            return number * 7 + HELD
        if kind == HITS:
            s, p = max(0.0, speed_at(T, -a, A, t)), -W
            if _caught(T, s, a):
                return number * 7 + CAUGHT
            number = number * 7 + HIT
        else:
            phase = T % TURN
            if phase < math.pi - theta:
                return number * 7 + BACK
            if phase > math.pi + theta:
                return number * 7 + ON
            s, p = 0.0, -W - place_at(T, -a, A, B, t)
            number = number * 7 + TURNED
        t = (T + math.pi) % TURN
    return OPEN


@compiled
def journeys(x: Floats, y: Floats, found: NDArray[np.int64]) -> None:
    """Write the journeys of releases at these distances to the wall ahead."""
    for k in range(len(x)):
        found[k] = journey(x[k], y)
