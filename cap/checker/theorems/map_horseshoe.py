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
        return self.bounded(_HORSESHOE, given=str(self.p))


_HORSESHOE = (
    "the map g: {given} has a compact invariant set Lambda, on which its topological entropy is at "
    "least {entropy}: "
)

THEOREM = MapHorseshoe
