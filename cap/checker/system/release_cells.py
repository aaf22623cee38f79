"""A cell of times of releases: G and G' on it, its image, and whether G turns there.

G = F - n T, F as in ``releases``.  On a cell [c, d] let G' lie in S.  G is monotone there, if S
does not contain 0, or if G'' is not 0 there (``release_bend``) and G' has one sign at c and d.
Then the image lies in the hull of G(c) and G(d); else in G(c) + S [0, d - c], and in G(d) - S [0, d
- c].  If G'' is not 0, G' vanishes at most once: the cell is two laps, on each of which G is
monotone.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.elementary import hull
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.release_bend import bend
from cap.checker.system.releases import Releases


class Cell(NamedTuple):
    """A cell, the windows of its contacts, S, G at its ends, what has its image, and its laps."""

    lower: Fraction
    upper: Fraction
    windows: Sequence[Interval]
    slope: Interval
    ends: tuple[Interval, Interval]
    image: Interval
    laps: int


def cell(
    F: Releases, periods: int, ends: tuple[Fraction, Fraction], windows: Sequence[Interval]
) -> Cell:
    """Prove that F is defined on a cell; return it.  Its laps are 0 if they are not known."""
    c, d = ends
    t, shift = Interval.enclosing(c, d, F.bits), F.period * periods
    moments = F.over(t, windows)
    S = moments[-1].by[0]
    first, last = (F.at(Interval.enclosing(q, q, F.bits), windows) for q in ends)
    low, high = first.time - shift, last.time - shift
    laps = 1
    if S.contains_zero():
        laps = _laps(bend(F, t, moments), first.by[0] * last.by[0])
    image = hull((low, high))
    if laps != 1:
        run = S * Interval.enclosing(0, d - c, F.bits)
        image = (low + run).intersection(high - run)
    return Cell(c, d, windows, S, (low, high), image, laps)


def confirm_laps(cells: Sequence[Cell]) -> list[int]:
    """Return how many laps each cell has."""
    need(all(c.laps for c in cells), "G may turn more than once in a cell")
    return [c.laps for c in cells]


def met(cells: Sequence[Cell]) -> list[range]:
    """Return for each cell those that its image meets, if it lies in I."""
    lower, upper = [c.lower for c in cells], [c.upper for c in cells]
    images = [c.image for c in cells]
    return [range(bisect_left(upper, x.lower), bisect_right(lower, x.upper)) for x in images]


def coverings(cells: Sequence[Cell]) -> list[range]:
    """Return for each cell those in the interior between the images of its ends."""
    lower, upper = [c.lower for c in cells], [c.upper for c in cells]
    edges = list[range]()
    for c in cells:
        low, high = sorted(c.ends, key=lambda x: x.lo)
        first, last = bisect_right(lower, low.upper), bisect_left(upper, high.lower)
        edges.append(range(first, max(first, last)))
    return edges


def _laps(turns: Interval, signs: Interval) -> int:
    """Return the laps, from G'' on the cell and the product of G' at its ends; 0 if not known."""
    if turns.contains_zero():
        return 0
    return 1 if signs.is_positive() else 2
