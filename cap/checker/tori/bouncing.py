"""An elastic ball on a table that vibrates: from one impact to the next, of functions.

Units: omega = g = 1; the table is at a sin t, 0 < a < 1.  After an impact at t the ball leaves it
with the speed v > 0, relative to it; after s > 0 it is above the table by

    h(s) = a sin t + (v + a cos t) s - s^2/2 - a sin(t + s).

*The next impact.*  h(0) = 0, h'(0) = v > 0 and h'' = a sin(t + s) - 1 < 0: so h has exactly one
zero s > 0, it is positive before, and h'(s) < 0 there.  The impact reverses the relative velocity,

    t' = t + s,      v' = -h'(s) = s - v - a cos t + a cos t' > 0.

Time can be reversed: (t, v) -> (t', v') is a bijection of v > 0, and analytic, as h'(s) != 0.

*Area.*  With u = v + a cos t the absolute velocity at the place q = a sin t, u dq - (u^2/2 + q) dt
= -v^2/2 dt + (a^2 cos^2(t)/2 - a sin t) dt on states after impacts.  A flight changes the form on
the left by the differential of its action, a function of the state; the impact changes the sign of
v only.  The second term has the same integral over each curve around the cylinder, and 0 over other
closed ones: so (t, w) -> (t', w'), w = v^2/2, keeps the integral of w dt over closed curves.

*Ends.*  By h(s) = 0, s = 2(v + a cos t) + 2a (sin t - sin t')/s; so v' - v = a cos t + a cos t' +
2a (sin t - sin t')/s is bounded where v is large, and the bijection keeps both ends of v > 0.

*Derivative*: with dv = dw/v,

    ds = ((a cos t - a sin t s - a cos t') dt + s dv)/v',
    dt' = dt + ds,      dv' = ds - dv + a sin t dt - a sin t' dt',      dw' = v' dv'.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.fourier import Function, moved, root
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.tori.invariant_curve import Image, Vector


class Flight(NamedTuple):
    """Hints along a curve: v and nearly 1/v, the time s of the flight and nearly 1/v'."""

    speed: Function
    inverse: Function
    time: Function
    later: Function


def over(a: Interval, flight: Flight, x: Function, w: Function) -> Image:
    """Return the image of all curves (theta + x, w) in these functions.

    For real functions v > 0 is the root of v^2 = 2w and s > 0 that of h: as v has a reciprocal it
    has one sign.
    """
    circle, half = x.circle, x.circle.unit // 2
    v = root(
        flight.speed,
        flight.speed * flight.speed - w * 2,
        lambda e: flight.speed.with_error(e) * 2,
        flight.inverse.divided(2),
    )
    per_v = v.inverse_near(flight.inverse)
    need(v.mean > v.error, "a speed after an impact may not be positive")
    k, s = x.cos_sin()
    cosine = Function(circle, [(0, 0), (half, 0)], 0)
    sine = Function(circle, [(0, 0), (0, -half)], 0)
    cos, sin = (cosine * k - sine * s) * a, (sine * k + cosine * s) * a  # a cos t, a sin t
    p, ahead = flight.time.with_error(0), flight.time.with_error(0).cos_sin()
    up = v + cos
    value = sin + up * p - (p * p).divided(2) - sin * ahead[0] - cos * ahead[1]

    def slope(e: int) -> Function:
        c, d = moved(ahead, e)
        return up - p.with_error(e) - cos * c + sin * d

    time = root(p, value, slope, -flight.later)
    need(time.mean - time.swing - time.error > 0, "a flight may take no time")
    c, d = moved(ahead, time.error)
    after, high = cos * c - sin * d, sin * c + cos * d  # of t', with a
    u = time - v - cos + after
    per_u = u.inverse_near(flight.later)

    def tangent(z: Vector) -> Vector:
        dt, dv = z[0], per_v * z[1]
        ds = per_u * ((cos - sin * time - after) * dt + time * dv)
        dt_after = dt + ds
        return dt_after, u * (ds - dv + sin * dt - high * dt_after)

    return Image(x + time, (u * u).divided(2), tangent)
