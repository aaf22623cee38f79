"""How many places of release have a fate: intervals of places, and measures by cells.

Places are divided into the portions and cells of ``portions``; G is the next place.

*Fates* are found in rounds.  A portion has a fate if all its next places have it, by the table of
the last round; the first table knows of one interval that is attracted.

*Measures.*  Let m_j bound the measure of the places in cell j without a certain fate.  Such places
in a portion are mapped by G to such places; as G is one-to-one if c > 0, their measure is at most
1/c times that of such places in its image: the sum over the cells j of m_j, or of what has not the
fate by the table in the part of the image in the cell, if that is less.  So the sums of these
bounds over the portions of a cell, 0 for those with the fate, and of the lengths of what is in no
portion, are bounds again.  The first ones are the lengths of the cells; each round gives smaller
ones.

Measures are whole numbers of 2^-60, rounded upwards: their sums are exact.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

from cap.checker.folded.numbers import UP, Pair
from cap.checker.folded.portions import Node, Portion
from cap.checker.folded.table import ATTRACTOR, NONE, SEGMENT, Table, first_table

_ROUNDS = 24
UNIT = 2.0**60


class Reach(NamedTuple):
    """An interval of places: whole cells i < k < j, and what is in doubt in the cells i and j.

    That is in units, and 0 in j if that is i.
    """

    i: int
    j: int
    first: int
    last: int

    def mass(self, masses: Sequence[int], sums: Sequence[int]) -> int:
        """Return a bound of the measure of the places without a fate, by bounds for the cells."""
        mass = min(masses[self.i], self.first)
        if self.i < self.j:
            mass += sums[self.j] - sums[self.i + 1] + min(masses[self.j], self.last)
        return mass


class Passage(NamedTuple):
    """A portion of a cell, its size in units, and the next places, with c."""

    cell: int
    size: int
    image: Pair
    c: float


def units(x: float) -> int:
    """Return a length in whole units, rounded upwards."""
    return math.ceil(x * UP * UNIT)


class Doubt:
    """The measure of the places to which a table gives no fate, or another one."""

    def __init__(self, table: Table, fate: int) -> None:
        self.ends = table.ends
        self.doubtful = [found != fate for found in table.fates]
        sizes = [
            units(b - a) * bad
            for (a, b), bad in zip(pairwise(self.ends), self.doubtful, strict=True)
        ]
        self.sums = list(accumulate(sizes, initial=0))

    def measure(self, low: float, high: float) -> int:
        """Return a bound of the measure of those in an interval, in units."""
        if low >= high:
            return 0
        i = min(max(bisect_right(self.ends, low) - 1, 0), len(self.doubtful) - 1)
        j = min(max(bisect_right(self.ends, high) - 1, 0), len(self.doubtful) - 1)
        if i == j:
            return units(high - low) if self.doubtful[i] else 0
        first = units(self.ends[i + 1] - low) if self.doubtful[i] else 0
        last = units(high - self.ends[j]) if self.doubtful[j] else 0
        return first + self.sums[j] - self.sums[i + 1] + last


class Places:
    """What is known of the places in [0, W]."""

    def __init__(self, kept: Pair, width: float, level: int, found: Sequence[Portion]) -> None:
        """``kept`` is attracted; the portions are in order, and do not overlap."""
        self.width, self.level, self.scale = width, level, (1 << level) / width
        self.edges = [Node(k, level).ends(width)[0] for k in range((1 << level) + 1)]
        self.sizes = [units(b - a) for a, b in pairwise(self.edges)]
        self.portions, self.table = found, self.rounds(kept, found)
        self.doubts = {fate: Doubt(self.table, fate) for fate in (ATTRACTOR, SEGMENT)}
        self.masses = {fate: self.mass(fate) for fate in (ATTRACTOR, SEGMENT)}
        self.sums = {
            fate: list(accumulate(masses, initial=0)) for fate, masses in self.masses.items()
        }

    def fate(self, ends: Pair) -> int:
        """Return the fate of all places in an interval, or 0."""
        return self.table.fate(ends)

    def missing(self, ends: Pair, fate: int) -> float:
        """Return a bound of the measure of the places in an interval without a fate."""
        mass = self.reach(ends, self.doubts[fate]).mass(self.masses[fate], self.sums[fate])
        return mass / UNIT * UP

    # fates

    def rounds(self, kept: Pair, found: Sequence[Portion]) -> Table:
        """Return the table of fates."""
        table = first_table(self.width, kept)
        known = [0] * len(found)
        for _ in range(_ROUNDS):
            changed = False
            for n, p in enumerate(found):
                if not known[n]:
                    known[n] = SEGMENT if p.image is None else table.fate(p.image)
                    changed = changed or known[n] > 0
            if not changed:
                break
            table = self.listed(kept, found, known)
        return table

    def listed(self, kept: Pair, found: Sequence[Portion], known: Sequence[int]) -> Table:
        """Return the table with the fates of these portions, and of what is kept."""
        ends, fates = [0.0], list[int]()
        for (low, high), fate in merged(kept, found, known):
            if low > ends[-1]:
                ends.append(low)
                fates.append(NONE)
            ends.append(high)
            fates.append(fate)
        if ends[-1] < self.width:
            ends.append(self.width)
            fates.append(NONE)
        return Table(ends, fates)

    # measures

    def mass(self, fate: int) -> list[int]:
        """Return bounds of the measures of the places in the cells without a fate."""
        doubt, fixed = self.doubts[fate], self.fixed(fate)
        rest = [(p.cell, p.size, p.c, self.reach(p.image, doubt)) for p in self.passages()]
        masses, last = self.sizes, -1
        for _ in range(_ROUNDS):
            sums = list(accumulate(masses, initial=0))
            if sums[-1] == last:
                break
            last, new = sums[-1], list(fixed)
            for cell, size, c, reach in rest:
                new[cell] += min(size, int(reach.mass(masses, sums) / c * UP) + 1)
            masses = [min(a, b) for a, b in zip(masses, new, strict=True)]
        return masses

    def passages(self) -> list[Passage]:
        """Return the portions of which no more is known than the next places."""
        found = list[Passage]()
        for p in self.portions:
            if p.image is not None and p.c > 0 and not self.table.fate(p.ends):
                found.append(Passage(p.cell, units(p.ends[1] - p.ends[0]), p.image, p.c))
        return found

    def fixed(self, fate: int) -> list[int]:
        """Return bounds of the measures of what has not the fate, but for those portions."""
        covered = [0.0] * len(self.sizes)
        for p in self.portions:
            found = self.table.fate(p.ends)
            if found == fate or (p.image is not None and p.c > 0 and not found):
                covered[p.cell] += p.ends[1] - p.ends[0]
        ends = pairwise(self.edges)
        fates = [self.table.fate(cell) for cell in ends]
        gaps = [
            max(0, size - math.floor(z / UP * UNIT))
            for size, z in zip(self.sizes, covered, strict=True)
        ]
        return [0 if f == fate else gap for f, gap in zip(fates, gaps, strict=True)]

    def reach(self, ends: Pair, doubt: Doubt) -> Reach:
        """Return an interval of places; nothing is beyond the first and the last one."""
        low, high = max(ends[0], 0.0), min(ends[1], self.width)
        i, j = self.cell(low), self.cell(high)
        if i >= j:
            return Reach(i, i, doubt.measure(low, high), 0)
        first = doubt.measure(low, self.edges[i + 1])
        return Reach(i, j, first, doubt.measure(self.edges[j], high))

    def cell(self, x: float) -> int:
        """Return the number of a cell that contains a place."""
        k = min(max(int(x * self.scale), 0), len(self.sizes) - 1)
        if x < self.edges[k]:
            return k - 1
        return min(k + (x > self.edges[k + 1]), len(self.sizes) - 1)


def merged(kept: Pair, found: Sequence[Portion], known: Sequence[int]) -> list[tuple[Pair, int]]:
    """Return the intervals with a fate, in order; ``kept`` is one of them."""
    low, high = kept
    all_ = [(p.ends, fate) for p, fate in zip(found, known, strict=True) if fate]
    below = [((a, min(b, low)), fate) for (a, b), fate in all_ if a < low]
    above = [((max(a, high), b), fate) for (a, b), fate in all_ if b > high]
    return [*below, (kept, ATTRACTOR), *above]
