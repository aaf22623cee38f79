"""Where motions meet a guard again and again: a surface of two dimensions.

A state of two variables, a guard h = c q + r(clock) of a mode, c a number, after which the mode
may be the same: just before a contact q = -r/c, so the contact is given by its time and by the
other variable of the state.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import Quotient, variable
from cap.system.timed import CLOCK, Timed, fitting


@dataclass(frozen=True)
class Section(Timed):
    """A guard of a mode, which `BadInput` refuses if it is no such guard."""

    def __post_init__(self) -> None:
        where, given = f"the guard {self.guard} of {self.mode}", self.value
        if len(self.system.state) != 2:
            n = len(self.system.state)
            raise BadInput(f"the state has {n} variables: the map from contact to contact needs 2")
        if self.system.autonomous:
            raise BadInput("nothing depends on the clock: contacts are no map of two variables")
        if self.mode not in self.system.guard(self.mode, self.guard).to:
            raise BadInput(f"after {where} the mode is another one")
        found = sorted(given.variables - CLOCK)
        if len(found) != 1 or given.derivative(found[0]).terms.keys() != {()}:
            raise BadInput(f"{where} is not of degree 1 in one variable of the state and the clock")
        if not self._polynomial():
            raise BadInput(f"the flights of {self.mode} are not polynomial in time: spring or drag")
        if self.reset[self.fixed] != Quotient.of(variable(self.fixed)):
            raise BadInput(f"at {where} the variable {self.fixed} jumps: it must not vary there")

    def _polynomial(self) -> bool:
        """Return whether the square of the matrix of the field is zero, so its exponential ends."""
        A = [row[:2] for row in self.system.matrix(self.mode)[:2]]
        return all(A[i][0] * A[0][j] == -(A[i][1] * A[1][j]) for i in (0, 1) for j in (0, 1))

    @property
    def free(self) -> str:
        """The other variable."""
        return next(z for z in self.system.state if z != self.fixed)

    @property
    def after(self) -> Quotient:
        """The other variable just after a contact, by itself and the clock."""
        new, here = self.reset[self.free], {self.fixed: self.place}
        return Quotient(new.numerator.substituted(here), new.denominator.substituted(here))


def sections(system: System) -> list[Section]:
    """Return all of them; raise `BadInput` with why there is none."""
    return fitting(
        partial(Section, system, mode, guard)
        for mode, given in system.modes.items()
        for guard in given.guards
    )
