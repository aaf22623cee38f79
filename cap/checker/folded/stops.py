"""Stops between the walls, and what follows them: a turn, or a stick and a release.

*A stop.*  Let T be a polynomial in an arc (theta, 2 pi - theta), modulo 2 pi, a - cos t >= m > 0
and |s| <= g at T, for all orbits.  As the derivative of cos is at most 1, s' <= -m/2 within m/2 of
T.  So if 2 g/m < m/2, s vanishes within e = 2 g/m of T; and if s > 0 from the start to the last
slow time, nowhere before, for s has no minimum in the arc; nor is T before the start, if that is
before the end of the arc: s >= 0 there, and s decreases in the arc.  If p < 0 then, nothing else
happens before.

*After it.*  A stop before pi - theta is a stick, with a release at pi - theta against the direction
of the flight; one from there to pi + theta a turn; one after it a stick, with a release at 2 pi -
theta in the direction of the flight.  After folding, each release is at a slow time.

*Its derivative.*  dT = -dA/(cos T - a), and p changes by d dA + dB, as s = 0.  After a turn, A' =
sin T + a d', B' = -W - p - cos T + a d'^2/2 - A' d' with d' = T - pi - ref':

    dA' = -(cos T + a)/(cos T - a) dA,      dB' = -(d dA + dB) - d' dA'.

*Not far after pi - theta.*  Whether the mass turns at a time up to D later, or sticks before, it
leaves from rest, folded at a time in [-theta, -theta + D]: ``System.released``.

*Not far before pi + theta.*  After a turn up to D < 0.1 before, the speed is at most D^2/2 (its
derivative -cos t - a is at most pi + theta - t).  At the time pi + theta + z the derivative is at
most -K z, K = sin theta - z; so the mass stops again before z = 2 D, if K z^2 >= D^2: the way is at
most D^2 (D + z)/2.  It sticks then, and its release at 2 pi - theta is that of the stick, but for
this way, back from the wall ahead; the other wall is farther.

*A stop just before a slow time, or none.*  Let s >= -n at the slow time by the formula, n >= 0, and
s > 0 at a time up to D before it, after pi + theta.  Who stops, at a time between, sticks until the
slow time, and its p is by at most n D above that of the formula.  So all leave the slow time with
the speed max(0, s) and p in [p, p + n D].
"""

from __future__ import annotations

import math
from typing import NamedTuple

from cap.checker.folded.flights import Flight, System, exact, followed
from cap.checker.folded.hits import shifted
from cap.checker.folded.numbers import TURN, UP, Pair, middle, minus, quotient, times
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.rejection import need

_FAR = "a stick or a turn, with far ends"
_NONE = 0.0, 0.0


class Halt(NamedTuple):
    """A stop at near + d in the arc k, if no hit comes before.

    ``e`` bounds the error of near + d without those of A and B, ``e_all`` with them; ``ends`` are
    bounds of the time, ``p_all`` is p with all errors, ``steep`` a lower bound of -s'.
    """

    k: int
    near: float
    d: Model
    e: float
    e_all: float
    cos: Model
    sin: Model
    D: Model
    p: Model
    p_all: Model
    ends: Pair


def halt(y: System, f: Flight, near: float, k: int) -> Halt:
    """Prove that the mass stops in this arc, close to a time, if it hits no wall before."""
    cos, sin = q.cos_sin(near)
    slope = cos - y.a
    need(slope < 0, "a stop is not transversal")
    d = q.scaled(y.at(f, (near, 0.0), cos, sin)[1], -1 / slope)
    d = exact(q.total(d, q.scaled(q.product(d, d), sin / (2 * slope))))
    cosine, sine = q.trigonometric((near + d[0], *d[1:]))
    D, lag = y.since(f, near, d)
    left = q.bound(y.speed(f.A, D, sine))
    steep = y.a - q.ends(cosine)[1] - y.a_error
    need(steep > 0, "a stop is not transversal")
    e, e_all = 2 * left / steep * UP, 2 * (left + f.errors[0]) / steep * UP
    need(2 * e_all < steep, "the time of a stop is not certain")
    low, high = q.ends((near + d[0], *d[1:6], e_all + lag))
    turn, more = y.turns[k - 1]
    after = turn + y.theta[0] + more + y.theta[1] + 1e-13
    inside = after < low and high < y.slows[k][0] - y.slows[k][1]
    need(inside, "a stop may be in another arc")
    need(f.begun[1] < y.slows[k][0] - y.slows[k][1], "a flight may begin after the arc of a stop")
    y.moving(f, after)
    p = q.widened(y.place(f, D, cosine), (left + 2 * e) * e * 2)
    spread = q.bound((0.0, *D[1:])) + e_all
    p_all = q.widened(p, y.influence(f, (f.ref + D[0], spread)))
    found = q.widened(cosine, e), q.widened(sine, e)
    return Halt(k, near, q.widened(d, lag), e, e_all, *found, D, p, p_all, (low, high))


def stop(y: System, f: Flight, h: Halt) -> Flight | Model:
    """Return the flight after a stop, or -p at the release after a stick."""
    turn, more = y.turns[h.k - 1]
    more += 4 * TURN * (abs(turn) + 8)
    low, high = h.ends[0] - turn - more, h.ends[1] - turn + more
    (first, e), (last, r) = y.first, y.last
    if high < first - e:
        return q.moved(h.p_all, *y.width)
    if low > last + r:
        return q.scaled(h.p_all, -1.0)
    if high < last - r:
        ahead = q.moved(q.scaled(h.p, -1.0), -y.width[0], y.width[1])
        if low > first + e:
            return turned(y, f, h, ahead)
        spread = (high - first + e) * UP
        need(spread < y.theta[0] / 2, _FAR)
        D = middle(q.ends(q.widened(h.D, h.e_all)))
        begun, ref, A, B = y.released(ahead, None, spread)
        J = _NONE, _NONE, minus(_NONE, D), (-1.0, 0.0)
        return followed(y, f, begun, ref, (A, B), J)._replace(slow=1)
    need(low > first + e, _FAR)
    return late(y, h, (last - low + r) * UP, high)


def turned(y: System, f: Flight, h: Halt, ahead: Model) -> Flight:
    """Return the flight after a turn, with p = ``ahead``."""
    c = middle(q.ends(q.widened(h.cos, h.e_all)))
    D, tau = (middle(q.ends(q.widened(z, h.e_all))) for z in (h.D, h.d))
    a = y.a, y.a_error
    j11 = quotient(minus(minus(_NONE, c), a), minus(c, a))
    J = j11, _NONE, minus(minus(_NONE, D), times(tau, j11)), (-1.0, 0.0)
    ref, later = y.folded(h.near, q.widened(h.d, h.e))
    A = q.total(h.sin, q.scaled(later, y.a, y.a_error))
    B = q.total(ahead, y.start(A, later, q.scaled(h.cos, -1.0)))
    begun = shifted(h.ends, h.near, ref)
    return followed(y, f, begun, ref, (A, B), J)._replace(slow=1)


def late(y: System, h: Halt, D: float, high: float) -> Model:
    """Return -p at the release after a stop that comes at most D before pi + theta, or later."""
    need(D < 0.1, _FAR)
    z = 2 * D
    K = y.sine[0] - y.sine[1] - z
    need(K * z * z >= D * D * UP, _FAR)
    need(max(high, y.last[0] + z) < y.slows[1][0] - 1e-9, _FAR)
    way = D * D * (D + z) / 2 * UP
    need(q.ends(h.p_all)[0] + y.width[0] > way + y.width[1], _FAR)
    return q.moved(q.scaled(h.p_all, -1.0), way / 2, way / 2 * UP)


class Chance(NamedTuple):
    """Orbits that may stop just before the slow time k: p for all, s, and s with its errors."""

    k: int
    p: Model
    s: Model
    s_all: Model


def chance(y: System, f: Flight, k: int) -> Chance:
    """Prove that until this slow time nothing happens, but perhaps a stick just before it."""
    at = y.slow_time(k)
    p, s = y.at(f, at, y.a, -y.sine[0])
    s_all = q.widened(s, f.errors[0])
    low = min(q.ends(s_all)[0], 0.0)
    before = math.sqrt(-3 * low / y.sine[0]) + 1e-9
    t = at[0] - before
    far = "a stop is not close to a slow time"
    need(q.ends(y.seen(f, (t, 0.0), *q.cos_sin(t))[1])[0] > 0, far)
    need(t > f.begun[1] and t - y.turns[k - 1][0] > y.last[0] + 1e-9, far)
    y.moving(f, t)
    way = -low * before * (1 + 1e-9)
    p = q.moved(p, way / 2, way / 2 * UP)
    need(q.ends(q.widened(p, y.influence(f, at)))[1] < 0, "the mass may stop, or hit")
    return Chance(k, p, s, s_all)


def merged(y: System, f: Flight, c: Chance, stuck: bool) -> Flight:
    """Return the flight of all orbits at the slow time, or only of those that have stuck."""
    t, e = y.slow_time(c.k)
    low, high = q.ends(c.s_all)
    low = min(low, 0.0)
    if stuck or high <= 0:
        part, s = 0.0, q.constant(0.0)
    else:  # max(0, s) is between part s and part (s - low)
        part = high / (high - low)
        most = part * -low * UP
        s = q.moved(q.scaled(c.s, part), most / 2, most / 2 * UP + part * TURN)
    d = t - f.ref, e + (abs(t) + abs(f.ref)) * TURN
    begun, ref, A, B = y.released(c.p, s)
    J = (part, 0.0), _NONE, d, (1.0, 0.0)
    return followed(y, f, begun, ref, (A, B), J)._replace(slow=1)
