"""Compiled, in doubles: where a launch hits the other wall, and how that depends on the launch.

It steers; nothing rests on it.  Units F = omega = 1; a launch (t, E) has the speed u, E = u²/2.
"""

import math

from cap.sets.compiled import kernel

TURN = 2 * math.pi


@kernel
def _place(t: float, u: float, f: float, T: float) -> float:
    d = T - t
    return u * d + math.cos(t) - math.cos(T) - d * math.sin(t) - 0.5 * f * d * d


@kernel
def _speed(t: float, u: float, f: float, T: float) -> float:
    return u + math.sin(T) - math.sin(t) - f * (T - t)


@kernel
def _reach(t: float, u: float, f: float, R: float, low: float, high: float) -> float:
    """Return when x = R, between two times at which x is below and above."""
    T = high
    for _ in range(100):
        x, v = _place(t, u, f, T), _speed(t, u, f, T)
        if x >= R:
            high = min(high, T)
        else:
            low = max(low, T)
        new = T - (x - R) / v if v > 0 else low
        if not (low < new < high):
            new = 0.5 * (low + high)
        if abs(new - T) < 1e-15 * max(1.0, abs(T)) or high - low < 1e-15:
            return new
        T = new
    return T


@kernel
def _halt(t: float, u: float, f: float, low: float, high: float) -> float:
    """Return when v = 0, between two times at which it is positive and not."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        if _speed(t, u, f, middle) > 0:
            low = middle
        else:
            high = middle
    return low


@kernel
def fly(t: float, u: float, f: float, R: float) -> tuple[float, float]:
    """Return the time and the speed of the hit; no speed if the flight stops."""
    rest = math.acos(f)
    k = math.floor((t + rest) / TURN)
    rising = t - k * TURN < rest
    T = t
    for _ in range(40):
        end = k * TURN + rest if rising else (k + 1) * TURN - rest
        if not rising and _speed(t, u, f, end) <= 0:
            end = _halt(t, u, f, T, end)
            if _place(t, u, f, end) < R:
                return end, 0.0
        if _place(t, u, f, end) >= R:
            T = _reach(t, u, f, R, T, end)
            return T, max(0.0, _speed(t, u, f, T))
        if not rising:
            k += 1
        rising = not rising
        T = end
    return T, 0.0


@kernel
def pulled(t: float, E: float, T: float, V: float, f: float, slope: float) -> float:
    """Return the slope dE/dt of the direction that a flight turns to one of a given slope."""
    u, d = math.sqrt(2 * E), T - t
    a, A = math.cos(t) - f, math.cos(T) - f
    tt, tu = (u + d * a) / V, -d / V
    vt, vu = A * tt - a, 1 + A * tu
    p, q, r, s = tt, tu / u, V * vt, V * vu / u
    return (r - p * slope) / (q * slope - s)
