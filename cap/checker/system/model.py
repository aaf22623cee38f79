"""A system with impacts and dry friction as data: modes, guards and resets.

*Clock.*  The variables cos and sin stand for cos wt and sin wt.  All others that are neither these
nor of the state are parameters.

*A mode* is a vector field, for each variable of the state a polynomial; while the system is in the
mode, the state z has z' = field, and all guards of the mode are positive.

*A guard* h is a polynomial.  When it comes to zero, the variables that its reset names jump, and
the system goes on in one of the modes that the guard names.  A reset is a polynomial in the state
before.

*Lie derivative.*  The derivative in time of a polynomial h along the flights of a mode is L h = sum
of (dh/dz) field_z - w sin dh/dcos + w cos dh/dsin, again a polynomial.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import NamedTuple

from cap.checker.system.polynomial import ZERO, Polynomial, variable

CLOCK = COS, SIN = "cos", "sin"


class Guard(NamedTuple):
    """A polynomial that is positive in its mode, and what happens where it comes to zero."""

    value: Polynomial
    reset: Mapping[str, Polynomial]
    to: tuple[str, ...]


class Mode(NamedTuple):
    """A vector field, and the guards that end its flights."""

    field: Mapping[str, Polynomial]
    guards: Mapping[str, Guard]


class Model(NamedTuple):
    """A system; ``omega`` is the frequency of its clock."""

    state: tuple[str, ...]
    omega: Fraction
    modes: Mapping[str, Mode]

    def lie(self, mode: str, h: Polynomial) -> Polynomial:
        """Return the derivative of h in time along the flights of a mode."""
        clock = {COS: variable(SIN) * -self.omega, SIN: variable(COS) * self.omega}
        rates = {**self.modes[mode].field, **clock}
        return sum((h.derivative(z) * rate for z, rate in rates.items()), ZERO)

    def is_constant(self, h: Polynomial) -> bool:
        """Return whether neither a variable of the state nor the clock occurs."""
        return h.variables.isdisjoint((*self.state, *CLOCK))
