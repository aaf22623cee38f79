"""Hits of the wall ahead, and what follows a hit that is slow.

*A hit.*  Let T be a polynomial, s >= m > 0 at T and |p| <= g there, for all orbits.  As |s'| <= 1 +
a < 2, s >= m/2 within m/4 of T.  So if 2 g/m < m/4, p vanishes once within e = 2 g/m of T.  If
moreover s > 0 since the start, that is the next event.

*Its derivative.*  dT = -(d dA + dB)/s.  After it the phase is T - pi, the speed s, p = -W, so A' =
2 sin T + A - a (ref' + pi - ref), B' = -W - cos T + a d'^2/2 - A' d' with d' = T - pi - ref':

    dA' = dA - (2 cos T/s) (d dA + dB),      dB' = d dA + dB - d' dA'.

*Captures* are as in ``cap.checker.flow.capture``, e = 1, mu = 0: if b_1 <= cos t <= b_2 from the
hit, with a speed of at most u, to the time t_d, b_1 > a, rise = b_1 + a, fall = b_2 - a, g = b_1 -
a, k = sqrt(fall/rise) < 1, u^2 < 2 rise W, and (1/rise + 1/sqrt(rise g)) u/(1 - k) is at most the
time until t_d, then the mass rests at the wall from then on, until it is released from there at pi
- theta in the other direction: folded, from p = -W.

*Coming to rest near the wall.*  Let a hit be at the time t >= 0, with a speed of at most u, and
until the time t_e <= pi/2 let nothing be required.  Until then cos t decreases and is >= 0.  So
while the mass rises from the wall, its speed decreases at the rate cos t + a >= a, and while it
falls, it grows, if at all, at a smaller rate than it decreased before at the same height: it comes
back with at most the speed u, and is never higher than u^2/(2 a).  After t_1 > theta, it does not
begin to fall, and falling it loses speed at the rate D = a - cos t_1 at least: so it stops, or hits
the wall, within u/D, and then stops within u/a.  If t_1 + u/D + u/a <= t_e, it rests from then on
until its release at pi - theta, u^2/(2 a) at most from the wall.
"""

from __future__ import annotations

import math

from cap.checker.folded.flights import Flight, Four, System, followed
from cap.checker.folded.numbers import TURN, UP, Pair, middle, minus, quotient, times
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.rejection import need

_SLOW, _LOW = 0.35, 0.001  # speeds for which a capture is tried; heights that count as none
_WAITS = (2.0, 4.0, 8.0, 16.0)


def hit(y: System, f: Flight, near: float) -> tuple[float, Flight | Model]:
    """Prove that the next event is a hit, close to a time.

    Return the earliest time and the flight after it, or after a capture -p at the release.
    """
    d = guess(y, f, near)
    cos, sin = q.trigonometric((near + d[0], *d[1:]))
    D, lag = y.since(f, near, d)
    s = y.speed(f.A, D, sin)
    least, most = q.ends(q.widened(s, f.errors[0]))
    need(least > 0, "the mass may stop, or hit")
    left = q.bound(y.place(f, D, cos))
    e = 2 * left / least * UP
    e_all = 2 * (left + q.bound(D) * f.errors[0] + f.errors[1]) / least * UP
    need(4 * e_all < least, "the time of a hit is not certain")
    low, high = q.ends((near + d[0], *d[1:6], e_all + lag))
    y.moving(f, high)
    resting = height(y, (low, high), most + 2 * e_all)
    if resting is not None:
        return low, q.moved(q.constant(*y.width), -resting / 2, resting / 2 * UP)
    speeds = least - 2 * e_all, most + 2 * e_all
    J = derivative(q.widened(cos, e_all), speeds, q.widened(D, e_all), q.widened(d, e_all + lag))
    ref, later = y.folded(near, q.widened(d, e + lag))
    error = (abs(near) + abs(f.ref) + 16) * (y.a_error + 4 * TURN)
    twice = q.scaled(q.widened(sin, e), 2.0)
    A = q.moved(q.total(twice, f.A), -y.a * (near - f.ref), error)
    B = q.moved(y.start(A, later, q.scaled(q.widened(cos, e), -1.0)), -y.width[0], y.width[1])
    return low, followed(y, f, shifted((low, high), near, ref), ref, (A, B), J)


def guess(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that p vanishes at near + d, nearly."""
    cos, sin = q.cos_sin(near)
    p, s = y.at(f, (near, 0.0), cos, sin)
    r = q.inverse(s)
    d = q.scaled(q.product(p, r), -1.0)
    bend = q.product(r, q.product(d, d))
    return (*q.total(d, q.scaled(bend, (y.a - cos) / 2))[:6], 0.0)


def shifted(ends: Pair, near: float, ref: float) -> Pair:
    """Return bounds of the times that begin a flight, from those that ended the last one."""
    shift, e = near - ref, 8 * TURN * (abs(near) + 8)
    return ends[0] - shift - e, ends[1] - shift + e


def derivative(cos: Model, speeds: Pair, d: Model, later: Model) -> Four:
    """Return an enclosure of the derivative of (A', B') in (A, B)."""
    c, D, tau = (middle(q.ends(z)) for z in (cos, d, later))
    g = quotient((2 * c[0], 2 * c[1]), middle(speeds))
    one = 1.0, 0.0
    j11, j12 = minus(one, times(g, D)), (-g[0], g[1])
    return j11, j12, minus(D, times(tau, j11)), minus(one, times(tau, j12))


def height(y: System, ends: Pair, speed: float) -> float | None:
    """Return how far from the wall the mass may rest after a slow hit, or None."""
    if speed > _SLOW:
        return None
    turn, e = y.turns[round((ends[0] + ends[1]) / (4 * math.pi))]
    begin, latest = ends[0] - turn - e - 1e-13, ends[1] - turn + e + 1e-13
    if captures(y, (begin, latest), speed):
        return 0.0
    low = speed * speed / (2 * y.a) * UP
    return low if low < _LOW and settles(y, (begin, latest), speed) else None


def captures(y: System, ends: Pair, speed: float) -> bool:
    """Return whether a capture follows a hit at a time between these, modulo 2 pi."""
    theta = y.theta[0] - y.theta[1]
    for wait in _WAITS:
        until = ends[1] + wait * speed
        if not (-theta < ends[0] and until < theta):
            return False
        ahead = [q.cos_sin(t)[0] for t in (ends[0], until)]
        least, most = min(ahead) - 1e-12, 1.0 if ends[0] <= 0 <= until else max(ahead) + 1e-12
        rise, fall, g = least + y.a - 1e-12, most - y.a + 1e-12, least - y.a - 1e-12
        if g > 0 and fall < rise and speed * speed < rise * y.width[0]:
            bounces = (1 / rise + 1 / math.sqrt(rise * g)) / (1 - math.sqrt(fall / rise)) * speed
            if ends[1] + bounces * (1 + 1e-9) <= until:
                return True
    return False


def settles(y: System, ends: Pair, speed: float) -> bool:
    """Return whether the mass comes to rest near the wall after a hit, by the second lemma."""
    late = max(ends[1], y.theta[0]) + 0.2
    if ends[0] < 0 or late > 1.5:
        return False
    drag = y.a - q.cos_sin(late)[0] - 1e-12
    return drag > 0 and late + (speed / drag + speed / y.a) * (1 + 1e-9) <= 1.57
