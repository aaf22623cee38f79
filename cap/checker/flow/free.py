"""The velocity of a mass that touches nothing: its periodic solution, and how others tend to it.

*The velocity.*  Where nothing is touched v' = F cos wt - mu v - f sgn v does not contain x (at v =
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

*Convergence.*  Let u = v - v*, until something is touched, U = |u(0)|, and kappa = (F - f)/(F + f).
In a half-period between turns of v*, |u| does not grow.  Call it *braking* if v* and u have
opposite signs: say it begins at s, u > 0 > v*.  There |v*|' = -F cos wt - f - mu |v*|, hence

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

as (kappa + kappa^2)/(1 - kappa^2) = (F - f)/(2f), if U is at most d, which is no more than the two
bounds above.  And u tends to 0.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.exponential import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.walls import BetweenWalls


class Velocity(NamedTuple):
    """What is computed of v*: -w t_0, c, v*(0), the place at 0 above that at t_0, the stroke."""

    y: Interval
    force: Interval
    v: Interval
    below: Interval
    stroke: Interval


class Free(BetweenWalls):
    """A theorem about orbits that touch nothing."""

    def velocity(self) -> Velocity:
        """Return v*, which turns twice in a period and never sticks."""
        need(self.p.f > 0, "0 < f does not hold")
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
        force = cos * self.number(self.p.F)
        need((force - f).is_positive(), "the orbit may stick, not turn")
        self.step("the periodic velocity turns twice in a period, and never sticks")
        return Velocity(y, force, v, moved(d, x_p[0]), stroke)

    def arcsin(self, s: Interval) -> Interval:
        """Return an enclosure of the arcsine."""
        return self.pi() / 2 - arccos(s)

    def turning_times(self, found: Velocity) -> list[Interval]:
        """Return the times of the turn left and the turn right in (0, T)."""
        half, start = (q / self.number(self.p.omega) for q in (self.pi(), found.y))
        return [half - start, half * 2 - start]

    def multiplier(self, found: Velocity) -> Interval:
        """Return e^(-mu T) q^2, by which v - v* is multiplied in a period, to first order."""
        f, mu = self.number(self.p.f), self.number(self.p.mu)
        factor = (found.force - f) / (found.force + f)
        return phi(0, -(mu * self.pi() * 2 / self.number(self.p.omega))) * factor.square()

    def drift(self) -> None:
        """Check that the integral of |v - v*| is below D(U) for U < d, the numbers as claimed."""
        F, f, omega, claims = self.p.F, self.p.f, self.p.omega, self.claims
        d, (a_1, a_2) = claims["basin"]["speed"], claims["basin"]["drift"]
        t_1, pi = claims["turning_times"][0], self.pi()
        kappa = (F - f) / (F + f)
        need(d > 0, "the basin has no interior")
        need(d <= pi.lower * (F + f) ** 2 / (2 * omega * F), "the basin is too fast for a period")
        need(d <= t_1.lower * (F + f), "the basin is too fast for the first turn")
        slope = t_1.upper + pi.upper * (F - f) / (2 * omega * f)
        need(a_1 >= slope, "the drift may be larger than claimed, to first order")
        need(a_2 >= f / ((F + f) ** 2 * (1 - kappa**4)), "the drift may be larger than claimed")
