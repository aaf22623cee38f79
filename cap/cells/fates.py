"""Compiled, in doubles: how long launches go on, and the strips in which they end alike.

It steers; nothing rests on it.  Units F = omega = 1; a launch (t, E) has the speed u, E = u²/2.
The *fate* of a launch: k >= 0 if after k flights it is above the ceiling E + a cos(t - b) = c,
-1 - k if it stops in its flight after k others, `LONG` if neither happens in n flights.
"""

import math

import numpy as np
from numpy.typing import NDArray

from cap.sets.compiled import kernel
from cap.sets.kept import kept

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

LONG = 10_000
CLOSE = 1e-10  # how near the ends of strips are found
TURN = 2 * math.pi
NODES = (-1.0, -0.5, 0.0, 0.5, 1.0)


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
def _fate(t: float, E: float, y: Floats) -> int:
    f, R, a, b, c, n = y[0], y[1], y[2], y[3], y[4], y[5]
    k = 0
    while True:
        if E + a * math.cos(t - b) > c:
            return k
        if k > n:
            return LONG
        T, V = fly(t, math.sqrt(2 * max(E, 0.0)), f, R)
        if V <= 0:
            return -1 - k
        t, E = (T + math.pi) % TURN, 0.5 * V * V
        k += 1


@kernel
def _contracted(t: float, E: float, flights: int, y: Floats) -> float:
    """Return the slope dE/dt of the direction that so many flights contract most."""
    f, R = y[0], y[1]
    p, q, r, s = 1.0, 0.0, 0.0, 1.0
    for _ in range(flights):
        u = math.sqrt(2 * E)
        T, V = fly(t, u, f, R)
        if V <= 0:
            break
        d, a, A = T - t, math.cos(t) - f, math.cos(T) - f
        tt, tu = (u + d * a) / V, -d / V
        vt, vu = A * tt - a, 1 + A * tu
        w, x, m, z = tt, tu / u, V * vt, V * vu / u
        p, q, r, s = w * p + x * r, w * q + x * s, m * p + z * r, m * q + z * s
        t, E = (T + math.pi) % TURN, 0.5 * V * V
    return -(p * q + r * s) / (q * q + s * s)


@kernel
def _end(t: float, E: float, fate: int, y: Floats, step: float, near: float) -> float:
    """Return where, from E in the direction of ``step``, the fate changes, up to ``near``."""
    low, high = E, E + step
    for _ in range(60):
        if high <= 0:
            high = 0.0
            break
        if _fate(t, high, y) != fate:
            break
        low, step = high, 1.7 * step
        high = low + step
        if abs(step) > 50:
            return low
    for _ in range(60):
        if abs(high - low) < near:
            break
        middle = 0.5 * (low + high)
        if middle > 0 and _fate(t, middle, y) == fate:
            low = middle
        else:
            high = middle
    return low


@kernel
def _followed(t: float, half: float, fate: int, y: Floats, ends: Floats) -> bool:
    """Find the ends of a strip at the `NODES`, from those in the middle, ``ends[2]``."""
    flights = fate if fate >= 0 else -1 - fate
    width = ends[2, 1] - ends[2, 0]
    for side in (-1, 1):
        low, high = ends[2, 0], ends[2, 1]
        at, step, node = 0.0, 0.5 * half, 1
        for _ in range(400):
            goal = 0.5 * half * node
            move = min(step, goal - at)
            E = 0.5 * (low + high)
            now, new = t + side * at, t + side * (at + move)
            slope = _contracted(now % TURN, E, flights, y)
            there = E + side * move * slope
            if there > 0 and _fate(new % TURN, there, y) == fate:
                slope = 0.5 * (slope + _contracted(new % TURN, there, flights, y))
                there = E + side * move * slope
            if not (there > 0 and _fate(new % TURN, there, y) == fate):
                step *= 0.5
                if step < 1e-7:
                    return False
                continue
            at += move
            arrived = at >= goal - 1e-15
            near = CLOSE if arrived else 0.02 * (high - low)
            part = 0.3 * (high - low)
            low, high = (
                _end(new % TURN, there, fate, y, -part, near),
                _end(new % TURN, there, fate, y, part, near),
            )
            if high - low < 0.02 * width:
                return False
            step *= 1.6
            if arrived:
                ends[2 + side * node, 0], ends[2 + side * node, 1] = low, high
                node += 1
                if node == 3:
                    break
        if node < 3:
            return False
    return True


def _column(t: float, half: float, y: Floats, grain: Floats, fates: Integers, ends: Floats) -> int:
    """Find the strips of the column |time - t| <= half: their fates, their ends at the nodes.

    ``y``: f, R, a, b, c, n.  ``grain``: energies are tried so far apart; strips thinner than the
    second are left out.  Returns their number.
    """
    step, thin = grain[0], grain[1]
    found, E, phase = 0, 0.5 * step, t % TURN
    top = y[4] - y[2] * math.cos(phase - y[3])
    while top > E and found < len(fates):
        fate = _fate(phase, E, y)
        if fate == LONG:
            E += step
            continue
        low = _end(phase, E, fate, y, -0.5 * step, CLOSE)
        high = _end(phase, E, fate, y, 0.5 * step, CLOSE)
        if high - low > thin:
            ends[found, 2, 0], ends[found, 2, 1] = low, high
            if _followed(t, half, fate, y, ends[found]):
                fates[found] = fate
                found += 1
        E = max(E, high) + step
    return found


column = kept(_column, error_model="numpy")
