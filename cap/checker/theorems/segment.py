"""The theorem about the segment: the T-periodic orbits that touch no wall, and a basin.

`cap.checker.flow.free` has the velocity v* of those orbits, and the bound D(U) for the integral of
|v - v*| of others.

*Orbits.*  So a T-periodic orbit that touches no wall has the velocity v*, and its place between the
two turns varies by the stroke, the integral of v* over half a period.  Its x(0) may be anything
with l < x(0) - below, x(0) + (stroke - below) < r, below the integral of v* from t_0 to 0: an open
segment (left, right) if the stroke is less than R; e does not matter.  At these states Phi has the
derivative ((1, *), (0, m)), m = e^(-mu T) q^2, q = (c - f)/(c + f) at each turn.

*A basin.*  Let u = v(0) - v*(0), U = |u| < d.  If left < x(0), x(0) + D(U) < right for u >= 0 (left
< x(0) - D(U), x(0) < right for u <= 0), then x differs from the orbit of the segment with the same
x(0) by less than what would bring that to a wall: none is touched.  The difference is monotone, so
it converges, and v - v* tends to 0: the orbit tends to one of the segment.  These states are an
open set of the area 2 (L d - a_1 d^2/2 - a_2 d^3/3), L = right - left, if D(d) <= L.
"""

from __future__ import annotations

from cap.checker.flow.free import Free, Velocity
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.theorem import BITS
from cap.checker.system.lossy import SYSTEM, WithLosses


class Segment(WithLosses, Free):
    """The segment of orbits that touch no wall."""

    HINTS = (BITS,)
    # fmt: off
    CLAIMS = (
        Field("left", Quantity("R"), "left", r"x_-", "T-periodic orbits that touch no wall are "
              "those with v = v*(0) and left < x < right at t = 0"),
        Field("right", Quantity("R"), "right", r"x_+", "see left"),
        Field("v", Quantity("R omega"), "v at t = 0", "v", "v*(0), their common velocity"),
        Field("stroke", Quantity("R"), "stroke", "s", "by which x varies on each; below R"),
        Field("turning_times", [Quantity("omega^-1")] * 2, "turn", "t_k",
              "of the turn left and the turn right, in (0, T)"),
        Field("multipliers", [Quantity()] * 2, "multiplier", r"\lambda",
              "exactly 1, then exp(-mu T) ((c - f)/(c + f))^2, c the force at the turns"),
        Field("basin", {"speed": number, "drift": [number] * 2}, "", "",
              "d and a, b: with D(u) = a u + b u^2, orbits from (x, v*(0) + u), |u| < d, left < x, "
              "x + D(u) < right if u >= 0, left < x - D(-u), x < right if u < 0, touch no wall and "
              "tend to one of these"),
        Field("basin_area", Quantity("R^2 omega"), "area of the basin", "A",
              "2 (L d - a d^2/2 - b d^3/3), L = right - left"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        found = self.velocity()
        self.segment(found)
        self.multipliers(found)
        self.basin(found.stroke)

    def segment(self, found: Velocity) -> None:
        """Compare the ends of the segment, the velocity, the stroke and the times of the turns."""
        R, claims = self.R, self.claims
        self.confirm(turning_times=self.turning_times(found))
        self.confirm(v=found.v)
        self.confirm(stroke=found.stroke)
        self.confirm(left=self.number(self.p.l) + found.below)
        self.confirm(right=self.number(self.p.r) - (found.stroke - found.below))
        room = claims["stroke"].upper < R and claims["left"].upper < claims["right"].lower
        need(room, "the stroke may be as long as the gap")
        self.step("there is one T-periodic orbit for each x between the ends, and no other")

    def multipliers(self, found: Velocity) -> None:
        """Compare the multipliers."""
        one, product = self.claims["multipliers"]
        need(one[:2] == (1, 1), "the first multiplier is exactly 1")
        self.compare("multipliers[1]", product, self.multiplier(found))
        need(product.lower > 0 and product.upper < 1, "the second multiplier is not in (0, 1)")
        self.step("the multipliers are 1 and one in (0, 1)")

    def basin(self, stroke: Interval) -> None:
        """Prove that the basin is one, and compare its area."""
        self.drift()
        claims, left, right = self.claims, self.claims["left"], self.claims["right"]
        d, (a_1, a_2) = claims["basin"]["speed"], claims["basin"]["drift"]
        need(a_1 * d + a_2 * d**2 <= right.lower - left.upper, "the drift may reach a wall")
        length = self.number(self.R) - stroke
        lost = self.number(a_1 * d**2 / 2 + a_2 * d**3 / 3)
        self.confirm(basin_area=(length * self.number(d) - lost) * 2)
        need(claims["basin_area"].lower > 0, "the area of the basin is not positive")
        self.step("all orbits from the basin tend to orbits of the segment")

    def words(self) -> str:
        """Return the theorem in one line."""
        d, a, b = map(decimal, (self.claims["basin"]["speed"], *self.claims["basin"]["drift"]))
        return self.told(SYSTEM + _ORBITS + _BASIN, d=d, a=a, b=b)


_ORBITS = (
    "with T = 2 pi/omega, "
    "the T-periodic orbits that touch no wall are those with v = v* at t = 0 and x anywhere "
    "between left and right, v* in {v}, left in {left}, right in {right}; they all have the same "
    "velocity, turn left at a time in {turning_times[0]} and right at one in {turning_times[1]}, "
    "never stick, and have a stroke in {stroke}; at these fixed points of the time-T map, which "
    "are not isolated, its derivative has the multipliers 1 and one in {multipliers[1]}"
)
_BASIN = (
    "; let D(u) = {a} u + {b} u^2: every orbit from (x, v* + u) with |u| < {d}, left < x and x + "
    "D(u) < right if u >= 0, left < x - D(-u) and x < right if u < 0, touches no wall and tends to "
    "one of these orbits; these states are an open set with an area in {basin_area}"
)

THEOREM = Segment
