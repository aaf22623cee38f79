"""Compiled: backwards in time from a set of stops, with the areas at the strobes that it passes.

*Units* and folding are those of `cap.checker.folded.flights`: a mass moves to the right, the wall
ahead is at p = 0, the other at -W; after a hit or a turn the picture is mirrored, and its time
shifted by pi.  Backwards friction drives: a flight has

    s = sin t + a d + A,      p = -cos t + a d²/2 + A d + B,      d = t - ref,      s' = cos t + a.

Let Theta = pi - arccos a.  s has its minima at the slow times 2 pi k - Theta.  A mass stops only
where cos t < -a, and turns: its next s' is a - cos t > 0.  So it never sticks.

*Stops* are pairs (q, t), q in [-W, 0] and cos t > -a: from rest at p = q at the time t.  The mass
sticks there if |cos t| < a, and turns if cos t > a.  The area in (p, s) at a later time is the
integral of |dA dB| = w dq dt, w = cos t + a at the start: A = -sin t at ref = t, and dB = dq + ...
A hit keeps it.

*Strobes* are the multiples of pi.  The states there from different stops, or from one stop after
different times, are different, up to the stop before: the motion from a state has one first stop.
A strobe during a hit is passed before or after it.  What counts is slower than V then: of a region,
a part.

*Errors.*  A = A_0(X, Y) + u, B = B_0(X, Y) + v with polynomials A_0, B_0 and (u, v) = C n, |n_1| <=
R_1, |n_2| <= R_2, as in `cap.checker.folded.flights`; J is the derivative of (A', B') in (A, B).
"""

import math
from typing import NamedTuple

from cap.areas.folded.laws import laws
from cap.areas.folded.polynomials import (
    TINY,
    UP,
    Model,
    bound,
    centred,
    constant,
    ends,
    exact,
    inverse,
    moved,
    product,
    scaled,
    total,
    trigonometric,
    widened,
)
from cap.flow import kernels
from cap.sets.circular import sin_cos_of_double
from cap.sets.compiled import kernel

Pair = tuple[float, float]
Four = tuple[Pair, Pair, Pair, Pair]

TURN = 2 * math.pi
PI_ERROR, TURN_ERROR = 2.0**-52, 2.0**-51  # of the doubles pi and 2 pi, with room
ROUND = 2.0**-49  # 16 times the rounding of a sum, relative
ARCS = 12  # of a flight


class Constants(NamedTuple):
    """The constants, each with a bound of its error: a, W, Theta, sqrt(1 - a²)."""

    a: float
    a_error: float
    width: float
    width_error: float
    theta: float
    theta_error: float
    sine: float
    sine_error: float


class Flight(NamedTuple):
    """Flights: A_0, B_0, C, R, bounds of the errors of A and B, ref, bounds of the start.

    ``slow`` is the number of the first slow time that may follow the start.
    """

    A: Model
    B: Model
    C: tuple[float, float, float, float]
    R: Pair
    errors: Pair
    ref: float
    begun: Pair
    slow: int


class Event(NamedTuple):
    """A hit or a turn at the times ref + D = near + d, nearly: d is a polynomial.

    ``time`` and ``all`` bound the error of d for A_0, B_0, and for all flights.  Between the ends
    are all times.  ``least`` and ``most`` bound the speeds, of all flights, ``lag`` what rounding
    near + d costs, ``place`` is p for A_0, B_0.  ``why`` is 0, or tells what was not certain.
    """

    why: int
    near: float
    d: Model
    D: Model
    cos: Model
    sin: Model
    place: Model
    time: float
    all: float
    lag: float
    ends: Pair
    least: float
    most: float


speed, place, start, from_rest = laws(total, product, scaled, 1.0)


@kernel
def at(y: Constants, f: Flight, time: Pair, cos: float, sin: float) -> tuple[Model, Model]:
    """Return p and s for A_0, B_0 at a time within an error of a double.

    cos and sin are wrong by 2^-50 and that error.  d is wrong by e; what is computed from it by at
    most e times the size of its derivative.
    """
    t = time[0]
    d = t - f.ref
    e = time[1] + (abs(t) + abs(f.ref)) * ROUND
    error = (bound(f.A) + abs(d) + 2) * (e + ROUND) + y.a_error * abs(d)
    s = moved(f.A, kernels.velocity(0.0, d, -y.a, sin), error)
    p = total(scaled(f.A, d, e), f.B)
    return moved(p, kernels.place(0.0, 0.0, d, -0.5 * y.a, cos), error * (1 + abs(d))), s


@kernel
def influence(f: Flight, d: float, e: float) -> float:
    """Return a bound of u d + v for d within e of a double."""
    p = abs(d * f.C[0] + f.C[2]) * f.R[0] + abs(d * f.C[1] + f.C[3]) * f.R[1]
    return (p + (e + abs(d) * ROUND) * f.errors[0] + f.errors[1] * ROUND) * UP


@kernel
def moving(y: Constants, f: Flight, until: float) -> bool:
    """Return whether s > 0 from the start up to a time, if it is so there."""
    for k in range(f.slow, ARCS):
        t = TURN * k - y.theta
        e = y.theta_error + k * TURN_ERROR + abs(t) * ROUND
        if t - e > until:
            return True
        s = at(y, f, (t, e + y.a_error + y.sine_error), -y.a, -y.sine)[1]
        if not ends(widened(s, f.errors[0]))[0] > 0:
            return False
    return False


@kernel
def _nothing(why: int) -> Event:
    """Return an event of which nothing is known."""
    z = constant(0.0, 0.0)
    return Event(why, 0.0, z, z, z, z, z, 0.0, 0.0, 0.0, (0.0, 0.0), 0.0, 0.0)


@kernel
def _since(f: Flight, near: float, d: Model) -> tuple[Model, float]:
    """Return near + d - ref, and a bound of the rounding of near + d."""
    lag = (abs(near) + abs(f.ref)) * ROUND
    return moved(d, near - f.ref, lag), lag


@kernel
def _at_zero(y: Constants, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that p vanishes at near + d, nearly; NaN if there is none."""
    sine, cosine = sin_cos_of_double(near)
    p, s = at(y, f, (near, 0.0), cosine, sine)
    r = inverse(s)
    d = scaled(product(p, r), -1.0, 0.0)
    bend = product(r, product(d, d))
    d = exact(total(d, scaled(bend, -0.5 * (y.a + cosine), 0.0)))
    cos, sin = trigonometric(centred(d, near + d[0]))
    D = moved(d, near - f.ref, 0.0)
    r = inverse(speed(y, f.A, D, sin))
    return exact(total(d, scaled(product(place(y, f, D, cos), r), -1.0, 0.0)))


@kernel
def hit(y: Constants, f: Flight, near: float) -> Event:
    """Return the next event, if it is certain that it is a hit close to a time.

    Let s >= m > 0 and |p| <= g at T.  As |s'| <= 1 + a < 2, s >= m/2 within m/4 of T.  So if 2 g/m
    < m/4, p vanishes once within 2 g/m of T.
    """
    d = _at_zero(y, f, near)
    cos, sin = trigonometric(centred(d, near + d[0]))
    D, lag = _since(f, near, d)
    least, most = ends(widened(speed(y, f.A, D, sin), f.errors[0]))
    if not least > 0:
        return _nothing(1)
    p = place(y, f, D, cos)
    left = bound(p)
    e = 2 * left / least * UP
    e_all = 2 * (left + bound(D) * f.errors[0] + f.errors[1]) / least * UP
    if not 4 * e_all < least:
        return _nothing(2)
    low, high = ends(widened(centred(d, near + d[0]), e_all + lag))
    if not moving(y, f, high):
        return _nothing(3)
    speeds = least - 2 * e_all, (most + 2 * e_all) * UP
    return Event(0, near, d, D, cos, sin, p, e, e_all, lag, (low, high), *speeds)


@kernel
def _at_rest(y: Constants, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that s vanishes at near + d, nearly; NaN if there is none."""
    sine, cosine = sin_cos_of_double(near)
    slope = cosine + y.a
    d = scaled(at(y, f, (near, 0.0), cosine, sine)[1], -1 / slope, 0.0)
    d = exact(total(d, scaled(product(d, d), sine / (2 * slope), 0.0)))
    cos, sin = trigonometric(centred(d, near + d[0]))
    r = inverse(moved(cos, y.a, 0.0))
    s = speed(y, f.A, moved(d, near - f.ref, 0.0), sin)
    return exact(total(d, scaled(product(s, r), -1.0, 0.0)))


@kernel
def turn(y: Constants, f: Flight, near: float) -> Event:
    """Return the next event, if it is certain that it is a turn close to a time.

    Let s' <= -m < 0 and |s| <= g at T.  As |s''| <= 1, s' <= -m/2 within m/2 of T.  So if 2 g/m <
    m/2, s vanishes once within 2 g/m of T.  If all that time is in one arc where cos t < -a, s
    falls from where it is positive: from the start, or from the beginning of the arc.  p has risen
    since the start, and is negative at T.
    """
    d = _at_rest(y, f, near)
    cos, sin = trigonometric(centred(d, near + d[0]))
    D, lag = _since(f, near, d)
    left = bound(speed(y, f.A, D, sin))
    steep = -(ends(cos)[1] + y.a + y.a_error) - TINY
    if not steep > 0:
        return _nothing(4)
    steep /= UP
    e = 2 * left / steep * UP
    e_all = 2 * (left + f.errors[0]) / steep * UP
    if not 2 * e_all < steep:
        return _nothing(5)
    low, high = ends(widened(centred(d, near + d[0]), e_all + lag))
    k = math.floor((near + y.theta) / TURN) + 1
    more = y.theta_error + abs(k) * TURN_ERROR + (abs(k) + 2) * TURN * ROUND
    after, until = TURN * (k - 1) + y.theta + more, TURN * k - y.theta - more
    if not (after < low and high < until and f.begun[1] < until):
        return _nothing(6)
    if not moving(y, f, after):
        return _nothing(7)
    p = widened(place(y, f, D, cos), (left + 2 * e) * e * 2)
    spread = bound(centred(D, 0.0)) + e_all
    if not ends(widened(p, influence(f, D[0], spread)))[1] < 0:
        return _nothing(8)
    return Event(0, near, d, D, cos, sin, p, e, e_all, lag, (low, high), 0.0, 0.0)
