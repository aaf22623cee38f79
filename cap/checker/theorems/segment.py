"""The theorem about the segment: the T-periodic orbits that touch no wall, and a basin.

*The velocity.*  Where no wall is touched v' = F cos wt - mu v - f sgn v does not contain x (at v =
0 the mass rests while |F cos wt| <= f).  Let u = v_1 - v_2 for two solutions: friction decreases
with v, so (u^2)' <= -2 mu u^2.  Hence |u| does not grow, and u keeps its sign.

*A solution.*  A flight to the right from v = 0 at t_0 has v = V(t) - V(t_0) e^(-mu d) - f h(d), d =
t - t_0, h(d) = (1 - e^(-mu d))/mu, V(t) = A sin(wt + psi), A = F/sqrt(w^2 + mu^2), tan psi = mu/w.
It vanishes again half a period later if, with D = e^(-mu T/2) and h = h(T/2),

    V(t_0) = -f h/(1 + D),    that is    -w t_0 = y = arcsin(f h/((1 + D) A)) + psi,

as V(t_0 + T/2) = -V(t_0).  (The other root has cos w t_0 <= 0.)  Let c = F cos y > f.  On the
flight p = e^(mu t) v has p' = e^(mu t) (F cos wt - f), which is positive up to wt = theta =
arccos(f/F), then negative up to 2 pi - theta, and wt_0 + pi < pi + theta < 2 pi - theta: p rises,
falls to zero, and is positive in between.  At both ends the force F cos w t is c in size, above f:
the mass turns. Mirrored in time by T/2 and in sign, this is a solution v* of period T, v*(t + T/2)
= -v*(t), which turns right at t_0 and left at t_0 + T/2, w t_0 in (-theta, 0): v*(0) > 0.  For mu =
0: sin w t_0 = -pi f/(2F), c > f means f/F < 2/sqrt(4 + pi^2), and the stroke is 2 c/w^2.

*There is no other.*  Let v be another solution of period T, u = v - v*.  |u| is periodic and does
not grow, so it is constant, not zero, so mu = 0 and v, v* never have opposite signs for a while.
But v* passes through 0 at its turns: just before or after one it lies between 0 and -u.

*Orbits.*  So a T-periodic orbit that touches no wall has the velocity v*, and its place between the
two turns varies by the stroke, the integral of v* over half a period.  Its x(0) may be anything
with l < x(0) - below, x(0) + (stroke - below) < r, below the integral of v* from t_0 to 0: an open
segment (left, right) if the stroke is less than R; e does not matter.  At these states Phi has the
derivative ((1, *), (0, m)), m = e^(-mu T) q^2, q = (c - f)/(c + f) at each turn.

*A basin.*  Let u = v - v*, until a wall is touched, U = |u(0)|, and kappa = (F - f)/(F + f).  In a
half-period between turns of v*, |u| does not grow.  Call it *braking* if v* and u have opposite
signs: say it begins at s, u > 0 > v*.  There |v*|' = -F cos wt - f - mu |v*|, hence

    |v*(s + d)| <= (F - f) h(d),      |v*(s + T/2 - d)| <= (F + f) (e^(mu d) - 1)/mu.

 (i)   While v > 0, u' = -2f - mu u.  If v vanishes, first at s + d, then u = |v*| there: e^(-mu d)
       u(s) - 2f h(d) <= (F - f) h(d), so h(d) >= e^(-mu d) u(s)/(F + f), u(s + d) <= kappa u(s).
 (ii)  If v <= 0 at some time, let s + T/2 - d be the last one: u = |v*| <= (F + f) e^(mu d) h(d)
       there, and from there on as in (i), u(s + T/2) = e^(-mu d) u - 2f h(d) <= kappa u.
 (iii) If v > 0 all the time, u decreases by at least f T.
So u(s + T/2) <= kappa^2 u(s), if f T >= (1 - kappa^2) u(s), that is u(s) <= T (F + f)^2/(4F).  And
u <= max(kappa u(s), u(s) - 2 f d) at s + d, so its integral over the half-period is at most kappa
u(s) T/2 + f u(s)^2/(F + f)^2.  From t = 0 to the turn left at t_1 = t_0 + T/2, |u| <= U; if u < 0
this is the rest of a braking half-period, and |u(t_1)| <= kappa U as in (ii), or because |u|
decreases by at least 2 f t_1, if U <= (F + f) t_1.  Braking and other half-periods alternate;
adding up, in both cases

    integral of |u| from 0 on  <=  D(U) = a_1 U + a_2 U^2,

    a_1 = t_1 + T (F - f)/(4f),      a_2 = f/((F + f)^2 (1 - kappa^4)),

as (kappa + kappa^2)/(1 - kappa^2) = (F - f)/(2f).  So if U < d, and left < x(0), x(0) + D(U) <
right for u >= 0 (left < x(0) - D(U), x(0) < right for u <= 0), then x differs from the orbit of the
segment with the same x(0) by less than what would bring that to a wall: none is touched.  The
difference is monotone, so it converges, and v - v* tends to 0: the orbit tends to one of the
segment.  These states are an open set of the area 2 (L d - a_1 d^2/2 - a_2 d^3/3), L = right -
left, if D(d) <= L.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.flow.exponential import phi
from cap.checker.kernel.elementary import arccos, cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.theorem import BITS, SYSTEM, WITH_LOSSES, Theorem


class Velocity(NamedTuple):
    """What is computed of v*: -w t_0, c, v*(0), the place at 0 above that at t_0, the stroke."""

    y: Interval
    force: Interval
    v: Interval
    below: Interval
    stroke: Interval


class Segment(Theorem):
    """The segment of orbits that touch no wall."""

    PARAMETERS = WITH_LOSSES
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
        need(self.p.f > 0, "0 < f does not hold")
        found = self.velocity()
        need((found.force - self.number(self.p.f)).is_positive(), "the orbit may stick, not turn")
        self.step("the periodic velocity turns twice in a period, and never sticks")
        self.segment(found)
        self.multipliers(found.force)
        self.basin(found.stroke)

    def velocity(self) -> Velocity:
        """Return what is known of v*, in closed form."""
        omega, mu, f = (self.number(q) for q in (self.p.omega, self.p.mu, self.p.f))
        half = self.pi() / omega
        square = self.number(self.p.omega**2 + self.p.mu**2)
        D, h = phi(0, -(mu * half)), half * phi(1, -(mu * half))
        sine = f * h * square.sqrt() / ((D + 1) * self.number(self.p.F))
        y = self.arcsin(sine) + self.arcsin(mu / square.sqrt())
        cos, sin = cos_sin(y)  # of -w t_0
        P, d, lag = self.number(self.p.F) / square, y / omega, mu / omega
        x_p = [P * -1, P * (-(lag * sin) - cos)]  # at 0 and at t_0
        v_p = [P * mu, P * (mu * cos - omega * sin)]
        A = -v_p[1]
        C = mu * A + f

        def moved(time: Interval, response: Interval) -> Interval:
            """Return the way since t_0 on the flight."""
            k = time.square() * phi(2, -(mu * time))
            return response - x_p[1] + A * time - C * k

        v = v_p[0] + A - C * d * phi(1, -(mu * d))
        stroke = moved(half, -x_p[1])
        return Velocity(y, cos * self.number(self.p.F), v, moved(d, x_p[0]), stroke)

    def arcsin(self, s: Interval) -> Interval:
        """Return an enclosure of the arcsine."""
        return self.pi() / 2 - arccos(s)

    def segment(self, found: Velocity) -> None:
        """Compare the ends of the segment, the velocity, the stroke and the times of the turns."""
        R, omega, claims = self.R, self.p.omega, self.claims
        half, start = self.pi() / self.number(omega), found.y / self.number(omega)
        self.confirm(turning_times=[half - start, half * 2 - start])
        self.confirm(v=found.v)
        self.confirm(stroke=found.stroke)
        self.confirm(left=self.number(self.p.l) + found.below)
        self.confirm(right=self.number(self.p.r) - (found.stroke - found.below))
        room = claims["stroke"].upper < R and claims["left"].upper < claims["right"].lower
        need(room, "the stroke may be as long as the gap")
        self.step("there is one T-periodic orbit for each x between the ends, and no other")

    def multipliers(self, force: Interval) -> None:
        """Compare the multipliers."""
        one, product = self.claims["multipliers"]
        need(one[:2] == (1, 1), "the first multiplier is exactly 1")
        f, mu = self.number(self.p.f), self.number(self.p.mu)
        factor = (force - f) / (force + f)
        decay = phi(0, -(mu * self.pi() * 2 / self.number(self.p.omega)))
        self.compare("multipliers[1]", product, decay * factor.square())
        need(product.lower > 0 and product.upper < 1, "the second multiplier is not in (0, 1)")
        self.step("the multipliers are 1 and one in (0, 1)")

    def basin(self, stroke: Interval) -> None:
        """Prove that the basin is one, and compare its area."""
        F, f, omega, claims = self.p.F, self.p.f, self.p.omega, self.claims
        d, (a_1, a_2) = claims["basin"]["speed"], claims["basin"]["drift"]
        t_1, pi = claims["turning_times"][0], self.pi()
        left, right = claims["left"], claims["right"]
        kappa = (F - f) / (F + f)
        need(d > 0, "the basin has no interior")
        need(d <= pi.lower * (F + f) ** 2 / (2 * omega * F), "the basin is too fast for a period")
        need(d <= t_1.lower * (F + f), "the basin is too fast for the first turn")
        slope = t_1.upper + pi.upper * (F - f) / (2 * omega * f)
        need(a_1 >= slope, "the drift may be larger than claimed, to first order")
        need(a_2 >= f / ((F + f) ** 2 * (1 - kappa**4)), "the drift may be larger than claimed")
        need(a_1 * d + a_2 * d**2 <= right.lower - left.upper, "the drift may reach a wall")
        length = self.number(self.R) - stroke
        lost = self.number(a_1 * d**2 / 2 + a_2 * d**3 / 3)
        self.confirm(basin_area=(length * self.number(d) - lost) * 2)
        need(claims["basin_area"].lower > 0, "the area of the basin is not positive")
        self.step("all orbits from the basin tend to orbits of the segment")

    def words(self) -> str:
        """Return the theorem in one line."""
        d, (a, b) = self.claims["basin"]["speed"], self.claims["basin"]["drift"]
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
