"""The first zero of a gap or a speed whose inflections are known: no event needs a time step."""

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from cap.flow.itinerary import root

Curve = Callable[[float], tuple[float, float]]  # the value and the slope at a time
NEAR = 1e-13  # of a period: a flight may begin at a zero of its acceleration


def zeros(
    omega: float, ratio: float, a: float, b: float, *, with_first: bool = False
) -> list[float]:
    """Return the times in (a, b), in order, at which cos ωt = ``ratio``; none if they are double.

    Times within rounding errors of a are left out, or are in, ``with_first``.
    """
    if not abs(ratio) < 1:
        return []
    turn, angle = 2 * math.pi, math.acos(ratio)
    first, last = math.floor(omega * a / turn), math.ceil(omega * b / turn)
    times = [(k * turn + side * angle) / omega for k in range(first, last + 1) for side in (-1, 1)]
    near = NEAR * (turn / omega + abs(a))
    least = a - near if with_first else a + near
    return sorted(max(t, a) for t in times if least < t < b)


def first_stop(speed: Curve, knots: Sequence[float], *, rises: bool) -> float | None:
    """Return the first zero of a speed that is monotone between neighbouring ``knots``.

    The knots include both ends; with ``rises`` the speed begins at 0, and rises to the next knot.
    """
    for k, (p, q) in enumerate(pairwise(knots)):
        if not (rises and k == 0) and speed(q)[0] <= 0:
            return root(speed, p, q) if speed(p)[0] > 0 else p
    return None


def first_contact(gap: Curve, knots: Sequence[float]) -> float | None:
    """Return the first time at which a gap closes whose slope is monotone between ``knots``.

    Only where the gap falls: one that is 0, or rounded to less, just after a contact rises first.
    If its maximum there rounds to 0 or less, the maximum is the contact: none is lost.
    """
    for p, q in pairwise(knots):
        for u, w in pairwise(_split(gap, p, q)):
            if gap((u + w) / 2)[1] < 0 and gap(w)[0] <= 0:
                return root(gap, u, w) if gap(u)[0] > 0 else u
    return None


def _split(gap: Curve, p: float, q: float) -> list[float]:
    """Return p, the zero of the slope between if there is one, and q."""
    first, last = gap(p)[1], gap(q)[1]
    if (first > 0) == (last > 0):
        return [p, q]
    low, high = p, q
    while True:  # bisection: only the sign of the slope is used
        middle = (low + high) / 2
        if not low < middle < high:
            return [p, middle, q] if p < middle < q else [p, q]
        low, high = (middle, high) if (gap(middle)[1] > 0) == (first > 0) else (low, middle)
