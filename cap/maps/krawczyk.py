"""Krawczyk's operator: existence, uniqueness and enclosure of a fixed point in the plane.

For G(z) = Φ(z) - z, a point m of the box Z and any matrix C (Neumaier 1990, Section 5.1)

    K(Z) = m - C G(m) + (1 - C G'(Z)) (Z - m).

If K(Z) lies in the interior of Z, then G has exactly one zero in Z, and it lies in K(Z).
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, cast

from cap.errors import NotProved
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box, Exact
from cap.sets.matrix import Matrix
from cap.sets.scalar import S


@dataclass(frozen=True)
class Preconditioner:
    """The point m and the matrix C, exact; neither needs trust."""

    centre: tuple[Fraction, Fraction]
    matrix: Matrix[Fraction]

    @cached_property
    def _exact(self) -> tuple[tuple[Exact, Exact], ...]:
        """m and the rows of C as rationals of which balls are made fast, at any precision."""
        pairs = self.centre, *self.matrix
        return tuple((interval.exact(p), interval.exact(q)) for p, q in pairs)

    @property
    def point(self) -> Box:
        """m, enclosed."""
        x, v = self._exact[0]
        return interval.ball(x), interval.ball(v)

    @property
    def rows(self) -> Matrix[Ball]:
        """C, enclosed."""
        _, (p, q), (r, s) = self._exact
        return (interval.ball(p), interval.ball(q)), (interval.ball(r), interval.ball(s))

    def contains(self, box: Box, reach: tuple[Fraction, Fraction]) -> bool:
        """Return whether ``box`` lies in the interior of the rectangle; exact."""
        return all(
            c - half < interval.ends(side)[0] and interval.ends(side)[1] < c + half
            for side, c, half in zip(box, self.centre, reach, strict=True)
        )

    def box(self, reach: tuple[Fraction, Fraction]) -> Box:
        """Return a box that contains the rectangle of half-widths ``reach`` around m."""
        x, v = self._exact[0]
        return interval.around(x, reach[0]), interval.around(v, reach[1])


def operator(
    hint: Preconditioner,
    image: tuple[Any, Any],
    slope: Matrix[S],
    box: Box,
    bound: Callable[[S], Ball] = lambda q: cast(Ball, q),
) -> Box:
    """Return an enclosure of K(box), from ``image`` ∋ Φ(m) and ``slope`` ⊇ Φ'(box).

    Both may be of any scalar type with a ``bound``: over Taylor models what varies in the entries
    of Φ' cancels in those of C Φ' before it is bounded, and so does what varies with parameters.
    A fixed point in ``box`` lies in K, if ``slope`` encloses Φ' also between there and m.
    """
    x, v = hint.point
    rows = hint.rows
    (p, q), (r, s) = matrix.product(cast("Matrix[S]", rows), matrix.minus_identity(slope))
    a, b, e, d = bound(p), bound(q), bound(r), bound(s)
    g, h = map(bound, matrix.apply(rows, (image[0] - x, image[1] - v)))
    dx, dv = box[0] - x, box[1] - v
    return (
        x - g + ((1 - a) * dx - b * dv),
        v - h + ((1 - d) * dv - e * dx),
    )


def contract(
    hint: Preconditioner,
    image: tuple[Any, Any],
    slope: Matrix[S],
    box: Box,
    bound: Callable[[S], Ball] = lambda q: cast(Ball, q),
) -> Box:
    """Prove that Φ has exactly one fixed point in ``box``; return a box inside that contains it.

    Assumes Φ is C¹ on ``box``, ``image`` encloses Φ(m) and ``slope`` encloses Φ' on ``box``.
    Verifies that m lies in ``box``, and that what is returned, K(box), lies in its interior.
    Raises `NotProved` with both boxes: the box may be too large, or there is no fixed point.
    """
    m = hint.point
    k = operator(hint, image, slope, box, bound)
    for name, inner, outer, centre in zip("xv", k, box, m, strict=True):
        if not interval.subset(centre, outer):
            raise NotProved("Krawczyk", f"the centre leaves the box in {name}", {name: centre})
        if not interval.subset_interior(inner, outer):
            sets = {"K - m": inner - centre, "box - m": outer - centre}
            raise NotProved("Krawczyk", f"K(box) is not inside the box in {name}", sets)
    return k
