"""Regions of a rectangle between parabolas, in a tree of cuts, as a certificate lists it.

*Regions.*  With z from -1 to 1, a region lies over a dyadic interval of z, with Y from -1 to 1 over
it, and between two *edges* e_0 + e_1 Y + e_2 Y^2, integers in units of 2^-80.  It may be cut by an
edge between its own, or into the halves Y <= 0 and Y >= 0.

*As text*, a tree is a sequence of integers (`cap.checker.kernel.parabolas`):

    0              nothing is counted
    1              cut into halves, Y <= 0 first
    2 d_0 d_1 d_2  cut by the edge that is the mean of its two edges, rounded down to multiples of
                   2^-40 by coefficient, plus these multiples of 2^-40; the lower part first
    n + 2          followed back over n flights, or until what comes next is not certain

If regions are followed forwards, too, a tree comes after each n + 2: of its parts, with

    0              nothing is known
    1, 2           as above
    3              followed forwards
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from cap.checker.kernel.parabolas import Edge, integers, ordered
from cap.checker.kernel.rejection import need

UNIT, CUT = 2.0**-80, 1 << 40  # edges by cuts are multiples of CUT units
MOST_HALVINGS, MOST_CUTS, MOST_FLIGHTS = 20, 60, 64
_LARGEST = 1 << 84
_BEGIN = 4  # flights take as long as all else for a leaf
_AHEAD, USUAL = 36, 5  # flights take as long as a part that goes forwards, at most and mostly
FORWARDS = 3


class Region(NamedTuple):
    """What lies between two edges, over the part [j, j + 1] 2^-n of all z."""

    low: Edge
    high: Edge
    j: int = 0
    n: int = 0
    cuts: int = 0

    def halves(self) -> tuple[Region, Region]:
        """Return the halves Y <= 0 and Y >= 0."""
        need(self.n < MOST_HALVINGS, "a region is halved too often")
        return self.half(-1), self.half(1)

    def half(self, side: int) -> Region:
        """Return one half, for the side -1 or 1."""
        low, high = restricted(self.low, side), restricted(self.high, side)
        return self._replace(low=low, high=high, j=2 * self.j + (side > 0), n=self.n + 1)

    def parts(self, more: Edge) -> tuple[Region, Region]:
        """Return the parts below and above an edge."""
        need(self.cuts < MOST_CUTS, "a region is cut too often")
        both = zip(self.low, self.high, more, strict=True)
        a, b, c = (((low + high) // (2 * CUT) + d) * CUT for low, high, d in both)
        need(max(abs(a), abs(b), abs(c)) < _LARGEST, "an edge is too far away")
        edge = a, b, c
        ordered([self.low, edge, self.high])
        below, above = self._replace(high=edge), self._replace(low=edge)
        return below._replace(cuts=self.cuts + 1), above._replace(cuts=self.cuts + 1)


class Leaf(NamedTuple):
    """A region that is followed back over so many flights, and its parts that go forwards."""

    region: Region
    flights: int
    parts: tuple[Region, ...] = ()

    def work(self) -> int:
        """Return what it usually takes, as `flights` counts it."""
        return _BEGIN + self.flights + USUAL * len(self.parts)


def restricted(edge: Edge, side: int) -> Edge:
    """Return an edge over the half Y <= 0 or Y >= 0, for the side -1 or 1."""
    a, b, c = edge
    found = 4 * a + 2 * side * b + c, 2 * b + 2 * side * c, c
    need(not any(z % 4 for z in found), "an edge is halved too often")
    return found[0] // 4, found[1] // 4, found[2] // 4


def leaves(text: str, root: Region, *, parted: bool = False) -> Iterator[Leaf]:
    """Give the leaves of a tree; ``parted`` if the tree of its parts comes after each."""
    found = integers(text)
    for region, code in ends(found, root, MOST_FLIGHTS + 2):
        parts = ends(found, region, FORWARDS) if parted else ()
        yield Leaf(region, code - 2, tuple(part for part, _ in parts))
    need(next(found, None) is None, "a tree goes on after its last node")


def ends(found: Iterator[int], root: Region, most: int) -> Iterator[tuple[Region, int]]:
    """Give the regions without parts in a tree, with their codes above 2, which are at most so."""
    waiting = [root]
    while waiting:
        region = waiting.pop()
        code = next(found, -1)
        need(0 <= code <= most, "a tree has a node of no kind")
        if code == 1:
            waiting += reversed(region.halves())
        elif code == 2:
            more = [next(found, _LARGEST) for _ in range(3)]
            waiting += reversed(region.parts((more[0], more[1], more[2])))
        elif code:
            yield region, code


def flights(text: str, *, parted: bool = False, ahead: int = _AHEAD) -> int:
    """Return how many flights the leaves of a tree are followed over, at most.

    What a leaf takes besides counts as `_BEGIN` more; a part forwards as ``ahead`` in all.
    """
    found, total = integers(text), 0
    for code in found:
        if code == 2:
            for _ in range(3):
                next(found, None)
        elif code == FORWARDS and parted:
            total += ahead
        elif code > 2:
            total += _BEGIN + min(code - 2, MOST_FLIGHTS)
    return total
