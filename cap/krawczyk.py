"""Krawczyk's operator: existence, uniqueness and enclosure of a fixed point in the plane.

For G(z) = Φ(z) - z, a point m of the box Z and any matrix C (Neumaier 1990, Section 5.1)

    K(Z) = m - C G(m) + (1 - C G'(Z)) (Z - m).

If K(Z) lies in the interior of Z, then G has exactly one zero in Z, and it lies in K(Z).
"""

from fractions import Fraction
from typing import NamedTuple

from cap import interval, matrix
from cap.errors import NotProved
from cap.interval import Ball
from cap.matrix import Matrix

Box = tuple[Ball, Ball]


class Preconditioner(NamedTuple):
    """The point m and the matrix C, exact; neither needs trust."""

    centre: tuple[Fraction, Fraction]
    matrix: tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]

    @property
    def point(self) -> Box:
        """m, enclosed."""
        return interval.ball(self.centre[0]), interval.ball(self.centre[1])

    def box(self, radius: Fraction) -> Box:
        """Return a box that contains the square of half-width ``radius`` around m."""
        x, v = self.centre
        return interval.around(x, radius), interval.around(v, radius)


def minus_identity(m: Matrix[Ball]) -> Matrix[Ball]:
    """Return m - 1."""
    (a, b), (c, d) = m
    return (a - 1, b), (c, d - 1)


def operator(hint: Preconditioner, image: Box, slope: Matrix[Ball], box: Box) -> Box:
    """Return an enclosure of K(box), from ``image`` ∋ Φ(m) and ``slope`` ⊇ Φ'(box).

    A fixed point in ``box`` lies in it, if ``slope`` encloses Φ' also between there and m.
    """
    x, v = hint.point
    (p, q), (r, s) = hint.matrix
    c = (interval.ball(p), interval.ball(q)), (interval.ball(r), interval.ball(s))
    (a, b), (e, d) = matrix.product(c, minus_identity(slope))
    g, h = image[0] - x, image[1] - v
    dx, dv = box[0] - x, box[1] - v
    return (
        x - (c[0][0] * g + c[0][1] * h) + ((1 - a) * dx - b * dv),
        v - (c[1][0] * g + c[1][1] * h) + ((1 - d) * dv - e * dx),
    )


def contract(hint: Preconditioner, image: Box, slope: Matrix[Ball], box: Box) -> Box:
    """Prove that Φ has exactly one fixed point in ``box``; return a box K in its interior with it.

    Assumes Φ is C¹ on ``box``, ``image`` encloses Φ(m) and ``slope`` encloses Φ' on ``box``;
    m in ``box`` is verified, and K in the interior of ``box``.  Raises `NotProved` with both boxes;
    this does not say that there is no fixed point, only that the box is too large or elsewhere.
    """
    m = hint.point
    k = operator(hint, image, slope, box)
    for name, inner, outer, centre in zip("xv", k, box, m, strict=True):
        if not interval.subset(centre, outer):
            raise NotProved("Krawczyk", f"the centre leaves the box in {name}", {name: centre})
        if not interval.subset_interior(inner, outer):
            sets = {"K": inner, "box": outer}
            raise NotProved("Krawczyk", f"K(box) is not inside the box in {name}", sets)
    return k
