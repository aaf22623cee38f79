"""The (1,1) orbits in closed form: T-periodic, of no zero velocity, one hit of each wall a period.

*Units.*  Time 1/omega, speed F/omega, length F/omega^2; alpha = f/F and rho = R omega^2/F remain.
The speed u = |v| is continuous through elastic hits, and between them

    u' = s cos t - alpha,    s = 1 on the way to the right wall, s = -1 on the way to the left one.

The hits are at t_1 (right wall) and at t_2 in (t_1, t_1 + 2 pi) (left wall); u_1, u_2 are the
speeds at them.  Write t_2 - t_1 = pi + 2 delta, |delta| < pi/2, and phi = (t_1 + t_2)/2 - pi; then
t_1 = phi + pi/2 - delta, t_2 = phi + 3 pi/2 + delta and

    sin t_1 =  cos(phi - delta),    cos t_1 = -sin(phi - delta),
    sin t_2 = -cos(phi + delta),    cos t_2 =  sin(phi + delta).

*The equations.*  u(t_2) = u_1 - (sin t_2 - sin t_1) - alpha (pi + 2 delta), and back u_1 = u_2 +
(sin t_1 - sin t_2) - alpha (pi - 2 delta).  The sum is (a), and then u_1 = W + alpha delta, u_2 = W
- alpha delta for one number W.  Each way is rho long:

    rho = (u_1 + sin t_1)(pi + 2 delta) + cos t_2 - cos t_1 - alpha (pi + 2 delta)^2/2,
    rho = (u_2 - sin t_2)(pi - 2 delta) + cos t_2 - cos t_1 - alpha (pi - 2 delta)^2/2.

With (a), half of the sum is (c) and a quarter of the difference is (b):

    (a)  2 cos phi cos delta = pi alpha
    (b)  W delta = -(pi/2) sin phi sin delta
    (c)  pi W + 2 sin phi (cos delta + delta sin delta) = rho

Conversely a solution with u > 0 on the whole period is a (1,1) orbit: on each way the mass moves
in one direction and arrives after exactly rho.

*Symmetric orbits*: delta = 0, cos phi = pi alpha/2, sin phi = -c with c = +-sqrt(1 - (pi
alpha/2)^2), W = (rho + 2c)/pi.  The half-period later mirror image of a (1,1) orbit, (x, v, t) ->
(l + r - x, -v, t + T/2), is one with -delta in the place of delta and the same phi and W.  So these
orbits are their own images, and all others come in pairs (``pairs``).

*The least speed* of a symmetric orbit: u(t + pi) = u(t), u_1 = u_2 = W.  On the way to the left u'
= -cos t - alpha changes its sign from - to + at a = pi/2 + arcsin alpha only (mod 2 pi).  If t_1 <
a, u decreases to a, then increases and may decrease again up to t_2: the least speed is u(a) = W -
q + alpha (arccos alpha + phi), q = sqrt(1 - alpha^2).  If not (phi >= arcsin alpha), u first
increases and then decreases: it is W.

*The linear part.*  At a hit x - wall changes its sign and v becomes -v; with y the distance
travelled, dy remains and du loses kappa dy, kappa_1 = 2 cos(t_1)/u_1, kappa_2 = -2 cos(t_2)/u_2.  A
flight of length d adds d du to dy.  So Phi' has determinant 1, and the trace of the product of the
four matrices is

    trace = 2 - 2 pi (kappa_1 + kappa_2) + kappa_1 kappa_2 (pi^2 - 4 delta^2).

On a symmetric orbit kappa_1 = kappa_2 = 2 pi c/(rho + 2c), and half a period with the reflection
has the trace 2 - k, k = 2 pi^2 c/(rho + 2c), and determinant 1; so trace = (2 - k)^2 - 2.  It is 2
at k = 4, where c = 2 rho/(pi^2 - 4): there the pairs are born; it is -2, and the half has the
eigenvalues +-i, at k = 2, where c = rho/(pi^2 - 2).  Between 0 and 4, apart from 2, the orbit is
elliptic; for k < 0 or k > 4 it is a saddle.

*State at t = 0.*  If 0 < t_1 < pi = t_2 - t_1, the mass moves to the right at t = 0, with

    u(0) = W - pi alpha/2 + alpha t_1,    r - x(0) = (W - pi alpha/2) t_1 + 1 - c + alpha t_1^2/2.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need


class Symmetric(NamedTuple):
    """A symmetric orbit: cos phi = pi alpha/2 and sin phi = -c."""

    alpha: Interval
    rho: Interval
    c: Interval

    @classmethod
    def of(cls, alpha: Interval, rho: Interval, sign: int) -> Symmetric:
        """Return the orbit with this sign of c, alpha < 2/pi."""
        return cls(alpha, rho, cosine_of_phase(alpha) * sign)

    @property
    def pi(self) -> Interval:
        """An enclosure of pi."""
        return pi(self.rho.bits)

    @property
    def hit_speed(self) -> Interval:
        """The speed at both hits."""
        return (self.rho + self.c * 2) / self.pi

    @property
    def t_1(self) -> Interval:
        """The time of the hit of the right wall, in (0, pi): cos t_1 = c."""
        return arccos(self.c)

    @property
    def k(self) -> Interval:
        """The trace of half a period is 2 - k."""
        return self.pi.square() * self.c * 2 / (self.rho + self.c * 2)

    @property
    def start(self) -> tuple[Interval, Interval]:
        """The distance from the right wall, and the speed, at t = 0."""
        t, alpha = self.t_1, self.alpha
        slow = self.hit_speed - self.pi * alpha / 2
        return slow * t + (-self.c + 1) + alpha * t.square() / 2, slow + alpha * t

    @property
    def slowest(self) -> Interval:
        """The least speed."""
        alpha, phi = self.alpha, self.t_1 - self.pi / 2
        angle = arccos(alpha) + phi  # negative from pi/2 on: t_1 >= a
        if angle.is_before(self.pi / 2):
            return self.hit_speed - (-alpha.square() + 1).sqrt() + alpha * angle
        later = (self.pi / 2).is_before(angle)
        need(later, "whether the speed decreases after a hit is not decided")
        return self.hit_speed


def cosine_of_phase(alpha: Interval) -> Interval:
    """Return sqrt(1 - (pi alpha/2)^2), the size of c."""
    return (-(pi(alpha.bits) * alpha / 2).square() + 1).sqrt()


def friction(c: Interval) -> Interval:
    """Return alpha from c in (0, 1): alpha = (2/pi) sqrt(1 - c^2)."""
    return (-c.square() + 1).sqrt() * 2 / pi(c.bits)


def birth(rho: Interval) -> Interval | None:
    """Return c = 2 rho/(pi^2 - 4), where pairs are born; None if rho >= (pi^2 - 4)/2."""
    return below_one(rho * 2 / (pi(rho.bits).square() - 4))


def half_turn(rho: Interval) -> Interval | None:
    """Return c = rho/(pi^2 - 2), where Phi' = -1; None if rho >= pi^2 - 2."""
    return below_one(rho / (pi(rho.bits).square() - 2))


def below_one(c: Interval) -> Interval | None:
    """Return c if it is below 1, None if it is not: neither certain rejects."""
    one = c.integer(1)
    need(c.is_before(one) or one.is_before(c), "whether c is below 1 is not decided")
    return c if c.is_before(one) else None
