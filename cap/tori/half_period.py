"""Half a period of motions with one hit, as a map of functions.

Units F = ω = 1, walls at ±a, α = f/F.  From (x, v) with v > 0 at the time 0 the mass flies to the
right wall, hits it at t in (0, π), and flies back; σ(x, v) is minus the state at the time π:

    x + vt + 1 - cos t - αt²/2 = a,                u = v + sin t - αt,  the speed at the hit,
    σ = ((u + sin t) d - 1 - cos t - αd²/2 - a,  v + 2 sin t - απ),                d = π - t,
    Dσ = (1 d; 0 1) (1 0; k 1) (1 t; 0 1),   k = -2 cos t/u:     det Dσ = 1, factor by factor.

As (x, v, t) -> (-x, -v, t + π) is a symmetry, σσ = Φ where the left wall is hit in (π, 2π).

*Which root is the hit.*  The velocity v + sin t - αt rises up to arccos α and then falls, up to a
time beyond π.  So on (0, π) it changes sign once at most, from + to -; as x < a at first, the first
root is the one at which it is not negative.
"""

from dataclasses import dataclass
from typing import NamedTuple

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import FourierModel, perturbed, root
from cap.sets.interval import Ball
from cap.tori import flights
from cap.tori.invariant_curve import Image, Vector


class Hit(NamedTuple):
    """A hint: the time of the hit along the curve, sine and cosine of it, and 1/speed."""

    time: FourierModel
    sin: FourierModel
    cos: FourierModel
    inverse: FourierModel

    @classmethod
    def near(cls, time: FourierModel, inverse: FourierModel) -> "Hit":
        """Return the hint with its sine and cosine."""
        return cls(time.centre(), *time.centre().sin_cos(), inverse.centre())


class Passage(NamedTuple):
    """Half a period: the state at its end, and what makes Dσ."""

    x: FourierModel
    v: FourierModel
    time: FourierModel
    rest: FourierModel
    kick: FourierModel

    def tangent(self, w: Vector) -> Vector:
        """Return Dσ w."""
        p, q = w
        p = p + self.time * q
        q = q + self.kick * p
        return p + self.rest * q, q


@dataclass(frozen=True)
class HalfPeriods:
    """The map of as many half periods as there are hints."""

    alpha: Ball
    a: Ball
    hits: tuple[Hit, ...]

    def __call__(self, x: FourierModel, v: FourierModel) -> Image:
        """Return the image of the functions in the models."""
        passages = list[Passage]()
        for hint in self.hits:
            passages.append(self.passage(hint, x, v))
            x, v = passages[-1][:2]

        def tangent(w: Vector) -> Vector:
            for each in passages:
                w = each.tangent(w)
            return w

        return Image(x, v, tangent)

    def passage(self, hint: Hit, x: FourierModel, v: FourierModel) -> Passage:
        """Return half a period of the functions in the models."""
        t, sin, cos, inverse = hint
        value = flights.beyond(self.alpha, self.a, (x, v), t, cos)

        def speed(error: Ball) -> FourierModel:
            near = perturbed((sin, cos), error)[0]
            found: FourierModel = flights.speed(self.alpha, v, t.widened_to(error), near)
            return found

        t = root(t, value, speed, inverse)
        sin, cos = perturbed((sin, cos), t.error)
        u, d = speed(t.error), interval.pi() - t
        confirm_hit(t, u)
        place = flights.landing(self.alpha, self.a, u, (sin, cos), d)
        velocity = flights.speed(self.alpha, v, interval.pi(), 2 * sin)
        return Passage(place, velocity, t, d, -2 * cos * u.reciprocal_near(inverse))


def confirm_hit(t: FourierModel, u: FourierModel) -> None:
    """Raise `NotProved` unless, for real functions, 0 < t < π and u > 0 at all real θ.

    As u has a reciprocal it has no zero, so its mean tells its sign.
    """
    middle, reach = t.mean.real, t.swing + t.error
    if not (middle - reach > 0 and middle + reach < interval.pi()):
        raise NotProved("hit", "it may not be in (0, π)", {"mean": middle, "reach": reach})
    if not u.mean.real > 0:
        raise NotProved("hit", "the speed may not be positive", {"mean speed": u.mean.real})
