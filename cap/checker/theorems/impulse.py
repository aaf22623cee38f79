"""The theorem about the impulse bound: for f > 2F/pi every motion comes to rest, and soon.

Let d = f - 2F/pi > 0, and u = |v|.  Where v is not 0, with s its sign,

    u' = s F cos(omega t) - f - mu u <= F |cos(omega t)| - f;      at a hit u becomes e u <= u;

without a zero of v the walls are hit alternately, so not infinitely often in finite time.

*The integral.*  H(theta), the integral of |cos| - 2/pi from 0 to theta, has the period pi, since
2/pi is the mean of |cos|; it is odd, and sin theta - 2 theta/pi for |theta| <= pi/2, where H' = 0
at cos theta = 2/pi.  So |H| <= h/pi,  h = sqrt(pi^2 - 4) - 2 arccos(2/pi),  and over any time tau

    the integral of F |cos(omega t)| - f is at most (2h/pi) F/omega - d tau.

*Rest.*  Let Z be the set of the times in [t, t + tau] at which v = 0; consider this integral over
each of the intervals of which the other times consist.  Between two times of Z u goes from 0 to 0,
so it is not negative; nor on the last interval, from 0 to some u >= 0; on the first, where u begins
with |v| at the time t, it is at least -|v|.  If the measure of Z is 0, they add up to the whole:

    -|v| <= (2h/pi) F/omega - d tau,      tau <= D + B |v|,      D = (2h/pi) F/(omega d),  B = 1/d.

So within longer times v = 0 on a set of positive measure.  At a time of Z the mass stays at rest
for a while if |F cos(omega t)| < f, or if it is at a wall and the force presses it there; if not,
either |F cos(omega t)| = f, or v is not 0 just after: such times of Z are countably many.  So Z
contains an interval.

*Sharp.*  Let f = 2F/pi, e = 1, mu = 0.  For |omega t| <= pi/2 let v = R omega/pi + (F/omega)
H(omega t): then v' = F cos(omega t) - f, and v leads from l to r in this time, since H is odd.  At
its ends H = 0: so after an elastic hit the mirror image follows, half a period later, and then v
again.  As H >= -h/pi, v > 0 if R > h F/omega^2: this velocity, of period T, never vanishes.
"""

from __future__ import annotations

from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.theorem import BITS
from cap.checker.system.lossy import SYSTEM, WithLosses


class Impulse(WithLosses):
    """Every motion comes to rest."""

    HINTS = (BITS,)
    # fmt: off
    CLAIMS = (
        Field("margin", Quantity("F"), "f - 2F/pi", r"f - 2F/\pi", "f - 2F/pi, positive"),
        Field("delay", Quantity("omega^-1"), "D", "D", "2hF/(omega (pi f - 2F))"),
        Field("delay_per_speed", Quantity("F^-1"), "B", "B", "1/(f - 2F/pi)"),
        Field("gap", Quantity("F omega^-2"), "G", "G", "hF/omega^2"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        p, pi = self.p, self.pi()
        bound = pi.integer(2) / pi
        margin = self.number(p.f / p.F) - bound  # d/F
        need(margin.is_positive(), "f is not certainly above 2F/pi")
        self.step("f > 2F/pi: every motion comes to rest")
        h = (pi.square() - 4).sqrt() - arccos(bound) * 2
        self.confirm(
            margin=margin * self.number(p.F),
            delay=h * bound / margin * self.number(1 / p.omega),
            delay_per_speed=margin.integer(1) / margin * self.number(1 / p.F),
            gap=h * self.number(p.F / p.omega**2),
        )
        self.step("the claims contain what is computed")
        need(self.claims["margin"].lower > 0, "the margin claimed is not positive")
        self.step("f > 2F/pi also by the numbers claimed")

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told(SYSTEM + _IMPULSE)


_IMPULSE = (
    "f - 2F/pi is in {margin}, so from every state (x, v), at every time, the mass comes to rest "
    "within any time longer than D + B |v|, D in {delay}, B in {delay_per_speed}: its velocity is "
    "zero on an interval of time; hence there is no motion whose velocity never vanishes; with "
    "f = 2F/pi, e = 1 and mu = 0, and walls farther apart than G in {gap}, there is one, of "
    "period 2 pi/omega: the bound 2F/pi is sharp"
)

THEOREM = Impulse
