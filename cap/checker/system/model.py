"""A system with impacts and dry friction as data: modes, guards and resets.

*Clock.*  The variables cos and sin stand for cos wt and sin wt.  All others that are neither these
nor of the state are parameters; one of the name pi is this number.

*A mode* is a vector field, for each variable of the state a polynomial; while the system is in the
mode, the state z has z' = field, and all guards of the mode are positive.

*A guard* h is a polynomial.  When it comes to zero, the variables that its reset names jump, and
the system goes on in one of the modes that the guard names.  A reset is a polynomial in the state
before, over the divisor of the guard.  Where infinitely many such events accumulate, the system
goes on in the mode ``rest``, if there is one, from the state to which theirs tend.

*Lie derivative.*  The derivative in time of a polynomial h along the flights of a mode is L h = sum
of (dh/dz) field_z - w sin dh/dcos + w cos dh/dsin, again a polynomial.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from cap.checker.system.polynomial import ONE, ZERO, Polynomial, variable

CLOCK = COS, SIN = "cos", "sin"
PI = "pi"


class Guard(NamedTuple):
    """A polynomial that is positive in its mode, and what happens where it comes to zero."""

    value: Polynomial
    reset: Mapping[str, Polynomial]
    to: tuple[str, ...]
    divisor: Polynomial = ONE
    rest: str | None = None


class Mode(NamedTuple):
    """A vector field, and the guards that end its flights."""

    field: Mapping[str, Polynomial]
    guards: Mapping[str, Guard]


@dataclass(frozen=True, eq=False)
class Model:
    """A system; ``omega``, or omega pi if ``times_pi``, is the frequency of its clock.

    What is computed of a system alone may be kept, under this object.
    """

    state: tuple[str, ...]
    omega: Fraction
    modes: Mapping[str, Mode]
    times_pi: bool = False

    @property
    def frequency(self) -> Polynomial:
        """The frequency of the clock."""
        return variable(PI) * self.omega if self.times_pi else Polynomial.of(self.omega)

    @cached_property
    def autonomous(self) -> bool:
        """Whether the clock occurs nowhere."""
        found = [q for mode in self.modes.values() for q in mode.field.values()]
        for mode in self.modes.values():
            for guard in mode.guards.values():
                found += [guard.value, guard.divisor, *guard.reset.values()]
        return all(q.variables.isdisjoint(CLOCK) for q in found)

    def lie(self, mode: str, h: Polynomial) -> Polynomial:
        """Return the derivative of h in time along the flights of a mode."""
        w = self.frequency
        clock = {COS: variable(SIN) * -w, SIN: variable(COS) * w}
        rates = {**self.modes[mode].field, **clock}
        return sum((h.derivative(z) * rate for z, rate in rates.items()), ZERO)

    def is_constant(self, h: Polynomial) -> bool:
        """Return whether neither a variable of the state nor the clock occurs."""
        return h.variables.isdisjoint((*self.state, *CLOCK))
