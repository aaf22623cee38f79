"""Half a period with one hit: sigma, of functions and of boxes of states.

Units F = omega = 1, walls at -a and a, alpha = f/F in (0, 1), x'' = cos t - alpha sgn x'.  From (x,
v), -a < x < a, v > 0, at the time 0, as long as v > 0,

    x(t) = x + vt + 1 - cos t - alpha t^2/2,        v(t) = v + sin t - alpha t.

*The hit.*  v(t) rises up to arccos alpha and then falls, up to a time beyond pi.  So on (0, pi) it
changes sign once at most, from + to -; as x(0) < a, x(t) = a has at most two roots there, and the
first is the one with v(t) >= 0.  If x(t) = a at t in (0, pi) with u = v(t) > 0, then v > 0 on [0,
t]: the mass hits the right wall at t, for the first time, with the speed u.

*The way back*, up to the time pi, d = pi - t: minus the state there is sigma(x, v) = (X, V),

    X = (u + sin t) d - 1 - cos t - alpha d^2/2 - a,        V = v + 2 sin t - alpha pi.

The speed is u + sin t - sin s - alpha (s - t) at the time s; it falls up to pi - arccos alpha and
then rises, so it is at least V - c, c = sqrt(1 - alpha^2) - alpha arccos alpha (the integral of cos
s - alpha over [0, arccos alpha]).  So if V > c it never vanishes; if X < a, too, the left wall is
not hit before pi.  As (x, v, t) -> (-x, -v, t + pi) is a symmetry, sigma can be applied again: two
half periods are the map over a period; in the second one the left wall is hit.

*Area.*  By t_x = -1/u and t_v = -t/u,

    D sigma = (1 d; 0 1) (1 0; k 1) (1 t; 0 1),     k = -2 cos t/u.

Each factor has determinant 1: this is where e = 1 and mu = 0 are used.  The flow is invertible, so
sigma is injective where V > c and |X| < a.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.fourier import Function, moved, root
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import place, velocity
from cap.checker.tori.invariant_curve import Vector

REFINED = 6  # steps of Newton's method for the hit of one state


class Hit(NamedTuple):
    """The time of a hit along a curve, a polynomial, with cosine and sine; and nearly 1/u."""

    time: Function
    cos: Function
    sin: Function
    inverse: Function

    @classmethod
    def of(cls, time: Function, inverse: Function) -> Hit:
        """Return it with cosine and sine."""
        return cls(time, *time.cos_sin(), inverse)


class Passage(NamedTuple):
    """sigma of functions, and t, d, k."""

    x: Function
    v: Function
    t: Function
    d: Function
    k: Function

    def tangent(self, w: Vector) -> Vector:
        """Return D sigma w, factor by factor."""
        p, q = w
        p = p + self.t * q
        q = q + self.k * p
        return p + self.d * q, q


class States(NamedTuple):
    """The states (x, v) + B y, |y_1|, |y_2| <= 1, for all numbers in the intervals."""

    x: Interval
    v: Interval
    B: tuple[tuple[Interval, Interval], tuple[Interval, Interval]]

    def range(self, row: int) -> Interval:
        """Return the interval of x, or of v."""
        reach = sum(b.magnitude().hi for b in self.B[row])
        middle = (self.x, self.v)[row]
        return Interval(middle.lo - reach, middle.hi + reach, middle.bits)


class Motion:
    """The laws, at one precision: alpha, a and the least V."""

    def __init__(self, alpha: Fraction, a: Fraction, bits: int) -> None:
        self.bits, self.pi = bits, pi(bits)
        self.alpha = Interval.enclosing(alpha, alpha, bits)
        self.a = Interval.enclosing(a, a, bits)
        root = (-self.alpha.square() + 1).sqrt()
        self.least = root - self.alpha * arccos(self.alpha)  # c
        self.floats = float(alpha), float(a)

    # functions

    def passage(self, hit: Hit, x: Function, v: Function) -> Passage:
        """Return sigma of all functions in x, v.

        Confirmed: for real ones 0 < t < pi and u > 0.  As 1/u exists, u has one sign.
        """
        p, cos, sin, inverse = hit
        circle = p.circle
        a = circle.constant(self.a)
        value = place(x + 1, v, p, self.alpha / 2, cos) - a

        def speed(e: int) -> Function:
            return velocity(v, p.with_error(e), self.alpha, moved((cos, sin), e)[1])

        t = root(p, value, speed, inverse)
        cos, sin = moved((cos, sin), t.error)
        u, d = speed(t.error), circle.constant(self.pi) - t
        k = cos * u.inverse_near(inverse) * -2
        reach, end = t.swing + t.error, self.pi.lo * circle.unit >> self.bits
        need(t.mean - reach > 0 and t.mean + reach < end, "a hit may not be in (0, pi)")
        need(u.mean > u.error, "a speed at a hit may not be positive")
        X = place(-a - cos, u + sin, d, self.alpha / 2, 1)
        V = velocity(v, circle.constant(self.pi), self.alpha, sin * 2)
        return Passage(X, V, t, d, k)

    # boxes

    def after(self, z: States) -> States:
        """Return states that contain sigma of these; all of them have the hit, and never stop.

        In mean value form: sigma of the middle, and D sigma over all states.
        """
        v = z.range(1)
        need(v.is_positive() and self.inside(z.range(0)), "a state may be outside")
        t = self.hit(z)
        cos, sin = cos_sin(t)
        u = velocity(v, t, self.alpha, sin)
        need(u.is_positive(), "a speed at a hit may not be positive")
        k, d = -cos * 2 / u, self.pi - t
        B = self.derivative(t, k, d, z.B)
        image = States(*self.of_middle(z, t), B)
        need(self.least.is_before(image.range(1)), "a velocity may vanish")
        need(self.inside(image.range(0)), "a mass may hit the left wall")
        return image

    def inside(self, x: Interval) -> bool:
        """Return whether -a < x < a."""
        return (-self.a).is_before(x) and x.is_before(self.a)

    def hit(self, z: States) -> Interval:
        """Return an interval in (0, pi) that contains the times of the hits of all states.

        A guess in doubles, confirmed: x(t) is below a at the lower end, and above at the upper end.
        x(t) of a state is affine in y.
        """
        t, width = self.guess(z)
        low, high = (self.number(end) for end in (t - width, t + width))
        need(low.is_positive() and high.is_before(self.pi), "a hit may not be in (0, pi)")
        for end, sign in ((low, -1), (high, 1)):
            reach = sum((b + c * end).magnitude().hi for b, c in zip(*z.B, strict=True))
            beyond = self.beyond(z, end) * sign
            need(beyond.lo > reach, "a hit may be elsewhere")
        return Interval(low.lo, high.hi, self.bits)

    def guess(self, z: States) -> tuple[float, float]:
        """Return, in doubles, where the hit of the middle is, and how far from it others are."""
        alpha, a = self.floats
        x, v = (float(c.midpoint().lower) for c in (z.x, z.v))
        reach = [[float(b.magnitude().upper) for b in row] for row in z.B]
        t = (a - x) / v
        for _ in range(30):
            speed = velocity(v, t, alpha, math.sin(t))
            need(abs(speed) > 1e-9 and abs(t) < 10, "no hit is found")
            t -= (place(x + 1, v, t, alpha / 2, math.cos(t)) - a) / speed
        far = sum(b + c * abs(t) for b, c in zip(*reach, strict=True)) / abs(speed)
        return t, 1.1 * far + 2 * far**2 + 1e-12

    def number(self, t: float) -> Interval:
        """Return a double exactly, or nearly."""
        need(math.isfinite(t), "no hit is found")
        return Interval.enclosing(Fraction(t), Fraction(t), self.bits)

    def beyond(self, z: States, t: Interval) -> Interval:
        """Return x(t) - a of the middle."""
        return place(z.x + 1, z.v, t, self.alpha / 2, cos_sin(t)[0]) - self.a

    def of_middle(self, z: States, t: Interval) -> tuple[Interval, Interval]:
        """Return sigma of the middle, whose hit is in t; Newton's method sharpens this first."""
        for _ in range(REFINED):
            middle, (_, sin) = t.midpoint(), cos_sin(t)
            slope = velocity(z.v, t, self.alpha, sin)
            t = t.intersection(middle - self.beyond(z, middle) / slope)
        cos, sin = cos_sin(t)
        V = velocity(z.v, t, self.alpha, sin * 2)
        X = place(-self.a - cos, V, self.pi - t, self.alpha / 2, 1)
        return X, velocity(z.v, self.pi, self.alpha, sin * 2)

    def derivative(
        self, t: Interval, k: Interval, d: Interval, B: tuple[tuple[Interval, Interval], ...]
    ) -> tuple[tuple[Interval, Interval], tuple[Interval, Interval]]:
        """Return D sigma B, with the product of the three factors."""
        below = k, k * t + 1
        above = d * below[0] + 1, t + d * below[1]
        rows = [(p * B[0][0] + q * B[1][0], p * B[0][1] + q * B[1][1]) for p, q in (above, below)]
        return rows[0], rows[1]


def cells(
    centre: tuple[Fraction, Fraction], M: list[list[Fraction]], h: Fraction, n: int, bits: int
) -> Iterator[States]:
    """Yield n^2 parallelograms that cover centre + M [-h, h]^2."""
    half = h / n

    def exact(q: Fraction) -> Interval:
        return Interval.enclosing(q, q, bits)

    B = [[exact(entry * half) for entry in row] for row in M]
    for i in range(n):
        for j in range(n):
            y = [(2 * m + 1) * half - h for m in (i, j)]
            x, v = (c + row[0] * y[0] + row[1] * y[1] for c, row in zip(centre, M, strict=True))
            yield States(exact(x), exact(v), ((B[0][0], B[0][1]), (B[1][0], B[1][1])))
