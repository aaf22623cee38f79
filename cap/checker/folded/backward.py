"""The flow backwards in time, folded by its symmetry, for all states of a region.

*Units and folding* are those of `cap.checker.folded.flights`.  Backwards, with t for -t, friction
drives: x'' = cos t + a sgn x'.  While the mass moves to the right, the wall ahead at p = 0,

    s(t) = sin t + a d + A,      p(t) = -cos t + a d^2/2 + A d + B,      d = t - ref,

s' = cos t + a.  Let theta = arccos a.  s has its minima at the *slow* times 2 pi k - (pi - theta),
and decreases in the arcs (pi - theta, pi + theta) modulo 2 pi only: so a mass that stops does so in
these arcs, where |cos t| > a: it turns, and never sticks.  Only what has just stuck begins at rest
elsewhere.

*Hits and stops* are found as in `cap.checker.folded.hits` and `stops`, with -a for a: T is a
polynomial, and what p or s leave there bounds the error of the time.  As |s'| <= 1 + a < 2: if s >=
m > 0 and |p| <= g at T, and 2 g/m < m/4, p vanishes once within 2 g/m of T.  If -cos t - a >= m > 0
and |s| <= g at T, and 2 g/m < m/2, s vanishes within 2 g/m of T.

*After a hit* at T, with s then: A' = 2 sin T + A + a (ref' + pi - ref), B' = -W - cos T - a d'^2/2
- A' d', d' = T - pi - ref'.  *After a turn* at T: A' = sin T - a d', B' = -W - p - cos T - a d'^2/2
- A' d'.  With dT = -(d dA + dB)/s or -dA/(cos T + a):

    hit:    dA' = dA - (2 cos T/s) (d dA + dB),              dB' = d dA + dB - d' dA'
    turn:   dA' = -(cos T - a)/(cos T + a) dA,               dB' = -(d dA + dB) - d' dA'

*Areas.*  The states at one time have the area of the integral of a density over the region from
which they come: for states at rest at the places q and the times t, of |s'| dq dt.  A hit keeps it;
a turn multiplies it by (a - cos T)/(-a - cos T), what |s'| is after it and before it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from cap.checker.folded.flights import Four, carried, constants
from cap.checker.folded.numbers import TURN, UP, Pair, middle, minus, quotient, times, zero
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.polynomials import LAST, Model
from cap.checker.kernel.quadratic import cos_sin
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.theorem import Parameters

_ARCS = 6  # of a flight
_NEAR = 1e-13  # more than the errors of the times here, all below 50
_NONE, _ONE = (0.0, 0.0), (1.0, 0.0)


class Flight(NamedTuple):
    """A flight: bounds of its start, ref, A, B, C, R, bounds of the errors of A and B.

    As in `cap.checker.folded.flights`.  ``slow`` is the number of the first slow time that counts,
    ``density`` that of the area, ``passed`` how many multiples of pi its times have been shifted.
    """

    begun: Pair
    ref: float
    A: Model
    B: Model
    C: tuple[float, float, float, float]
    R: Pair
    errors: Pair
    slow: int
    density: Model
    passed: int


class Event(NamedTuple):
    """A hit or a turn: bounds of its time, of the speed then, and the flight after it."""

    ends: Pair
    speed: float
    after: Flight


class System:
    """The constants, each a double with a bound of its error."""

    def __init__(self, p: Parameters) -> None:
        known = constants(p)
        self.a, self.a_error = known.a
        self.width, self.theta, self.pi, self.sine = known[1:]

    def slow(self, k: int) -> Pair:
        """Return the slow time of this number, and a bound of its error."""
        t = (2 * k - 1) * self.pi[0] + self.theta[0]
        return t, (2 * k + 1) * self.pi[1] + self.theta[1] + _NEAR

    def speed(self, A: Model, d: Model, sin: Model) -> Model:
        """Return s at the time ref + d with this sine."""
        return q.total(q.total(sin, q.scaled(d, self.a, self.a_error)), A)

    def place(self, f: Flight, d: Model, cos: Model) -> Model:
        """Return p, without errors, at the time ref + d with this cosine."""
        ahead = q.product(d, q.total(q.scaled(d, self.a / 2, self.a_error), f.A))
        return q.total(q.scaled(cos, -1.0), q.total(ahead, f.B))

    def start(self, A: Model, d: Model, cos: Model) -> Model:
        """Return -cos t - a d^2/2 - A d with this cosine of t: B, but for p."""
        half = q.scaled(d, -self.a / 2, self.a_error)
        return q.total(cos, q.product(d, q.total(half, q.scaled(A, -1.0))))

    def at(self, f: Flight, t: float, e: float = 0.0) -> tuple[Model, Model]:
        """Return (p, s), without errors, at a time within e of t."""
        cos, sin = cos_sin(t)
        d = t - f.ref
        e += (abs(t) + abs(f.ref) + 1) * TURN
        error = (q.size(f.A) + abs(d) + 2) * e + self.a_error * abs(d)
        s = q.moved(f.A, sin + self.a * d, error)
        p = q.total(q.scaled(f.A, d, e), f.B)
        return q.moved(p, -cos + self.a * d * d / 2, error * (1 + abs(d))), s

    def influence(self, f: Flight, t: float, e: float) -> float:
        """Return a bound of A d + B for the errors A, B, at a time within e of t."""
        (c11, c12, c21, c22), (r1, r2) = f.C, f.R
        d = t - f.ref
        p = abs(d * c11 + c21) * r1 + abs(d * c12 + c22) * r2
        e += (abs(t) + abs(f.ref)) * TURN
        return (p + (e + abs(d) * TURN) * f.errors[0] + f.errors[1] * TURN) * UP

    def moving(self, f: Flight, until: float) -> None:
        """Prove that s > 0 from the start to a time, if it is so there."""
        for k in range(f.slow, _ARCS):
            t, e = self.slow(k)
            if t - e > until:
                return
            s = q.widened(self.at(f, t, e)[1], f.errors[0])
            need(q.ends(s)[0] > 0, "the mass may stop, or not")
        raise Rejected("a flight is too long")

    def folded(self, near: float, d: Model) -> tuple[float, Model]:
        """Return ref in [-pi, pi] and d' with near + d - pi = ref + d', modulo 2 pi."""
        k = 1 + 2 * round((near - math.pi) / (2 * math.pi))
        ref = near - k * self.pi[0]
        return ref, q.widened(d, (abs(near) + 8) * TURN + abs(k) * (self.pi[1] + 4 * TURN))


def scout(y: System, f: Flight) -> tuple[str, float, int]:
    """Return what comes next in the middle of the region, when, and in which arc: it steers."""
    a, A, B, ref = y.a, f.A[0], f.B[0], f.ref

    def s(t: float) -> float:
        return math.sin(t) + a * (t - ref) + A

    def ahead(t: float) -> float:
        d = t - ref
        return math.cos(t) - d * (A + a * d / 2) - B

    low = (f.begun[0] + f.begun[1]) / 2
    for k in range(f.slow, _ARCS):
        slow = y.slow(k)[0]
        if slow <= low:
            continue
        high, kind = slow, "hit"
        if s(slow) <= 0:
            high, kind = zero(s, max(low, slow - 2 * y.theta[0]), slow), "turn"
        if ahead(high) <= 0:
            return "hit", zero(ahead, low, high), k
        if kind == "turn":
            return kind, high, k
        low = slow
    raise Rejected("a flight is too long")


def event(y: System, f: Flight) -> Event:
    """Prove what comes next, for all orbits."""
    kind, near, k = scout(y, f)
    return hit(y, f, near) if kind == "hit" else turn(y, f, near, k)


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
    y.moving(f, ends[1])
    least, most = least - 2 * e_all, most + 2 * e_all
    c, tau, d_all = (middle(q.ends(q.widened(z, e_all + lag))) for z in (cos, d, D))
    g = quotient((2 * c[0], 2 * c[1]), middle((least, most)))
    j11 = minus(_ONE, times(g, d_all))
    j12 = -g[0], g[1]
    J = j11, j12, minus(d_all, times(tau, j11)), minus(_ONE, times(tau, j12))
    ref, later = y.folded(near, q.widened(d, e + lag))
    error = (abs(near) + abs(f.ref) + 16) * (y.a_error + 4 * TURN)
    A = q.moved(q.total(q.scaled(q.widened(sin, e), 2.0), f.A), y.a * (near - f.ref), error)
    B = q.moved(y.start(A, later, q.scaled(q.widened(cos, e), -1.0)), -y.width[0], y.width[1])
    after = followed(f, ends, (near, ref), (A, B), J)
    slow = 1 if after.begun[0] > sum(y.slow(0)) else 0
    return Event(ends, most, after._replace(slow=slow))


def hitting(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that p vanishes at near + d, nearly: by Newton's method."""
    p, s = y.at(f, near)
    d = q.exact(q.scaled(q.product(p, q.inverse(s)), -1.0))
    for _ in range(2):
        cos, sin = q.trigonometric(q.with_constant(d, near + d[0]))
        D, _lag = since(f, near, d)
        step = q.product(y.place(f, D, cos), q.inverse(y.speed(f.A, D, sin)))
        d = q.exact(q.total(d, q.scaled(step, -1.0)))
    return d


def turn(y: System, f: Flight, near: float, k: int) -> Event:
    """Prove that the next event is a turn, close to a time, before the slow time k."""
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
    c, tau, d_all = (middle(q.ends(q.widened(z, e_all + lag))) for z in (cos, d, D))
    a = y.a, y.a_error
    j11 = quotient(minus(a, c), (c[0] + a[0], (c[1] + a[1] + TURN) * UP))
    J = j11, _NONE, minus(minus(_NONE, d_all), times(tau, j11)), (-1.0, 0.0)
    ref, later = y.folded(near, q.widened(d, e + lag))
    A = q.total(q.widened(sin, e), q.scaled(later, -y.a, y.a_error))
    ahead = q.moved(q.scaled(p, -1.0), -y.width[0], y.width[1])
    B = q.total(ahead, y.start(A, later, q.scaled(q.widened(cos, e), -1.0)))
    density = denser(y, f.density, q.widened(cos, e_all))
    return Event(ends, 0.0, followed(f, ends, (near, ref), (A, B), J)._replace(density=density))


def stopping(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that s vanishes at near + d, nearly: by Newton's method."""
    slope = cos_sin(near)[0] + y.a
    need(slope < 0, "a stop is not transversal")
    d = q.exact(q.scaled(y.at(f, near)[1], -1 / slope))
    for _ in range(2):
        cos, sin = q.trigonometric(q.with_constant(d, near + d[0]))
        D, _lag = since(f, near, d)
        step = q.product(y.speed(f.A, D, sin), q.inverse(q.moved(cos, y.a, y.a_error)))
        d = q.exact(q.total(d, q.scaled(step, -1.0)))
    return d


def denser(y: System, density: Model, cos: Model) -> Model:
    """Return the density of areas after a turn at a time with this cosine."""
    minus_cos = q.scaled(cos, -1.0)
    before = q.inverse(q.moved(minus_cos, -y.a, y.a_error))
    return q.product(density, q.product(q.moved(minus_cos, y.a, y.a_error), before))


def since(f: Flight, near: float, d: Model) -> tuple[Model, float]:
    """Return near + d - ref, and a bound of the rounding of near + d."""
    lag = (abs(near) + abs(f.ref)) * TURN
    return q.moved(d, near - f.ref, lag), lag


def shifted(ends: Pair, near: float, ref: float) -> Pair:
    """Return bounds of the times that begin a flight, from those that ended the last one."""
    shift, e = near - ref, 8 * TURN * (abs(near) + 8)
    return ends[0] - shift - e, ends[1] - shift + e


def followed(f: Flight, ends: Pair, times: Pair, models: tuple[Model, Model], J: Four) -> Flight:
    """Return the flight with models A, B after the flight f, the errors of which J carries.

    ``ends`` are the bounds of the time that ended f, ``times`` are near and the new ref.
    """
    A, B = models
    begun = shifted(ends, *times)
    C, R, errors = carried((f.C, f.R, f.errors), J, (A[LAST], B[LAST]))
    passed = f.passed + round((times[0] - times[1]) / math.pi)
    polynomials = q.exact(A), q.exact(B)
    return Flight(begun, times[1], *polynomials, C, R, errors, 1, f.density, passed)
