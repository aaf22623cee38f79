"""What the theorems about an invariant curve around a cylinder have in common.

F is a map of the cylinder (x modulo 2 pi, y), or of y > 0, analytic and invertible, that keeps the
integral of y dx along each closed curve, so det DF = 1, and both ends of the cylinder.  K(theta) =
(theta + x(theta), y(theta)), with the frame N, are trigonometric polynomials that are given.  The
a-posteriori theorem (``cap.checker.tori.invariant_curve``), on the cylinder, has an invariant curve
C within a distance of K, which F turns by the rotation number.

*On the cylinder*, which is not simply connected, that the integral of y dx is kept is what the
theorem needs of areas.  The curve is embedded: if C(a) and C(b) are one point, so are C(theta + a)
and C(theta + b) for all theta, as the rotation number is irrational; the mean of their first
components differs by a - b and a multiple of 2 pi, so a - b is a multiple of 2 pi.

*C separates the cylinder*, and F keeps both parts, as it keeps the ends.  So an orbit that begins
below C stays below it, forward and backward.  y on C is within the distance of y on K, which is
evaluated at many places.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.citation import cite
from cap.checker.kernel.fourier import Circle
from cap.checker.kernel.reading import number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Table, Whole, bound
from cap.checker.kernel.theorem import Certificate, Theorem
from cap.checker.tori import rotation
from cap.checker.tori.invariant_curve import Image, Setting, Shift, Vector, beside
from cap.checker.tori.values import extent
from cap.checker.tori.written import COARSE, QUOTIENTS, function

MAX_DEGREE = 1 << 15
MAX_WORK = 50 * MAX_DEGREE  # degree times places
PAIR = {"first": text, "second": text}


class AroundCylinder(Theorem):
    """An invariant curve around a cylinder."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        Field("places", Whole(20, 200), "", "", "coefficients are integers in units 10^-places"),
        Field("degree", Whole(8, MAX_DEGREE), "", "N", "functions are kept up to exp(iN theta)"),
        Field("rho", number, "", r"\rho", "of the norm"),
        Field("reach", number, "", "r", "the map is bounded on functions within r of K"),
        Field("frame", PAIR, "", "N", "det(K', N) is nearly 1; in units 10^-20"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("rotation_number", {"head": QUOTIENTS, "period": QUOTIENTS}, "", r"\alpha",
              "[0; head, period, period, ...]"),
        Field("diophantine", bound, "", r"\gamma", "k dist(k alpha, Z) is at least this"),
        Field("curve", PAIR, "", "K", "coefficients 0, 1, ... of the first coordinate less theta, "
              "and of the second: re im, re im, ..."),
        Field("distance", bound, "", "", "the curve is within this of K"),
    )
    CITES = (
        cite("best approximation", "Khinchin, Continued Fractions, 1964, Theorem 17",
             ("quotients", "the quotients are positive integers", "rotation_number")),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:  # noqa: ARG003
        """Bound the time."""
        work = hints["degree"] * hints["places"]
        need(work <= MAX_WORK, f"degree times places is more than {MAX_WORK}")
        need(0 < hints["rho"] <= 1, "0 < rho <= 1 does not hold")

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        hints = self.hints
        self.circle = Circle(hints["degree"], hints["rho"], hints["places"])

    @abstractmethod
    def image(self, K: Vector) -> Image:
        """Return the image of all curves in these functions, or reject."""

    def curve(self, whole: int = 0) -> tuple[Fraction, Fraction]:
        """Prove that there is an invariant curve; return bounds of y on it.

        It is turned by ``whole`` turns and alpha.
        """
        circle, claims = self.circle, self.claims
        K, N = self.pair(claims["curve"], 1), self.pair(self.hints["frame"], self.coarse)
        quotients, gamma = claims["rotation_number"], claims["diophantine"]
        need(gamma <= rotation.constant(**quotients), "the Diophantine constant is smaller")
        self.step("the rotation number is as far from rationals as claimed")
        alpha = rotation.value(**quotients, bits=circle.bits)
        ahead = Shift(circle, alpha, pi(circle.bits))
        r = circle.above(self.hints["reach"])
        need(r > 0, "the reach is not positive")
        self.tell("functions on the circle are multiplied", 0.1)
        image = self.image(K)
        self.tell("functions on the circle are multiplied", 0.5)
        around = self.image((K[0].with_error(r), K[1].with_error(r)))
        self.tell("functions on the circle are multiplied", 0.9)
        self.step("the map is defined for all functions near K")
        omega = circle.constant((alpha + whole) * pi(circle.bits) * 2)
        defect = image.x - ahead(K[0]) - omega, image.y - ahead(K[1])
        spread = around.x - image.x, around.y - image.y
        L = K[0].derivative() + 1, K[1].derivative()
        given = Setting(K, L, N, ahead, gamma, self.hints["reach"])
        found = beside(given, defect, spread, image.tangent)
        need(found.distance <= claims["distance"], "the curve may be farther from K")
        self.step("there is an invariant curve near K, with the rotation number")
        lower, upper = extent(K[1])
        return lower - found.distance, upper + found.distance

    @property
    def coarse(self) -> int:
        """10^-20, the unit of what need not be sharp, in units of the circle."""
        places: int = self.hints["places"]
        return int(10 ** (places - COARSE))

    def pair(self, words: dict[str, str], unit: int) -> Vector:
        """Return two functions."""
        first, second = (function(self.circle, words[k], unit) for k in ("first", "second"))
        return first, second
