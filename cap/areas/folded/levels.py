"""Compiled, in doubles: orbits forwards from turns to the stick, and lines of one release.

It steers; nothing rests on it.  The flow is that of `cap.areas.folded.backward` with a < 0.
"""

import math

from cap.areas.folded.backward import Constants
from cap.areas.folded.contraction import STEEPEST
from cap.areas.folded.next_event import HIT, NOTHING, TURN, next_event, place_at, speed_at
from cap.sets.compiled import kernel

EVENTS, TURNS = 40, 6  # of an orbit; without a hit, of one that goes to the segment
SLOW = 0.02  # a hit with such a speed may be followed by a rest
FLAT = 1e-3  # a derivative in q that is so much smaller than that in t is none


@kernel
def level(y: Constants, q: float, t: float) -> float:
    """Return the slope dq/dt at which the place of the next stick does not change; 0 if unknown."""
    a, p, s, turns = y.a, min(max(q, 1e-9 - y.width), -1e-9), 0.0, 0
    f0, f1, g0, g1 = 0.0, -math.cos(t) - a, 1.0, 0.0
    for _ in range(EVENTS):
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(a, y.theta, A, B, t, t)
        if kind == NOTHING:
            break
        d, cos = T - t, math.cos(T)
        f0, g0 = f0 + f1 * d, g0 + g1 * d
        s, p = speed_at(T, a, A, t), place_at(T, a, A, B, t)
        if kind == HIT:
            if s < SLOW:
                break
            f1, g1, p, turns = f1 - 2 * cos * f0 / s, g1 - 2 * cos * g0 / s, -y.width, 0
        elif cos > a:
            slope = -f0 / g0 if abs(g0) > FLAT * abs(f0) else STEEPEST
            return min(max(slope, -STEEPEST), STEEPEST)
        else:
            turns += 1
            if turns >= TURNS:
                break
            back = (a - cos) / (a + cos)
            f0, f1, g0, g1, p, s = -f0, back * f1, -g0, back * g1, -y.width - p, 0.0
        t = T + math.pi - TURN * math.floor((T + math.pi) / TURN + 0.5)
    return 0.0
