"""Families of parallelograms for a planar map, saddle by saddle."""

from collections.abc import Callable, Iterator

from cap.floats.coverings.family import Family, family
from cap.floats.coverings.leaves import Leaves
from cap.floats.coverings.planar import Planar
from cap.floats.coverings.regions import cells, regions
from cap.floats.coverings.saddles import saddles

__all__ = ["Family", "families", "families_by_cells"]


def families(g: Planar, effort: int, tell: Callable[[str], None]) -> Iterator[Family]:
    """Give the families found at the saddles of a map; ``effort`` is the length of the words."""
    for saddle in saddles(g):
        tell("words on the unstable manifold of a saddle")
        found = regions(g, saddle)
        leaves = Leaves(g, saddle, found, effort, effort)
        yield family(g, saddle, leaves, tell)


def families_by_cells(g: Planar, effort: int, tell: Callable[[str], None]) -> Iterator[Family]:
    """Give the families found with the cells of a grid as symbols, ``effort`` of them before a
    point and twice as many from it on.
    """
    for saddle in saddles(g):
        tell("words on the unstable manifold of a saddle")
        leaves = Leaves(g, saddle, cells(g, saddle), effort, 2 * effort)
        yield family(g, saddle, leaves, tell)
