"""The theorem about the pitchfork: a pair of (1,1) orbits is born from the symmetric one.

In the units and with the equations of ``closed_form``: with phi in (-pi/2, 0) from (a) and W
from (c), the remaining equation (b) is g(delta, alpha) = 0,

    g = W delta + (pi/2) sin phi sin delta,

which is odd in delta.  Put A = pi alpha/2, c = sqrt(1 - A^2), s = -sin phi = sqrt(1 - A^2/cos^2
delta) = c - A^2 delta^2/(2c) + O(delta^4), W = (rho + 2s (1 + delta^2/2))/pi + O(delta^4).  Hence g
= c_1 delta + c_3 delta^3 + O(delta^5) with

    c_1 = rho/pi + (2/pi - pi/2) c,
    c_3 = (c - A^2/c)/pi + (pi/2)(A^2/(2c) + c/6),
    dc_1/dalpha = (pi/2 - 2/pi)(pi^2/4) alpha/c > 0.

c_1 = 0 at c = 2 rho/(pi^2 - 4): with dc_1/dalpha != 0, c_3 != 0 this is a pitchfork, and the zeros
besides delta = 0 are alpha = alpha_0 - c_3/(dc_1/dalpha) delta^2 + O(delta^4): both orbits of the
pair have the same alpha, and by ``pairs`` these are all pairs.  On them trace Phi' is even in
delta, with the value 2 at delta = 0; its jet gives the next coefficient.

The symmetric orbit has the half trace h = 2 - 2 pi^2 c/(rho + 2c), -2 there, with the slope

    dh/dalpha = -2 pi^2 rho/(rho + 2c)^2 dc/dalpha,    dc/dalpha = -(pi^2/4) alpha/c.

Least speeds are continuous: the orbits of the pair with small delta are genuine if this one is.
"""

from __future__ import annotations

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.theorem import BITS
from cap.checker.one_one.closed_form import Symmetric, birth, friction
from cap.checker.one_one.pairs import over_intervals
from cap.checker.one_one.scaled import STATE, SYSTEM, Scaled
from cap.checker.system import all_f


class Pitchfork(all_f.ForAllF, Scaled):
    """The birth of the pair."""

    HINTS = (BITS,)
    # fmt: off
    CLAIMS = (
        Field("f", Quantity("F"), "f0", "f_0",
              "f_0 = F alpha(0), where the pair is born from the symmetric orbit 'plus'"),
        *STATE,
        Field("half_trace_slope", Quantity("F^-1"), "slope of the half map's trace in f",
              "dh/df", "at f_0, where the half trace is -2"),
        Field("cubic", Quantity(), "cubic coefficient", "c_3", "c_3 at alpha(0)"),
        Field("linear_slope", Quantity(), "slope of the linear coefficient in f/F",
              r"dc_1/d\alpha", "dc_1/dalpha at alpha(0)"),
        Field("curvature", Quantity("F"), "p, f = f0 + p delta^2 + ...", "p",
              "-F cubic/linear_slope: f = f_0 + curvature delta^2 + O(delta^4) on the pair"),
        Field("trace_curvature", Quantity(), "q, trace = 2 + q delta^2 + ...", "q",
              "trace Phi' = 2 + trace_curvature delta^2 + O(delta^4) on the pair"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        c, F = birth(self.rho), self.number(self.p.F)
        if c is None:
            raise Rejected("R omega^2/F is not below (pi^2 - 4)/2: no pair is born")
        alpha = friction(c)
        self.confirm(f=alpha * F)
        self.confirm(**self.state(Symmetric(alpha, self.rho, c)))
        need(self.claims["least_speed"].lower > 0, "the least speed is not positive")
        self.step("the symmetric orbit is genuine where the pair is born")
        bend, cubic = -self.pi().square() / 4 * alpha / c, self.cubic(c)
        linear = -(self.pi() / 2 - self.number(2) / self.pi()) * bend
        half = -self.pi().square() * 2 * self.rho / (self.rho + c * 2).square() * bend
        self.confirm(half_trace_slope=half / F, cubic=cubic, linear_slope=linear)
        self.confirm(curvature=-cubic / linear * F)
        pair = over_intervals(self.rho).at(self.number(0), 2)
        self.confirm(trace_curvature=pair.trace.coefficients[2,])
        self.step("the derivatives contain what is computed")
        for name in ("half_trace_slope", "cubic", "linear_slope", "curvature", "trace_curvature"):
            claim = self.claims[name]
            need(not claim.lower <= 0 <= claim.upper, f"{name} does not exclude 0")
        self.step("it is a pitchfork")

    def cubic(self, c: Interval) -> Interval:
        """Return c_3."""
        A2 = -c.square() + 1
        return (c - A2 / c) / self.pi() + self.pi() / 2 * (A2 / c / 2 + c / 6)

    def words(self) -> str:
        """Return the theorem in one line."""
        kind = "elliptic" if self.claims["trace_curvature"].upper < 0 else "saddles"
        side = "f < f_0" if self.claims["curvature"].upper < 0 else "f > f_0"
        return self.told(all_f.told(SYSTEM) + _PITCHFORK, kind=kind, side=side)


_PITCHFORK = (
    "at one f_0 in {f}, two (1,1) orbits, mirror images of each other under (x, v, t) -> (l + r - "
    "x, -v, t + T/2), branch off from the symmetric (1,1) orbit with x in {x}, v in {v} at t = 0, "
    "which there has the speed at its hits in {hit_speed} and a least speed in {least_speed}; its "
    "map over half a period with the reflection has the trace -2 there, with the derivative in f "
    "in {half_trace_slope}; the two, with (pi + 2 delta)/omega and (pi - 2 delta)/omega from the "
    "hit of r to that of l, belong to f = f_0 + p delta^2 + O(delta^4) with p in {curvature}, and "
    "have the trace 2 + q delta^2 + O(delta^4) with q in {trace_curvature}"
    "; so for {side} near f_0 both are {kind} near the symmetric orbit, and none is there "
    "on the other side of f_0"
)

THEOREM = Pitchfork
