"""Compiled: images of arcs to the second order, as `cap.checker.strips.arc` has them.

It steers: values at the middle of an arc are doubles, and taken for exact, with some room; what
holds over a whole arc are intervals of doubles.  So what holds here is accepted by the checker, as
a rule.  The formulas are derived in `cap.checker.strips.arc`.
"""

import math
from typing import Any, NamedTuple

from cap.areas.strips.hits import TURN, fly, velocity
from cap.sets.circular import sin_cos
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, is_finite, is_positive, lower, magnitude

ROOM = 1e-11  # conditions hold by so much at least
SLOW = 1e-4  # hits are faster than this


class Arc(NamedTuple):
    """The launches t + dt s, e + e1 s + e2 s² for s in [-1, 1]."""

    t: float
    dt: float
    e: float
    e1: float
    e2: float


class Image(NamedTuple):
    """Whether all launches of an arc hit; times and energies: value, slope, bend.

    ``times`` are all times of the hits, ``slopes`` all their slopes.
    """

    hits: bool
    T: float
    T1: float
    T2: Interval
    times: Interval
    slopes: Interval
    E: float
    E1: float
    E2: Interval


@kernel
def least(value: float, slope: float, bend: Interval) -> float:
    """Return a number below all values on an arc."""
    return value - abs(slope) + 0.5 * min(0.0, lower(bend))


@kernel
def part(arc: Arc, half: float, k: int) -> Arc:
    """Return one of 1/half equal parts of an arc."""
    s = -1 + half * (2 * k + 1)
    e, e1 = arc.e + s * (arc.e1 + s * arc.e2), arc.e1 + 2 * s * arc.e2
    return Arc(arc.t + s * arc.dt, half * arc.dt, e, half * e1, half * half * arc.e2)


@kernel
def _nowhere() -> Image:
    zero = Interval(0.0, 0.0)
    return Image(False, 0.0, 0.0, zero, zero, zero, 0.0, 0.0, zero)


@kernel
def _root(x: Interval) -> Interval:
    """Return the square roots of positive numbers: |sqrt(m + a) - sqrt m| <= |a|/sqrt m."""
    s = math.sqrt(x.mid)
    return Interval(s, x.rad / s + 1e-15 * s)


@kernel
def _falls(u: Any, d: Any, a: Any, dt: float, du: Any) -> Any:
    """Return how fast x at a fixed time falls along an arc, a time d after a launch at which v'=a.

    Divided by the velocity then, it is the slope of the times of a hit.
    """
    return (u + d * a) * dt - d * du


@kernel
def image(arc: Arc, f: float, R: float) -> Image:
    """Return the image of an arc."""
    t, dt, bend, reach = arc.t, arc.dt, 2 * arc.e2, abs(arc.e1) + abs(arc.e2)
    if not arc.e > reach:
        return _nowhere()
    u = math.sqrt(2 * arc.e)
    T, V = fly(t, u, f, R)
    if not SLOW < V:
        return _nowhere()
    ts, us = Interval(t, abs(dt)), _root(Interval(2 * arc.e, 2 * reach))
    du, dus = arc.e1 / u, Interval(arc.e1, abs(bend)) / us
    d2us = (bend - dus * dus) / us
    sin_t, cos_t = sin_cos(ts)
    a, A, d, aa = math.cos(t) - f, math.cos(T) - f, T - t, cos_t - f
    T1 = _falls(u, d, a, dt, du) / V
    V1 = du + A * T1 - a * dt
    bound, found, Ts, dTs, Vs, sin_T, cos_T = 1.2 * abs(T1) + ROOM, False, ts, ts, us, sin_t, cos_t
    for _ in range(4):
        Ts = Interval(T, bound)
        ds = Ts - ts
        sin_T, cos_T = sin_cos(Ts)
        Vs = velocity(us, sin_t, ds, sin_T, f)
        if not is_positive(Vs):
            return _nowhere()
        dTs = _falls(us, ds, aa, dt, dus) / Vs
        size = magnitude(dTs) + 1e-14
        if size <= bound:
            found = True
            break
        bound = 1.3 * size
    if not found or not _moves(arc, du - a * dt, d2us + sin_t * (dt * dt), f, T + bound):
        return _nowhere()
    AA, ds, d1 = cos_T - f, Ts - ts, dTs - dt
    dVs = dus + AA * dTs - aa * dt
    a1, A1 = sin_t * -dt, -(sin_T * dTs)
    dN = (dus + d1 * aa + ds * a1) * dt - d1 * dus - ds * d2us
    T2 = (dN - dVs * dTs) / Vs
    V2 = d2us + AA * T2 + A1 * dTs - a1 * dt
    E2 = dVs * dVs + Vs * V2
    finite = is_finite(T2) and is_finite(E2)
    return Image(finite, T, T1, T2, Ts, dTs, 0.5 * V * V, V * V1, E2)


@kernel
def _moves(arc: Arc, slope: float, bend: Interval, f: float, until: float) -> bool:
    """Return whether v > 0 at all its local minima."""
    rest, t = math.acos(f), arc.t
    first = math.ceil((t - abs(arc.dt) + rest - 1e-9) / TURN)
    last = math.floor((until + rest + 1e-9) / TURN)
    for k in range(first, last + 1):
        T = TURN * k - rest
        v = velocity(math.sqrt(2 * arc.e), math.sin(t), T - t, math.sin(T), f)
        if least(v, slope, bend) <= ROOM:
            return False
    return True
