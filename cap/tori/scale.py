"""How functions on a circle are computed, as their coefficients fall."""

import math
from fractions import Fraction
from typing import NamedTuple


class Scale(NamedTuple):
    """How functions are computed: modes, ρ, decimal places."""

    degree: int
    rho: Fraction
    places: int

    @property
    def bits(self) -> int:
        """The working precision."""
        return self.places * 10 // 3 + 32

    @classmethod
    def of(
        cls, decay: float, attempt: int, digits: int = 0, *, least: int = 0, most: float = math.inf
    ) -> "Scale":
        """Return what suits coefficients that fall like exp(-decay k): the strip is a fifth.

        There are from ``least`` to ``most`` modes, and with each attempt more.
        """
        rho = decay / 5
        degree = int(min(max(least, round(95 / (decay - rho) * 1.3**attempt)), most))
        places = max(40 + round(rho * degree / 2.3), digits + 16)
        return cls(degree, Fraction(max(1, round(rho * 10**5)), 10**5), places)
