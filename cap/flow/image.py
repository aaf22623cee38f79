"""Where a state of a box goes, when the orbits from the whole box are proved already."""

from collections.abc import Sequence
from typing import Any

from cap.flow.event import BALLS, Expected
from cap.flow.model import Flight, Moment, Oscillator
from cap.flow.orbit import PartialOrbit, State
from cap.flow.strobe import BEGIN
from cap.sets import interval
from cap.sets.interval import Ball, Box


def image(osc: Oscillator[Any], state: Box, expected: Sequence[Expected], periods: int = 1) -> Box:
    """Return an enclosure of Φⁿ(state), for a state of a box on which `strobe` has succeeded.

    The events of ``expected`` are those of the box, their windows contain the times of this orbit.
    """
    orbit = _Known(osc, State(BEGIN, *state), BALLS)
    for number, event in enumerate(expected, start=1):
        orbit.meet(event, number)
    return orbit.finish(Moment(periods * osc.T, interval.ZERO, interval.ONE)).end


class _Known(PartialOrbit[Ball]):
    """An orbit of which it is known that nothing happens between its events.

    So they are located once more, for the place and the velocity at each; its monodromy and its
    least speed are not looked after.
    """

    def _fly(self, _flight: Flight[Ball], until: Ball) -> None:
        self.now, self.before, self.released = until, until, None

    def _bounce(self, _flight: Flight[Ball], _moment: Moment[Ball], _velocity: Ball) -> None:
        pass
