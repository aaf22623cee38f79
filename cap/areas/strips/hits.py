"""Compiled, in doubles: where a launch hits the other wall, and how that depends on the launch.

It steers; nothing rests on it.  Units F = omega = 1; a launch (t, E) has the speed u, E = u²/2.
"""

import math
from typing import Any, NamedTuple

from cap.flow import kernels
from cap.sets.compiled import kernel

TURN = 2 * math.pi
NEAR = 1e-9  # steps of Newton's method at which the next one changes nothing
LEAST = 1e-15  # nor does it in an interval that is shorter


class _Launch(NamedTuple):
    """A launch: its time and the cosine of it, u - sin t, and the friction."""

    t: float
    cos: float
    rate: float
    f: float


@kernel
def velocity(u: Any, sin_t: Any, d: Any, sin: Any, f: float) -> Any:
    """Return v a time d after a launch with the speed u, at a moment with this sine."""
    return kernels.velocity(u - sin_t, d, f, sin)


@kernel
def _velocity(n: _Launch, d: float, sin: float) -> float:
    """Return v likewise; sin t is in the rate."""
    v: float = kernels.velocity(n.rate, d, n.f, sin)
    return v


@kernel
def _place(n: _Launch, d: float, cos: float) -> float:
    """Return x after a time d, at a moment with this cosine."""
    x: float = kernels.place(n.cos, n.rate, d, 0.5 * n.f, cos)
    return x


@kernel
def _reach(n: _Launch, R: float, low: float, high: float, near: float) -> tuple[float, float]:
    """Return when x = R, between two times at which x is below and above, and the speed."""
    T, v = near if low < near < high else high, 0.0
    for _ in range(100):
        d, sin, cos = T - n.t, math.sin(T), math.cos(T)
        x, v = _place(n, d, cos), _velocity(n, d, sin)
        if x >= R:
            high = min(high, T)
        else:
            low = max(low, T)
        step = (R - x) / v if v > 0 else math.inf
        if abs(step) < NEAR:
            return T + step, v + step * (cos - n.f)
        if high - low < LEAST:
            break
        T += step
        if not (low < T < high):
            T = 0.5 * (low + high)
    return T, v


@kernel
def _halt(n: _Launch, low: float, high: float) -> float:
    """Return when v = 0, between two times at which it is positive and not."""
    T = high
    for _ in range(100):
        v, push = _velocity(n, T - n.t, math.sin(T)), math.cos(T) - n.f
        if v > 0:
            low = max(low, T)
        else:
            high = min(high, T)
        step = -v / push if push < 0 else math.inf
        if abs(step) < NEAR:
            return T + step
        if high - low < LEAST:
            break
        T += step
        if not (low < T < high):
            T = 0.5 * (low + high)
    return T


@kernel
def fly(t: float, u: float, f: float, R: float, near: float = math.inf) -> tuple[float, float]:
    """Return the time and the speed of the hit; no speed if the flight stops.

    It is found sooner if it is ``near`` a time.
    """
    rest, height = math.acos(f), math.sqrt(1 - f * f)
    k = math.floor((t + rest) / TURN)
    rising = t - k * TURN < rest
    n, T = _Launch(t, math.cos(t), u - math.sin(t), f), t
    for _ in range(40):
        end = k * TURN + rest if rising else (k + 1) * TURN - rest
        d, cos = end - t, f
        stops = not rising and _velocity(n, d, -height) <= 0
        if stops:
            end = _halt(n, T, end)
            d, cos = end - t, math.cos(end)
        if _place(n, d, cos) >= R:
            T, v = _reach(n, R, T, end, near)
            return T, max(0.0, v)
        if stops:
            return end, 0.0
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
