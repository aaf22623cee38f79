"""What the equations of an orbit need of numbers: the clock, exponentials, and functions of them.

`Balls` enclose, at the precision at which they are made; `Floats` are for searches.
"""

from collections.abc import Mapping, Sequence
from math import cos, pi, sin
from typing import Any, Protocol

from cap.errors import BadInput
from cap.orbits.motion import Motion
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.exponential import Exponential, number
from cap.system.model import System
from cap.system.source import Evaluated, Function
from cap.system.source import enclosed as enclosed_number

Clock = tuple[Any, Any]


class Numbers(Protocol):
    """Numbers of one kind: the period of the clock, and what functions of them need."""

    period: Any

    def clock(self, t: Any) -> Clock:
        """Return cos wt and sin wt."""

    def exponential(self, motion: Motion, d: Any) -> Sequence[Any]:
        """Return the inputs of a motion, the entries of X = exp(N d)."""

    def of(self, function: Function) -> Evaluated:
        """Return a function of such numbers."""


class Balls:
    """Balls at the precision at which this is made; ``values`` are those of parameters, or sets."""

    def __init__(self, system: System, values: Mapping[str, Ball] | None = None) -> None:
        self.values = dict(values or {})
        _given(system, self.values)
        self.bits, self._omega = interval.working_bits(), number(system.omega)
        self._bound = dict[Function, Evaluated]()
        self.period = 2 * interval.pi() * number(system.omega.reciprocal())
        self._exponentials = dict[Motion, Exponential]()

    def clock(self, t: Ball) -> Clock:
        """Return an enclosure of cos wt and sin wt."""
        s, c = (self._omega * t).sin_cos()
        return c, s

    def exponential(self, motion: Motion, d: Ball) -> Sequence[Ball]:
        """Return an enclosure of the entries of exp(N d) in the rows of the state."""
        if motion not in self._exponentials:
            self._exponentials[motion] = Exponential(motion.generator, len(motion.system.state))
        return self._exponentials[motion](d)

    def of(self, function: Function) -> Evaluated:
        """Return a function of balls."""
        if function not in self._bound:
            self._bound[function] = (
                function.bound(enclosed_number, self.values)
                if function.parameters
                else function.balls()
            )
        return self._bound[function]


class Floats:
    """Doubles; nothing is rounded outwards."""

    def __init__(self, system: System) -> None:
        _given(system, {})
        self._omega = float(number(system.omega))
        self.period = 2 * pi / self._omega

    def clock(self, t: float) -> Clock:
        """Return cos wt and sin wt."""
        return cos(self._omega * t), sin(self._omega * t)

    def exponential(self, motion: Motion, d: float) -> Sequence[float]:
        """Return the entries of exp(N d)."""
        return motion.in_doubles.near(d)

    def of(self, function: Function) -> Evaluated:
        """Return a function of doubles."""
        return function.floats()


def _given(system: System, values: Mapping[str, Any]) -> None:
    """Refuse parameters without values."""
    left = [name for name in system.parameters if name not in values]
    if left:
        raise BadInput(f"the parameters {left} have no values: use .at")
