"""The theorem about two masses: an orbit on which no mass stops, with a real pair of multipliers.

The multipliers are the zeros of lambda^2 - z lambda + 1 for both reduced traces z.  For |z| > 2
they are real, the outer one (z +- sqrt(z^2 - 4))/2 with the sign of z, and its inverse; for the
other one, in (-2, 2), they are exp(+-2 pi i theta), theta = arccos(z/2)/(2 pi) in (0, 1/2).
"""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.citation import cite
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.stable_manifolds import HADAMARD_PERRON
from cap.checker.particles.periodic_orbit import KRAWCZYK, Located, PeriodicOrbit


class ParticlesSaddle(PeriodicOrbit):
    """One pair of multipliers is real, one is on the unit circle."""

    # fmt: off
    CLAIMS = (
        *PeriodicOrbit.CLAIMS,
        Field("multipliers", [Quantity()] * 2, "multiplier", r"\lambda",
              "the real pair: outside the unit circle, then its inverse"),
        Field("rotation_number", Quantity(), "rotation number", r"\theta",
              "in (0, 1/2): the other pair is exp(+-2 pi i theta)"),
    )
    CITES = (
        KRAWCZYK,
        cite(
            *HADAMARD_PERRON,
            ("smooth", "Phi is real analytic near the fixed point: all contacts are transverse, "
             "one at a time, and no velocity vanishes", "closing_speeds, least_speeds"),
            ("split", "one eigenvalue of the derivative lies outside the unit circle, and no "
             "other one", "multipliers, rotation_number"),
        ),
    )
    # fmt: on

    def conclude(self, at: Located) -> None:
        """Prove that one multiplier lies outside the unit circle, and two on it."""
        claims = self.claims["reduced_traces"]
        high = claims[0].lower > 2
        need(high or claims[1].upper < -2, "neither reduced trace is certainly outside [-2, 2]")
        rest = claims[1] if high else claims[0]
        need(rest.lower > -2 and rest.upper < 2, "no reduced trace is certainly in (-2, 2)")
        z, other = at.reduced_traces if high else at.reduced_traces[::-1]
        outer = (z + (z.square() - 4).sqrt() * (1 if high else -1)) / 2
        self.confirm(
            multipliers=[outer, outer.integer(1) / outer],
            rotation_number=arccos(other / 2) / at.M.two_pi,
        )
        self.outside()

    def outside(self) -> None:
        """Check what the numbers claimed must satisfy."""
        (large, small), number = self.claims["multipliers"], self.claims["rotation_number"]
        need(large.lower > 1 or large.upper < -1, "the outer multiplier may lie in the unit circle")
        inside = small.lower > -1 and small.upper < 1
        need(inside, "the inner multiplier may lie outside the unit circle")
        within = number.lower > 0 and number.upper < Fraction(1, 2)
        need(within, "the rotation number is not in (0, 1/2)")
        self.step("one multiplier lies outside the unit circle, one inside, and two on it")

    def words(self) -> str:
        """Return the theorem in one line."""
        outer, inner = self.claims["multipliers"]
        return self.told(_UNSTABLE, outer=outer, inner=inner)


_UNSTABLE = (
    "P* has two real multipliers, in {outer} and {inner}, and two on the unit circle, exp(+-2 pi i "
    "theta) with theta in {rotation_number}: hence (Hadamard-Perron) it has an unstable curve, and "
    "is unstable"
)

THEOREM = ParticlesSaddle
