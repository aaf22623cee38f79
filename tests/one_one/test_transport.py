"""Jets of flights between the walls: they are flights of the model."""

from fractions import Fraction

import pytest

from cap.flow.formulas import dry
from cap.one_one import transport
from cap.one_one.closed_form import asymmetric
from cap.one_one.transport import Hit
from cap.sets import interval
from cap.sets.elementary import sqrt
from cap.sets.jet import Jet

ORDER = 3


@pytest.mark.parametrize("sign", [-1, 1])
def test_flights_of_jets(sign):
    """From x = 0 with the speed of the jets they come to x = ±ρ, with the energy found."""
    with interval.workprec(150):
        orbit = asymmetric(interval.ball(Fraction(1, 5)), interval.ball(2))
        k = 0 if sign < 0 else 1
        phases = orbit.phases[k], orbit.phases[1 - k]
        u, duration = orbit.speeds[k], orbit.durations[k]
        energy, delay = Jet.variables((u * u / 2, u * 0), ORDER)
        found = transport._flight(orbit, sign, Hit(delay, energy), phases, duration)
        flight = dry({"F": 1, "omega": 1, "f": orbit.alpha}, interval.ball)[sign]
        begin, end = (
            transport._sin_cos(*pair) for pair in zip(phases, (delay, found.delay), strict=True)
        )
        rest = flight.rest(delay * 0, sqrt(energy * 2) * sign, *begin)
        now = *rest, found.delay - delay + duration, *end
        [x], [v] = flight.position(*now), flight.velocity(*now)
        for zero in (x - orbit.rho * sign, v * v / 2 - found.energy):
            assert len(zero.coefficients) == 10
            for c in zero.coefficients:
                assert c.contains(0)
                assert c.rad() < 1e-35
