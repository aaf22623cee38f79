"""Polynomials next to the times of hits and turns, as functions of X and Y: they steer.

Let E f be the sum of w f_w, f_w the part of degree w of f: a derivation.  So where p or s vanishes

    s E T + (T - ref) E A + E B = 0      or      (cos T + a) E T + E A = 0,

which gives the parts of T one after the other, with those of cos T and sin T: E cos T = -sin T E T,
E sin T = cos T E T.  Coefficients are in the order of `cap.checker.kernel.polynomials`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cap.checker.folded.motion import Flight, System
from cap.checker.kernel.polynomials import DEGREE, LAST, MONOMIALS, Model
from cap.checker.kernel.rejection import need

Part = tuple[float, ...]
Coefficients = list[float]
_DEGREES = [i + j for i, j in MONOMIALS]
_PARTS = [(w, w * (w + 1) // 2, (w + 1) * (w + 2) // 2) for w in range(1, DEGREE + 1)]
_POLISHED = 2


def hitting(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that p vanishes at near + d, nearly."""
    t = near
    for _ in range(_POLISHED):
        d = t - f.ref
        s = math.sin(t) + y.a * d + f.A[0]
        need(s > 0, "the mass may stop, or hit")
        t -= (d * (y.a * d / 2 + f.A[0]) + f.B[0] - math.cos(t)) / s
    d = t - f.ref
    s = math.sin(t) + y.a * d + f.A[0]
    D, ET, cos, sin, speeds = (_room(z) for z in (d, 0.0, math.cos(t), math.sin(t), s))
    EA, EB = _derived(f.A), _derived(f.B)
    for w, low, high in _PARTS:
        pulls = zip(part(w, ET, speeds), part(w, EA, D), EB[low:high], strict=True)
        rise = [-(u + v + z) / s for u, v, z in pulls]
        _extend(w, (low, high), (D, ET, cos, sin), rise)
        for k in range(low, high):
            speeds[k] = sin[k] + y.a * D[k] + f.A[k]
    return (t - near, *D[1:], 0.0)


def stopping(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that s vanishes at near + d, nearly."""
    t = near
    for _ in range(_POLISHED):
        slope = math.cos(t) + y.a
        need(slope < 0, "a stop is not transversal")
        t -= (math.sin(t) + y.a * (t - f.ref) + f.A[0]) / slope
    T, ET, cos, sin = (_room(z) for z in (t, 0.0, math.cos(t), math.sin(t)))
    EA, slope = _derived(f.A), cos[0] + y.a
    for w, low, high in _PARTS:
        pulls = zip(part(w, ET, cos), EA[low:high], strict=True)
        _extend(w, (low, high), (T, ET, cos, sin), [-(u + v) / slope for u, v in pulls])
    return (t - near, *T[1:], 0.0)


def _room(constant: float) -> Coefficients:
    """Return the coefficients of a constant."""
    return [constant, *[0.0] * (LAST - 1)]


def _derived(p: Model) -> Coefficients:
    """Return the coefficients of E p."""
    return [w * c for w, c in zip(_DEGREES, p, strict=False)]


def _extend(
    w: int, ends: tuple[int, int], functions: tuple[Coefficients, ...], rise: Coefficients
) -> None:
    """Write the parts of degree w of T, E T, cos T and sin T; that of E T is ``rise``."""
    (low, high), (T, ET, cos, sin) = ends, functions
    ET[low:high] = rise
    T[low:high] = [z / w for z in rise]
    falls, rises = part(w, ET, sin), part(w, ET, cos)
    cos[low:high] = [-z / w for z in falls]
    sin[low:high] = [z / w for z in rises]


def part(w: int, f: Sequence[float], g: Sequence[float]) -> Part:
    """Return the part of degree w of f g, for f without a constant, w from 1 to 4."""
    if w == 1:
        return f[1] * g[0], f[2] * g[0]
    _, f1, f2, f3, f4, f5, f6, f7, f8, f9, *last = f
    g0, g1, g2, g3, g4, g5, g6, g7, g8, g9, *_ = g
    if w == 2:
        return f1 * g1 + f3 * g0, f1 * g2 + f2 * g1 + f4 * g0, f2 * g2 + f5 * g0
    if w == 3:
        return (
            f1 * g3 + f3 * g1 + f6 * g0,
            f1 * g4 + f2 * g3 + f3 * g2 + f4 * g1 + f7 * g0,
            f1 * g5 + f2 * g4 + f4 * g2 + f5 * g1 + f8 * g0,
            f2 * g5 + f5 * g2 + f9 * g0,
        )
    f10, f11, f12, f13, f14 = last
    return (
        f1 * g6 + f3 * g3 + f6 * g1 + f10 * g0,
        f1 * g7 + f2 * g6 + f3 * g4 + f4 * g3 + f6 * g2 + f7 * g1 + f11 * g0,
        f1 * g8 + f2 * g7 + f3 * g5 + f4 * g4 + f5 * g3 + f7 * g2 + f8 * g1 + f12 * g0,
        f1 * g9 + f2 * g8 + f4 * g5 + f5 * g4 + f8 * g2 + f9 * g1 + f13 * g0,
        f2 * g9 + f5 * g5 + f9 * g2 + f14 * g0,
    )
