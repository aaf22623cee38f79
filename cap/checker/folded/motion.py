"""The flow in both directions of time, for all states of a kind: see `cap.checker.folded.flights`.

A state depends on one variable or two: what is computed are models, of `cap.checker.kernel.line` or
of `cap.checker.kernel.polynomials`, two modules with the same functions.  For ``line`` all bounds
are those of a norm of functions and their derivatives.
"""

from __future__ import annotations

import math
from typing import Any

from cap.checker.folded.flights import Flight, Four, Model, carried
from cap.checker.folded.numbers import TURN, UP, Pair, shifted
from cap.checker.folded.scout import Middle, scout
from cap.checker.kernel import line, polynomials
from cap.checker.kernel.angles import cos_sin, of, rounded
from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.rounding import need_doubles
from cap.checker.system.flight import place, velocity
from cap.checker.system.walls import Parameters

_ARCS = 12  # of a flight
_BITS = 160
_NEAR = 1e-13  # more than the errors of the times here, all below 90


class Direction:
    """The constants of one direction of time, each a double with a bound of its error.

    ``theta`` is arccos a, ``rest`` is arccos |a|, ``sine`` that of both, ``q`` the module of the
    models.
    """

    q: Any = polynomials

    def __init__(self, p: Parameters, *, forwards: bool = False) -> None:
        need(p.f > 0 and p.e == 1 and p.mu == 0, "the folded flow needs f > 0, e = 1, mu = 0")
        need_doubles()
        a, self.a_error = rounded(p.f / p.F)
        self.a = -a if forwards else a
        self.width = rounded((p.r - p.l) * p.omega**2 / p.F)
        cosine, half = Interval.enclosing(p.f / p.F, p.f / p.F, _BITS), pi(_BITS)
        theta = arccos(cosine)
        self.rest, self.pi = of(theta), of(half)
        self.theta = of(half - theta) if forwards else self.rest
        self.sine = of((cosine.integer(1) - cosine.square()).sqrt())

    def slow(self, k: int) -> Pair:
        """Return the slow time of this number, and a bound of its error."""
        t = (2 * k - 1) * self.pi[0] + self.theta[0]
        return t, (2 * k + 1) * self.pi[1] + self.theta[1] + _NEAR

    def multiple(self, k: int) -> Pair:
        """Return a multiple of pi, and a bound of its error."""
        return k * self.pi[0], abs(k) * (self.pi[1] + TURN)

    def speed(self, A: Model, d: Model, sin: Model) -> Model:
        """Return s at the time ref + d with this sine."""
        return self.q.total(self.q.total(sin, self.q.scaled(d, self.a, self.a_error)), A)

    def place(self, f: Flight, d: Model, cos: Model) -> Model:
        """Return p, without errors, at the time ref + d with this cosine."""
        q = self.q
        ahead = q.product(d, q.total(q.scaled(d, self.a / 2, self.a_error), f.A))
        return q.total(q.scaled(cos, -1.0), q.total(ahead, f.B))

    def start(self, A: Model, d: Model, cos: Model) -> Model:
        """Return cos t - a d^2/2 - A d, t = ref + d, with this cosine: B, if p = 0 then."""
        q = self.q
        half = q.scaled(d, -self.a / 2, self.a_error)
        return q.total(cos, q.product(d, q.total(half, q.scaled(A, -1.0))))

    def from_rest(self, d: Model, minus_sin: Model) -> Model:
        """Return A, if s = 0 at the time ref + d; given minus its sine."""
        return self.q.total(minus_sin, self.q.scaled(d, -self.a, self.a_error))

    def at(self, f: Flight, t: float, e: float = 0.0) -> tuple[Model, Model]:
        """Return (p, s), without errors, at a time within e of t."""
        q, d = self.q, t - f.ref
        cos, sin = cos_sin(t)
        e += (abs(t) + abs(f.ref) + 1) * TURN
        error = (q.size(f.A) + abs(d) + 2) * e + self.a_error * abs(d)
        s = q.moved(f.A, velocity(0.0, d, -self.a, sin), error)
        p = q.total(q.scaled(f.A, d, e), f.B)
        return q.moved(p, place(0.0, 0.0, d, -self.a / 2, cos), error * (1 + abs(d))), s

    def states(self, f: Flight, t: float, e: float) -> tuple[Model, Model]:
        """Return (p, s) at a time within e of t."""
        p, s = self.at(f, t, e)
        p = self.q.widened(p, self.influence(f, t, e))
        return p, self.q.widened(s, f.errors[0])

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
            s = self.q.widened(self.at(f, t, e)[1], f.errors[0])
            need(self.q.ends(s)[0] > 0, "the mass may stop, or not")
        raise Rejected("a flight is too long")

    def since_start(self, f: Flight, low: float) -> None:
        """Prove that a hit, not before a time, is not before the start either.

        p < 0 and s >= 0 at the start, p = 0 and s > 0 at the hit: were it before the start, s would
        be negative at a minimum between, at a slow time.
        """
        need(low > self.slow(-1)[0] + 1, "a hit may be before the start")
        for t, e in map(self.slow, (0, 1)):
            between = low <= t + e and t - e <= f.begun[1]
            need(not between, "a hit may be before the start")

    def folded(self, near: float, d: Model) -> tuple[float, Model]:
        """Return ref in [-pi, pi] and d' with near + d - pi = ref + d', modulo 2 pi."""
        k = 1 + 2 * round((near - math.pi) / (2 * math.pi))
        ref = near - k * self.pi[0]
        return ref, self.q.widened(d, (abs(near) + 8) * TURN + abs(k) * (self.pi[1] + 4 * TURN))


class Releases(Direction):
    """The flow forwards, of states that depend on one variable: the place of release."""

    q = line

    def __init__(self, p: Parameters) -> None:
        super().__init__(p, forwards=True)


def middle_of(y: Direction, f: Flight) -> Middle:
    """Return the flight in the middle of the region, nearly: it steers."""
    return Middle(-y.a, y.q.first(f.A), y.q.first(f.B), f.ref)


def upcoming(y: Direction, f: Flight) -> tuple[str, float, int]:
    """Return what comes next in the middle of the region, when, and in which arc: it steers."""
    slows = ((k, y.slow(k)[0]) for k in range(f.slow, _ARCS))
    return scout(middle_of(y, f), (f.begun[0] + f.begun[1]) / 2, slows, 2 * y.theta[0])


def since(y: Direction, f: Flight, near: float, d: Model) -> Model:
    """Return near + d - ref."""
    return y.q.moved(d, near - f.ref, (abs(near) + abs(f.ref)) * TURN)


def followed(
    y: Direction, f: Flight, ends: Pair, near: Pair, models: tuple[Model, Model], J: Four
) -> Flight:
    """Return the flight with models A, B after the flight f, the errors of which J carries.

    ``ends`` are the bounds of the time that ended f, ``near`` are near and the new ref.
    """
    A, B = models
    begun, q = shifted(ends, *near), y.q
    C, R, errors = carried((f.C, f.R, f.errors), J, (q.error(A), q.error(B)))
    passed = f.passed + round((near[0] - near[1]) / math.pi)
    return Flight(begun, near[1], q.exact(A), q.exact(B), C, R, errors, 1, passed)
