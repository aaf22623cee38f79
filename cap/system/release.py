"""Contacts that give the state after them by their time alone.

A guard h = c x + r(clock) of a mode, x a variable of the state and c a number, after which all
other variables are given by x and the clock: just before the contact x = -r/c.
"""

from __future__ import annotations

from dataclasses import dataclass

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import COS, PI, SIN, ZERO, Polynomial, Quotient

CLOCK = {COS, SIN, PI}


@dataclass(frozen=True)
class Release:
    """A guard of a mode and the mode after it, which `BadInput` refuses if it is no such guard."""

    system: System
    mode: str
    guard: str
    to: str

    def __post_init__(self) -> None:
        where, value = f"{self.guard} of {self.mode}", self.value
        if self.system.autonomous:
            raise BadInput("nothing depends on the clock: a release has no phase")
        found = sorted(value.variables - CLOCK)
        if not found:
            raise BadInput(f"at {where} the clock alone decides when: it gives no map of phases")
        if len(found) > 1 or value.derivative(found[0]).terms.keys() != {()}:
            raise BadInput(f"{where} is not of degree 1 in one variable of the state and the clock")
        known = {found[0], *CLOCK}
        for z, q in self.system.reset(self.mode, self.guard).items():
            if not (q.numerator.variables | q.denominator.variables) <= known:
                raise BadInput(f"after {where} {z} is not given by {found[0]} and the clock")

    @property
    def value(self) -> Polynomial:
        """The guard."""
        return self.system.guard(self.mode, self.guard).value

    @property
    def fixed(self) -> str:
        """The variable that the time of a release gives."""
        return next(z for z in self.system.state if z in self.value.variables)

    @property
    def place(self) -> Polynomial:
        """That variable at a release, a polynomial in the clock."""
        c = self.value.derivative(self.fixed)
        return (ZERO - self.value.without(self.fixed)) * c.reciprocal()

    @property
    def reset(self) -> dict[str, Quotient]:
        """The state after a release."""
        return self.system.reset(self.mode, self.guard)


def releases(system: System) -> list[Release]:
    """Return all of them; raise `BadInput` with why there is none."""
    found, reasons = list[Release](), list[str]()
    for mode, given in system.modes.items():
        for guard, named in given.guards.items():
            for to in named.to:
                try:
                    found.append(Release(system, mode, guard, to))
                except BadInput as reason:
                    reasons.append(str(reason))
    if not found:
        raise BadInput("; ".join(dict.fromkeys(reasons)) or "the system has no guard")
    return found
