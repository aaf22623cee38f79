"""The center of an island: a fixed point P* of G, that is sigma or sigma sigma = Phi.

Krawczyk's inclusion: with C near (DG - 1)^-1, the image by C (1 - G) of all states within r of m
lies inside of them.  Motions from all of them never stop (``half_period``), so P* has one that
never stops, for all times.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field
from cap.checker.tori.half_period import Motion, States

HINTS = (
    Field("middle", [number] * 2, "", "", "a point near P*"),
    Field("radius", number, "", "", "P* is within it, in x and in v"),
    Field("preconditioner", [[number] * 2] * 2, "", "C", "near (DG(P*) - 1)^-1"),
)


class FixedPoint(NamedTuple):
    """A rectangle that contains a fixed point, and the traces of DG on the square around it."""

    x: Interval
    v: Interval
    trace: Interval


def fixed_point(motion: Motion, half_periods: int, hints: dict[str, Any]) -> FixedPoint:
    """Prove that there is a fixed point in a square."""

    def exact(q: Fraction) -> Interval:
        return Interval.enclosing(q, q, motion.bits)

    r, zero = hints["radius"], exact(Fraction(0))
    need(r > 0, "the radius is not positive")
    m = [exact(q) for q in hints["middle"]]
    z = States(m[0], m[1], ((exact(r), zero), (zero, exact(r))))
    for _ in range(half_periods):
        z = motion.after(z)
    found = []
    for i, row in enumerate(hints["preconditioner"]):
        c, d = map(exact, row)
        K = m[i] - c * (z.x - m[0]) - d * (z.v - m[1])
        for j in (0, 1):  # (1 - C (DG - 1)) r, column by column
            entry = _column(z, exact(r), j)
            change = c * entry[0] + d * entry[1]
            left = (exact(r) if i == j else zero) - change
            reach = left.magnitude().hi
            K = Interval(K.lo - reach, K.hi + reach, K.bits)
        middle = hints["middle"][i]
        need(K.lies_inside(middle - r, middle + r), "K does not lie inside its box")
        found.append(K)
    return FixedPoint(found[0], found[1], (z.B[0][0] + z.B[1][1]) / exact(r))


def _column(z: States, r: Interval, j: int) -> tuple[Interval, Interval]:
    """Return a column of (DG - 1) r."""
    first, second = z.B[0][j], z.B[1][j]
    return (first - r, second) if j == 0 else (first, second - r)
