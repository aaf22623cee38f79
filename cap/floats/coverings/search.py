"""Families of parallelograms for a planar map, saddle by saddle."""

from collections.abc import Callable, Iterator
from fractions import Fraction

from cap.floats.coverings.family import Family, family
from cap.floats.coverings.leaves import Leaves, Regions
from cap.floats.coverings.planar import Planar, contacts
from cap.floats.coverings.regions import cells, regions
from cap.floats.coverings.saddles import Saddle, saddles
from cap.system.section import Section

__all__ = ["Family", "families", "families_by_cells", "families_of_contacts"]

FEW = (4, 5)  # symbols before and after, of a sample that takes less time
SAME = 0.01  # phases and states of one saddle


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
        yield _by_cells(g, saddle, cells(g, saddle), effort, tell)


def families_of_contacts(
    section: Section, effort: int, tell: Callable[[str], None]
) -> Iterator[tuple[Fraction, Family]]:
    """Give families of the map from contact to contact, found with cells, and for each a time.

    Phases are those within half a period of this time, near the saddle.
    """
    tell("fixed points of the map from contact to contact")
    for phase, saddle in _saddles_of_contacts(section):
        g = contacts(section, float(phase))
        found = cells(g, saddle, FEW)
        yield phase, _by_cells(g, saddle, found, effort, tell)


def _by_cells(
    g: Planar, saddle: Saddle, found: Regions, effort: int, tell: Callable[[str], None]
) -> Family:
    tell("words on the unstable manifold of a saddle")
    return family(g, saddle, Leaves(g, saddle, found, effort, 2 * effort), tell)


def _saddles_of_contacts(section: Section) -> list[tuple[Fraction, Saddle]]:
    """Return saddles, each with a time near its phase: the weakest first, then the slowest.

    Two cuts are tried, as a phase may be at a cut.
    """
    found = list[tuple[Fraction, Saddle]]()
    zero = contacts(section, 0.0)
    for middle in (0.0, zero.size):
        for saddle in saddles(contacts(section, middle)):
            near = Fraction(round(saddle.point[0] * 1000), 1000)
            turns = [abs(float(near - phase)) % (2 * zero.size) for phase, _ in found]
            known = any(
                min(turn, 2 * zero.size - turn) < SAME
                and abs(saddle.point[1] - other.point[1]) < SAME * zero.size
                for turn, (_, other) in zip(turns, found, strict=True)
            )
            if not known:
                found.append((near, saddle))
    return sorted(found, key=lambda each: _rank(each[1]))


def _rank(saddle: Saddle) -> tuple[float, float]:
    return round(abs(saddle.large), 6), abs(float(saddle.point[1]))
