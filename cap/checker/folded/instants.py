"""Polynomials next to the times of hits and stops, in one variable or two: they steer.

Let E f be the sum of w f_w, f_w the part of degree w of f: a derivation.  So where p or s vanishes

    s E T + (T - ref) E A + E B = 0      or      (cos T + a) E T + E A = 0,

which gives the parts of T one after the other, with those of cos T and sin T: E cos T = -sin T E T,
E sin T = cos T E T.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from cap.checker.folded.flights import Flight, Model
from cap.checker.folded.motion import Direction, middle_of
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import velocity

Coefficients = list[float]
Steer = Callable[[float], float]
_STEPS, _CLOSE = 8, 1e-8  # of Newton's method, which squares the last one


def hitting(y: Direction, f: Flight, near: float) -> tuple[float, Model]:
    """Return t and a polynomial d without a constant: p vanishes at t + d, nearly."""
    A, B, middle = y.q.coefficients(f.A), y.q.coefficients(f.B), middle_of(y, f)
    t = _zero(near, lambda t: -middle.ahead(t), middle.speed)
    s = _positive(middle.speed(t))
    D, ET, cos, sin, speeds = (_room(z, A) for z in (t - f.ref, 0.0, math.cos(t), math.sin(t), s))
    EA, EB, part = _derived(y, A), _derived(y, B), y.q.part
    for w, low, high in y.q.PARTS:
        pulls = zip(part(w, ET, speeds), part(w, EA, D), EB[low:high], strict=True)
        _extend(y, (w, low, high), (D, ET, cos, sin), [-(u + v + z) / s for u, v, z in pulls])
        for k in range(low, high):
            speeds[k] = velocity(A[k], D[k], -y.a, sin[k])
    return t, y.q.of_coefficients((0.0, *D[1:]))


def stopping(y: Direction, f: Flight, near: float) -> tuple[float, Model]:
    """Return t and a polynomial d without a constant: s vanishes at t + d, nearly."""
    A, middle = y.q.coefficients(f.A), middle_of(y, f)
    t = _zero(near, lambda t: -middle.speed(t), lambda t: -math.cos(t) - y.a)
    slope = _positive(-math.cos(t) - y.a)
    T, ET, cos, sin = (_room(z, A) for z in (t, 0.0, math.cos(t), math.sin(t)))
    EA = _derived(y, A)
    for w, low, high in y.q.PARTS:
        pulls = zip(y.q.part(w, ET, cos), EA[low:high], strict=True)
        _extend(y, (w, low, high), (T, ET, cos, sin), [(u + v) / slope for u, v in pulls])
    return t, y.q.of_coefficients((0.0, *T[1:]))


def _zero(t: float, F: Steer, slope: Steer) -> float:
    """Return where F, which increases, vanishes, nearly, by Newton's method."""
    for _ in range(_STEPS):
        step = F(t) / _positive(slope(t))
        t -= step
        if abs(step) < _CLOSE:
            break
    return t


def _positive(slope: float) -> float:
    """Return a slope by which it is divided."""
    need(slope > 0, "the time of an event is not certain")
    return slope


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
