"""The oscillator as a model, with any constants."""

from __future__ import annotations

from fractions import Fraction

from cap.checker.system.friction import friction
from cap.checker.system.polynomial import Polynomial

CONSTANTS = {
    "F": Fraction(2),
    "f": Fraction(2, 5),
    "l": Fraction(-1),
    "r": Fraction(3),
    "e": Fraction(9, 10),
    "mu": Fraction(1, 7),
}


def oscillator(omega=Fraction(1), **changes):
    """Return the oscillator with some constants changed."""
    constants = {name: Polynomial.of(q) for name, q in (CONSTANTS | changes).items()}
    return friction(omega, constants)
