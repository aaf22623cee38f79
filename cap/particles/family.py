"""Two masses, the second one anywhere in an interval: the mechanics for all of them at once."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from cap.parameters import Parameters
from cap.particles.model import Model
from cap.sets import interval


class Family(Model):
    """The models with the masses (m, q) for all q of an interval.

    What is enclosed is enclosed for all of them.  ``masses`` are those at the upper end.
    """

    def __init__(self, p: Parameters, mass: Fraction, second: Sequence[Fraction]) -> None:
        lower, upper = second
        super().__init__(p, (mass, upper))
        first, q = self.oscillators[0], interval.hull(interval.ball(lower), interval.ball(upper))
        each = interval.ball(mass) / q  # the forces of the first mass, per unit of the second
        self.oscillators[1] = replace(
            first, F=first.F * each, f=first.f * each, F_v=first.F_v * each, F_x=first.F_x * each
        )
        m = interval.ball(mass)
        # p of a collision, n = (-1, 1)
        self.pushes[1] = -2 / (1 + m / q), 2 / (1 + q / m)
        one, (a, b) = interval.ONE, self.pushes[1]
        self.rules[1] = (one + a, -a), (b, one - b)
