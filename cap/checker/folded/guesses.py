"""Polynomials next to the times of hits and stops, as functions of one variable: they steer."""

from __future__ import annotations

import math
from operator import mul

from cap.checker.folded.flights import Path, System
from cap.checker.kernel import line
from cap.checker.kernel.angles import cos_sin
from cap.checker.kernel.line import Coefficients
from cap.checker.kernel.rejection import need

_STEPS, _CLOSE = 8, 1e-8  # of Newton's method, which squares the last one


def hit_guess(y: System, f: Path, near: float) -> Coefficients:
    """Return a polynomial at which p vanishes, nearly: s T' + A' (T - ref) + B' = 0."""
    near = polished(y, f, near)
    s = math.sin(near) - y.a * (near - f.ref) + f.A[0]
    need(s > 0, "the mass may stop, or hit")
    return solved(y, f, near, s, full=True)


def stop_guess(y: System, f: Path, near: float) -> Coefficients:
    """Return a polynomial at which s vanishes, nearly: (cos T - a) T' + A' = 0."""
    for _ in range(_STEPS):
        m = math.cos(near) - y.a
        need(m < 0, "a stop is not transversal")
        step = (math.sin(near) - y.a * (near - f.ref) + f.A[0]) / m
        near -= step
        if abs(step) < _CLOSE:
            break
    return solved(y, f, near, math.cos(near) - y.a, full=False)


def polished(y: System, f: Path, near: float) -> float:
    """Return the time of a hit of the middle."""
    for _ in range(_STEPS):
        cos, sin = cos_sin(near)
        d = near - f.ref
        s = sin - y.a * d + f.A[0]
        if s <= 0:
            break
        step = (-cos + d * (f.A[0] - y.a * d / 2) + f.B[0]) / s
        near -= step
        if abs(step) < _CLOSE:
            break
    return near


def solved(y: System, f: Path, near: float, m: float, full: bool) -> Coefficients:
    """Return the first coefficients of a solution T with T(0) = near."""
    T, D, rates = [near], [near - f.ref], [m]  # rates: s, or cos T - a
    cos, sin = cos_sin(near)
    C, S, slopes = [cos], [sin], list[float]()
    pulls = [k * a for k, a in enumerate(f.A)][1:]
    for k in range(line.DEGREE):
        past = sum(map(mul, rates[1:], reversed(slopes)))
        if full:
            past += sum(map(mul, pulls, reversed(D))) + (k + 1) * f.B[k + 1]
        else:
            past += pulls[k]
        slopes.append(-past / m)
        T.append(slopes[k] / (k + 1))
        D.append(T[-1])
        cos, sin = (sum(map(mul, slopes, reversed(z))) / (k + 1) for z in (S, C))
        C.append(-cos)
        S.append(sin)
        rates.append(sin - y.a * T[-1] + f.A[k + 1] if full else -cos)
    return tuple(T)
