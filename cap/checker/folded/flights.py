"""Flights between two walls, folded by the symmetry of the system, for all orbits of a kind.

*Units.*  Time 1/omega, length F/omega^2: forwards x'' = cos t + a sgn x' with a = -f/F in (-1, 0);
backwards, with -t for t, the same with a = f/F.  The walls are W = (r - l) omega^2/F apart; e = 1,
mu = 0.

*Folding.*  The flow commutes with (x, v, t) -> (l + r - x, -v, t + pi).  So a flight to the left is
described as one to the right, its time shifted by pi; and after a hit or a turn the next flight has
its time shifted by pi.  What remains is the distance p <= 0 to the wall ahead, negative: p becomes
-W by a hit, and -W - p by a turn.  Times count modulo 2 pi.

*A flight* has the speed s >= 0 and the distance p,

    s(t) = sin t + a d + A,      p(t) = -cos t + a d^2/2 + A d + B,      d = t - ref,

s' = cos t + a.  Let theta = arccos a.  s has its minima at the *slow* times 2 pi k - (pi - theta),
and decreases in the arcs (pi - theta, pi + theta) modulo 2 pi only: there a mass stops.  So s > 0
after the start up to a time if s >= 0 at the start and s > 0 there and at the slow times between;
and as long as that holds, p increases.

*Errors.*  A = A_0 + u, B = B_0 + w with polynomials A_0, B_0 in one variable or two, and (u, w) = C
n, |n_1| <= R_1, |n_2| <= R_2, C nearly a rotation.  The map to the next flight is differentiable;
by the mean value theorem its image of (A, B) differs from that of (A_0, B_0) by J C n, with J in
the hull of the derivatives.  The images of (A_0, B_0) are polynomials and errors (z_1, z_2).  The
new C has the longer column of J C in its first direction, and its inverse is its transposed up to
2^-49.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from cap.checker.folded.numbers import TURN, UP, Pair

Four = tuple[Pair, Pair, Pair, Pair]
Model = Any
"""A model of `cap.checker.kernel.line` or of `cap.checker.kernel.polynomials`."""


class Flight(NamedTuple):
    """A flight: bounds of the time of its start, ref, A_0, B_0, C, R, bounds of the errors u, w.

    ``slow`` is the number of the first slow time that counts, ``passed`` how many multiples of pi
    its times have been shifted since the first flight.
    """

    begun: Pair
    ref: float
    A: Model
    B: Model
    C: tuple[float, float, float, float]
    R: Pair
    errors: Pair
    slow: int
    passed: int


Errors = tuple[tuple[float, float, float, float], Pair, Pair]


def carried(before: Errors, J: Four, z: Sequence[float]) -> Errors:
    """Return C, R and the bounds of the errors after a map with derivatives in J, and errors z."""
    (j11, k11), (j12, k12), (j21, k21), (j22, k22) = J
    (c11, c12, c21, c22), (r1, r2), (ea, eb) = before
    m11, m12 = j11 * c11 + j12 * c21, j11 * c12 + j12 * c22
    m21, m22 = j21 * c11 + j22 * c21, j21 * c12 + j22 * c22
    size = (abs(j11) + abs(j12) + abs(j21) + abs(j22)) * (ea + eb + r1 + r2) * TURN
    za = z[0] + k11 * ea + k12 * eb + size
    zb = z[1] + k21 * ea + k22 * eb + size
    longer = (m11 * m11 + m21 * m21) * r1 * r1 >= (m12 * m12 + m22 * m22) * r2 * r2
    u, w = (m11, m21) if longer else (m12, m22)
    length = math.hypot(u, w)
    u, w = (u / length, w / length) if length > 1e-100 else (1.0, 0.0)
    n1 = abs(u * m11 + w * m21) * r1 + abs(u * m12 + w * m22) * r2 + abs(u) * za + abs(w) * zb
    n2 = abs(u * m21 - w * m11) * r1 + abs(u * m22 - w * m12) * r2 + abs(u) * zb + abs(w) * za
    n1, n2 = (n1 + size) * UP, (n2 + size) * UP
    errors = (abs(u) * n1 + abs(w) * n2) * UP, (abs(w) * n1 + abs(u) * n2) * UP
    return (u, -w, w, u), (n1, n2), errors
