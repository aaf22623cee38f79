"""How many places of release have a fate: intervals of places, and measures.

G is the next place.  By ``settled``, some intervals of places have a fate; of portions between them
G is known.  So [0, W] is divided into *parts*: such intervals, portions, and the gaps between them.

*Measures.*  Let m_j bound the measure of the places in part j without a certain fate.  Such places
in a portion are mapped by G to such places; as G is one-to-one if c > 0, their measure is at most
1/c times that of such places in its image: the sum of m_j over the parts j in the image, or of the
length of what of a part is in the image, if that is less.  The first bounds are the lengths of the
parts, but 0 where the fate is known to be the right one; each round gives smaller ones.

Measures are whole numbers of 2^-60, rounded upwards: their sums are exact.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

from cap.checker.folded.numbers import UP, Pair
from cap.checker.folded.portions import Piece, Portion
from cap.checker.folded.settled import Settled
from cap.checker.folded.table import FATES, divided

_ROUNDS = 24
_LITTLE = 1e-5  # by which a round must make the sum less, relatively
UNIT = 2.0**60


class Reach(NamedTuple):
    """An interval of places: whole parts i < k < j, and what of the parts i and j it contains.

    That is in units, and 0 in j if that is i.
    """

    i: int
    j: int
    first: int
    last: int

    def mass(self, masses: Sequence[int], sums: Sequence[int]) -> int:
        """Return a bound of the measure of the places without a fate, by bounds for the parts."""
        mass = min(masses[self.i], self.first)
        if self.i < self.j:
            mass += sums[self.j] - sums[self.i + 1] + min(masses[self.j], self.last)
        return mass


Part = Portion | int
"""A portion, or a fate, or 0 if there is none."""
Reached = tuple[int, float, Reach]
"""The number of a portion, c, and its next places."""


def units(x: float) -> int:
    """Return a length in whole units, rounded upwards."""
    return math.ceil(x * UP * UNIT)


class Places:
    """What is known of the places in [0, W].

    ``ends`` are those of the parts; ``masses`` and their ``sums``, for each fate, bound the measure
    of the places in a part without it.
    """

    def __init__(
        self, kept: Sequence[Pair], width: float, level: int, pieces: Sequence[Piece]
    ) -> None:
        """``kept`` are attracted; no two pieces overlap; ``level`` is that of ``settled``."""
        settled = Settled(kept, width, level, pieces)
        self.width, self.table = width, settled.table
        self.ends, self.parts = parts(settled)
        reached = [
            (n, part.c, self.reach(part.image))
            for n, part in enumerate(self.parts)
            if isinstance(part, Portion)
        ]
        self.masses = {fate: self.mass(fate, reached) for fate in FATES}
        self.sums = {
            fate: list(accumulate(masses, initial=0)) for fate, masses in self.masses.items()
        }

    def fate(self, ends: Pair) -> int:
        """Return the fate of all places in an interval, or 0."""
        return self.table.fate(ends)

    def missing(self, ends: Pair, fate: int) -> float:
        """Return a bound of the measure of the places in an interval without a fate."""
        mass = self.reach(ends).mass(self.masses[fate], self.sums[fate])
        return mass / UNIT * UP

    def mass(self, fate: int, reached: Sequence[Reached]) -> list[int]:
        """Return bounds of the measures of the places in the parts without a fate."""
        sizes = (units(b - a) for a, b in pairwise(self.ends))
        masses = [
            0 if isinstance(part, int) and part & fate else size
            for part, size in zip(self.parts, sizes, strict=True)
        ]
        for _ in range(_ROUNDS):
            sums = list(accumulate(masses, initial=0))
            for n, c, reach in reached:
                masses[n] = min(masses[n], int(reach.mass(masses, sums) / c * UP) + 1)
            if sums[-1] - sum(masses) <= _LITTLE * sums[-1]:
                break
        return masses

    def reach(self, ends: Pair) -> Reach:
        """Return an interval of places; nothing is beyond the first and the last one."""
        low, high = max(ends[0], 0.0), min(ends[1], self.width)
        i, j = self.part(low), self.part(high)
        if i >= j:
            return Reach(i, i, units(max(0.0, high - low)), 0)
        return Reach(i, j, units(self.ends[i + 1] - low), units(high - self.ends[j]))

    def part(self, x: float) -> int:
        """Return the number of the part that contains a place."""
        return min(max(bisect_right(self.ends, x) - 1, 0), len(self.parts) - 1)


def parts(settled: Settled) -> tuple[list[float], list[Part]]:
    """Return the ends of the parts, and the parts; portions in part kept are gaps."""
    apart = [p for p in settled.portions if p.c > 0 and not overlaps(p.ends, settled.kept)]
    items: list[tuple[Pair, Part]] = [*settled.table.known(), *((p.ends, p) for p in apart)]
    return divided(settled.width, items)


def overlaps(ends: Pair, intervals: Iterable[Pair]) -> bool:
    """Return whether an interval has more than an end in common with one of these."""
    return any(ends[0] < high and low < ends[1] for low, high in intervals)
