"""The theorem about chaos of a planar map given by formulas, on a plane or a torus (`formulas`).

*Claimed:* what `entropy` says of the map.  If the sets are disjoint, the map is semiconjugate on
Lambda onto the subshift of forward paths: whether it is injective, nothing is claimed of.
"""

from __future__ import annotations

from typing import Any

from cap.checker.coverings.entropy import Coverings
from cap.checker.coverings.formulas import FORMULAS, Formulas, Map, formulas


class MapHorseshoe(Coverings):
    """Entropy of a map."""

    PARAMETERS = FORMULAS
    units = {}  # noqa: RUF012

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Formulas:
        """Return the map."""
        return formulas(given)

    def map(self) -> Map:
        """Return the map, in doubles."""
        return Map(self.p)

    def words(self) -> str:
        """Return the theorem in one line."""
        kind = _DISJOINT if self.claims["together"] == 1 else _OVERLAPPING
        return self.bounded(_HORSESHOE + kind, map=str(self.p))


_HORSESHOE = (
    "the map g: {map} has a compact invariant set Lambda, on which its topological entropy is at "
    "least {entropy}: {sets} parallelograms and {edges} coverings between them, with a matrix A of "
    "a spectral radius of at least {growth}; "
)
_DISJOINT = (
    "the parallelograms are disjoint: g on Lambda is semiconjugate onto the one-sided subshift of "
    "A, and for each n g^n has at least tr(A^n) fixed points in Lambda"
)
_OVERLAPPING = (
    "some of them overlap, but without diamonds: for each n g^n has at least tr(A^n)/{together} "
    "fixed points in Lambda; no semiconjugacy onto a subshift is claimed"
)

THEOREM = MapHorseshoe
