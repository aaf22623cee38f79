"""What of a guard is known by identities of polynomials: its form, its zeros, its restitution."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from cap.errors import BadInput
from cap.floats.models.spectrum import Floats, number
from cap.system.model import Guard, System
from cap.system.polynomial import COS, ONE, PI, SIN, Polynomial, Quotient, variable

ORDERS = range(3)  # h, L h, L^2 h


def split(system: System, mode: str, word: str) -> tuple[Floats, Polynomial]:
    """Return a guard as row.y, row (Z,), and the rest, which is a quadratic in time on all flights.

    Refuses a guard whose rest is none: L^3 of it is not identically zero.
    """
    h, names = system.guard(mode, word).value, (*system.state, COS, SIN)
    linear = Polynomial({m: c for m, c in h.terms.items() if Polynomial({m: c}).degree <= 1})
    rest = higher = h - linear
    for _ in ORDERS:
        higher = system.lie(mode, higher)
    if higher:
        raise BadInput(
            "floats follow guards of degree 1 in the state, cos wt and sin wt, and what is "
            f"quadratic in time on a flight: {word} of the mode {mode} is neither"
        )
    slopes = (*map(linear.derivative, names), linear.without(*names))
    return np.array([float(number(q)) for q in slopes]), rest


def identities(system: System, mode: str, word: str, to: str) -> dict[str, int]:
    """Return for each guard of ``to`` the bits of the h, L h, L^2 h that vanish after an event.

    They do so by an identity: with the reset they are zero, or a multiple of the event's guard.
    """
    event, reset = system.guard(mode, word).value, system.reset(mode, word)
    found = {}
    for name, guard in system.modes[to].guards.items():
        h, bits = guard.value, 0
        for order in ORDERS:
            vanishes = _after(h, reset).numerator.multiple_of(event) is not None
            bits |= vanishes << order
            h = system.lie(to, h)
        found[name] = bits
    return found


def orders(bits: int) -> list[int]:
    """Return the orders whose bits are set."""
    return [order for order in ORDERS if bits >> order & 1]


def _after(h: Polynomial, reset: dict[str, Quotient]) -> Quotient:
    """Return h after a reset, a function of y before it."""
    if all(name not in reset or reset[name] == Quotient.of(variable(name)) for name in h.variables):
        return Quotient.of(h)
    names = {name: reset.get(name, Quotient.of(variable(name))) for name in h.variables}
    constant = lambda c: Quotient.of(Polynomial.of(c))  # noqa: E731
    return Quotient.of(h.evaluated(names, constant, Quotient.of(variable(PI))))


def restitution(system: System, mode: str, word: str, to: str) -> Fraction | None:
    """Return e with L h after = - e L h before, if it is a number; h is the event's guard."""
    h = system.guard(mode, word).value
    before, after = system.lie(mode, h), _after(system.lie(to, h), system.reset(mode, word))
    if after.denominator != ONE or not before:
        return None
    return after.numerator.multiple_of(-before)


def resting(system: System, mode: str, guard: Guard) -> Iterator[Polynomial | Quotient]:
    """Yield the state with h = L h = 0: one position is moved, and one velocity."""
    moved: dict[str, Polynomial | Quotient] = {}
    for h in (guard.value, system.lie(mode, guard.value)):
        for z in system.state:
            slope = h.derivative(z)
            if slope and z not in moved and len(slope.terms) == 1 and slope.is_number:
                moved[z] = variable(z) - h / slope
                break
    yield from (moved.get(z, variable(z)) for z in system.state)
