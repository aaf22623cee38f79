"""Contacts that give the state after them by their time alone.

A guard h = c x + r(clock) of a mode, x a variable of the state and c a number, after which all
other variables are given by x and the clock: just before the contact x = -r/c.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from cap.errors import BadInput
from cap.system.model import System
from cap.system.timed import CLOCK, Timed, fitting


@dataclass(frozen=True)
class Release(Timed):
    """A guard of a mode and the mode after it, which `BadInput` refuses if it is no such guard."""

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
        for z, q in self.reset.items():
            if not (q.numerator.variables | q.denominator.variables) <= known:
                raise BadInput(f"after {where} {z} is not given by {found[0]} and the clock")


def releases(system: System) -> list[Release]:
    """Return all of them; raise `BadInput` with why there is none."""
    return fitting(
        partial(Release, system, mode, guard, to)
        for mode, given in system.modes.items()
        for guard, named in given.guards.items()
        for to in named.to
    )
