"""Where one state of a box goes: as the full proof says, in less time."""

from fractions import Fraction

import pytest
from attempts import box
from flows import BITS, MIXED, expected

from cap.flow.event import BALLS
from cap.flow.image import image
from cap.flow.itinerary import itinerary
from cap.flow.strobe import oscillator, strobe
from cap.flow.windows import find_windows
from cap.sets import interval


@pytest.mark.parametrize("name", MIXED)
@pytest.mark.parametrize("periods", [1, 2])
def test_an_image_is_that_of_the_full_proof(name, periods):
    """Through events of all kinds, exactly the same balls; and it lies in the image of the box."""
    p, x, v, *_ = MIXED[name]
    state = Fraction(x), Fraction(v)
    with interval.workprec(BITS):
        osc = oscillator(p)
        path = itinerary(p, *map(float, state), float(periods * osc.T))
        around = box(state, BALLS, Fraction(1, 10**20))
        windows, orbit = find_windows(osc, around, expected(path), BALLS, periods)
        point = box(state, BALLS)
        found = image(osc, point, windows, periods)
        assert [*map(str, found)] == [*map(str, strobe(osc, point, windows, BALLS, periods).end)]
        for ball, other in zip(orbit.end, found, strict=True):
            assert ball.contains(other + interval.ZERO)
