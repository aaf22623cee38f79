"""The mechanics with losses: x'' = F cos wt - f sgn x' - mu x', and v -> -e v at a wall.

*Flights.*  A solution of x'' = F cos wt - mu x' is, with P = F/(mu^2 + w^2),

    x_p(t) = P ((mu/w) sin wt - cos wt),      v_p(t) = P (mu cos wt + w sin wt).

Let h(d) be the integral of e^(-mu u) over [0, d], and k(d) that of h.  The flight that starts at
t_0 from (x_0, v_0) is, with d = t - t_0, A = v_0 - v_p(t_0), X = x_0 - x_p(t_0), C = mu A + s f,

    x(t) = x_p(t) + X + A d - C k(d),      v(t) = v_p(t) + A - C h(d),

for k' = h, h' = 1 - mu h, so that x' = v and v' = v_p' - C + mu C h = (F cos wt - mu v_p) - s f -
mu (A - C h); and at t_0 this is (x_0, v_0).  There is no division by mu: with phi_n as in
``exponential``,

    h(d) = d phi_1(-mu d),      k(d) = d^2 phi_2(-mu d),      h = d, k = d^2/2 for mu = 0,

so mu may be a variable of the jets, over an interval that contains 0; and so may e.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.flow.exponential import phi
from cap.checker.flow.mechanics import Box, Ends, Mechanics
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, lift
from cap.checker.kernel.series import divided, nilpotent, reciprocal
from cap.checker.kernel.theorem import Parameters


class Losses(NamedTuple):
    """A set of restitutions e and viscosities mu, by the ends of two intervals."""

    e: Ends
    mu: Ends


class Lossy(Mechanics):
    """The mechanics with the e and mu of the parameters or, as further variables, with a set."""

    def __init__(
        self,
        p: Parameters,
        box: Box,
        m: Box,
        order: int,
        periods: int = 1,
        losses: Losses | None = None,
    ) -> None:
        sets = [Interval.enclosing(*q, box[0].bits) for q in losses or ()]
        super().__init__(p, [*box, *sets], [*m, *(q.midpoint() for q in sets)], order, periods)
        exact = [self.constant(self.number(q)) for q in (p.e, p.mu)]
        self.e, self.mu = self.variables[2:] or exact
        self.is_viscous = p.mu > 0 or losses is not None
        constants = self.constant(self.omega.square()), self.constant(self.F)
        self.amplitude = lift(lambda mu, w, F: F * reciprocal(mu * mu + w), self.mu, *constants)

    @property
    def losses(self) -> tuple[Centred, ...]:
        """Viscosity and P, if there is viscosity."""
        return (self.mu, self.amplitude) if self.is_viscous else ()

    def x_p(self, cos: RealJet, sin: RealJet, *losses: RealJet) -> RealJet:
        """Return x_p(t)."""
        if not losses:
            return super().x_p(cos, sin)
        mu, P = losses
        return P * (mu * sin * (mu.constant.integer(1) / self.omega) - cos)

    def v_p(self, cos: RealJet, sin: RealJet, *losses: RealJet) -> RealJet:
        """Return v_p(t)."""
        if not losses:
            return super().v_p(cos, sin)
        mu, P = losses
        return P * (mu * cos + sin * self.omega)

    def integral(self, n: int, d: RealJet, *losses: RealJet) -> RealJet:
        """Return h(d) for n = 1, k(d) for n = 2."""
        if not losses:
            return super().integral(n, d)
        z = -(d * losses[0])
        power = d if n == 1 else d * d
        return power * composed([phi(n, z.constant, k) for k in range(d.order + 1)], z)

    def acceleration(self, arc: Sequence[RealJet], when: Sequence[RealJet], s: int) -> RealJet:
        """Return v'(t) on a flight of direction s."""
        cos = when[1]
        driven = cos * self.F - Jet(cos.order, {cos.origin: self.f * s})
        return driven - self.velocity(arc, when) * arc[4] if self.is_viscous else driven

    def drag(self, A: Centred, s: int) -> Centred:
        """Return C on a flight."""
        c = super().drag(A, s)
        return lift(lambda a, mu, c: a * mu + c, A, self.mu, c) if self.is_viscous else c

    def reflected(self, speed: Centred, s: int) -> Centred:
        """Return the velocity after a hit, from the speed before it."""
        return lift(lambda u, e: u * e * -s, speed, self.e)


def composed(derivatives: Sequence[Interval], jet: RealJet) -> RealJet:
    """Return g(jet) from g and its derivatives at the constant term, as many as the order.

    Of c + h, h without constant term, it is the sum of g^(k)(c) h^k/k!.
    """
    h, one = nilpotent(jet), derivatives[0].integer(1)
    term, total = Jet(jet.order, {jet.origin: one}), Jet(jet.order, {jet.origin: derivatives[0]})
    for k in range(1, jet.order + 1):
        term = divided(term * h, k)
        total = total + term * derivatives[k]
    return total
