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
orbits are their own images, and all others come in pairs.

*Pairs*: delta > 0 and its image.  Let S = -sin phi.  By (b) W = (pi/2) S sin(delta)/delta, so S > 0
as W > 0 is a mean of speeds.  (c) becomes S G = rho with

    G = (pi^2/2) sin(delta)/delta - 2 cos delta - 2 delta sin delta,
    G' = (pi^2/2) (delta cos delta - sin delta)/delta^2 - 2 delta cos delta < 0    in (0, pi/2),

G(0) = (pi^2 - 4)/2, G(pi/2) = 0.  With f > 0, cos phi = C = sqrt(1 - S^2) > 0 and (a) says

    S = rho/G,    alpha = (2/pi) cos(delta) sqrt(1 - S^2).

S increases and alpha strictly decreases with delta, as far as S < 1: for each alpha in (0,
alpha(0)) there is exactly one delta > 0 that satisfies the equations.  At delta = 0 the two
formulas meet the symmetric orbit with c = S = 2 rho/(pi^2 - 4).  There are no pairs if rho >=
G(0).

*The least speed* of a pair, delta > 0.  On the way to the left u' = -cos t - alpha changes its sign
from - to + at a = pi/2 + arcsin alpha only (mod 2 pi).  Here phi = -arcsin S lies in (-pi/2, 0), so
-a < -pi/2 < t_1 < pi/2 < a < pi < t_2 < a + 2 pi: the speed decreases from t_1 to a, and on [a,
t_2] it is least at an end.  On the way to the right u' = cos t - alpha is negative from arccos
alpha < t_2 to b = a + pi and positive from there to 2 pi + arccos alpha, so beyond t_2 the least
speed is that at b or at an end of the way (hits: u_2, u_1 > u(a)).  If t_2 < b < t_1 + 2 pi, the
formulas for both ways give

    u(b) - u(a) = cos(phi + delta) - cos(phi - delta) = 2 S sin delta > 0.

So the least speed is min(L, u_2), with q = sqrt(1 - alpha^2) and a - t_1 = arcsin alpha - phi +
delta

    L = u(a) = W - q + cos(phi - delta) - alpha (arcsin alpha - phi)
             = W - q - S sin delta + alpha (arccos alpha + arccos S - pi/2),
    L' = W' - (S sin delta)' + alpha' (arccos alpha + arccos S - pi/2) - (2/pi) cos(delta) S',

as C cos delta = pi alpha/2 and as -q' = alpha alpha'/q cancels the derivative of arccos alpha.

*Of a symmetric orbit*: u(t + pi) = u(t), u_1 = u_2 = W.  If t_1 < a, u decreases to a, then
increases and may decrease again up to t_2: the least speed is u(a) = W - q + alpha (arccos alpha +
phi).  If not (phi >= arcsin alpha), u first increases and then decreases: it is W.

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

from collections.abc import Callable
from fractions import Fraction
from typing import Generic, NamedTuple

from cap.checker.flow.mechanics import Parameters
from cap.checker.kernel.elementary import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import need
from cap.checker.one_one.series import K, cos_sinc, divided, plus, reciprocal, square_root
from cap.checker.one_one.taylor_model import TaylorModel


class Pair(NamedTuple, Generic[K]):
    """One orbit of the pair at each delta, as jets in delta."""

    delta: Jet[K]
    cos: Jet[K]
    sin: Jet[K]
    S: Jet[K]
    C: Jet[K]
    alpha: Jet[K]
    W: Jet[K]
    speeds: tuple[Jet[K], Jet[K]]
    trace: Jet[K]

    @property
    def hits(self) -> tuple[tuple[Jet[K], Jet[K]], tuple[Jet[K], Jet[K]]]:
        """The pairs (cos t_1, sin t_1) and (cos t_2, sin t_2)."""
        S_cos, S_sin = self.S * self.cos, self.S * self.sin
        C_cos, C_sin = self.C * self.cos, self.C * self.sin
        return (S_cos + C_sin, C_cos - S_sin), (C_sin - S_cos, -C_cos - S_sin)


class Pairs(Generic[K]):
    """The orbits with delta > 0, over intervals or Taylor models.

    ``embed`` makes one of a number, ``values`` encloses what it takes.
    """

    def __init__(
        self, rho: Interval, embed: Callable[[Interval], K], values: Callable[[K], Interval]
    ) -> None:
        self.rho, self.pi = embed(rho), embed(pi(rho.bits))
        self.embed, self.values = embed, values

    def at(self, delta: K, order: int = 0) -> Pair[K]:
        """Return the orbits at delta, with so many derivatives, divided by factorials."""
        return self.along(Jet(order, {(0,): delta, (1,): delta.integer(1)}))

    def along(self, delta: Jet[K]) -> Pair[K]:
        """Return the orbits along a jet."""
        cos, sinc = cos_sinc(delta, self.embed)
        sin = delta * sinc
        G = divided(sinc * (self.pi * self.pi), 2) - (cos + delta * sin) * 2
        S = reciprocal(G) * self.rho
        C = square_root(plus(-(S * S), 1))
        alpha = C * cos * (self.pi.integer(2) / self.pi)
        W = divided(S * sinc * self.pi, 2)
        u_1, u_2 = W + alpha * delta, W - alpha * delta
        kappa_1 = (S * cos + C * sin) * 2 * reciprocal(u_1)
        kappa_2 = (S * cos - C * sin) * 2 * reciprocal(u_2)
        times = plus(delta * delta * -4, self.pi * self.pi)
        trace = plus((kappa_1 + kappa_2) * self.pi * -2 + kappa_1 * kappa_2 * times, 2)
        return Pair(delta, cos, sin, S, C, alpha, W, (u_1, u_2), trace)


def over_intervals(rho: Interval) -> Pairs[Interval]:
    """Return the orbits at single delta."""
    return Pairs(rho, lambda t: t, lambda t: t)


def over_cells(rho: Interval) -> Pairs[TaylorModel]:
    """Return the orbits over cells of delta."""
    return Pairs(rho, TaylorModel.constant, TaylorModel.range)


def scaled_distance(p: Parameters, bits: int) -> Interval:
    """Return rho."""
    rho = (p.r - p.l) * p.omega**2 / p.F
    return Interval.enclosing(rho, rho, bits)


def slowest(pair: Pair[Interval]) -> Interval:
    """Return L of one orbit of a pair."""
    alpha, S = pair.alpha.constant, pair.S.constant
    angle = arccos(alpha) + arccos(S) - pi(S.bits) / 2
    q = (-alpha.square() + 1).sqrt()
    return pair.W.constant - q - S * pair.sin.constant + alpha * angle


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


def rational(q: Fraction, bits: int) -> Interval:
    """Return an enclosure of a rational number."""
    return Interval.enclosing(q, q, bits)
