"""Flights between two walls, folded by the symmetry of the system, for all orbits from a box.

*Units.*  Time 1/omega, length F/omega^2: x'' = cos t - a sgn x', a = f/F in (0, 1), and the walls
are W = (r - l) omega^2/F apart; e = 1, mu = 0.

*Folding.*  The flow commutes with (x, v, t) -> (l + r - x, -v, t + pi).  So a flight to the left is
described as one to the right, its time shifted by pi; and after a hit or a turn the next flight has
its time shifted by pi.  What remains is the distance p <= 0 to the wall ahead, negative: p becomes
-W by a hit, and -W - p by a turn.  Times count modulo 2 pi.

*A flight* has the speed s >= 0 and the distance p,

    s(t) = sin t - a d + A,      p(t) = -cos t - a d^2/2 + A d + B,      d = t - ref,

s' = cos t - a.  Let theta = arccos a.  s has its minima at the *slow* times 2 pi k - theta, its
maxima at 2 pi k + theta.  So s > 0 after the start up to a time if s >= 0 at the start and s > 0
there and at the slow times between; and as long as that holds, p increases.

*Errors.*  A = A_0(X, Y) + u, B = B_0(X, Y) + w with polynomials A_0, B_0 over [-1, 1]^2, and (u, w)
= C n, |n_1| <= R_1, |n_2| <= R_2, C nearly a rotation.  The map to the next flight is
differentiable; by the mean value theorem its image of (A, B) differs from that of (A_0, B_0) by J C
n, with J in the hull of the derivatives.  The images of (A_0, B_0) are polynomials and errors
(z_1, z_2).  The new C has the longer column of J C in its first direction, and its inverse is its
transposed up to 2^-49.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.folded.numbers import TURN, UP, Pair
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.elementary import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.line import Coefficients
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.theorem import Parameters

_BITS = 160
ARCS = 12  # of a flight
Four = tuple[Pair, Pair, Pair, Pair]
IDENTITY: Four = ((1.0, 0.0), (0.0, 0.0), (0.0, 0.0), (1.0, 0.0))


class Flight(NamedTuple):
    """A flight: bounds of its start, ref, A_0, B_0, C, R, bounds of the errors of A and B.

    ``slow`` is the number k of the first slow time that counts.
    """

    begun: Pair
    ref: float
    A: Model
    B: Model
    C: tuple[float, float, float, float]
    R: Pair
    errors: Pair
    slow: int


class Path(NamedTuple):
    """A flight with A_0, B_0 in one variable, and errors that have derivatives: see ``paths``."""

    begun: Pair
    ref: float
    A: Coefficients
    B: Coefficients
    C: tuple[float, float, float, float]
    R: Pair
    errors: Pair
    slow: int


class System:
    """The constants, each a double with a bound of its error."""

    def __init__(self, p: Parameters) -> None:
        need(p.f > 0 and p.e == 1 and p.mu == 0, "the folded flow needs f > 0, e = 1, mu = 0")
        ieee = sys.float_info.mant_dig == 53 and sys.float_info.rounds == 1
        need(ieee, "doubles are not those of IEEE 754, rounded to nearest")
        alpha = p.f / p.F
        cosine = Interval.enclosing(alpha, alpha, _BITS)
        theta, half = arccos(cosine), pi(_BITS)
        self.a, self.a_error = q.rounded(alpha)
        self.width = q.rounded((p.r - p.l) * p.omega**2 / p.F)
        self.theta, self.pi = q.of(theta), q.of(half)
        self.sine = q.of((cosine.integer(1) - cosine.square()).sqrt())
        self.turns = {k: q.of(half * (2 * k)) for k in range(-2, ARCS + 3)}
        self.slows = {k: q.of(half * (2 * k) - theta) for k in range(ARCS + 3)}
        self.first, self.last = q.of(half - theta), q.of(half + theta)  # turns are between them

    def speed(self, A: Model, d: Model, sin: Model) -> Model:
        """Return s at the time ref + d with this sine."""
        return q.total(q.total(sin, q.scaled(d, -self.a, self.a_error)), A)

    def place(self, f: Flight, d: Model, cos: Model) -> Model:
        """Return p, without errors, at the time ref + d with this cosine."""
        drag = q.scaled(d, -self.a / 2, self.a_error)
        ahead = q.total(q.product(d, q.total(drag, f.A)), f.B)
        return q.total(q.scaled(cos, -1.0), ahead)

    def start(self, A: Model, d: Model, cos: Model) -> Model:
        """Return cos t + a d^2/2 - A d: B, but for p."""
        half = q.scaled(d, self.a / 2, self.a_error)
        return q.total(cos, q.product(d, q.total(half, q.scaled(A, -1.0))))

    def at(self, f: Flight, time: Pair, cos: float, sin: float) -> tuple[Model, Model]:
        """Return (p, s), without errors, at a time t; cos and sin are wrong by 2^-50 + its error.

        d is wrong by e; what is computed from it, by at most e times the size of its derivative.
        """
        t, e = time
        d = t - f.ref
        e += (abs(t) + abs(f.ref)) * TURN
        size = q.bound(f.A) + abs(d) + 2
        error = size * (e + TURN) + self.a_error * abs(d)
        s = q.moved(f.A, sin - self.a * d, error)
        p = q.total(q.scaled(f.A, d, e), f.B)
        return q.moved(p, -cos - self.a * d * d / 2, error * (1 + abs(d))), s

    def influence(self, f: Flight, time: Pair) -> float:
        """Return a bound of A d + B for the errors A, B, at a time t."""
        (c11, c12, c21, c22), (r1, r2) = f.C, f.R
        d = time[0] - f.ref
        p = abs(d * c11 + c21) * r1 + abs(d * c12 + c22) * r2
        e = time[1] + (abs(time[0]) + abs(f.ref)) * TURN
        return (p + (e + abs(d) * TURN) * f.errors[0] + f.errors[1] * TURN) * UP

    def seen(self, f: Flight, time: Pair, cos: float, sin: float) -> tuple[Model, Model]:
        """Return (p, s) at a time, with errors."""
        p, s = self.at(f, time, cos, sin)
        return q.widened(p, self.influence(f, time)), q.widened(s, f.errors[0])

    def slow_time(self, k: int) -> Pair:
        """Return the slow time of this number; its error covers those of its cosine and sine."""
        t, e = self.slows[k]
        return t, e + self.a_error + self.sine[1]

    def at_slow(self, f: Flight, k: int) -> tuple[Model, Model]:
        """Return (p, s) at the slow time of number k, with errors."""
        return self.seen(f, self.slow_time(k), self.a, -self.sine[0])

    def moving(self, f: Flight, until: float) -> None:
        """Prove that s > 0 from the start to a time, if it is so there."""
        for k in range(f.slow, ARCS):
            if self.slows[k][0] - self.slows[k][1] > until:
                return
            need(q.ends(self.at_slow(f, k)[1])[0] > 0, "the mass may stop, or not")
        raise Rejected("a flight is too long")

    def since(self, f: Flight, near: float, d: Model) -> tuple[Model, float]:
        """Return near + d - ref, and a bound of the rounding of near + d."""
        lag = (abs(near) + abs(f.ref)) * TURN
        return q.moved(d, near - f.ref, lag), lag

    def folded(self, near: float, d: Model) -> tuple[float, Model]:
        """Return ref in [-pi, pi] and d' with near + d - pi = ref + d', modulo 2 pi."""
        ref = near - self.pi[0]
        k = round(ref / (2 * math.pi))
        need(k in self.turns, "a flight is too long")
        ref -= self.turns[k][0]
        return ref, q.widened(d, (abs(near) + 8) * TURN + self.pi[1] + self.turns[k][1])

    # starts

    def fresh(self, begun: Pair, ref: float, A: Model, B: Model) -> Flight:
        """Return the flight with models A, B."""
        errors = A[6], B[6]
        C = 1.0, 0.0, 0.0, 1.0
        return Flight(begun, ref, exact(A), exact(B), C, errors, errors, self.first_slow(begun))

    def first_slow(self, begun: Pair) -> int:
        """Return the number of the first slow time that may follow a start in [-pi, pi]."""
        return 1 if begun[0] > self.slows[0][0] + self.slows[0][1] else 0

    def launched(self, p: Model, s: Model, half: bool) -> Flight:
        """Return the flight from (p, s) at the time 0, or pi if ``half``."""
        ref, e = self.pi if half else (0.0, 0.0)
        B = q.moved(p, -1.0 if half else 1.0, 8 * e)
        return self.fresh((ref - e, ref + e), ref, q.widened(s, 2 * e), B)

    def released(
        self, p: Model, s: Model | None = None, spread: float = 0.0
    ) -> tuple[Pair, float, Model, Model]:
        """Return start, ref, A, B of the flight from p at the slow time, with the speed s there.

        Or from rest, at a time t_0 up to ``spread`` after it: as functions of t_0, dA/dt_0 = a -
        cos t_0, and dB/dt_0 = -(t_0 - ref) dA/dt_0, at most spread, and spread^2, in size.
        """
        t, e = self.slows[0]
        more = spread * spread / 2 * UP + 4 * TURN + 8 * (e + self.a_error) + self.sine[1]
        sine = self.sine[0]
        A = q.constant(sine, more) if s is None else q.moved(s, sine, more)
        B = q.moved(p, self.a, spread * more + 4 * TURN + 8 * (e + self.a_error))
        return (t - e, t + spread + e), t, A, B

    def rest(self, p: Model) -> Flight:
        """Return the flight of a release at p."""
        return self.fresh(*self.released(p))._replace(slow=1)


def exact(p: Model) -> Model:
    """Return the polynomial of a model."""
    return p[0], p[1], p[2], p[3], p[4], p[5], 0.0


def halved(f: Flight, along: int, side: float) -> Flight:
    """Return the flights from one half of a box."""
    A, B = q.half(f.A, along, side), q.half(f.B, along, side)
    C, R, errors = carried(f, IDENTITY, (A[6], B[6]))
    return f._replace(A=exact(A), B=exact(B), C=C, R=R, errors=errors)


def carried(
    f: Flight | Path, J: Four, z: Sequence[float]
) -> tuple[tuple[float, float, float, float], Pair, Pair]:
    """Return C, R and the bounds of the errors after a map with derivatives in J, and errors z."""
    (j11, k11), (j12, k12), (j21, k21), (j22, k22) = J
    c11, c12, c21, c22 = f.C
    (r1, r2), (ea, eb) = f.R, f.errors
    m11, m12 = j11 * c11 + j12 * c21, j11 * c12 + j12 * c22
    m21, m22 = j21 * c11 + j22 * c21, j21 * c12 + j22 * c22
    size = (abs(j11) + abs(j12) + abs(j21) + abs(j22)) * (ea + eb + r1 + r2) * TURN
    za = z[0] + k11 * ea + k12 * eb + size
    zb = z[1] + k21 * ea + k22 * eb + size
    longer = (m11 * m11 + m21 * m21) * r1 * r1 >= (m12 * m12 + m22 * m22) * r2 * r2
    u, w = (m11, m21) if longer else (m12, m22)
    length = math.hypot(u, w)
    u, w = (u / length, w / length) if length > 1e-100 else (1.0, 0.0)
    n1 = abs(u * m11 + w * m21) * r1 + abs(u * m12 + w * m22) * r2 + abs(u) * za + abs(w) * zb
    n2 = abs(u * m21 - w * m11) * r1 + abs(u * m22 - w * m12) * r2 + abs(u) * zb + abs(w) * za
    n1, n2 = (n1 + size) * UP, (n2 + size) * UP
    errors = (abs(u) * n1 + abs(w) * n2) * UP, (abs(w) * n1 + abs(u) * n2) * UP
    return (u, -w, w, u), (n1, n2), errors


def followed(
    y: System, f: Flight, begun: Pair, ref: float, models: tuple[Model, Model], J: Four
) -> Flight:
    """Return the flight with models A, B after the flight f, the errors of which J carries."""
    A, B = models
    C, R, errors = carried(f, J, (A[6], B[6]))
    return Flight(begun, ref, exact(A), exact(B), C, R, errors, y.first_slow(begun))
