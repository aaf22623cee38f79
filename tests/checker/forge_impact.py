"""A test tool: valid certificates of ``symmetric``, ``pitchfork`` and ``branch``, made in mpmath.

Nothing here is rigorous.  The formulas are in cos and sin of the hit times, and derivatives are
numerical: the checker's own forms are not used.  The values of the twist are the prover's.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import gcd

from mpmath import mp, mpf

from cap.checker.theorems import load
from cap.maps.twist import regular_twist
from cap.one_one.closed_form import asymmetric
from cap.one_one.transport import period_jet
from cap.sets import interval
from cap.sets.taylor_model import Domain
from checker.forge import _decimal, _mp

PAPER = {"F": "1", "omega": "1", "f": "2/5", "l": "-1", "r": "1"}
WALLS = {k: v for k, v in PAPER.items() if k != "f"}


class Orbit:
    """A (1,1) orbit in physical units from alpha, phi, delta and the scaled mean speed W."""

    def __init__(self, system, alpha, phi, delta, W):
        self.system, self.alpha, self.phi, self.delta, self.W = system, alpha, phi, delta, W
        self.t1, self.t2 = phi + mp.pi / 2 - delta, phi + 3 * mp.pi / 2 + delta
        self.u1, self.u2 = W + alpha * delta, W - alpha * delta

    def u(self, t):
        """Return the scaled speed at t in [t1 - 2 pi, t1 + 2 pi]."""
        if self.t1 <= t <= self.t2:
            return self.u1 - (mp.sin(t) - mp.sin(self.t1)) - self.alpha * (t - self.t1)
        t2 = self.t2 if t > self.t2 else self.t2 - 2 * mp.pi
        return self.u2 + mp.sin(t) - mp.sin(t2) - self.alpha * (t - t2)

    @property
    def least_speed(self):
        """The least speed: at a hit, or where the force balances the friction."""
        a = mp.pi / 2 + mp.asin(self.alpha)
        times = [t + 2 * mp.pi * k for t in (a, a + mp.pi) for k in (-1, 0, 1)]
        inner = [t for t in times if self.t1 < t < self.t1 + 2 * mp.pi]
        return self.system.speed * min(self.u1, self.u2, *map(self.u, inner))

    @property
    def trace(self):
        """The trace of the product of flights and hits."""
        k1, k2 = 2 * mp.cos(self.t1) / self.u1, -2 * mp.cos(self.t2) / self.u2
        d1 = self.t2 - self.t1
        product = mp.matrix([[1, 2 * mp.pi - d1], [0, 1]]) * mp.matrix([[1, 0], [-k2, 1]])
        product *= mp.matrix([[1, d1], [0, 1]]) * mp.matrix([[1, 0], [-k1, 1]])
        return product[0, 0] + product[1, 1]

    @property
    def half_trace(self):
        """The trace of half a period, for a symmetric orbit."""
        k = 2 * mp.cos(self.t1) / self.u1
        product = mp.matrix([[1, mp.pi], [0, 1]]) * mp.matrix([[1, 0], [-k, 1]])
        return product[0, 0] + product[1, 1]

    @property
    def start(self):
        """The position and the velocity at t = 0, by quadrature."""
        x = self.system.r - self.system.length * mp.quad(self.u, [0, self.t1])
        return x, self.system.speed * self.u(mpf(0))


class System:
    """The parameters and the orbits."""

    def __init__(self, parameters):
        self.F, self.omega, self.l, self.r = (_mp(parameters[k]) for k in ("F", "omega", "l", "r"))
        self.R = self.r - self.l
        self.rho = self.R * self.omega**2 / self.F
        self.speed, self.length = self.F / self.omega, self.F / self.omega**2

    def symmetric(self, alpha, sign):
        """Return the symmetric orbit with this sign of c."""
        phi = -sign * mp.acos(mp.pi * alpha / 2)
        return Orbit(self, alpha, phi, mpf(0), (self.rho - 2 * mp.sin(phi)) / mp.pi)

    def pair(self, delta):
        """Return the orbit with delta > 0."""
        sinc = mp.sinc(delta)
        G = mp.pi**2 / 2 * sinc - 2 * mp.cos(delta) - 2 * delta * mp.sin(delta)
        phi = -mp.asin(self.rho / G)
        alpha = 2 / mp.pi * mp.cos(phi) * mp.cos(delta)
        return Orbit(self, alpha, phi, delta, -mp.pi / 2 * mp.sin(phi) * sinc)


def claim(value, digits, unit=1):
    """Return an enclosure of the value that is as narrow as its digits demand."""
    size = max(abs(value), _mp(unit) if isinstance(unit, Fraction) else mpf(unit))
    size *= mpf(10) ** -(digits + 1)
    return [_decimal(value - 3 * size, digits + 12), _decimal(value + 3 * size, digits + 12)]


def hull(low, high, digits):
    """Return [low, high], rounded outwards."""
    size = max(abs(low), abs(high), mpf(1)) * mpf(10) ** -(digits + 1)
    return [_decimal(low - size, digits + 12), _decimal(high + size, digits + 12)]


def certificate(theorem, parameters, digits, claims, hints):
    """Return the certificate."""
    return {
        "format": "cap-certificate/1",
        "theorem": theorem,
        "parameters": dict(parameters),
        "digits": str(digits),
        "claims": claims,
        "hints": {"bits": str(int(digits * 3.33) + 80)} | hints,
        "cites": list(load(theorem).CITES),
        "provenance": {"tool": "forge"},
    }


def state(system, orbit, digits):
    """Return the claims about an orbit at t = 0 and at its hits."""
    (x, v), R, omega = orbit.start, system.R, system.omega
    return {
        "x": claim(x, digits, R),
        "v": claim(v, digits, R * omega),
        "hit_times": [claim(t / omega, digits, 1 / omega) for t in (orbit.t1, orbit.t2)],
        "hit_speed": claim(system.speed * orbit.W, digits, R * omega),
        "least_speed": claim(orbit.least_speed, digits, R * omega),
    }


def forge_symmetric(parameters=PAPER, digits=20, *, genuine=False):
    """Return a valid certificate, or one that calls the orbits of all formulas genuine."""
    with mp.workdps(2 * digits + 30):
        system = System(parameters)
        alpha, F, pi = _mp(parameters["f"]) / system.F, system.F, mp.pi
        branches = {
            name: symmetric_orbit(system, alpha, sign, digits, genuine=genuine)
            for name, sign in (("plus", 1), ("minus", -1))
        }
        born, flip = 2 * system.rho / (pi**2 - 4), system.rho / (pi**2 - 2)
        claims = {"branches": branches, "saddle_center": claim(2 * F / pi, digits, F)}
        for name, c in (("pitchfork", born), ("minus_identity", flip)):
            f = 2 / pi * mp.sqrt(1 - c**2) * F if c < 1 else None
            claims[name] = "none" if f is None else claim(f, digits, F)
        claims["paper_roots"] = paper_roots(system, alpha, digits)
        return certificate("symmetric", parameters, digits, claims, {})


def symmetric_orbit(system, alpha, sign, digits, *, genuine=False):
    """Return the claims about one formula, which may call its orbit genuine if it is not."""
    if mp.pi * alpha > 2:
        return "none"
    orbit = system.symmetric(alpha, sign)
    if orbit.W <= 0:
        return "none"
    claims = state(system, orbit, digits)
    if orbit.least_speed < 0 and not genuine:
        return {"genuine": "no"} | {k: claims[k] for k in ("hit_speed", "least_speed")}
    return claims | {
        "genuine": "yes",
        "half_trace": claim(orbit.half_trace, digits),
        "trace": claim(orbit.trace, digits),
        "type": "elliptic" if abs(orbit.trace) < 2 else "saddle",
    }


def paper_roots(system, alpha, digits):
    """Return the roots of the paper's equation, by bisection on (0, pi/2)."""
    F, R, omega, f = system.F, system.R, system.omega, alpha * system.F

    def psi(t):
        right = 2 * F + R * omega**2 - f * mp.pi**2 / 2 + f * t * (mp.pi - t)
        return F * mp.pi * mp.sin(t) - right

    low, high = mpf(0), mp.pi / 2
    if psi(low) >= 0 or psi(high) <= 0:
        return []
    for _ in range(4 * mp.dps):
        middle = (low + high) / 2
        low, high = (low, middle) if psi(middle) > 0 else (middle, high)
    return [
        {
            "theta": claim(t, digits),
            "velocity": claim(-F / omega * mp.sin(t) - f / omega * (mp.pi - t), digits, R * omega),
        }
        for t in (low, mp.pi - low)
    ]


def forge_pitchfork(parameters=WALLS, digits=20):
    """Return a valid certificate; the derivatives are differences of very high precision."""
    with mp.workdps(6 * digits + 60):
        system, F = System(parameters), _mp(parameters["F"])
        alpha = system.pair(mpf(0)).alpha
        orbit, h = system.symmetric(alpha, 1), mpf(10) ** -(2 * digits + 10)

        def g(delta, alpha):
            phi = -mp.acos(mp.pi * alpha / (2 * mp.cos(delta)))
            W = (system.rho - 2 * mp.sin(phi) * (mp.cos(delta) + delta * mp.sin(delta))) / mp.pi
            return delta * W + mp.pi / 2 * mp.sin(phi) * mp.sin(delta)

        def linear(alpha):
            return g(h, alpha) / h

        linear_slope = (linear(alpha + h) - linear(alpha - h)) / (2 * h)
        traces = [system.symmetric(alpha + s * h, 1).half_trace for s in (1, -1)]
        claims = {
            "f": claim(alpha * F, digits, F),
            **state(system, orbit, digits),
            "half_trace_slope": claim((traces[0] - traces[1]) / (2 * h * F), digits, 1 / F),
            "cubic": claim(g(h, alpha) / h**3, digits),
            "linear_slope": claim(linear_slope, digits),
            "curvature": claim((system.pair(h).alpha - alpha) / h**2 * F, digits, F),
            "trace_curvature": claim((system.pair(h).trace - 2) / h**2, digits),
        }
        return certificate("pitchfork", parameters, digits, claims, {})


def forge_branch(
    parameters=WALLS,
    digits=10,
    first="0.05",
    width="0.01",
    zero="0.36226226705284",
    last=None,
):
    """Return a valid certificate, with one zero of the twist, negative before it.

    With ``last`` the cells end there, and the least speed is positive.
    """
    with mp.workdps(2 * digits + 30):
        system = System(parameters)
        top = Fraction(last) if last else None
        end = None if last else bracket(lambda d: system.pair(d).least_speed, "0.01", "0.7", digits)
        deepest = end[0] if end else top
        marks = [Fraction(0), Fraction(first)]
        while marks[-1] + Fraction(width) < deepest:
            marks.append(marks[-1] + Fraction(width))
        marks.append(end[1] if end else top)
        zeros = [(Fraction(zero) - Fraction(1, 10**12), Fraction(zero) + Fraction(1, 10**12))]
        zeros = [z for z in zeros if z[1] < deepest]
        cells = [cell(system, a, b, zero) for a, b in pairwise(marks)]
        met = []
        for ratio in sorted(
            Fraction(p, q)
            for q in range(2, 9)
            for p in range(1, q)
            if gcd(p, q) == 1 and 2 * p <= q
        ):
            level = 2 * mp.cos(2 * mp.pi * _mp(ratio))
            if system.pair(_mp(deepest)).trace < level:
                at = bracket(lambda d, s=level: system.pair(d).trace - s, "0.001", deepest, digits)
                met.append((str(ratio), at))

        def f(delta):
            return system.F * system.pair(_mp(delta)).alpha

        def ends(at, quantity=f):
            return hull(quantity(at[1]), quantity(at[0]), digits + 1)

        claims = {
            "f_start": claim(f(0), digits, system.F),
            "f_end": ends(end) if end else "none",
            "trace_end": ends(end, lambda d: system.pair(_mp(d)).trace) if end else "none",
            "f_range": [
                _decimal(f(deepest) + mpf(10) ** -12, 20),
                _decimal(f(0) - mpf(10) ** -6, 20),
            ],
            "resonances": [{"ratio": ratio, "f": ends(at)} for ratio, at in met],
            "twist_zeros": [ends(z) for z in zeros],
            "cells": cells,
        }
        claims["exceptions"] = exceptions(claims)
        hints = {
            "end": [text(q) for q in end] if end else "none",
            "resonances": [[text(q) for q in at] for _, at in met],
            "twist_zeros": [[text(q) for q in z] for z in zeros],
        }
        return certificate("branch", parameters, digits, claims, hints)


def text(q):
    """Return a fraction as the format writes it."""
    return str(Fraction(q))


def bracket(value, low, high, digits):
    """Return a short bracket of the zero of a decreasing function."""
    low, high = Fraction(low), Fraction(high)
    while high - low > Fraction(1, 10 ** (digits + 4)):
        middle = (low + high) / 2
        low, high = (middle, high) if value(_mp(middle)) > 0 else (low, middle)
    return low, high


def cell(system, low, high, zero):
    """Return the claims about a cell; only a cell away from delta = 0 and the zero has a sign."""
    a, b = system.pair(_mp(low)), system.pair(_mp(high))
    signed = low > 0 and not low <= Fraction(zero) <= high and b.trace > -1.9
    return {
        "delta": [text(low), text(high)],
        "f": hull(system.F * b.alpha, system.F * a.alpha, 10),
        "trace": hull(b.trace, a.trace, 10),
        "least_speed": hull(system.speed * lowest(b), system.speed * lowest(a), 10),
        "twist": ("-" if high < Fraction(zero) else "+") if signed else "none",
        "regular_twist": regular(system, low, high) if signed else "none",
    }


def regular(system, low, high):
    """Return the claim on (1 + trace) tau_1 over a cell, a hundredth larger than its enclosure."""
    with interval.workprec(200):
        half, middle = (interval.ball((high + s * low) / 2) for s in (-1, 1))
        (delta,) = Domain([half], 10).variables((middle,))
        rho, area = (rational(q) for q in (system.rho, system.F**2 / system.omega**3))
        pair = asymmetric(delta, interval.ball(rho))
        E, t = period_jet(pair, 3)
        scaled = regular_twist(E, t, 1 if t[1, 0].bound() > 0 else -1).bound()
        value = scaled / interval.ball(area)
        if not value.is_finite():
            return ["1", "2"]
        wider = value + interval.symmetric(value) / 100
        return list(interval.outward(wider, 14))


def rational(q):
    """Return the rational of small denominator that a parameter is."""
    return Fraction(mp.nstr(q, 25)).limit_denominator(10**9)


def lowest(orbit):
    """Return the scaled speed at its least value on the way to the left."""
    return orbit.u(mp.pi / 2 + mp.asin(orbit.alpha))


def exceptions(claims):
    """Return the f of the cells without sign and of the low resonances, in the range, united."""
    low, high = map(Fraction, claims["f_range"])
    where = {q["ratio"]: [Fraction(z) for z in q["f"]] for q in claims["resonances"]}
    if "1/2" in where:
        low = max(low, where["1/2"][0])
    pieces = [
        [Fraction(z) for z in c["f"]]
        for c in claims["cells"]
        if c["twist"] == "none" and Fraction(c["trace"][1]) > -2
    ]
    pieces += [where[q] for q in ("1/4", "1/3") if q in where]
    clipped = sorted([max(a, low), min(b, high)] for a, b in pieces if a <= high and b >= low)
    result = []
    for a, b in clipped:
        if result and a <= result[-1][1]:
            result[-1][1] = max(b, result[-1][1])
        else:
            result.append([a, b])
    return [[text(a), text(b)] for a, b in result]
