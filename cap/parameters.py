"""The parameters of the oscillator, as exact rationals."""

import re
from dataclasses import dataclass, fields, replace
from fractions import Fraction

from cap.errors import BadInput

_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d{1,3})?|[+-]?\d+/\d+", re.ASCII)
_LONGEST = 200  # characters: enough for any number that a person types
_LARGEST = Fraction(10) ** 30


def exact(text: str) -> Fraction:
    """Return the rational that ``text`` names: an integer, a decimal or ``p/q``.

    ``exact("0.4")`` is 2/5, not the binary double next to it.  Raises `BadInput` on anything
    else, and on non-zero numbers outside [1e-30, 1e30] in size.
    """
    text = text.strip()
    shown = text if len(text) <= 40 else text[:37] + "..."
    if len(text) > _LONGEST or not _NUMBER.fullmatch(text):
        raise BadInput(f"not a number: {shown!r} (write an integer, a decimal or p/q)")
    try:
        value = Fraction(text)
    except ZeroDivisionError:
        raise BadInput(f"not a number: {shown!r} (the denominator is zero)") from None
    if value and not 1 / _LARGEST <= abs(value) <= _LARGEST:
        raise BadInput(f"number out of range: {shown!r} (its size must lie in [1e-30, 1e30])")
    return value


@dataclass(frozen=True)
class Parameters:
    """Forcing F cos(ωt), friction f, walls l < r; 0 <= f < F and ω > 0 (eq:model).

    ``e`` is the restitution at the walls, 0 < e <= 1, and ``mu`` >= 0 the viscosity (eq:perturbed).
    """

    F: Fraction
    omega: Fraction
    f: Fraction
    l: Fraction
    r: Fraction
    e: Fraction = Fraction(1)
    mu: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        """Raise `BadInput` unless the parameters are those of an oscillator."""
        if self.F <= 0:
            raise BadInput(f"the forcing must be positive: F = {self.F}")
        if self.omega <= 0:
            raise BadInput(f"the frequency must be positive: omega = {self.omega}")
        if self.f < 0:
            raise BadInput(f"the friction must not be negative: f = {self.f}")
        if self.f >= self.F:
            raise BadInput(
                f"the friction must be below the forcing: f = {self.f}, F = {self.F} "
                "(with f >= F the mass comes to rest)"
            )
        if self.l >= self.r:
            raise BadInput(f"the left wall must be left of the right wall: l={self.l}, r={self.r}")
        if self.R * _LARGEST < 1:
            raise BadInput(f"the walls must be at least 1e-30 apart: {float(self.R):.3g}")
        if not 0 < self.e <= 1:
            raise BadInput(f"the restitution must be positive and at most 1: e = {self.e}")
        if self.mu < 0:
            raise BadInput(f"the viscosity must not be negative: mu = {self.mu}")

    @property
    def conserves(self) -> bool:
        """Whether nothing but turning and sticking loses phase space: e = 1 and mu = 0."""
        return self.e == 1 and self.mu == 0

    @property
    def R(self) -> Fraction:  # noqa: N802 (the paper's symbol)
        """The distance between the walls."""
        return self.r - self.l

    def strings(self) -> dict[str, str]:
        """Return the parameters as exact strings, in the order of the dataclass."""
        return {field.name: str(getattr(self, field.name)) for field in fields(self)}

    def elastic_strings(self) -> dict[str, str]:
        """Return the parameters but e and mu, which a theorem on elastic walls does not mention.

        Raises `BadInput` if the walls are not elastic, or the flights viscous.
        """
        if not self.conserves:
            raise BadInput(
                f"this theorem is about elastic walls and dry friction: e = {self.e}, mu = "
                f"{self.mu} (`periodic` and `persistence` allow e < 1 and mu > 0)"
            )
        strings = self.strings()
        return {name: strings[name] for name in strings if name not in ("e", "mu")}


PAPER = Parameters(Fraction(1), Fraction(1), Fraction(2, 5), Fraction(-1), Fraction(1))


def at(**values: str) -> Parameters:
    """Return the paper's parameters but for these."""
    return replace(PAPER, **{name: Fraction(value) for name, value in values.items()})
