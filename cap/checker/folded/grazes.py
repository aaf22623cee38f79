"""Orbits that stop just before the wall, or hit it just before they would stop.

Let T be the time of the stop, and P the value of p there, if there were no wall; T and P vary with
the orbit, P < 0 for some and P > 0 for others.  The former stop at T.  The latter hit the wall at a
time t before.  On [T - b, T] let g <= a - cos <= G, g > 0, and P <= g b^2/2.  Then p <= 0 at T - b
(s' = cos - a, so s >= g (T - .) there), so the hit is in [T - b, T]; its speed u has d(s^2/2) = -(a
- cos) dp, so g P <= u^2/2 <= G P; and, with the formula of the flight,

    sin t - a t - u = sin T - a T.

So what becomes of them depends smoothly on (u, T), though not on their state before: they are
followed from there, as a new box with X from u = 0 to its largest value, and Y for T.
"""

from __future__ import annotations

import math

from cap.checker.folded.flights import Flight, System, exact
from cap.checker.folded.hits import shifted
from cap.checker.folded.numbers import TURN, UP, Pair, middle, zero
from cap.checker.folded.stops import Halt
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.rejection import need

_FAST = "a slow hit may be too fast"


def slow_hits(y: System, h: Halt) -> tuple[Pair, float, Flight]:
    """Return (g, G), the largest u, and the flights after the slow hits."""
    most = q.ends(h.p_all)[1]
    low, high = h.ends
    g, G = braking(y, low, high)
    back = 0.0
    for _ in range(3):
        need(g > 0, _FAST)
        back = math.sqrt(2 * most / g) * 1.01 + 1e-12
        g, G = braking(y, low - back, high)
    need(g > 0 and 2 * most <= g * back * back and back < 1, _FAST)
    fastest = math.sqrt(2 * G * most) * UP
    u = fastest / 2, fastest / 2, 0.0, 0.0, 0.0, 0.0, fastest * TURN
    mid, rad = middle(h.ends)
    d = 0.0, 0.0, rad, 0.0, 0.0, 0.0, TURN * (1 + abs(mid))
    return (g, G), fastest, bounced(y, (mid, d), u, h.ends)


def braking(y: System, low: float, high: float) -> Pair:
    """Return bounds of a - cos t on an interval."""
    cosines = [q.cos_sin(t)[0] for t in (low, high)]
    least, most = min(cosines) - 1e-12, max(cosines) + 1e-12
    for t, _ in y.turns.values():
        if low - 1e-9 <= t <= high + 1e-9:
            most = 1.0
        if low - 1e-9 <= t + y.pi[0] <= high + 1e-9:
            least = -1.0
    return y.a - most - 1e-12, y.a - least + 1e-12


def bounced(y: System, stop: tuple[float, Model], u: Model, ends: Pair) -> Flight:
    """Return the flight after a hit with the speed u, without which a stop would come."""
    mid, d_stop = stop
    sine = q.trigonometric((mid, *d_stop[1:]))[1]
    goal = q.total(q.total(sine, q.scaled(d_stop, -y.a, y.a_error)), u)
    near = zero(lambda t: math.sin(t) - y.a * (t - mid) - goal[0], mid - 1.5, mid)
    cos, sin = q.cos_sin(near)
    slope = cos - y.a
    need(slope < 0, _FAST)
    d = q.scaled(q.moved(goal, y.a * (near - mid) - sin, TURN * 8), 1 / slope)
    d = exact(q.total(d, q.scaled(q.product(d, d), sin / (2 * slope))))
    cosine, sine = q.trigonometric((near + d[0], *d[1:]))
    lag = (abs(near) + abs(mid)) * TURN
    past = q.scaled(q.moved(d, near - mid, lag), -y.a, y.a_error)
    left = q.bound(q.total(q.total(sine, past), q.scaled(goal, -1.0)))
    steep = y.a - q.ends(cosine)[1] - y.a_error
    need(steep > 0, _FAST)
    e = 2 * left / steep * UP
    need(2 * e < steep, "the time of a slow hit is not certain")
    times = q.ends((near + d[0], *d[1:6], e + lag))
    need(braking(y, times[0], ends[1])[0] > 0, _FAST)
    ref, later = y.folded(near, q.widened(d, e + lag))
    A = q.total(q.total(u, q.widened(sine, e)), q.scaled(later, y.a, y.a_error))
    B = y.start(A, later, q.scaled(q.widened(cosine, e), -1.0))
    B = q.moved(B, -y.width[0], y.width[1])
    return y.fresh(shifted(times, near, ref), ref, A, B)
