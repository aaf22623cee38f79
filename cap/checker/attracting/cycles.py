"""Cycles of releases that attract: intervals of places, each of which is taken into the next.

Let G, the next place, take J_1 into J_2, ..., J_k into J_1, be continuously differentiable there,
and the product of the largest |G'| on them be less than 1.  Then G^k contracts J_1, which is
compact: it has exactly one fixed point there, and the orbits released in the intervals converge to
the orbit released in it, which is periodic, or to its image by the symmetry, up to shifts of the
time by multiples of T.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cap.checker.attracting.part import Part
from cap.checker.folded.basins import Basins
from cap.checker.folded.motion import Direction, Releases
from cap.checker.folded.numbers import UP, Pair
from cap.checker.folded.paths import next_release
from cap.checker.folded.units import Distances
from cap.checker.kernel import line
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Enclosure, Many, region

_MOST, _LONGEST = 16, 32


class Cycles(Part):
    """Cycles of intervals of places."""

    CLAIM = Many(Many(region, 1, _LONGEST), 1, _MOST)

    def prove(self, known: Basins) -> None:
        """Prove that the release map contracts the cycles."""
        y = Releases(self.theorem.p)
        for cycle in self.claim:
            contract(y, known, [self.scale.distances(interval) for interval in cycle])
            self.theorem.step(
                "the release map takes a cycle of intervals into itself, and contracts it"
            )

    def kept(self) -> list[Enclosure]:
        """Return the intervals."""
        return [interval for cycle in self.claim for interval in cycle]

    def words(self) -> Iterator[str]:
        """Give the periodic orbits."""
        for cycle in self.claim:
            yield _PERIODIC.format(" and then in ".join(map(str, cycle)))


def contract(y: Direction, basins: Basins, cycle: Sequence[Distances]) -> None:
    """Prove that intervals are taken each into the next, and contracted in the end."""
    factor = 1.0
    for here, after in zip(cycle, [*cycle[1:], cycle[0]], strict=True):
        place = next_release(y, basins, here.outer)
        if isinstance(place, int):
            raise Rejected("a cycle of releases goes to the segment, or to a sink")
        factor = factor * slope(place, here.outer) * UP
        low, high = line.ends(place)
        need(after.inner[0] < low and high < after.inner[1], "releases may leave their cycle")
    need(factor < 1, "the release map may not contract its cycle")


def slope(place: line.Line, ends: Pair) -> float:
    """Return a bound of |G'| over an interval; after a rest near a wall none is known."""
    need(any(place[0][1:]), "a cycle of releases may rest near a wall")
    low, high = line.slopes(place)
    return max(-low, high) / ((ends[1] - ends[0]) / 2) * UP


_PERIODIC = (
    "a periodic orbit that sticks and is released again and again in {} (releases to the left "
    "mirrored), or to its image by S; up to S and shifts of the time by multiples of T no other "
    "periodic orbit is released so"
)

PART = Cycles
