"""Guards whose contacts are told by their time: it gives a variable of the state.

A guard h = c x + r(clock) of a mode, x a variable of the state and c a number: just before a
contact x = -r/c.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import COS, PI, SIN, ZERO, Polynomial, Quotient

CLOCK = {COS, SIN, PI}
T = TypeVar("T")


@dataclass(frozen=True)
class Timed:
    """A guard of a mode; that it is of this form its subclasses confirm."""

    system: System
    mode: str
    guard: str

    @property
    def value(self) -> Polynomial:
        """The guard."""
        return self.system.guard(self.mode, self.guard).value

    @property
    def fixed(self) -> str:
        """The variable that the time of a contact gives."""
        return next(z for z in self.system.state if z in self.value.variables)

    @property
    def place(self) -> Polynomial:
        """That variable at a contact, a polynomial in the clock."""
        c = self.value.derivative(self.fixed)
        return (ZERO - self.value.without(self.fixed)) * c.reciprocal()

    @property
    def reset(self) -> dict[str, Quotient]:
        """The state after a contact."""
        return self.system.reset(self.mode, self.guard)


def fitting(made: Iterable[Callable[[], T]]) -> list[T]:
    """Return all that can be made; raise `BadInput` with why there is none."""
    found, reasons = list[T](), list[str]()
    for make in made:
        try:
            found.append(make())
        except BadInput as reason:
            reasons.append(str(reason))
    if not found:
        raise BadInput("; ".join(dict.fromkeys(reasons)) or "the system has no guard")
    return found
