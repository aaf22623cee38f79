"""The theorem about an elastic ball on a vibrating table: an invariant curve bounds its speeds.

    y'' = -g,   y > A sin(omega t);   at y = A sin(omega t) the velocity relative to the table
    changes its sign;   0 < A omega^2 < g.

In units omega = g = 1 the map from impact to impact is that of ``cap.checker.tori.bouncing``, with
a = A omega^2/g, in the coordinates t and v^2/2; what follows is in ``cap.checker.tori.cylinder``.

From both sides a motion comes near the curve, and goes far: ``cap.checker.tori.passage``.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import MAX_SIZE, number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Whole, enclosure
from cap.checker.tori import passage, told
from cap.checker.tori.bouncing import Flight, over
from cap.checker.tori.cylinder import AroundCylinder
from cap.checker.tori.invariant_curve import Image, Vector
from cap.checker.tori.written import function

PER_SECOND = 8_000  # digits of functions
PLACES_PER_SECOND = 400_000  # binary places of impacts
NAMES = ("A", "omega", "g")


class Table(NamedTuple):
    """The exact parameters."""

    A: Fraction
    omega: Fraction
    g: Fraction


class BallCurve(AroundCylinder):
    """An invariant curve of a ball on a table."""

    PARAMETERS = dict.fromkeys(NAMES, number)
    units = {}  # noqa: RUF012
    # fmt: off
    HINTS = (
        *AroundCylinder.HINTS,
        Field("flight", dict.fromkeys(("speed", "inverse", "time", "later"), text), "", "",
              "along K: v; 1/v; the time to the next impact; 1/v there; both reciprocals in units "
              "10^-20"),
        Field("bits", Whole(64, passage.MAX_BITS), "", "", "binary places of the impacts of rise "
              "and fall"),
    )
    CLAIMS = (
        *AroundCylinder.CLAIMS,
        Field("turns", Whole(0, 999), "", "n", "the table oscillates n + alpha times between two "
              "impacts, on average"),
        Field("speeds", enclosure, "speeds", "v", "on the curve: after impacts, relative to the "
              "table"),
        Field("rise", passage.PASSAGE, "", "", "a motion that starts below the curve, with this "
              "phase and speed after an impact; after so many more its speed is at least this"),
        Field("fall", passage.PASSAGE, "", "", "a motion that starts above the curve; after so "
              "many more impacts its speed is at most this"),
    )
    # fmt: on

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Table:
        """Return the parameters; those of no such ball reject."""
        p = Table(**given)
        sized = all(1 / Fraction(MAX_SIZE) <= q <= MAX_SIZE for q in p)
        need(sized, "a parameter is not between 10^-30 and 10^30")
        need(p.A * p.omega**2 < p.g, "A omega^2 < g does not hold")
        return p

    def seconds(self) -> int:
        """Return about how long a proof takes: products of functions are most of it."""
        functions = int(self.hints["degree"] * self.hints["places"]) // PER_SECOND
        impacts = sum(int(self.claims[side]["impacts"]) for side in ("rise", "fall"))
        return functions + impacts * int(self.hints["bits"]) // PLACES_PER_SECOND

    def prove(self) -> None:
        """Prove the theorem."""
        hints, bits, coarse = self.hints["flight"], self.circle.bits, self.coarse
        a = self.p.A * self.p.omega**2 / self.p.g
        self.a = Interval.enclosing(a, a, bits)
        units = {"speed": 1, "inverse": coarse, "time": 1, "later": coarse}
        self.flight = Flight(**{k: function(self.circle, hints[k], units[k]) for k in units})
        low, high = self.curve(self.claims["turns"])
        need(low > 0, "v^2/2 may not be positive on the curve")
        speeds = (Interval.enclosing(low, high, bits) * 2).sqrt()
        scale = self.p.g / self.p.omega
        claim = self.claims["speeds"]
        need(claim.lower <= speeds.lower * scale, "speeds: they may be lower")
        need(speeds.upper * scale <= claim.upper, "speeds: they may be higher")
        self.step("on the curve the speeds are between the bounds")
        self.passages(a, scale)

    def passages(self, a: Fraction, unit: Fraction) -> None:
        """Prove that motions pass from one speed to another, below the curve and above it."""
        rise, fall = self.claims["rise"], self.claims["fall"]
        speeds, force = self.claims["speeds"], Interval.enclosing(a, a, self.hints["bits"])
        need(rise["speed"] < speeds.lower, "rise: the motion may not start below the curve")
        need(rise["speed"] < rise["to"], "rise: the motion is not claimed to rise")
        last = passage.after(force, rise, unit).lower * unit
        need(rise["to"] <= last, "rise: the speed at the end may be lower")
        self.step("a motion below the curve rises as claimed")
        need(fall["speed"] > speeds.upper, "fall: the motion may not start above the curve")
        need(fall["speed"] > fall["to"], "fall: the motion is not claimed to fall")
        last = passage.after(force, fall, unit).upper * unit
        need(last <= fall["to"], "fall: the speed at the end may be higher")
        self.step("a motion above the curve falls as claimed")

    def image(self, K: Vector) -> Image:
        """Return the image of all curves in these functions."""
        return over(self.a, self.flight, *K)

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        low, high = claims["speeds"].text
        more = {name: decimal(claims[name]) for name in ("diophantine", "distance")}
        more |= {"low": low, "high": high, "alpha": told.turns(claims)}
        for side, far in (("rise", "u"), ("fall", "w")):
            given = claims[side]
            more |= {far: decimal(given["speed"]), f"{far}_end": decimal(given["to"])}
            more |= {f"{far}_impacts": given["impacts"]}
        return _BALL.format(turns=claims["turns"], **self.p._asdict(), **more)


_BALL = (
    "a ball, y'' = -{g}, that bounces elastically on a table at {A} sin({omega} t): in the plane "
    "of the phase omega t of an impact, modulo 2 pi, and of the speed v > 0 after it, relative to"
    " the table, the map to the next impact has an invariant analytic curve that goes around "
    "once, on which it is conjugate to a rotation; between two impacts on it the table oscillates"
    " {turns} + alpha times on average, alpha = {alpha} (dist(k alpha, Z) >= {diophantine}/k for "
    "k = 1, 2, ...); in the coordinates omega t and v^2 omega^2/(2 g^2) the curve is within "
    "{distance} of the trigonometric polynomial of the certificate; on it {low} <= v <= {high}; "
    "motions that start below the curve stay below it, forward and backward: if v < {low} after "
    "one impact, then v <= {high} after all, and if v > {high} after one, then v >= {low} after "
    "all; below it a motion goes from v = {u} to v >= {u_end} in {u_impacts} impacts, and above "
    "it one from v = {w} to v <= {w_end} in {w_impacts}: so no invariant curve that goes around "
    "once lies in {u} <= v < {u_end} or in {w_end} < v <= {w}; of all invariant curves that go "
    "around once, above the first motion or through it, the greatest lower bound of max v lies in "
    "[{u_end}, {high}], and of those below the second or through it, the least upper bound of "
    "min v in [{low}, {w_end}]"
)

THEOREM = BallCurve
