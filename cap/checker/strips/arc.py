"""Arcs of launches, and their flights to the other wall.

Units: F = omega = 1.  A *launch* (t, E) leaves a wall at the time t with the speed u > 0, E =
u^2/2.  With s in [-1, 1] an *arc* is the curve t = t_0 + t_1 s, E = e_0 + e_1 s + e_2 s^2.

*A flight* over the distance R against the friction f (f < 0: backward in time) is that of
`cap.checker.system.flight` with X = cos t and V = u - sin t.

v has its local minima at T = 2 pi k - arccos f.  So v > 0 from t to T if it is at both ends and at
these times between them.  If then x(T) = R, T is when the other wall is hit, with the speed V =
v(T): in the mirror image (t, E) becomes (T + pi, V^2/2).

*Derivatives.*  On an arc, ' being d/ds, a = cos t - f, A = cos T - f, d = T - t,

    T' = N/V,   N = (u + d a) t' - d u',                     V' = u' + A T' - a t',
    T'' = (N' - V' T')/V,                                    V'' = u'' + A T'' + A' T' - a' t',
    N' = (u' + d' a + d a') t' - d' u' - d u'',              a' = -t' sin t,   A' = -T' sin T,

and at a fixed time T, v' = u' - a t', v'' = u'' + t'^2 sin t, x' = d u' - (u + d a) t',
x'' = d u'' - 2 t' u' + (a + d sin t) t'^2.

*Where T is.*  At s = 0 let r = |x(T_0) - R| for a guess T_0.  As |v'| <= 1 + |f| in time, v > V/2
within D = 2 r/V of T_0 if (1 + |f|) D <= V/2, so x = R within D.  It is after the launch, T > t,
which is looked at here; and so it is on all of an arc along which T is continuous, as x = 0 at t.
"""

from __future__ import annotations

import math
from functools import cached_property, lru_cache
from typing import NamedTuple

from cap.checker.kernel.doubles import PI, Double, cos_sin
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import place, velocity

SPAN = 40.0  # the longest flight that is followed


Taylor = tuple[Double, Double, Double]
"""Value and first derivative at s = 0, and second derivative over the whole arc."""


def least(z: Taylor) -> float:
    """Return a number below all values on the arc: z(s) >= z(0) - |z'(0)| + min(z'', 0)/2."""
    bend = 0.0 if z[2].lower >= 0 else z[2].lower / 2  # NaN stays NaN
    return (z[0] - z[1].magnitude + bend).lower


def negative(z: Taylor) -> Taylor:
    """Return -z."""
    return -z[0], -z[1], -z[2]


class Arc(NamedTuple):
    """t = t_0 + t_1 s, E = e_0 + e_1 s + e_2 s^2 for s in [-1, 1]."""

    t: Double
    dt: Double
    e: Double
    e1: Double
    e2: Double

    def halves(self) -> tuple[Arc, Arc]:
        """Return the arcs s <= 0 and s >= 0."""
        dt, e1, e2 = self.dt * 0.5, self.e1 * 0.5, self.e2 * 0.25
        slope = self.e2 * 0.5
        return (
            Arc(self.t - dt, dt, self.e - e1 + e2, e1 - slope, e2),
            Arc(self.t + dt, dt, self.e + e1 + e2, e1 + slope, e2),
        )


class Point(NamedTuple):
    """A launch and its derivatives along an arc, at one s or over all."""

    t: Double
    cos: Double
    sin: Double
    u: Double
    du: Double
    d2u: Double


def _point(t: Double, energy: Double, slope: Double, bend: Double) -> Point:
    """Return it: u = sqrt(2 E), u' = E'/u, u'' = (E'' - u'^2)/u."""
    u = (energy * 2.0).sqrt()
    du = slope / u
    return Point(t, *cos_sin(t), u, du, (bend - du * du) / u)


def everywhere(arc: Arc) -> Point:
    """Return what is known of all launches of an arc, or of arcs with intervals of coefficients."""
    bend = arc.e2 * 2.0
    reach = arc.e1.magnitude + arc.e2.magnitude
    t, slope = arc.t.widened(arc.dt.magnitude), arc.e1.widened(bend.magnitude)
    return _point(t, arc.e.widened(reach), slope, bend)


class Hit(NamedTuple):
    """When and how fast the other wall is hit at s = 0, with the derivatives of both."""

    T: Double
    V: Double
    T1: Double
    V1: Double


class Launches:
    """The launches of an arc, followed against the friction ``f`` to a wall at the distance R.

    ``all`` are these, or more of them, ``among`` which they are; the hit at s = 0 may be ``near`` a
    time: that steers only.
    """

    def __init__(
        self, arc: Arc, f: Double, R: Double, among: Point | None = None, near: float | None = None
    ) -> None:
        self.arc, self.dt, self.f, self.R, self.guess = arc, arc.dt, f, R, near
        self.near = _point(arc.t, arc.e, arc.e1, arc.e2 * 2.0)
        self.all = among or everywhere(arc)

    @cached_property
    def hit(self) -> Hit:
        """The hit at s = 0, or a rejection."""
        near, dt, T = self.near, self.dt, _hit(self)
        cos, sin = cos_sin(T)
        V = self.speed(near, T, sin)
        T1 = numerator(self, near, T) / V
        return Hit(T, V, T1, near.du + (cos - self.f) * T1 - (near.cos - self.f) * dt)

    def end(self, s: float) -> Launches:
        """Return the launch at s = -1 or 1."""
        t, dt, e, e1, e2 = self.arc
        none = Double(0.0)
        return Launches(Arc(t + dt * s, none, e + e1 * s + e2, none, none), self.f, self.R)

    def alone(self) -> Launches:
        """Return the launches of the arc, and no more."""
        self.all = everywhere(self.arc)
        return self

    def velocity(self, T: Double) -> Taylor:
        """Return v at a fixed time."""
        sin = cos_sin(T)[1]
        return self.speed(self.near, T, sin), self._slope(self.near), self._bend()

    def speed(self, at: Point, T: Double, sin: Double) -> Double:
        """Return v(T) at one s, or an interval for all; sin is that of T."""
        return velocity(at.u - at.sin, T - at.t, self.f, sin)

    def _slope(self, at: Point) -> Double:
        return at.du - (at.cos - self.f) * self.dt

    def _bend(self) -> Double:
        return self.all.d2u + self.dt * self.dt * self.all.sin

    def place(self, T: Double) -> Taylor:
        """Return x at a fixed time."""
        near, whole, dt = self.near, self.all, self.dt
        d, w = T - near.t, T - whole.t
        cos = cos_sin(T)[0]
        first = d * near.du - (near.u + d * (near.cos - self.f)) * dt
        turn = whole.cos - self.f + w * whole.sin
        second = w * whole.d2u - dt * whole.du * 2.0 + turn * dt * dt
        return self.way(T, cos), first, second

    def way(self, T: Double, cos: Double) -> Double:
        """Return x(T) at s = 0; cos is that of T."""
        at = self.near
        return place(at.cos, at.u - at.sin, T - at.t, self.f * 0.5, cos)

    def minima(self, low: float, high: float) -> list[Double]:
        """Return the times of the local minima of v that may be in [low, high]."""
        rest, margin = _arccos(self.f), 1e-9  # more than the rounding of these times, below 2000
        first = math.ceil((low + rest.lower - margin) / (2 * math.pi))
        last = math.floor((high + rest.upper + margin) / (2 * math.pi))
        return [PI * (2.0 * k) - rest for k in range(first, last + 1)]

    def moves(self, until: float) -> bool:
        """Return whether v > 0 at all its local minima from the launch to a time."""
        low = self.all.t.lower
        return all(least(self.velocity(T)) > 0 for T in self.minima(low, until))


@lru_cache(maxsize=16)  # by what it is, not by its value
def _arccos(y: Double) -> Double:
    """Return the arccosine, for |y| < 0.999: near a guess a, |arccos y - a| <= |cos a - y|/sin."""
    a = math.acos(y.mid)
    far = (cos_sin(Double(a))[0] - y).magnitude
    sine = cos_sin(Double(a, 2e-3))[1].lower  # over more than a and arccos y
    need(abs(y.mid) < 0.999 and sine > 0 and far < 1e-10 * sine, "f is too near F")
    return Double(a, far / sine * (1 + 1e-9))


def numerator(launches: Launches, at: Point, T: Double) -> Double:
    """Return N."""
    d = T - at.t
    return (at.u + d * (at.cos - launches.f)) * launches.dt - d * at.du


def _hit(launches: Launches) -> Double:
    """Return an interval around the time of the hit at s = 0."""
    at, f, R = launches.near, launches.f.mid, launches.R.mid
    guess = _guess(at.t.mid, at.u.mid, f, R, launches.guess)
    T = Double(guess)
    cos, sin = cos_sin(T)
    V = launches.speed(launches.near, T, sin).lower
    need(V > 0, "a wall may be reached without speed")
    r = (launches.way(T, cos) - launches.R).magnitude
    D = 2 * r / V * (1 + 1e-12)
    need((1 + launches.f.magnitude) * D <= V / 2, "the time of a hit is not certain")
    T = Double(guess, D)
    need((T - at.t).is_positive(), "a hit may be before its launch")
    return T


def _guess(t: float, u: float, f: float, R: float, near: float | None) -> float:
    """Return a float near the first time at which x = R, or near another one: it needs no trust."""
    X, V = math.cos(t), u - math.sin(t)

    def x(T: float) -> float:
        return place(X, V, T - t, f / 2, math.cos(T))

    def v(T: float) -> float:
        return velocity(V, T - t, f, math.sin(T))

    low, T = (t, t) if near is None else (near - 0.125, near)
    while near is None and x(T) < R:
        low, T = T, T + 0.25
        if v(T) < 0:  # x may have passed R, and come back
            rising = low
            for _ in range(30):
                middle = (rising + T) / 2
                rising, T = (middle, T) if v(middle) > 0 else (rising, middle)
            need(x(T) >= R, "a flight does not end")
        need(t + SPAN > T, "a flight does not end")
    for _ in range(60):
        step = (x(T) - R) / v(T) if v(T) > 0 else math.inf
        if abs(step) < 1e-15 * max(1.0, abs(T)):
            break
        T = T - step if low <= T - step <= low + 0.25 else (low + T) / 2
    return T
