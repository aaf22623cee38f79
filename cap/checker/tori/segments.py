"""Segments of states carried over half periods with one hit, forward or backward, in doubles.

Units F = omega = 1, walls at -a and a, alpha = f/F in (0, 1), x'' = cos t - alpha sgn x'.  A state
is one at a time n pi, in the mirror image (x, v, t) -> (-x, -v, t + pi) for odd n.

*Both senses.*  Read backward, y(s) = -x(-s), a motion has y'' = -cos s + alpha sgn y'.  So with e =
1 forward, e = -1 backward and y = e x, as long as y' > 0,

    y(s) = y + vs + e (1 - cos s - alpha s^2/2),        y'(s) = v + e (sin s - alpha s),

and after a hit of the wall a at t with the speed u, with the speed w, as long as w > 0,

    w(s) = u + e (sin t - sin s - alpha (s - t)),   Y = u d + e (d sin t - 1 - cos t - alpha d^2/2)
    - a,       V = v + e (2 sin t - alpha pi),      d = pi - t,

where (Y, V) is minus the state at pi: the next one.  Let b = arccos alpha, c = sin b - alpha b.
sin s - alpha s rises up to b and then falls, up to a time beyond pi; its maximum is c.

*Forward* (e = 1), v > 0.  If y(t) = a, 0 < t < pi and u > 0, this is the first hit (y' rises, then
falls).  After it w falls up to pi - b, where it is V - c, and then rises.  So if V > c and Y < a,
nothing else happens before pi.  If V <= c and t < pi - b, w has a zero s_0 <= pi - b; on [s_0, pi -
b] w >= V - c, so that at s_0 the mass is at most (c - V)(pi - b) farther to the left than what the
formula has at pi - b, -Y + V b - k, k = 1 - alpha - alpha b^2/2.  So if

    Y + k + c (pi - b) - V pi < a,

the left wall is not hit before s_0: the velocity vanishes.

*Backward* (e = -1).  From a state with 0 < v <= c the velocity vanishes at a time s_1 <= b, if no
wall is hit before; y(s_1) <= y(b) + (c - v) b = y + c b - k.  So it does if

    y + c b - k < a.

If v > c, y' > 0 up to pi, as it falls up to b and then rises.  After the hit w rises up to pi - b,
and then falls: if V > 0 and Y < a, nothing else happens before pi.  If V <= 0, w has a zero after
pi - b, within b of pi, and |w| <= |V| from there on: if Y - V b < a, no wall is hit before.

*Segments.*  m + T r + Q s, |r| <= 1, |s_i| <= r_i: m and T are the middle and half of a segment,
exactly, Q = (p -q; q p) is nearly a rotation, and s takes the errors.  The image is that of m, by
the mean value theorem, plus the derivative over all states times T r + Q s:

    D = (1 d; 0 1) (1 0; k 1) (1 t; 0 1),     k = -2 e cos t/u.

The next T is the middle of D T; what differs is added to s, in the axes of the next Q: along
the longer side of what D makes of Q s, and across.  Where some of the states have stopped, the
others are still in the image: the formulas hold for them, and are evaluated for all.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.doubles import GROWTH, PI, TINY, Double, cos_sin, enclosing
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import place, velocity

Vector = tuple[Double, Double]
NEWTON = 30
PART = 1e-12  # of a guess, that is added to its width


class Segment(NamedTuple):
    """The states m + T r + Q s: m = (y, v), T = (dy, dv), Q = (p -q; q p), |s| <= (r1, r2)."""

    y: float
    v: float
    dy: float
    dv: float
    p: float = 1.0
    q: float = 0.0
    r1: float = 0.0
    r2: float = 0.0

    @classmethod
    def between(cls, first: Vector, second: Vector) -> Segment:
        """Return states that contain the segments from all first to all second ones."""
        middle = [(a + b) * 0.5 for a, b in zip(first, second, strict=True)]
        half = [(b - a) * 0.5 for a, b in zip(first, second, strict=True)]
        error = max((m.rad + h.rad) * GROWTH for m, h in zip(middle, half, strict=True))
        (y, v), (dy, dv) = middle, half
        return cls(y.mid, v.mid, dy.mid, dv.mid, 1.0, 0.0, error, error)

    def reach(self, a: float, b: float) -> float:
        """Return a bound of |a y + b v| over T r + Q s; sums of two products cancel at times."""
        along = abs(a * self.dy) + abs(b * self.dv)
        exact = abs(a * self.dy + b * self.dv)
        across = abs(a * self.p + b * self.q) * self.r1 + abs(b * self.p - a * self.q) * self.r2
        slack = (abs(a) + abs(b)) * (abs(self.p) + abs(self.q)) * (self.r1 + self.r2)
        return ((exact + across) + (along + slack) * 2.0**-50 + TINY) * GROWTH

    def direction(self) -> tuple[float, float]:
        """Return a vector, of nearly the length 1, in which it is long: that of T, or of Q."""
        size = math.hypot(self.dy, self.dv)
        return (self.dy / size, self.dv / size) if size > self.r1 else (self.p, self.q)

    def ranges(self) -> Vector:
        """Return the intervals of y and of v."""
        return Double(self.y, self.reach(1.0, 0.0)), Double(self.v, self.reach(0.0, 1.0))


class Sense:
    """The laws in one sense of time: ``sign`` is 1 forward, -1 backward."""

    def __init__(self, alpha: Fraction, a: Fraction, sign: float) -> None:
        self.sign, self.alpha, self.a = sign, enclosing(alpha), enclosing(a)
        self.drag, self.half = self.alpha * sign, self.alpha * (sign / 2)
        self.floats = float(alpha), float(a)
        self.b = _arccos(self.alpha)
        self.c = cos_sin(self.b)[1] - self.alpha * self.b
        self.wait = PI - self.b
        fallen = self.alpha * self.b * self.b * 0.5  # alpha b^2/2
        k = -self.alpha - fallen + 1.0
        self.ahead = k + self.c * self.wait  # + Y - V pi
        self.behind = self.c * self.b - k  # + Y

    def stopped(self, z: Segment) -> bool:
        """Return whether all states of a segment that has come here certainly stop."""
        return z.ranges()[1].upper < self.c.lower

    def begin(self, z: Segment) -> None:
        """Confirm that the states are between the walls, and those with v <= c stop backward."""
        y, v = z.ranges()
        need((self.a - y).is_positive() and (self.a + y).is_positive(), "a state is beyond a wall")
        if self.sign < 0:
            self._stop(y, v, v)

    def after(self, z: Segment) -> Segment:
        """Return the states half a period later, of those that have not stopped.

        Confirmed: all others have, and these have hit one wall once.
        """
        v = z.ranges()[1]
        need(v.is_positive(), "a state is not one with a positive velocity")
        guess = self._guess(z)
        defect, t, u = self._hit(z, v, guess)
        image = self._middle(z, Double(guess) - defect / u)
        k, d = cos_sin(t)[0] * (-2 * self.sign) / u, PI - t
        columns = [_column(*column, t, k, d) for column in ((z.dy, z.dv), (z.p, z.q), (-z.q, z.p))]
        result = _moved(z, image, columns)
        Y, V = result.ranges()
        self._stop(Y, V, t)
        return result

    def _stop(self, Y: Double, V: Double, t: Double) -> None:
        """Confirm that the states with V <= c stop, and the others hit no second wall."""
        need((self.a - Y).is_positive(), "a second wall may be hit")
        if V.lower > self.c.upper:
            return
        if self.sign > 0:
            need((self.wait - t).is_positive(), "a hit may be too late for a stop")
            place = self.ahead + Y - PI * V.lower
        else:
            place = self.behind + Y
            need((self.a - Y + self.b * min(V.lower, 0.0)).is_positive(), "a wall may be hit")
        need((self.a - place).is_positive(), "a wall may be hit before a stop")

    def _guess(self, z: Segment) -> float:
        """Return, in doubles, when m hits the wall."""
        (alpha, a), e = self.floats, self.sign
        t = math.acos(alpha) if e > 0 else (a - z.y) / z.v  # the greatest speed, or the first
        for _ in range(NEWTON):
            speed = velocity(z.v, t, e * alpha, e * math.sin(t))
            need(abs(speed) > 1e-9 and abs(t) < 10, "no hit is found")
            step = (place(z.y + e, z.v, t, e * alpha / 2, e * math.cos(t)) - a) / speed
            t -= step
            if abs(step) < 1e-14:
                break
        return t

    def _hit(self, z: Segment, v: Double, guess: float) -> tuple[Double, Double, Double]:
        """Return y - a of m at the guess, the times of the hits of all states, and their speeds.

        Newton's interval method: y(t) - a at the guess, over the speed at all times near it.
        """
        t, e = Double(guess), self.sign
        cos, sin = cos_sin(t)
        defect = place(Double(z.y) + e, Double(z.v), t, self.half, cos * e) - self.a
        all_states = defect.widened(z.reach(1.0, guess))
        far = all_states.magnitude
        speed = abs(velocity(z.v, guess, self.drag.mid, e * sin.mid))
        need(speed > 0, "no hit is found")
        near = Double(guess, 1.2 * far / speed + 16 * far * far + PART)
        u = self._speed(v, near)
        need(u.is_positive(), "a speed at a hit may not be positive")
        moved = all_states / u
        need(moved.magnitude < near.rad, "a hit may be elsewhere")
        times = t.widened(moved.magnitude)  # with the guess: the defect of m is from there
        need(times.is_positive() and (PI - times).is_positive(), "a hit may not be in (0, pi)")
        return defect, times, self._speed(v, times)

    def _speed(self, v: Double, t: Double) -> Double:
        """Return y'(t)."""
        return velocity(v, t, self.drag, cos_sin(t)[1] * self.sign)

    def _middle(self, z: Segment, t: Double) -> Vector:
        """Return the image of m, which hits the wall at t."""
        e, d = self.sign, PI - t
        cos, sin = cos_sin(t)
        v, twice = Double(z.v), sin * (2.0 * e)
        V = velocity(v, t, self.drag, twice)
        Y = place(-self.a - cos * e, V, d, self.half, e)
        return Y, velocity(v, PI, self.drag, twice)


def _column(p: float, q: float, t: Double, k: Double, d: Double) -> Vector:
    """Return D (p, q)."""
    above = t * q + p
    below = k * above + q
    return above + d * below, below


def _moved(z: Segment, image: Vector, columns: list[Vector]) -> Segment:
    """Return what contains the image plus D T r + D Q s, given the image of m, D T and D Q."""
    (dy, dv), first, second = columns
    errors = [(m.rad + T.rad) * GROWTH for m, T in zip(image, (dy, dv), strict=True)]
    p, q = _axis(first, z.r1, second, z.r2)
    square = Double(p) * p + Double(q) * q
    radii = []
    for a, b in ((p, q), (-q, p)):  # rows of Q^-1, times its determinant
        parts = [((c[0] * a + c[1] * b) / square).magnitude for c in (first, second)]
        error = (abs(a) * errors[0] + abs(b) * errors[1]) * GROWTH
        error = (Double(error) / square).magnitude
        radii.append((parts[0] * z.r1 + parts[1] * z.r2 + error) * GROWTH)
    return Segment(image[0].mid, image[1].mid, dy.mid, dv.mid, p, q, *radii)


def _axis(first: Vector, r1: float, second: Vector, r2: float) -> tuple[float, float]:
    """Return, nearly, the direction of the longer one of two vectors."""
    one, two = (math.hypot(c[0].mid, c[1].mid) for c in (first, second))
    c, size = (first, one) if one * r1 >= two * r2 else (second, two)
    need(0 < size < math.inf, "a derivative is no number")
    return c[0].mid / size, c[1].mid / size


def _arccos(y: Double) -> Double:
    """Return the arccosine of numbers in (0, 1): a guess b, and (cos b - y)/sin of what is near."""
    guess = math.acos(y.mid)
    cos, _ = cos_sin(Double(guess))
    defect = cos - y
    near = Double(guess, 4 * defect.magnitude / math.sin(guess) + PART)
    moved = defect / cos_sin(near)[1]
    need(moved.magnitude < near.rad, "an arccosine is not found")
    return Double(guess) + moved
