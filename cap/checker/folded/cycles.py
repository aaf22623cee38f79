"""Cycles of releases that attract: intervals of places, each of which is taken into the next.

Let G, the next place, take J_1 into J_2, ..., J_k into J_1, be continuously differentiable there,
and the product of the largest |G'| on them be less than 1.  Then G^k contracts J_1, which is
compact: it has exactly one fixed point there, and the orbits released in the intervals converge to
the orbit released in it, which is periodic, or to its image by the symmetry, up to shifts of the
time by multiples of T.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.folded.basins import Basins
from cap.checker.folded.flights import System
from cap.checker.folded.numbers import UP, Pair
from cap.checker.folded.paths import next_release
from cap.checker.kernel import line
from cap.checker.kernel.rejection import Rejected, need


class Distances(NamedTuple):
    """Distances to the wall ahead: an interval that contains those meant, and one within them."""

    outer: Pair
    inner: Pair


def contract(y: System, basins: Basins, cycle: Sequence[Distances]) -> None:
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
