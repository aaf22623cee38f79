"""The theorem about a saddle: a fixed point of a non-sticking orbit, one multiplier outside the
unit circle and one inside.

The multipliers are the zeros of z^2 - trace z + 1; for |trace| > 2 the outer one is (trace +-
sqrt(trace^2 - 4))/2 with the sign of the trace, and the inner one is its inverse.
"""

from __future__ import annotations

from typing import ClassVar

from cap.checker.flow.itinerary import Passage
from cap.checker.kernel.citation import Citation, cite
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.stable_manifolds import HADAMARD_PERRON
from cap.checker.maps.fixed_point import Point
from cap.checker.maps.non_sticking import KRAWCZYK, NonSticking


class Saddle(NonSticking):
    """The fixed point is hyperbolic."""

    # fmt: off
    CLAIMS = (
        *NonSticking.CLAIMS,
        Field("multipliers", [Quantity()] * 2, "multiplier", r"\lambda",
              "the eigenvalue of Phi'(P*) outside the unit circle, then the one inside"),
    )
    CITES: ClassVar[tuple[Citation, ...]] = (
        KRAWCZYK,
        cite(
            *HADAMARD_PERRON,
            ("smooth", "Phi is real analytic near the fixed point: "
             "all hits are transverse and no velocity vanishes", "hit_speeds, least_speed"),
            ("hyperbolic", "one eigenvalue of the Jacobian lies outside the unit circle and one "
             "inside", "multipliers"),
        ),
    )
    # fmt: on

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:  # noqa: ARG002
        """Prove that one multiplier lies outside the unit circle and one inside."""
        trace = orbit.x[1, 0] + orbit.v[0, 1]
        sign = 1 if trace.is_positive() else -1
        outer = (trace + (trace.square() - 4).sqrt() * sign) / 2
        self.confirm(multipliers=[outer, outer.integer(1) / outer])
        claim, (large, small) = self.claims["trace"], self.claims["multipliers"]
        need(claim.lower > 2 or claim.upper < -2, "the trace does not exclude [-2, 2]")
        outside = large.lower > 1 or large.upper < -1
        need(outside, "the outer multiplier may lie in the unit circle")
        inside = small.lower > -1 and small.upper < 1
        need(inside, "the inner multiplier may lie outside the unit circle")
        self.step("one multiplier lies outside the unit circle and one inside")

    def words(self) -> str:
        """Return the theorem in one line."""
        outer, inner = self.claims["multipliers"]
        return self.statement(
            "the fixed point is a hyperbolic saddle with trace in {trace} and multipliers in "
            "{outer} and {inner}: hence (Hadamard-Perron) it has stable and unstable curves, and "
            "is unstable",
            outer=outer,
            inner=inner,
        )


THEOREM = Saddle
