"""An independent transcription of the dynamics, in mpmath: the oracle of the tests.

A flight is kept as the state that it starts from.  Events are bracketed on a float grid and refined
by bisection; derivatives are divided differences at many digits.  Nothing here comes from `cap`.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

from mpmath import mp, mpf, workdps

DIGITS = 60
GRID = 200


class Turns(Exception):
    """The velocity vanishes."""


@dataclass
class System:
    """F, ω, f, l, r in mpmath numbers; T = 2π/ω."""

    F: mpf
    w: mpf
    f: mpf
    l: mpf
    r: mpf

    @classmethod
    def of(cls, p):
        """Return the system of exact parameters."""
        return cls(*(mpf(q.numerator) / q.denominator for q in (p.F, p.omega, p.f, p.l, p.r)))

    @property
    def T(self):  # noqa: N802
        """The period."""
        return 2 * mp.pi / self.w


@dataclass
class Flight:
    """The flight of sign ``s`` from the state (x, v) at time t."""

    system: System
    s: int
    t: mpf
    x: mpf
    v: mpf

    def velocity(self, t, m=mp):
        """Return v(t)."""
        F, w, f = self.system.F, self.system.w, self.system.f
        kick = F / w * (m.sin(w * t) - m.sin(w * self.t))
        return self.v + kick - self.s * f * (t - self.t)

    def position(self, t, m=mp):
        """Return x(t)."""
        F, w, f = self.system.F, self.system.w, self.system.f
        d = t - self.t
        drift = (self.v - F / w * m.sin(w * self.t)) * d
        swing = F / w**2 * (m.cos(w * t) - m.cos(w * self.t))
        return self.x + drift - swing - self.s * f * d**2 / 2

    def floats(self):
        """Return the same flight in floats."""
        names = ("F", "w", "f", "l", "r")
        system = System(*(float(getattr(self.system, name)) for name in names))
        return Flight(system, self.s, float(self.t), float(self.x), float(self.v))

    def slowest(self, end):
        """Return the least s v on [t, end]: at the ends or where F cos ωt = s f."""
        F, w, f = self.system.F, self.system.w, self.system.f
        angle = mp.acos(self.s * f / F)
        turns = [(sign * angle + 2 * mp.pi * k) / w for sign in (1, -1) for k in range(-1, 4)]
        times = [self.t, end, *(t for t in turns if self.t < t < end)]
        return min(self.s * self.velocity(t) for t in times)


@dataclass
class Orbit:
    """Hit times and velocities before the hits, the end at time T, the least speed."""

    hits: list
    velocities: list
    end: tuple
    least: mpf


def bisected(g, a, b):
    """Return a zero of the increasing g in [a, b]: bisection, then Newton's secants."""
    for _ in range(12):
        middle = (a + b) / 2
        a, b = (a, middle) if g(middle) > 0 else (middle, b)
    return mp.findroot(g, (a, b), solver="anderson", tol=mpf(10) ** (-2 * mp.dps + 10), maxsteps=99)


def next_hit(flight, end, formal):
    """Return the time in (t, end] at which the wall ahead is hit, or None."""
    near, system = flight.floats(), flight.system
    wall = system.r if flight.s > 0 else system.l
    times = [near.t + (float(end) - near.t) * k / GRID for k in range(GRID + 1)]
    for a, b in pairwise(times):
        if near.s * (near.position(b, math) - float(wall)) > 0:
            return bisected(lambda t: flight.s * (flight.position(t) - wall), mpf(a), mpf(b))
        if not formal and near.s * near.velocity(b, math) <= 0:
            raise Turns
    return None


def flow(system, x, v, *, start=0, end=None, formal=False):
    """Follow (x, v) from time ``start`` to ``end``; raise `Turns` if the velocity vanishes.

    With ``formal`` a flight goes on with its sign where the velocity vanishes.
    """
    with workdps(DIGITS):
        end = system.T if end is None else end
        flight = Flight(system, 1 if v > 0 else -1, mpf(start), mpf(x), mpf(v))
        hits, velocities, least = [], [], abs(mpf(v))
        while True:
            hit = next_hit(flight, end, formal)
            least = min(least, flight.slowest(end if hit is None else hit))
            if least <= 0 and not formal:
                raise Turns
            if hit is None:
                break
            before = flight.velocity(hit)
            hits.append(hit)
            velocities.append(before)
            wall = system.r if flight.s > 0 else system.l
            flight = Flight(system, -flight.s, hit, wall, -before)
        return Orbit(hits, velocities, (flight.position(end), flight.velocity(end)), least)


def strobe(system, x, v):
    """Return Φ(x, v)."""
    return flow(system, x, v).end


def jacobian(system, x, v):
    """Return Φ' by central differences, right to 30 digits and more."""
    with workdps(DIGITS):
        h = mpf(10) ** -(DIGITS // 3)
        columns = []
        for dx, dv in ((h, 0), (0, h)):
            plus, minus = strobe(system, x + dx, v + dv), strobe(system, x - dx, v - dv)
            columns.append([(a - b) / (2 * h) for a, b in zip(plus, minus, strict=True)])
        return [[columns[0][i], columns[1][i]] for i in (0, 1)]


def derivatives(system, x, v, order):
    """Return {(i, j): (coefficient of dx^i dv^j in x, in v)} of Φ for 1 <= i + j <= order.

    Divided differences on a grid of step 10^-(DIGITS/(order + 3)) or less, exact to order + 2.
    """
    with workdps(DIGITS):
        step, reach = mpf(10) ** -(DIGITS // 5), (order + 2) // 2
        grid = range(-reach, reach + 1)
        values = {(a, b): strobe(system, x + a * step, v + b * step) for a in grid for b in grid}
        vandermonde = mp.matrix([[mpf(a) ** i for i in range(len(grid))] for a in grid])
        inverse = vandermonde**-1
        result = {}
        for i in range(order + 1):
            for j in range(order + 1 - i):
                if i + j:
                    result[i, j] = tuple(
                        mp.fsum(
                            inverse[i, p] * inverse[j, q] * values[a, b][k]
                            for p, a in enumerate(grid)
                            for q, b in enumerate(grid)
                        )
                        / step ** (i + j)
                        for k in (0, 1)
                    )
        return result


def periodic_orbit(system, guess):
    """Return (x, v, hits) of the orbit that hits r, then l, once per period: Newton on hit times.

    The speed must come back, and both crossings have the length R = r - l:
    with u_1 the speed at the first hit, both are equations in the hit times alone.
    """
    F, w, f, T, R = system.F, system.w, system.f, system.T, system.r - system.l

    def lengths(t1, t2):
        back = Flight(system, -1, t1, mpf(0), mpf(0))
        fore = Flight(system, 1, t2, mpf(0), mpf(0))
        return -back.position(t2) / 1, fore.position(t1 + T), t2 - t1, t1 + T - t2

    def equations(t1, t2):
        left, right, d1, d2 = lengths(t1, t2)
        u1 = (R - left) / d1
        gained = -Flight(system, -1, t1, mpf(0), mpf(0)).velocity(t2)
        u2 = u1 + gained
        return [mp.sin(w * t1) - mp.sin(w * t2) - mp.pi * f / F, right + u2 * d2 - R]

    with workdps(DIGITS + 10):
        t1, t2 = mp.findroot(equations, tuple(mpf(t) for t in guess), tol=mpf(10) ** (-2 * DIGITS))
        left, _, d1, _ = lengths(t1, t2)
        u1 = (R - left) / d1
        back = Flight(system, -1, t1, system.r, -u1)
        fore = Flight(system, 1, t2, system.l, -back.velocity(t2))
        return fore.position(T), fore.velocity(T), (t1, t2)
