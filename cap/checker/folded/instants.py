"""Polynomials next to the times of hits and turns, as functions of X and Y: they steer.

Let E f be the sum of w f_w, f_w the part of degree w of f: a derivation.  So where p or s vanishes

    s E T + (T - ref) E A + E B = 0      or      (cos T + a) E T + E A = 0,

which gives the parts of T one after the other.  A part of degree w is the list of its w + 1
coefficients, in the order of `cap.checker.kernel.polynomials`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cap.checker.folded.backward import Flight, System
from cap.checker.kernel.polynomials import DEGREE, Model
from cap.checker.kernel.rejection import need

Part = list[float]
_DEGREES = range(1, DEGREE + 1)
_ENDS = [(w * (w + 1) // 2, (w + 1) * (w + 2) // 2) for w in range(DEGREE + 1)]
_POLISHED = 2


def hitting(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that p vanishes at near + d, nearly."""
    t = near
    for _ in range(_POLISHED):
        d = t - f.ref
        s = math.sin(t) + y.a * d + f.A[0]
        need(s > 0, "the mass may stop, or hit")
        t -= (d * (y.a * d / 2 + f.A[0]) + f.B[0] - math.cos(t)) / s
    A, B = parts(f.A), parts(f.B)
    T, D, cos, sin = begun(t, f.ref)
    speeds = [[sin[0][0] + y.a * D[0][0] + A[0][0]]]
    for w in _DEGREES:
        pull = derived(T, speeds, w, w - 1), derived(A, D, w, w), B[w]
        rise = [-sum(z) / speeds[0][0] for z in zip(*pull, strict=True)]
        extended(T, D, cos, sin, rise)
        speeds.append([z + y.a * u + v for z, u, v in zip(sin[w], rise, A[w], strict=True)])
    return joined(T, t - near)


def stopping(y: System, f: Flight, near: float) -> Model:
    """Return a polynomial d, such that s vanishes at near + d, nearly."""
    t = near
    for _ in range(_POLISHED):
        slope = math.cos(t) + y.a
        need(slope < 0, "a stop is not transversal")
        t -= (math.sin(t) + y.a * (t - f.ref) + f.A[0]) / slope
    A = parts(f.A)
    T, D, cos, sin = begun(t, f.ref)
    for w in _DEGREES:
        pull = derived(T, cos, w, w - 1), A[w]
        extended(T, D, cos, sin, [-sum(z) / (cos[0][0] + y.a) for z in zip(*pull, strict=True)])
    return joined(T, t - near)


def begun(t: float, ref: float) -> tuple[list[Part], list[Part], list[Part], list[Part]]:
    """Return the first parts of T, T - ref, cos T and sin T."""
    return [[t]], [[t - ref]], [[math.cos(t)]], [[math.sin(t)]]


def extended(T: list[Part], D: list[Part], cos: list[Part], sin: list[Part], part: Part) -> None:
    """Add the next part to T, and to what depends on it: E cos T = -sin T E T."""
    w = len(T)
    T.append(part)
    D.append(part)
    falls, rises = derived(T, sin, w, w), derived(T, cos, w, w)
    cos.append([-z for z in falls])
    sin.append(rises)


def derived(f: Sequence[Part], g: Sequence[Part], w: int, last: int) -> Part:
    """Return the part of degree w of g E f, divided by w, but for those of f after the last."""
    found = [0.0] * (w + 1)
    for v in range(1, last + 1):
        other, share = g[w - v], v / w
        for i, x in enumerate(f[v]):
            for j, z in enumerate(other, i):
                found[j] += share * x * z
    return found


def parts(p: Model) -> list[Part]:
    """Return the parts of a polynomial."""
    return [list(p[low:high]) for low, high in _ENDS]


def joined(f: Sequence[Part], constant: float) -> Model:
    """Return the polynomial with these parts, and another constant."""
    return (constant, *(c for part in f[1:] for c in part), 0.0)
