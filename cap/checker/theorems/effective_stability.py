"""The theorem about effective stability: motions from an ellipse stay in a larger one for long.

Phi has exactly one fixed point P* in the box, all orbits from the box hit the walls in the same
order and never stop (``non_sticking``).  On the box Phi is continuous, and injective: from the
state at T a motion can be followed back, as a flight goes on until the mass is at the wall, and an
elastic hit can be reversed.

A polynomial H is a hint.  The lemma of ``drift`` says how long orbits from the smaller ellipse stay
in the larger one, which lies in the box.  Between nT and (n+1)T the motion is one from the box: its
velocity does not vanish.

Neither ellipticity, nor a twist, nor that areas are preserved is used.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cap.checker.flow.itinerary import Passage
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Whole
from cap.checker.maps.drift import (
    change,
    determinant,
    drift,
    excess,
    half_widths,
    inverse,
)
from cap.checker.maps.fixed_point import Point
from cap.checker.maps.non_sticking import KRAWCZYK, NonSticking

LEAST, MOST = 4, 24  # order


class EffectiveStability(NonSticking):
    """Motions from an ellipse around the fixed point stay in a larger one for N periods."""

    # fmt: off
    HINTS = (
        *NonSticking.HINTS,
        Field("order", Whole(LEAST, MOST), "", "", "of the jets over a box around the ellipse"),
        Field("integral", Many(Many(number, 2, MOST + 1), 2, MOST), "", "H",
              "for n = 1, 2, ..: the coefficients of u_1^(n-j) u_2^j, j = 0 .. n"),
    )
    CLAIMS = (
        *NonSticking.CLAIMS,
        Field("centre", [number] * 2, "", "c", "(x, v), of the ellipses"),
        Field("axes", [[number] * 2] * 2, "", "A",
              "rows: the ellipse E = {c + A u : |u| <= 1} lies in the box"),
        Field("part", number, "", r"\kappa",
              "P* is in the inner ellipse E' = {c + A u : |u| <= part}, part < 1"),
        Field("periods", number, "", "N",
              "an integer: motions from E' at t = 0 are in E at t = nT, |n| <= periods"),
        Field("area", Quantity("R^2 omega"), "area", r"\pi\kappa^2|\det A|", "of E'"),
    )
    CITES = (KRAWCZYK,)
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        super().limit(hints, claims)
        rows = hints["integral"]
        shaped = all(len(row) == n + 1 for n, row in enumerate(rows, start=1))
        need(shaped, "a row of the integral has not as many coefficients as its degree needs")

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:  # noqa: ARG002
        """Prove that motions from the inner ellipse stay in the outer one."""
        part, periods = self.claims["part"], self.claims["periods"]
        need(0 < part < 1, "the inner ellipse is not the smaller one")
        need(periods >= 1 and periods.denominator == 1, "periods is not a positive integer")
        need(determinant(self.claims["axes"]) != 0, "the axes are parallel")
        rectangle = self.ellipses(fixed_point)
        bits, H, axes = self.hints["bits"], self.hints["integral"], self.claims["axes"]
        inner = self.number(part**2) + excess(H, part, bits)
        outer = self.number(1) - excess(H, Fraction(1), bits)
        lost = drift(self.change(rectangle), axes) * int(periods)
        need((inner + lost).is_before(outer), "orbits may leave the ellipse before")
        self.step("for so many periods H does not grow from the inner ellipse to the outer one")
        self.confirm(area=self.pi() * self.number(part**2 * abs(determinant(axes))))

    def ellipses(self, fixed_point: Point) -> list[Interval]:
        """Prove that E lies in the box and P* in E'; return the least rectangle around E."""
        centre, axes, part = (self.claims[name] for name in ("centre", "axes", "part"))
        halves = half_widths(axes, self.hints["bits"])
        rectangle = [
            Interval.enclosing(c - half.upper, c + half.upper, self.hints["bits"])
            for c, half in zip(centre, halves, strict=True)
        ]
        need(self.is_in_the_box(rectangle), "the outer ellipse is not in the box")
        offsets = [z - self.number(c) for z, c in zip(fixed_point, centre, strict=True)]
        square = self.number(0)
        for p, q in inverse(axes):
            u = offsets[0] * self.number(p) + offsets[1] * self.number(q)
            square = square + u.square()
        need(square.is_before(self.number(part**2)), "P* is not certainly in the inner ellipse")
        self.step("the outer ellipse is in the box, and P* in the inner one")
        return rectangle

    def change(self, rectangle: list[Interval]) -> Any:
        """Return H o Phi - H as jets at c and over the rectangle."""
        centre, axes = self.claims["centre"], self.claims["axes"]
        c = [self.number(q) for q in centre]
        passage = self.phi.over(rectangle, c, self.hints["order"])
        before = passage.mechanics.variables
        return change(self.hints["integral"], axes, centre, [*before, passage.x, passage.v])

    def words(self) -> str:
        """Return the theorem in one line."""
        centre, axes = self.claims["centre"], self.claims["axes"]
        return self.statement(
            _STAY,
            c=", ".join(decimal(q) for q in centre),
            A=", ".join(f"({decimal(p)}, {decimal(q)})" for p, q in axes),
            kappa=decimal(self.claims["part"]),
        )


_STAY = (
    "let E be the ellipse of all c + A u, |u| <= 1, with c = ({c}), and A = ({A}) in rows, and E' "
    "the ellipse {kappa} times as large around the same centre, of area in {area}: the fixed point "
    "is in E', and of every motion that starts in E' at t = 0 the velocity does not vanish for |t| "
    "<= {periods} T, and at each multiple of T in this time the state is in E"
)


THEOREM = EffectiveStability
