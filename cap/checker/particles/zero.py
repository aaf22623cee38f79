"""What theorems about an orbit of two masses share: the zero of the equations of its events.

1. *Existence.*  K(box) lies in the interior of the box of the unknowns of all events: there is
   exactly one zero in it (``existence``).
2. *Localisation.*  The same for a small box S in it: the zero lies in K(S).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, ClassVar

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.existence import Ends, Equations, krawczyk, lies_in, needs_matrix
from cap.checker.particles.mechanics import Mechanics
from cap.checker.system.masses import TwoMasses


class ZeroOfEvents(TwoMasses):
    """An orbit of two masses, by its events; claims named in ``LISTED`` have one entry for each."""

    LISTED: ClassVar[tuple[str, ...]]

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Reject what is not the same number of events everywhere."""
        count = len(claims["itinerary"])
        for name in cls.LISTED:
            need(len(claims[name]) == count, f"claims.{name} is not a list of {count}")
        need(len(hints["centre"]) == count, f"hints.centre is not a list of {count}")
        needs_matrix(hints["preconditioner"], count, "hints.preconditioner")

    @property
    @abstractmethod
    def box(self) -> list[Ends]:
        """The box claimed."""

    @abstractmethod
    def equations(self, M: Mechanics) -> Equations:
        """Return the equations of the events."""

    @abstractmethod
    def units_of(self, word: str) -> tuple[Fraction, ...]:
        """Return the units of the unknowns of an event."""

    def zero(self, M: Mechanics) -> list[Interval]:
        """Prove that there is exactly one zero in the box; return K(S), which contains it."""
        self.krawczyk(M, self.box)
        self.step("K(box) lies in the interior of the box: exactly one zero of G")
        return self.localisation(M)

    def krawczyk(self, M: Mechanics, region: Sequence[Ends]) -> list[Interval]:
        """Return K(region) if it lies in the interior of the region."""
        centre = [c for event in self.hints["centre"] for c in event]
        return krawczyk(M, self.equations(M), region, centre, self.hints["preconditioner"])

    def localisation(self, M: Mechanics) -> list[Interval]:
        """Return K(S), which contains the zero."""
        radius, small = self.hints["radius"], list[Ends]()
        need(radius > 0, "radius is not positive")
        for word, event in zip(self.claims["itinerary"], self.hints["centre"], strict=True):
            reach = [(c, radius * unit) for c, unit in zip(event, self.units_of(word), strict=True)]
            small += [(c - r, c + r) for c, r in reach]
        need(lies_in(small, self.box), "S is not in the box")
        result = self.krawczyk(M, small)
        self.step("K(S) lies in the interior of S, which lies in the box: K(S) contains the zero")
        return result

    def in_order(self, name: str, periods: int, what: str) -> None:
        """Check that the times claimed increase and lie in the period of the orbit."""
        times = self.claims[name]
        need(times[0].lower > 0, f"the first {what} may be before 0")
        increasing = all(s.upper < t.lower for s, t in pairwise(times))
        need(increasing, f"the times of the {what}s are not increasing")
        before = times[-1].upper * self.omega < 2 * periods * self.pi().lower
        need(before, f"the last {what} is not before {'nT' if what == 'event' else 'T'}")
