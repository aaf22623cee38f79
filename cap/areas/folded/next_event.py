"""Compiled, in doubles: what comes next in a flight, and when.

It steers; nothing rests on it.  The flight is that of `cap.areas.folded.backward`, s' = cos t + a;
forwards in time a is negative, -f/F.  The speed falls from theta to -theta, modulo 2π.
"""

import math

from cap.flow.kernels import place, velocity
from cap.sets.compiled import kernel

NOTHING, HIT, TURNS = 0, 1, 2
TURN = 2 * math.pi
LONGEST, STEPS = 24, 60
CLOSE = 1e-10  # Newton's method squares it


@kernel
def speed_at(t: float, a: float, A: float, ref: float) -> float:
    """Return s."""
    s: float = velocity(A, t - ref, -a, math.sin(t))
    return s


@kernel
def place_at(t: float, a: float, A: float, B: float, ref: float) -> float:
    """Return p."""
    p: float = place(B, A, t - ref, -0.5 * a, math.cos(t))
    return p


@kernel
def _rest(a: float, A: float, ref: float, low: float, high: float) -> float:
    """Return when s = 0, between two times at which it is positive and not."""
    t = high
    for _ in range(STEPS):
        s, slope = speed_at(t, a, A, ref), math.cos(t) + a
        if s > 0:
            low = t
        else:
            high = t
        new = t - s / slope if slope < 0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) < CLOSE or high - low < CLOSE:
            return new
        t = new
    return t


@kernel
def _contact(a: float, A: float, B: float, ref: float, low: float, high: float) -> float:
    """Return when p = 0, between two times at which it is negative and not."""
    t = high
    for _ in range(STEPS):
        p, s = place_at(t, a, A, B, ref), speed_at(t, a, A, ref)
        if p >= 0:
            high = t
        else:
            low = t
        new = t - p / s if s > 0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) < CLOSE or high - low < CLOSE:
            return new
        t = new
    return t


@kernel
def next_event(
    a: float, theta: float, A: float, B: float, ref: float, begun: float
) -> tuple[int, float]:
    """Return whether a hit or a stop is next, and when."""
    k = math.floor((begun + theta) / TURN)
    rising, low = begun - k * TURN < theta, begun
    for _ in range(LONGEST):
        end = k * TURN + theta if rising else (k + 1) * TURN - theta
        stops = (not rising) and speed_at(end, a, A, ref) <= 0
        if stops:
            end = _rest(a, A, ref, low, end)
        if place_at(end, a, A, B, ref) >= 0:
            return HIT, _contact(a, A, B, ref, low, end)
        if stops:
            return TURNS, end
        if not rising:
            k += 1
        rising, low = not rising, end
    return NOTHING, math.nan
