"""Hits and stops of the flow of a region, and the next flights (`cap.checker.folded.motion`).

*Hits and stops*: T is a polynomial, and what p or s leave there bounds the error of the time.  As
|s'| <= 1 + a < 2: if s >= m > 0 and |p| <= g at T, and 2 g/m < m/4, p vanishes once within 2 g/m of
T.  If -cos t - a >= m > 0 and |s| <= g at T, and 2 g/m < m/2, s vanishes within 2 g/m of T.

*After a hit* at T, with s then: A' = 2 sin T + A + a (ref' + pi - ref), B' = -W - cos T - a d'^2/2
- A' d', d' = T - pi - ref'.  *After a turn* at T: A' = sin T - a d', B' = -W - p - cos T - a d'^2/2
- A' d'.  With dT = -(d dA + dB)/s or -dA/(cos T + a):

    hit:    dA' = dA - (2 cos T/s) (d dA + dB),              dB' = d dA + dB - d' dA'
    turn:   dA' = -(cos T - a)/(cos T + a) dA,               dB' = -(d dA + dB) - d' dA'
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.folded.instants import hitting, stopping
from cap.checker.folded.motion import Flight, System, followed, since, upcoming
from cap.checker.folded.numbers import TURN, UP, Pair, middle, minus, quotient, times
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.polynomials import Model
from cap.checker.kernel.rejection import need

_NONE, _ONE = (0.0, 0.0), (1.0, 0.0)


class Event(NamedTuple):
    """A hit or a stop at near + d; the cosine and the sine of that, and D = near + d - ref.

    ``e`` bounds the error of the time without those of A and B, ``e_all`` with them and rounding;
    ``ends`` are bounds of the time, ``speeds`` of the speed; ``p`` is the place of a stop, without
    errors and with them.
    """

    near: float
    d: Model
    D: Model
    cos: Model
    sin: Model
    e: float
    e_all: float
    ends: Pair
    speeds: Pair
    p: tuple[Model, Model] | None = None


def event(y: System, f: Flight) -> Event:
    """Prove what comes next, for all orbits."""
    kind, near, k = upcoming(y, f)
    return hit(y, f, near) if kind == "hit" else stop(y, f, near, k)


def after(y: System, f: Flight, e: Event) -> Flight:
    """Return the flight after an event."""
    return after_hit(y, f, e) if e.p is None else after_turn(y, f, e, e.p[0])


def hit(y: System, f: Flight, near: float) -> Event:
    """Prove that the next event is a hit, close to a time."""
    d = hitting(y, f, near)
    cos, sin = q.trigonometric(q.with_constant(d, near + d[0]))
    D, lag = since(f, near, d)
    s = y.speed(f.A, D, sin)
    least, most = q.ends(q.widened(s, f.errors[0]))
    need(least > 0, "the mass may stop, or hit")
    left = q.size(y.place(f, D, cos))
    e = 2 * left / least * UP
    e_all = 2 * (left + q.size(D) * f.errors[0] + f.errors[1]) / least * UP
    need(4 * e_all < least, "the time of a hit is not certain")
    ends = q.ends(q.widened(q.with_constant(d, near + d[0]), e_all + lag))
    # the next flight begins within 1.5 of [-pi, pi]: after the slow time of number -1
    need(ends[1] - ends[0] < 3, "the time of a hit is not certain")
    y.since_start(f, ends[0])
    y.moving(f, ends[1])
    speeds = least - 2 * e_all, most + 2 * e_all
    return Event(near, d, D, cos, sin, e + lag, e_all + lag, ends, speeds)


def after_hit(y: System, f: Flight, h: Event) -> Flight:
    """Return the flight after a hit."""
    c, tau, D = (middle(q.ends(q.widened(z, h.e_all))) for z in (h.cos, h.d, h.D))
    g = quotient((2 * c[0], 2 * c[1]), middle(h.speeds))
    j11, j12 = minus(_ONE, times(g, D)), (-g[0], g[1])
    J = j11, j12, minus(D, times(tau, j11)), minus(_ONE, times(tau, j12))
    ref, later = y.folded(h.near, q.widened(h.d, h.e))
    error = (abs(h.near) + abs(f.ref) + 16) * (y.a_error + 4 * TURN)
    twice = q.scaled(q.widened(h.sin, h.e), 2.0)
    A = q.moved(q.total(twice, f.A), y.a * (h.near - f.ref), error)
    B = q.moved(y.start(A, later, q.scaled(q.widened(h.cos, h.e), -1.0)), -y.width[0], y.width[1])
    found = followed(f, h.ends, (h.near, ref), (A, B), J)
    return found._replace(slow=1 if found.begun[0] > sum(y.slow(0)) else 0)


def stop(y: System, f: Flight, near: float, k: int) -> Event:
    """Prove that the next event is a stop, close to a time, before the slow time k."""
    d = stopping(y, f, near)
    cos, sin = q.trigonometric(q.with_constant(d, near + d[0]))
    D, lag = since(f, near, d)
    left = q.size(y.speed(f.A, D, sin))
    steep = -q.ends(cos)[1] - y.a - y.a_error
    need(steep > 0, "a stop is not transversal")
    e, e_all = 2 * left / steep * UP, 2 * (left + f.errors[0]) / steep * UP
    need(2 * e_all < steep, "the time of a stop is not certain")
    ends = q.ends(q.widened(q.with_constant(d, near + d[0]), e_all + lag))
    slow, more = y.slow(k)
    first = slow - 2 * (y.theta[0] - y.theta[1]) + more
    need(first < ends[0] and ends[1] < slow - more, "a stop may be in another arc")
    need(f.begun[1] < slow - more, "a flight may begin after the arc of a stop")
    y.moving(f, first)
    p = q.widened(y.place(f, D, cos), (left + 2 * e) * e * 2)
    spread = q.size(q.with_constant(D, 0.0)) + e_all
    p_all = q.widened(p, y.influence(f, f.ref + D[0], spread))
    need(q.ends(p_all)[1] < 0, "the mass may hit before it stops")
    return Event(near, d, D, cos, sin, e + lag, e_all + lag, ends, _NONE, (p, p_all))


def after_turn(y: System, f: Flight, t: Event, p: Model) -> Flight:
    """Return the flight after a turn at a place."""
    c, tau, D = (middle(q.ends(q.widened(z, t.e_all))) for z in (t.cos, t.d, t.D))
    a = y.a, y.a_error
    j11 = quotient(minus(a, c), (c[0] + a[0], (c[1] + a[1] + TURN) * UP))
    J = j11, _NONE, minus(minus(_NONE, D), times(tau, j11)), (-1.0, 0.0)
    ref, later = y.folded(t.near, q.widened(t.d, t.e))
    A = q.total(q.widened(t.sin, t.e), q.scaled(later, -y.a, y.a_error))
    ahead = q.moved(q.scaled(p, -1.0), -y.width[0], y.width[1])
    B = q.total(ahead, y.start(A, later, q.scaled(q.widened(t.cos, t.e), -1.0)))
    return followed(f, t.ends, (t.near, ref), (A, B), J)
