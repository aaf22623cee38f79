"""Why no other event happens on a flight: two lemmas, found from the data by exact algebra.

*Lemma M.*  If L h = -g for another guard g of the mode, h decreases as long as that is positive:
once h has come to zero it is negative, and before it was positive.

*Lemma C.*  If (L + lambda) h = a cos wt + b sin wt + c, lambda a constant, then e^(lambda t) h has
the derivative e^(lambda t) (a cos wt + b sin wt + c): its local minima are where this comes from
negative to positive, at times that the clock alone decides.
"""

from __future__ import annotations

from cap.checker.kernel.rejection import Rejected
from cap.checker.system.model import Model
from cap.checker.system.polynomial import ZERO, Polynomial


def falls_while_positive(model: Model, mode: str, guard: str, other: str) -> bool:
    """Return whether Lemma M holds for a guard and another one of its mode."""
    guards = model.modes[mode].guards
    return model.lie(mode, guards[guard].value) == -guards[other].value


def clock_rate(model: Model, mode: str, guard: str) -> tuple[Polynomial, Polynomial]:
    """Return lambda and (L + lambda) h of Lemma C; a guard without them rejects."""
    h = model.modes[mode].guards[guard].value
    rate = model.lie(mode, h)
    for z in model.state:
        for decay in (ZERO, -rate.derivative(z), rate.derivative(z)):
            forced = rate + decay * h
            if model.is_constant(decay) and forced.variables.isdisjoint(model.state):
                return decay, forced
    raise Rejected(f"the rate of the guard {guard} depends on the state")
