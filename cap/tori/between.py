"""Rotation numbers between that of an elliptic fixed point P* and that of a curve C around it.

If the map turns P* + τw, w the direction of a segment from P* to a point of C, by an angle in
s (0, π), s = 1 or -1, wherever it is on the segment, the lifts of angles at P* and on C are one:
the rotation number at P* is a = arccos(trace/2)/2π, or 1 - a, where that of C is α, and both are on
the same side of 1/2.  (`cap.checker.tori.between` has the proof; docs/invariant-curve-proof.md the
periodic orbits.)
"""

from collections.abc import Callable
from typing import NamedTuple

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import FourierModel
from cap.sets.interval import Ball, Box, ComplexBall
from cap.sets.matrix import Matrix
from cap.tori.invariant_curve import Curve
from cap.tori.states import States

PLACES = 16  # where a segment may end: at multiples of 2π/16
PIECES = (16, 64, 256)
Derivative = Callable[[States], Matrix[Ball]]


class Ray(NamedTuple):
    """The segment from P* to the point at 2π place/16, in so many pieces; the sense of turns."""

    place: int
    pieces: int
    sense: int


def value(u: FourierModel, place: int) -> Ball:
    """Return the value of a real function at 2π place/16."""
    n = u.circle.degree
    turn = ComplexBall(0, interval.pi() * 2 * place / PLACES).exp()
    powers = [turn**k for k in range(PLACES)]
    parts = (c * powers[k % PLACES] for k, c in zip(u.circle.modes(n), u.coefficients, strict=True))
    total: Ball = interval.total(part.real for part in parts)
    return total + interval.symmetric(u.error)


def ray(after: Callable[[States], States], P: Box, curve: Curve, distance: Ball) -> Ray:
    """Return a segment on which the map turns all points one way, by less than π.

    ``after`` is the map for sets of states; C is within ``distance`` of the curve.
    """
    failed = NotProved("Lemma 5", "there is no segment to try")
    for pieces in PIECES:
        for place in range(PLACES):
            far = interval.symmetric(distance)
            end = value(curve.x, place) + far, value(curve.v, place) + far
            try:
                return Ray(place, pieces, sense(after, P, end, pieces))
            except NotProved as reason:
                failed = reason
    raise failed


def sense(after: Callable[[States], States], P: Box, end: Box, pieces: int) -> int:
    """Return the sign of det(w, DG w) on the segment, w its direction."""
    w = end[0] - P[0], end[1] - P[1]
    half = w[0] / (2 * pieces), w[1] / (2 * pieces)
    signs = set[int]()
    for n in range(pieces):
        middle = P[0] + half[0] * (2 * n + 1), P[1] + half[1] * (2 * n + 1)
        (p, _), (q, _) = after(States(middle, ((half[0], Ball(0)), (half[1], Ball(0))))).B
        turned = w[0] * q - w[1] * p
        signs.add(1 if turned > 0 else -1 if turned < 0 else 0)
    if signs not in ({1}, {-1}):
        raise NotProved("Lemma 5", "on a segment some states may turn by 0 or π", {"end": end[0]})
    return signs.pop()


def at_centre(trace: Ball, *, same: bool, alpha: Ball) -> Ball:
    """Return the rotation number at P*, in the sense of the curve.

    ``same``: whether the map turns the segment in the sense in which the curve winds.
    """
    if not abs(trace) < 2:
        raise NotProved("Lemma 5", "P* may not be elliptic", {"trace": trace})
    a = (trace / 2).acos() / (2 * interval.pi())
    if not (alpha < 0.5 if same else alpha > 0.5):
        raise NotProved("Lemma 5", "the curve turns the other way", {"rotation number": alpha})
    result: Ball = a if same else 1 - a
    return result
