"""The (1,1) orbits that are not symmetric, in closed form.

Units, names and the equations (a), (b), (c) are those of ``closed_form``.

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
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.series import K, cos_sinc, divided, plus, reciprocal, square_root
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


def slowest(pair: Pair[Interval]) -> Interval:
    """Return L of one orbit of a pair."""
    alpha, S = pair.alpha.constant, pair.S.constant
    angle = arccos(alpha) + arccos(S) - pi(S.bits) / 2
    q = (-alpha.square() + 1).sqrt()
    return pair.W.constant - q - S * pair.sin.constant + alpha * angle
