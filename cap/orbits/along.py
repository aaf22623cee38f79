"""A guard along one leg of an orbit, enclosed."""

from collections.abc import Sequence
from typing import NamedTuple

from cap.errors import NotProved
from cap.orbits.leg import Watch
from cap.orbits.numbers import Balls, Clock
from cap.sets.interval import Ball
from cap.system.source import Function


class End(NamedTuple):
    """An end of a leg, enclosed: the time, the clock, the state."""

    time: Ball
    clock: Clock
    state: Sequence[Ball]


class Leg(NamedTuple):
    """A leg of an orbit, from just after a contact, counted from 0, to just before the next."""

    number: int
    start: End
    end: End
    of: Balls


class Along(NamedTuple):
    """A guard h on a leg; ``vanishing`` of h, L h, .. are zero at the start, ``last`` at the end.

    Where h is zero and L h has its sign by another reason, both are counted.

    Each function returns an enclosure for all orbits that the leg encloses.
    """

    leg: Leg
    name: str
    watch: Watch
    vanishing: int
    last: int

    def at(self, end: End) -> Ball:
        """Return h at an end of the leg."""
        return self._value(self.watch.at, [*end.clock, *end.state])

    def rate(self, end: End) -> Ball:
        """Return L h at an end of the leg."""
        return self._value(self.watch.rate, [*end.clock, *end.state])

    def height(self, time: Ball, clock: Clock | None = None) -> Ball:
        """Return h at all times in a ball."""
        return self._value(self.watch.height, self._inputs(time, clock))

    def line(self, time: Ball) -> tuple[Ball, Ball]:
        """Return h and L h at all times in a ball."""
        h, rate = self.leg.of.of(self.watch.along)(*self._inputs(time))
        return h, rate

    def bend(self, time: Ball) -> Ball:
        """Return L² h at all times in a ball."""
        return self._value(self.watch.bend, self._inputs(time))

    def _value(self, function: Function, inputs: Sequence[Ball]) -> Ball:
        value: Ball = self.leg.of.of(function)(*inputs)[0]
        return value

    def _inputs(self, time: Ball, clock: Clock | None = None) -> list[Ball]:
        start, of = self.leg.start, self.leg.of
        d = time - start.time
        inputs = [*start.clock, *start.state, d, *(clock or of.clock(time))]
        motion = self.watch.motion
        return [*inputs, *of.exponential(motion, d)] if motion.generator else inputs

    def positive(self, h: Ball, time: Ball) -> None:
        """Raise `NotProved` unless h > 0."""
        if not h > 0:
            reason = "is negative" if h < 0 else "is not certain to be positive"
            raise self.failed(reason, time, h)

    def failed(self, reason: str, time: Ball, h: Ball) -> NotProved:
        """Return the exception: something else may happen on the leg, or happens."""
        step = f"leg {self.leg.number + 1}"
        return NotProved(step, f"the guard '{self.name}' {reason}", {"t": time, "h": h})
