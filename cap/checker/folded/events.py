"""Hits and stops of the flow, for all states of a kind, and the next flights.

*A hit or a stop at T.*  Let F(t) be p, or -s, at the time t, F' its derivative in t: s, or -cos t -
a, positive at T_0, a polynomial next to T.  It changes by at most K = |a| + k, or K = k, per time,
k = 1 in two variables (`cap.checker.kernel.polynomials.bend`): let |F(T_0)| <= g there, F'(T_0) >=
m, and K 2 g/m <= m/2; then F' >= m/2 within 2 g/m of T_0, and F vanishes there once.

In one variable functions have the norm of `cap.checker.kernel.line`.  Let m be the number F'(T_0)
at X = 0, and

    g >= |F(T_0)|/m,    |1 - F'(T_0)/m| + K 2 g/m <= 1/2,

with |F'(T_0 + z) - F'(T_0)| <= K |z| for |z| <= 1.  Then z -> z - F(T_0 + z)/m maps the functions
with |z| <= 2 g to themselves, and is a contraction there (the norm of its derivative is at most 1/2
there): so F vanishes at T_0 + z for a function z with |z| <= 2 g, and F' has no zero within 2 g of
T_0.  By ``line``, sin(T_0 + z) and cos(T_0 + z) differ from those of T_0 by at most k |z|, k = 1.2
(|cos T_0| + |sin T_0|).

*Which is next.*  A hit is, if s > 0 up to then.  It is so at T, and is shown at the slow times
before.  A stop in an arc where cos t < -a is the only one there, as s decreases; it is next if s >
0 up to the begin of the arc, and p < 0 at the stop.

*After a hit* at T, with s then: A' = 2 sin T + A + a (ref' + pi - ref), B' = -W - cos T - a d'^2/2
- A' d', d' = T - pi - ref'.  *After a turn* at T: A' = sin T - a d', B' = -W - p - cos T - a d'^2/2
- A' d'.  With dT = -(d dA + dB)/s or -dA/(cos T + a):

    hit:    dA' = dA - (2 cos T/s) (d dA + dB),              dB' = d dA + dB - d' dA'
    turn:   dA' = -(cos T - a)/(cos T + a) dA,               dB' = -(d dA + dB) - d' dA'

In one variable these are functions, too, and are enclosed by balls of functions around numbers.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.folded.flights import Flight, Model
from cap.checker.folded.instants import hitting, stopping
from cap.checker.folded.motion import Direction, followed, since, upcoming
from cap.checker.folded.numbers import TURN, UP, Pair, minus, quotient, times
from cap.checker.kernel.rejection import need

_NONE, _ONE = (0.0, 0.0), (1.0, 0.0)


class Event(NamedTuple):
    """A hit or a stop at near + d; the cosine and the sine of that, and D = near + d - ref.

    ``e`` bounds the error of the time without those of A and B, ``e_all`` with them; k e that of
    the cosine and of the sine; ``ends`` are bounds of the time; ``s`` is the speed of a hit, ``p``
    the place of a stop, without errors and with them.
    """

    near: float
    d: Model
    D: Model
    cos: Model
    sin: Model
    k: float
    e: float
    e_all: float
    ends: Pair
    s: Model = None
    p: tuple[Model, Model] | None = None


def event(y: Direction, f: Flight) -> Event:
    """Prove what comes next, for all orbits."""
    kind, near, k = upcoming(y, f)
    return hit(y, f, near) if kind == "hit" else stop(y, f, near, k)


def after(y: Direction, f: Flight, e: Event) -> Flight:
    """Return the flight after an event."""
    return after_hit(y, f, e) if e.p is None else after_turn(y, f, e, e.p[0])


def hit(y: Direction, f: Flight, guess: float) -> Event:
    """Prove that the next event is a hit, close to a time."""
    q, (near, d) = y.q, hitting(y, f, guess)
    cos, sin = q.trigonometric(q.with_constant(d, near))
    D, k = since(y, f, near, d), q.bend(cos, sin)
    s, K = q.widened(y.speed(f.A, D, sin), f.errors[0]), abs(y.a) + y.a_error + k
    left = q.size(y.place(f, D, cos))
    e, e_all = q.root(s, K, left, left + y.influence(f, f.ref + q.first(D), q.rest(D)))
    ends = q.ends(q.widened(q.with_constant(d, near), e_all))
    # the next flight begins within 1.5 of [-pi, pi]: after the slow time of number -1
    need(ends[1] - ends[0] < 3, "the time of an event is not certain")
    y.since_start(f, ends[0])
    y.moving(f, ends[1])
    return Event(near, d, D, cos, sin, k, e, e_all, ends, s=q.widened(s, K * e_all))


def after_hit(y: Direction, f: Flight, h: Event) -> Flight:
    """Return the flight after a hit."""
    q, (c, D, tau) = y.q, balls(y, h)
    g = quotient((2 * c[0], 2 * c[1]), q.ball(h.s))
    j11, j12 = minus(_ONE, times(g, D)), (-g[0], g[1])
    J = j11, j12, minus(D, times(tau, j11)), minus(_ONE, times(tau, j12))
    ref, later = y.folded(h.near, q.widened(h.d, h.e))
    error = (abs(h.near) + abs(f.ref) + 16) * (y.a_error + 4 * TURN)
    twice = q.scaled(q.widened(h.sin, h.k * h.e), 2.0)
    A = q.moved(q.total(twice, f.A), y.a * (h.near - f.ref), error)
    cos = q.scaled(q.widened(h.cos, h.k * h.e), -1.0)
    B = q.moved(y.start(A, later, cos), -y.width[0], y.width[1])
    found = followed(y, f, h.ends, (h.near, ref), (A, B), J)
    return found._replace(slow=1 if found.begun[0] > sum(y.slow(0)) else 0)


def stop(y: Direction, f: Flight, guess: float, arc: int) -> Event:
    """Prove that the next event is a stop, close to a time, before the slow time of an arc."""
    q, (near, d) = y.q, stopping(y, f, guess)
    cos, sin = q.trigonometric(q.with_constant(d, near))
    D, k = since(y, f, near, d), q.bend(cos, sin)
    left, K = q.size(y.speed(f.A, D, sin)), abs(y.a) + y.a_error + k
    steep = q.moved(q.scaled(cos, -1.0), -y.a, y.a_error)
    e, e_all = q.root(steep, k, left, left + f.errors[0])
    ends = q.ends(q.widened(q.with_constant(d, near), e_all))
    need(ends[1] - ends[0] < 3, "the time of an event is not certain")
    slow, more = y.slow(arc)
    first = slow - 2 * (y.theta[0] - y.theta[1]) + more
    need(first < ends[0] and ends[1] < slow - more, "a stop may be in another arc")
    need(f.begun[1] < slow - more, "a flight may begin after the arc of a stop")
    y.moving(f, first)
    p = q.widened(y.place(f, D, cos), (left + K * e) * e * UP)
    p_all = q.widened(p, y.influence(f, f.ref + q.first(D), (q.rest(D) + e_all) * UP))
    need(q.ends(p_all)[1] < 0, "the mass may hit before it stops")
    return Event(near, d, D, cos, sin, k, e, e_all, ends, p=(p, p_all))


def after_turn(y: Direction, f: Flight, t: Event, p: Model) -> Flight:
    """Return the flight after a turn at a place."""
    q, (c, D, tau) = y.q, balls(y, t)
    a = y.a, y.a_error
    j11 = quotient(minus(a, c), minus(c, (-a[0], a[1])))
    J = j11, _NONE, minus(minus(_NONE, D), times(tau, j11)), (-1.0, 0.0)
    ref, later = y.folded(t.near, q.widened(t.d, t.e))
    A = y.from_rest(later, q.widened(t.sin, t.k * t.e))
    ahead = q.moved(q.scaled(p, -1.0), -y.width[0], y.width[1])
    B = q.total(ahead, y.start(A, later, q.scaled(q.widened(t.cos, t.k * t.e), -1.0)))
    return followed(y, f, t.ends, (t.near, ref), (A, B), J)


def balls(y: Direction, e: Event) -> tuple[Pair, Pair, Pair]:
    """Return numbers, and bounds of how far from them are the cosine, T - ref, T - pi - ref'."""
    q = y.q
    c, D = q.ball(q.widened(e.cos, e.k * e.e_all)), q.ball(q.widened(e.D, e.e_all))
    return c, D, q.ball(y.folded(e.near, q.widened(e.d, e.e_all))[1])
