"""The theorem about an invariant curve around a cylinder, of a map given by formulas.

The map g is one of ``cap.checker.tori.kicked``.  K(theta) = (theta + x(theta), y(theta)), with the
frame N, are trigonometric polynomials that are given.  The a-posteriori theorem
(``cap.checker.tori.invariant_curve``), on the cylinder, has an invariant curve C within a distance
of K, which g turns by the rotation number.

*On the cylinder*, which is not simply connected, that g keeps the integral of y dx is what the
theorem needs of areas.  The curve is embedded: if C(a) and C(b) are one point, so are C(theta + a)
and C(theta + b) for all theta, as the rotation number is irrational; the mean of their first
components differs by a - b and a multiple of 2 pi, so a - b is a multiple of 2 pi.

*C separates the cylinder*, and g keeps both parts, as it keeps the ends.  So an orbit that begins
below C stays below it, forward and backward.  y on C is within the distance of y on K, which is
evaluated at many places.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from cap.checker.coverings.formulas import FORMULAS, Formulas, formulas
from cap.checker.kernel.citation import cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.elementary import pi
from cap.checker.kernel.fourier import Circle
from cap.checker.kernel.reading import number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Whole, bound, enclosure
from cap.checker.kernel.theorem import Certificate, Theorem
from cap.checker.system.given import printed
from cap.checker.tori import rotation, told
from cap.checker.tori.invariant_curve import Setting, Shift, Vector, beside
from cap.checker.tori.kicked import Kicked
from cap.checker.tori.values import extent
from cap.checker.tori.written import COARSE, QUOTIENTS, function

MAX_DEGREE = 1 << 15
MAX_WORK = 50 * MAX_DEGREE  # degree times places
MAX_FACTORS = 64  # cosines and sines in the map
PER_SECOND = 12_000  # digits of functions


class MapCurve(Theorem):
    """An invariant curve around a cylinder."""

    PARAMETERS = FORMULAS
    units = {}  # noqa: RUF012
    # fmt: off
    HINTS = (
        Field("places", Whole(20, 200), "", "", "coefficients are integers in units 10^-places"),
        Field("degree", Whole(8, MAX_DEGREE), "", "N", "functions are kept up to exp(iN theta)"),
        Field("rho", number, "", r"\rho", "of the norm"),
        Field("reach", number, "", "r", "the map is bounded on functions within r of K"),
        Field("frame", {"first": text, "second": text}, "", "N", "det(K', N) is nearly 1; in units "
              "10^-20"),
    )
    CLAIMS = (
        Field("rotation_number", {"head": QUOTIENTS, "period": QUOTIENTS}, "", r"\alpha",
              "[0; head, period, period, ...]"),
        Field("diophantine", bound, "", r"\gamma", "k dist(k alpha, Z) is at least this"),
        Field("curve", {"first": text, "second": text}, "", "K", "coefficients 0, 1, ... of the "
              "first coordinate less theta, and of the second: re im, re im, ..."),
        Field("distance", bound, "", "", "the curve is within this of K"),
        Field("bounds", enclosure, "second coordinate", "y", "on the curve"),
    )
    CITES = (
        cite("best approximation", "Khinchin, Continued Fractions, 1964, Theorem 17",
             ("quotients", "the quotients are positive integers", "rotation_number")),
    )
    # fmt: on

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Formulas:
        """Return the map."""
        return formulas(given)

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

    def seconds(self) -> int:
        """Return about how long a proof takes: products of functions are most of it."""
        return int(self.hints["degree"] * self.hints["places"]) // PER_SECOND

    def prove(self) -> None:
        """Prove the theorem."""
        factors = sum(len(m) for q in self.p.image for m in q.terms)
        need(factors <= MAX_FACTORS, f"the map has more than {MAX_FACTORS} factors")
        g, circle, claims = Kicked.of(self.p), self.circle, self.claims
        self.step("the map kicks y by a function of x with mean 0, and then x by b y + c, b != 0")
        K, N = self.pair(claims["curve"], 1), self.pair(self.hints["frame"], self.coarse)
        quotients, gamma = claims["rotation_number"], claims["diophantine"]
        need(gamma <= rotation.constant(**quotients), "the Diophantine constant is smaller")
        self.step("the rotation number is as far from rationals as claimed")
        alpha = rotation.value(**quotients, bits=circle.bits)
        ahead = Shift(circle, alpha, pi(circle.bits))
        self.tell("functions on the circle are multiplied", 0.1)
        image = g.over(*K)
        r = circle.above(self.hints["reach"])
        need(r > 0, "the reach is not positive")
        self.tell("functions on the circle are multiplied", 0.5)
        around = g.over(K[0].with_error(r), K[1].with_error(r))
        self.tell("functions on the circle are multiplied", 0.9)
        omega = circle.constant(alpha * pi(circle.bits) * 2)
        defect = image.x - ahead(K[0]) - omega, image.y - ahead(K[1])
        spread = around.x - image.x, around.y - image.y
        L = K[0].derivative() + 1, K[1].derivative()
        given = Setting(K, L, N, ahead, gamma, self.hints["reach"])
        found = beside(given, defect, spread, lambda w: g.tangent(image, w))
        need(found.distance <= claims["distance"], "the curve may be farther from K")
        self.step("there is an invariant curve near K, with the rotation number")
        self.bounds(K, found.distance)

    def bounds(self, K: Vector, distance: Fraction) -> None:
        """Compare what the second coordinate is on the curve."""
        lower, upper = extent(K[1])
        claim = self.claims["bounds"]
        need(claim.lower <= lower - distance, "bounds: y may be below them")
        need(upper + distance <= claim.upper, "bounds: y may be above them")
        self.step("on the curve y is between the bounds")

    @property
    def coarse(self) -> int:
        """10^-20, the unit of what need not be sharp, in units of the circle."""
        places: int = self.hints["places"]
        return int(10 ** (places - COARSE))

    def pair(self, words: dict[str, str], unit: int) -> Vector:
        """Return two functions."""
        first, second = (function(self.circle, words[k], unit) for k in ("first", "second"))
        return first, second

    def words(self) -> str:
        """Return the theorem in one line."""
        x, y = self.p.state
        images = ", ".join(printed(q, x) for q in self.p.image)
        claims = self.claims
        more = {name: decimal(claims[name]) for name in ("diophantine", "distance")}
        return _CURVE.format(
            x=x, y=y, images=images, alpha=told.turns(claims), low=claims["bounds"].text[0],
            high=claims["bounds"].text[1], **more,
        )  # fmt: skip


_CURVE = (
    "the map ({x}, {y}) -> ({images}) of the cylinder, {x} modulo 2 pi, has an invariant analytic "
    "curve without double points that goes around the cylinder once, on which it is conjugate to "
    "the rotation by alpha = {alpha} turns (dist(k alpha, Z) >= {diophantine}/k for k = 1, 2, "
    "...); the curve is within {distance} of the trigonometric polynomial of the certificate; on "
    "it {low} <= {y} <= {high}; orbits that start below the curve stay below it, and orbits above "
    "it above, for all times, forward and backward: so none goes from {y} < {low} to {y} > {high}, "
    "or back"
)

THEOREM = MapCurve
