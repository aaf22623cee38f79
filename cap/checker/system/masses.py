"""What theorems about two masses between two walls share: their parameters and units.

m_i x_i'' = F cos(omega t) - f sgn x_i',    l < x_1 < x_2 < r,    without losses
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.theorem import Certificate
from cap.checker.system.walls import WITHOUT_LOSSES, BetweenWalls, confirm_sizes, confirm_walls


class MassParameters(NamedTuple):
    """The exact parameters; mu is zero."""

    F: Fraction
    omega: Fraction
    f: Fraction
    l: Fraction
    r: Fraction
    masses: tuple[Fraction, ...]
    mu: Fraction = Fraction(0)


class TwoMasses(BetweenWalls):
    """A theorem about two masses; the unit m is the first one."""

    PARAMETERS = {**WITHOUT_LOSSES, "masses": [number] * 2}  # noqa: RUF012

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        self.units = {**self.units, "m": self.p.masses[0]}

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Any:
        """Return the parameters."""
        p = MassParameters(**given | {"masses": tuple(given["masses"])})
        confirm_walls(p)
        need(all(m > 0 for m in p.masses), "a mass is not positive")
        sizes = p.F, p.omega, *p.masses
        confirm_sizes((*sizes, abs(p.l), abs(p.r)), (*sizes, p.r - p.l))
        return p
