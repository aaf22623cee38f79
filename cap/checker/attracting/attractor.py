"""The chaotic attractor, as in the theorem `attractor`: an interval I that G takes into itself.

G is the next place of release, mirrored if that is to the left.  That it takes I into itself is
proved here in doubles, too, by intervals of places that are followed to their next release; and the
shares of `mixed` need no more.  All else that is claimed, as the entropy of G on I, is proved by
the theorem `attractor`, and is not used.

On each of finitely many closed intervals that cover I the same happens to all orbits, so G is
continuous on I.  So the orbits released in I tend to those released in A, the intersection of all
G^k(I): these sets are compact, and each is contained in the one before.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from cap.checker.attracting.part import Part
from cap.checker.folded.basins import Basins
from cap.checker.folded.motion import Direction, Releases
from cap.checker.folded.numbers import Pair
from cap.checker.folded.paths import next_release
from cap.checker.folded.units import Distances
from cap.checker.kernel import line
from cap.checker.kernel.citation import Citation
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Enclosure, columns
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems.attractor import Attractor

_MOST = 1 << 12  # intervals that are followed


def where_claimed(citation: Citation) -> Citation:
    """Return what is cited for an attractor, if one is claimed."""
    only, found = "only where ", list[dict[str, Any]]()
    for known in citation["hypotheses"]:
        statement, by = known["statement"], [f"attractor.{name}" for name in known["by"]]
        link = " and " if statement.startswith(only) else ": "
        statement = f"{only}`attractor` is claimed{link}{statement.removeprefix(only)}"
        found.append({**known, "statement": statement, "by": by})
    return citation | {"hypotheses": found}


class Chaotic(Part):
    """The interval I, and what is claimed of G on it."""

    CLAIM, HINTS = columns(Attractor.CLAIMS), columns(Attractor.HINTS)
    CITES = tuple(map(where_claimed, Attractor.CITES))

    @classmethod
    def limit(cls, hints: dict[str, Any], claim: Any) -> None:
        """Bound the time, as for the theorem."""
        Attractor.limit(hints["attractor"], claim)

    def prove(self, known: Basins) -> None:  # noqa: ARG002
        """Prove the theorem `attractor`, and again that G takes I into itself."""
        it = self.theorem
        hints = it.hints["attractor"]
        part = Certificate("attractor", it.p, it.certificate.digits, self.claim, hints)
        Attractor(part, it.step).prove()
        into_itself(Releases(it.p), self.scale.distances(self.claim["interval"]))

    def kept(self) -> list[Enclosure]:
        """Return I."""
        return [self.claim["interval"]]

    def words(self) -> Iterator[str]:
        """Give the orbits released in A."""
        yield _CHAOTIC.format(self.claim["interval"], self.claim["entropy"])


def into_itself(y: Direction, places: Distances) -> None:
    """Prove that all next releases from an interval are inside it."""
    todo, followed = [places.outer], 0
    while todo:
        low, high = todo.pop()
        followed += 1
        need(followed <= _MOST, "releases may leave their interval")
        if not stays(y, (low, high), places.inner):
            middle = (low + high) / 2
            todo += [(middle, high), (low, middle)]


def stays(y: Direction, places: Pair, inside: Pair) -> bool:
    """Return whether the next releases from some places certainly are inside an interval.

    After a rest near a wall, where the polynomial is constant, G may not be continuous.
    """
    try:
        after = next_release(y, Basins(), places)
    except Rejected:
        return False
    if isinstance(after, int) or not any(after[0][1:]):
        return False
    low, high = line.ends(after)
    return inside[0] < low and high < inside[1]


_CHAOTIC = (
    "the orbits released in A, or to their images by S, A the intersection of all G^k(I) for the "
    "release map G (from a release to the right to the next release, mirrored if that is to the "
    "left) on I = {}, of topological entropy in {}"
)

PART = Chaotic
