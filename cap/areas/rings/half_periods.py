"""Compiled: half periods in either sense of time, of states and of segments of them.

The formulas, and why they mean what they do, are in `cap.checker.tori.segments`.  Of states, in
doubles, they steer; of segments, in intervals of doubles, they prove.
"""

import math
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.flow.kernels import place, velocity
from cap.sets import doubles
from cap.sets.circular import PI, acos, sin_cos
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    is_finite,
    is_positive,
    lower,
    magnitude,
    upper,
    widened,
)

Floats = NDArray[np.float64]
NEWTON = 30
LEAST = 1e-4  # slower hits are none for what steers
SLACK = 2.0**-48  # of a sum of a few products: more than all roundings


class Laws(NamedTuple):
    """alpha, a, b = arccos alpha, c = sin b - alpha b, and the rest of what decides a stop."""

    alpha: Interval
    a: Interval
    b: Interval
    c: Interval
    ahead: Interval
    behind: Interval


class Flown(NamedTuple):
    """A state half a period later, with the times from start to hit and to the end; the kick."""

    y: float
    v: float
    t: float
    d: float
    k: float


class Hit(NamedTuple):
    """Times and speeds of hits, the kick, and the times from there to the end."""

    t: Interval
    u: Interval
    k: Interval
    d: Interval


class Strand(NamedTuple):
    """The states (y, v) + (dy, dv) r + (p -q; q p) s, |r| <= 1, |s| <= (r1, r2)."""

    y: float
    v: float
    dy: float
    dv: float
    p: float
    q: float
    r1: float
    r2: float


def laws(alpha: Fraction, a: Fraction) -> Laws:
    """Return the laws at exact parameters."""
    f = doubles.enclosing(alpha)
    b = acos(f)
    c = sin_cos(b)[0] - f * b
    k = 1.0 - f - 0.5 * (f * b * b)
    return Laws(f, doubles.enclosing(a), b, c, k + c * (PI - b), c * b - k)


@kernel
def hit(y: float, v: float, alpha: float, a: float, e: float) -> float:
    """Return when a state hits the wall a; NaN if no hit is found.

    Newton's method, kept in a bracket: where the mass has turned, it is too late.
    """
    low, high = 0.0, math.pi
    t = min(max((a - y) / v, 0.0), 3.0)
    step = 0.0
    for _ in range(NEWTON):
        speed = velocity(v, t, e * alpha, e * math.sin(t))
        if speed > LEAST:
            beyond = place(y + e, v, t, 0.5 * e * alpha, e * math.cos(t)) - a
            step = beyond / speed
            low, high = (low, t) if beyond > 0 else (t, high)
            t -= step
            if abs(step) < 1e-14:
                break
        else:
            high = t
        if not low < t < high:
            t = 0.5 * (low + high)
    return t if 0 < t < math.pi and abs(step) < 1e-12 else math.nan


@kernel
def flown(y: float, v: float, alpha: float, a: float, e: float) -> Flown:
    """Return a state half a period later; NaN if there is no hit."""
    t = hit(y, v, alpha, a, e)
    sin, cos, d = math.sin(t), math.cos(t), math.pi - t
    u = velocity(v, t, e * alpha, e * sin)
    if not u > LEAST:
        u = math.nan
    Y = place(-a - e * cos, u + e * sin, d, 0.5 * e * alpha, e)
    return Flown(Y, velocity(v, math.pi, e * alpha, 2 * e * sin), t, d, -2 * e * cos / u)


@kernel
def turned(dy: float, dv: float, z: Flown) -> tuple[float, float]:
    """Return the derivative times a vector."""
    above = dy + z.t * dv
    below = dv + z.k * above
    return above + z.d * below, below


@kernel
def reach(z: Strand, a: float, b: float) -> float:
    """Return a bound of |a y + b v| over what a strand adds to its middle."""
    exact = abs(a * z.dy + b * z.dv)
    across = abs(a * z.p + b * z.q) * z.r1 + abs(b * z.p - a * z.q) * z.r2
    terms = abs(a * z.dy) + abs(b * z.dv)
    terms += (abs(a) + abs(b)) * (abs(z.p) + abs(z.q)) * (z.r1 + z.r2)
    return exact + across + terms * SLACK + doubles.TINY


@kernel
def nowhere() -> Strand:
    """Return no strand: comparisons with it fail."""
    nan = math.nan
    return Strand(nan, nan, nan, nan, nan, nan, nan, nan)


@kernel
def column(p: Any, q: Any, t: Interval, k: Interval, d: Interval) -> tuple[Any, Any]:
    """Return the derivative times (p, q)."""
    above = t * q + p
    below = k * above + q
    return above + d * below, below


@kernel
def stops_or_goes_on(Y: Interval, V: Interval, t: Interval, given: Laws, e: float) -> bool:
    """Return whether states with V <= c certainly stop, and the others hit no second wall."""
    if not is_positive(given.a - Y):
        return False
    if lower(V) > upper(given.c):
        return True
    least = lower(V)
    if e > 0:
        late = is_positive(PI - given.b - t)
        return late and is_positive(given.a - (given.ahead + Y - PI * least))
    slow = is_positive(given.a - Y + given.b * min(least, 0.0))
    return slow and is_positive(given.a - (given.behind + Y))


@kernel
def begins(z: Strand, given: Laws, e: float) -> bool:
    """Return whether states are between the walls, and those that are slow backward stop."""
    Y, V = Interval(z.y, reach(z, 1.0, 0.0)), Interval(z.v, reach(z, 0.0, 1.0))
    between = is_positive(given.a - Y) and is_positive(given.a + Y) and is_positive(V)
    return between and (e > 0 or stops_or_goes_on(Y, V, V, given, e))


@kernel
def gap(x: Any, v: Any, t: Interval, given: Laws, e: float) -> Any:
    """Return how far beyond the wall states are at a time, if there were none."""
    return place(e, v, t, given.alpha * (0.5 * e), sin_cos(t)[1] * e) + x - given.a


@kernel
def first_hit(guess: float, beyond: Interval, V: Interval, given: Laws, e: float) -> Hit:
    """Return the first hit of states with the velocities V, which at a time are so far beyond.

    The speed is NaN if it is not certain that all hit, in half a period.
    """
    t = Interval(guess, 0.0)
    speed = velocity(V.mid, guess, e * given.alpha.mid, e * sin_cos(t)[0].mid)
    far = magnitude(beyond)
    near = Interval(guess, 1.2 * far / speed + 12 * far * far + 1e-12)
    moved = beyond / velocity(V, near, given.alpha * e, sin_cos(near)[0] * e)
    if not (is_finite(moved) and magnitude(moved) < near.rad):
        return Hit(moved, Interval(math.nan, math.nan), moved, moved)
    times = widened(t, magnitude(moved))
    s, c = sin_cos(times)
    u = velocity(V, times, given.alpha * e, s * e)
    if not (is_positive(u) and is_positive(times) and is_positive(PI - times)):
        return Hit(times, Interval(math.nan, math.nan), moved, moved)
    return Hit(times, u, c * (-2 * e) / u, PI - times)


@kernel
def after(z: Strand, given: Laws, e: float) -> Strand:
    """Return the states of a strand half a period later, or `nowhere` if that is not certain."""
    V = Interval(z.v, reach(z, 0.0, 1.0))
    guess = hit(z.y, z.v, given.alpha.mid, given.a.mid, e)
    if not (is_positive(V) and guess > 0):
        return nowhere()
    t = Interval(guess, 0.0)
    defect = gap(z.y, z.v, t, given, e)
    every = widened(defect, reach(z, 1.0, guess))
    found = first_hit(guess, every, V, given, e)
    if not is_positive(found.u):
        return nowhere()
    times, u, k, d = found
    at = t - defect / u
    Y, W = image(z.v, at, given, e)
    moved_strand = carried(
        z,
        Y,
        W,
        column(z.dy, z.dv, times, k, d),
        column(z.p, z.q, times, k, d),
        column(-z.q, z.p, times, k, d),
    )
    Y, W = (
        Interval(moved_strand.y, reach(moved_strand, 1.0, 0.0)),
        Interval(moved_strand.v, reach(moved_strand, 0.0, 1.0)),
    )
    return moved_strand if stops_or_goes_on(Y, W, times, given, e) else nowhere()


@kernel
def image(v: Any, t: Interval, given: Laws, e: float) -> tuple[Any, Any]:
    """Return the state at the end of the half period of the middle, which hits at t."""
    sin, cos = sin_cos(t)
    d = PI - t
    drag, twice = given.alpha * e, sin * (2.0 * e)
    Y = place(-given.a - cos * e, velocity(v, t, drag, twice), d, drag * 0.5, e)
    return Y, velocity(v, PI, drag, twice)


@kernel
def carried(z: Strand, Y: Interval, V: Interval, T: Any, first: Any, second: Any) -> Strand:
    """Return what contains the image: of the middle, of the direction, and of both axes."""
    error_y, error_v = Y.rad + T[0].rad, V.rad + T[1].rad
    one = math.sqrt(first[0].mid ** 2 + first[1].mid ** 2)
    two = math.sqrt(second[0].mid ** 2 + second[1].mid ** 2)
    if one * z.r1 >= two * z.r2:
        p, q = first[0].mid / one, first[1].mid / one
    else:
        p, q = second[0].mid / two, second[1].mid / two
    square = Interval(p, 0.0) * p + Interval(q, 0.0) * q
    grow = 1 + SLACK
    along = magnitude((first[0] * p + first[1] * q) / square) * z.r1
    along += magnitude((second[0] * p + second[1] * q) / square) * z.r2
    across = magnitude((first[1] * p - first[0] * q) / square) * z.r1
    across += magnitude((second[1] * p - second[0] * q) / square) * z.r2
    scale = magnitude(Interval(1.0, 0.0) / square)
    along += scale * (abs(p) * error_y + abs(q) * error_v) * grow
    across += scale * (abs(q) * error_y + abs(p) * error_v) * grow
    return Strand(Y.mid, V.mid, T[0].mid, T[1].mid, p, q, along * grow, across * grow)
