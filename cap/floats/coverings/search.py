"""Families of parallelograms for a planar map, saddle by saddle."""

from collections.abc import Callable, Iterator

from cap.floats.coverings.family import Family, family
from cap.floats.coverings.leaves import Leaves
from cap.floats.coverings.planar import Planar
from cap.floats.coverings.regions import regions
from cap.floats.coverings.saddles import saddles

__all__ = ["Family", "families"]


def families(g: Planar, effort: int, tell: Callable[[str], None]) -> Iterator[Family]:
    """Give the families found at the saddles of a map; ``effort`` is the length of the words."""
    for saddle in saddles(g):
        tell("words on the unstable manifold of a saddle")
        found = regions(g, saddle)
        leaves = Leaves(g, saddle, found, effort, effort)
        yield family(g, saddle, leaves, tell)
