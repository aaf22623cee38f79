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
from cap.checker.kernel.jet import Power
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Whole
from cap.checker.maps.drift import eliminated
from cap.checker.maps.ellipses import Ellipses, fields
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
        *fields(2, "(x, v)"),
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
        ellipses = Ellipses.of(self.claims)
        ellipses.hold(fixed_point)
        rectangle = ellipses.box(self.hints["bits"])
        need(self.is_in_the_box(rectangle), "the outer ellipse is not in the box")
        self.step("the outer ellipse is in the box, and P* in the inner one")
        centre = [self.number(c) for c in ellipses.centre]
        passage = self.phi.over(rectangle, centre, self.hints["order"])
        H: dict[Power, Fraction] = {
            (n - j, j): c
            for n, row in enumerate(self.hints["integral"], start=1)
            for j, c in enumerate(row)
        }
        ellipses.last(H, [*passage.mechanics.variables, passage.x, passage.v])
        self.step("for so many periods H does not grow from the inner ellipse to the outer one")
        det, _ = eliminated(ellipses.axes)
        self.confirm(area=self.pi() * self.number(ellipses.part**2 * abs(det)))

    def words(self) -> str:
        """Return the theorem in one line."""
        return Ellipses.of(self.claims).words(self.statement, _STAY)


_STAY = (
    "let E be the ellipse of all c + A u, |u| <= 1, with c = ({c}), and A = ({A}) in rows, and E' "
    "the ellipse {kappa} times as large around the same centre, of area in {area}: the fixed point "
    "is in E', and of every motion that starts in E' at t = 0 the velocity does not vanish for |t| "
    "<= {periods} T, and at each multiple of T in this time the state is in E"
)


THEOREM = EffectiveStability
