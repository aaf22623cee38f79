"""Motions of a ball on a table that go from one speed to another: no invariant curve between.

Units and letters as in ``cap.checker.tori.bouncing``: from the impact at t, with the speed v after
it, to the next one, at t + s, where s > 0 is the only zero of

    h(s) = a sin t + (v + a cos t) s - s^2/2 - a sin(t + s)

beside 0, and h > 0 before it, h < 0 after it.  So p < s if h(p) > 0 < p; and s <= q = m -
h(m)/h'(m) if h'(m) < 0, as h is concave.

*What a motion excludes.*  Let an invariant curve go around the cylinder, a Jordan curve of any
smoothness.  It separates the cylinder, and the map, which keeps both ends, keeps both parts.  If
the curve lay in u <= v < w, a motion with v = u after one impact would be below or on it, and one
with v >= w above it: so no motion is both, forward or backward.

*The first curve.*  Let a motion that comes to v >= w lie below the curve, or on it.  The vertical
line through this state meets the curve there or above: so max v >= w on each such curve, and on a
proved one max v is at most the upper bound there.  Of curves below a motion, in the same way, min v
is at most the speed that it falls to.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Whole, bound

MAX_IMPACTS, MAX_BITS = 400, 4096
NEWTON = 40  # steps, of which a few are taken
GRAINS = 64  # more than the rounding of a height
PASSAGE = {"phase": number, "speed": number, "impacts": Whole(1, MAX_IMPACTS), "to": bound}


class Impact(NamedTuple):
    """The phase of the impact, and the speed after it."""

    t: Interval
    v: Interval


def after(a: Interval, start: dict[str, Any], unit: Fraction) -> Interval:
    """Return the speed at the end of a passage; speeds are given in so many units."""
    phase, speed = start["phase"], start["speed"] / unit
    bits = a.bits
    at = Impact(Interval.enclosing(phase, phase, bits), Interval.enclosing(speed, speed, bits))
    need(at.v.is_positive(), "a speed at the start is not positive")
    for _ in range(start["impacts"]):
        at = following(a, at)
    return at.v


def following(a: Interval, at: Impact) -> Impact:
    """Return the next impact."""
    s = flight(a, at)
    t = at.t + s
    before, later = cos_sin(at.t)[0], cos_sin(t)[0]
    return Impact(t, s - at.v + a * (later - before))


def flight(a: Interval, at: Impact) -> Interval:
    """Return the time to the next impact: Newton's method at one state, then bounds for all."""
    m = near(a, Impact(at.t.midpoint(), at.v.midpoint()))
    value, slope = height(a, at, m)
    need((-slope).is_positive(), "a flight is not followed: its states may be too far apart")
    margin = ((value.magnitude() + exact(GRAINS, a.bits)) / -slope).hi * 5 // 4
    p = exact(m.lo - margin, a.bits)
    need(p.is_positive(), "a flight may take no time")
    need(height(a, at, p)[0].is_positive(), "a flight may end earlier")
    return Interval(p.lo, m.lo + margin, a.bits)


def exact(n: int, bits: int) -> Interval:
    """Return n 2^-bits."""
    return Interval(n, n, bits)


def height(a: Interval, at: Impact, s: Interval) -> tuple[Interval, Interval]:
    """Return h(s) and h'(s)."""
    (cos, sin), (later, high) = cos_sin(at.t), cos_sin(at.t + s)
    up = at.v + a * cos
    value = a * (sin - high) + s * (up - s / 2)
    return value, up - s - a * later


def near(a: Interval, at: Impact) -> Interval:
    """Return a number that should be near the time of flight from one state.

    Newton's method for h, from the right, where h is less than its parabola with sin(t + s) = -1.
    """
    up = at.v + a * cos_sin(at.t)[0]
    s = (up + (up.square() + a * 4).sqrt()).midpoint()
    for _ in range(NEWTON):
        value, slope = height(a, at, s)
        if slope.contains_zero():
            break
        step = (value / slope).midpoint()
        s = s - step
        if abs(step.lo) < 16:
            break
    return s
