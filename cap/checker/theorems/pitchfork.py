"""The theorem about the pitchfork: a pair of (1,1) orbits is born from the symmetric one.

In the units and with the equations of ``impact``: with phi in (-pi/2, 0) from (a) and W from (c),
the remaining equation (b) is g(delta, alpha) = 0,

    g = W delta + (pi/2) sin phi sin delta,

which is odd in delta.  Put A = pi alpha/2, c = sqrt(1 - A^2), s = -sin phi = sqrt(1 - A^2/cos^2
delta) = c - A^2 delta^2/(2c) + O(delta^4), W = (rho + 2s (1 + delta^2/2))/pi + O(delta^4).  Hence g
= c_1 delta + c_3 delta^3 + O(delta^5) with

    c_1 = rho/pi + (2/pi - pi/2) c,
    c_3 = (c - A^2/c)/pi + (pi/2)(A^2/(2c) + c/6),
    dc_1/dalpha = (pi/2 - 2/pi)(pi^2/4) alpha/c > 0.

c_1 = 0 at c = 2 rho/(pi^2 - 4): with dc_1/dalpha != 0, c_3 != 0 this is a pitchfork, and the zeros
besides delta = 0 are alpha = alpha_0 - c_3/(dc_1/dalpha) delta^2 + O(delta^4): both orbits of the
pair have the same alpha, and by ``impact`` these are all pairs.  On them trace Phi' is even in
delta, with the value 2 at delta = 0; its jet gives the next coefficient.

The symmetric orbit has the half trace h = 2 - 2 pi^2 c/(rho + 2c), -2 there, with the slope

    dh/dalpha = -2 pi^2 rho/(rho + 2c)^2 dc/dalpha,    dc/dalpha = -(pi^2/4) alpha/c.

Least speeds are continuous: the orbits of the pair with small delta are genuine if this one is.
"""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.one_one import closed_form as impact
from cap.checker.theorems.symmetric import Scaled


class Pitchfork(Scaled):
    """The birth of the pair."""

    def prove(self) -> None:
        """Prove the theorem."""
        c, F, one = impact.birth(self.rho), self.p.F, Fraction(1)
        if c is None:
            raise Rejected("R omega^2/F is not below (pi^2 - 4)/2: no pair is born")
        alpha = impact.friction(c)
        self.confirm("f", alpha * self.number(F), F)
        self.state("", self.claims, impact.Symmetric(alpha, self.rho, c))
        need(self.claims["least_speed"].lower > 0, "the least speed is not positive")
        self.step("the symmetric orbit is genuine where the pair is born")
        bend, cubic = -self.pi().square() / 4 * alpha / c, self.cubic(c)
        linear = -(self.pi() / 2 - self.number(Fraction(2)) / self.pi()) * bend
        half = -self.pi().square() * 2 * self.rho / (self.rho + c * 2).square() * bend
        self.confirm("half_trace_slope", half / self.number(F), 1 / F)
        self.confirm("cubic", cubic, one)
        self.confirm("linear_slope", linear, one)
        self.confirm("curvature", -cubic / linear * self.number(F), F)
        pair = impact.over_intervals(self.rho).at(self.number(Fraction(0)), 2)
        self.confirm("trace_curvature", pair.trace.coefficients[2,], one)
        self.step("the derivatives contain what is computed")
        for name in ("half_trace_slope", "cubic", "linear_slope", "curvature", "trace_curvature"):
            claim = self.claims[name]
            need(not claim.lower <= 0 <= claim.upper, f"{name} does not exclude 0")
        self.step("it is a pitchfork")

    def cubic(self, c: Interval) -> Interval:
        """Return c_3."""
        A2 = -c.square() + 1
        return (c - A2 / c) / self.pi() + self.pi() / 2 * (A2 / c / 2 + c / 6)
