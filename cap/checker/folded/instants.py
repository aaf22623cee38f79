"""Polynomials next to the times of hits and stops, in one variable or two: they steer.

Let E f be the sum of w f_w, f_w the part of degree w of f: a derivation.  So where p or s vanishes

    s E T + (T - ref) E A + E B = 0      or      (cos T + a) E T + E A = 0,

which gives the parts of T one after the other, with those of cos T and sin T: E cos T = -sin T E T,
E sin T = cos T E T.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cap.checker.folded.flights import Flight, Model
from cap.checker.folded.motion import Direction, middle_of
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import velocity

Coefficients = list[float]
_STEPS, _CLOSE = 8, 1e-8  # of Newton's method, which squares the last one


def hitting(y: Direction, f: Flight, near: float) -> tuple[float, Model]:
    """Return t and a polynomial d without a constant: p vanishes at t + d, nearly."""
    A, B, middle = y.q.coefficients(f.A), y.q.coefficients(f.B), middle_of(y, f)
    t, s = near, middle.speed(near)
    for _ in range(_STEPS):
        need(s > 0, "the mass may stop, or hit")
        step = middle.ahead(t) / s
        t += step
        s = middle.speed(t)
        if abs(step) < _CLOSE:
            break
    need(s > 0, "the mass may stop, or hit")
    D, ET, cos, sin, speeds = (_room(z, A) for z in (t - f.ref, 0.0, math.cos(t), math.sin(t), s))
    EA, EB, part = _derived(y, A), _derived(y, B), y.q.part
    for w, low, high in y.q.PARTS:
        pulls = zip(part(w, ET, speeds), part(w, EA, D), EB[low:high], strict=True)
        rise = [-(u + v + z) / s for u, v, z in pulls]
        _extend(y, (w, low, high), (D, ET, cos, sin), rise)
        for k in range(low, high):
            speeds[k] = velocity(A[k], D[k], -y.a, sin[k])
    return t, y.q.of_coefficients((0.0, *D[1:]))


def stopping(y: Direction, f: Flight, near: float) -> tuple[float, Model]:
    """Return t and a polynomial d without a constant: s vanishes at t + d, nearly."""
    t, A, middle = near, y.q.coefficients(f.A), middle_of(y, f)
    for _ in range(_STEPS):
        slope = math.cos(t) + y.a
        need(slope < 0, "a stop is not transversal")
        step = middle.speed(t) / slope
        t -= step
        if abs(step) < _CLOSE:
            break
    T, ET, cos, sin = (_room(z, A) for z in (t, 0.0, math.cos(t), math.sin(t)))
    EA, slope = _derived(y, A), cos[0] + y.a
    need(slope < 0, "a stop is not transversal")
    for w, low, high in y.q.PARTS:
        pulls = zip(y.q.part(w, ET, cos), EA[low:high], strict=True)
        _extend(y, (w, low, high), (T, ET, cos, sin), [-(u + v) / slope for u, v in pulls])
    return t, y.q.of_coefficients((0.0, *T[1:]))


def _room(constant: float, like: Sequence[float]) -> Coefficients:
    """Return the coefficients of a constant."""
    return [constant, *[0.0] * (len(like) - 1)]


def _derived(y: Direction, p: Sequence[float]) -> Coefficients:
    """Return the coefficients of E p."""
    return [w * c for w, c in zip(y.q.DEGREES, p, strict=True)]


def _extend(
    y: Direction,
    place: tuple[int, int, int],
    functions: tuple[Coefficients, ...],
    rise: Coefficients,
) -> None:
    """Write the parts of degree w of T, E T, cos T and sin T; that of E T is ``rise``."""
    (w, low, high), (T, ET, cos, sin) = place, functions
    ET[low:high] = rise
    T[low:high] = [z / w for z in rise]
    falls, rises = y.q.part(w, ET, sin), y.q.part(w, ET, cos)
    cos[low:high] = [-z / w for z in falls]
    sin[low:high] = [z / w for z in rises]
