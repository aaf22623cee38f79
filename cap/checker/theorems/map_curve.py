"""The theorem about an invariant curve around a cylinder, of a map given by formulas.

The map g is one of ``cap.checker.tori.kicked``; what follows is in ``cap.checker.tori.cylinder``.
"""

from __future__ import annotations

from typing import Any

from cap.checker.coverings.formulas import FORMULAS, Formulas, formulas
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, enclosure
from cap.checker.system.given import printed
from cap.checker.tori import told
from cap.checker.tori.cylinder import AroundCylinder
from cap.checker.tori.invariant_curve import Image, Vector
from cap.checker.tori.kicked import Kicked

MAX_FACTORS = 64  # cosines and sines in the map
PER_SECOND = 12_000  # digits of functions


class MapCurve(AroundCylinder):
    """An invariant curve around a cylinder."""

    PARAMETERS = FORMULAS
    units = {}  # noqa: RUF012
    # fmt: off
    CLAIMS = (
        *AroundCylinder.CLAIMS,
        Field("bounds", enclosure, "second coordinate", "y", "on the curve"),
    )
    # fmt: on

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Formulas:
        """Return the map."""
        return formulas(given)

    def seconds(self) -> int:
        """Return about how long a proof takes: products of functions are most of it."""
        return int(self.hints["degree"] * self.hints["places"]) // PER_SECOND

    def prove(self) -> None:
        """Prove the theorem."""
        factors = sum(len(m) for q in self.p.image for m in q.terms)
        need(factors <= MAX_FACTORS, f"the map has more than {MAX_FACTORS} factors")
        self.kicked = Kicked.of(self.p)
        self.step("the map kicks y by a function of x with mean 0, and then x by b y + c, b != 0")
        lower, upper = self.curve()
        claim = self.claims["bounds"]
        need(claim.lower <= lower, "bounds: y may be below them")
        need(upper <= claim.upper, "bounds: y may be above them")
        self.step("on the curve y is between the bounds")

    def image(self, K: Vector) -> Image:
        """Return the image of all curves in these functions."""
        return self.kicked.over(*K)

    def words(self) -> str:
        """Return the theorem in one line."""
        x, y = self.p.state
        claims = self.claims
        low, high = claims["bounds"].text
        more = {name: decimal(claims[name]) for name in ("diophantine", "distance")}
        more |= {"x": x, "y": y, "low": low, "high": high, "alpha": told.turns(claims)}
        return _CURVE.format(images=", ".join(printed(q, x) for q in self.p.image), **more)


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
