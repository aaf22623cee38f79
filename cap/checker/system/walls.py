"""What theorems about a mass between two walls share: its parameters, its units, its sentence.

    x'' = F cos(omega t) - f sgn x' - mu x',    l < x < r,    v -> -e v at the walls

Claims are in units of R = r - l, omega, F, and m, which is 1 here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.reading import MAX_SIZE, number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.theorem import Certificate, Theorem


class Parameters(NamedTuple):
    """The exact parameters."""

    F: Fraction
    omega: Fraction
    f: Fraction
    l: Fraction
    r: Fraction
    e: Fraction = Fraction(1)
    mu: Fraction = Fraction(0)


WITHOUT_LOSSES: dict[str, Any] = dict.fromkeys(Parameters._fields[:5], number)


class BetweenWalls(Theorem):
    """A theorem about a mass between two walls."""

    PARAMETERS = WITHOUT_LOSSES

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        self.R: Fraction = self.p.r - self.p.l
        self.omega: Fraction = self.p.omega
        self.units = {"R": self.R, "omega": self.omega, "F": self.p.F, "m": Fraction(1)}

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Any:
        """Return the parameters; e = 1 and mu = 0, unless they are given."""
        p = Parameters(**given)
        confirm_walls(p)
        confirm_sizes((p.F, p.omega, abs(p.l), abs(p.r), p.mu), (p.F, p.omega, p.r - p.l))
        return p


def confirm_walls(p: Any) -> None:
    """Reject an oscillation, friction or walls that are none."""
    need(p.omega > 0, "omega is not positive")
    need(0 <= p.f < p.F, "0 <= f < F does not hold")
    need(p.l < p.r, "l < r does not hold")


def confirm_sizes(large: Iterable[Fraction], small: Iterable[Fraction]) -> None:
    """Reject numbers that are too large, and positive ones that are too small."""
    fits = max(large) <= MAX_SIZE and min(small) * MAX_SIZE >= 1
    need(fits, "the parameters are not between 10^-30 and 10^30 in size")
