"""Tables of fates, by intervals."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from itertools import accumulate, pairwise
from operator import itemgetter
from typing import TypeVar

from cap.checker.folded.numbers import Pair

NONE, ATTRACTOR, SEGMENT = 0, 1, 2
EITHER = ATTRACTOR | SEGMENT  # what has one of both has it
FATES = ATTRACTOR, SEGMENT, EITHER

T = TypeVar("T")

Known = tuple[Pair, int]
"""An interval, and the fate of all that lies in it."""


class Table:
    """[0, W] in intervals, in order, each with a fate or 0."""

    def __init__(self, width: float, known: Iterable[Known]) -> None:
        self.ends, self.fates = divided(width, known)
        sizes = (0.0 if fate else b - a for (a, b), fate in self._intervals())
        self._open = list(accumulate(sizes, initial=0.0))

    def _intervals(self) -> Iterator[Known]:
        """Give the intervals, and their fates or 0."""
        return zip(pairwise(self.ends), self.fates, strict=True)

    def fate(self, ends: Pair) -> int:
        """Return the fate of all that lies in an interval, or 0; nothing is beyond the table."""
        low, high = max(ends[0], self.ends[0]), min(ends[1], self.ends[-1])
        k = bisect_right(self.ends, low, 0, len(self.fates)) - 1
        return self.fates[k] if low <= high <= self.ends[k + 1] else NONE

    def known(self) -> Iterator[Known]:
        """Give the intervals with a fate."""
        return ((ends, fate) for ends, fate in self._intervals() if fate)

    def doubtful(self, ends: Pair) -> float:
        """Return how much of an interval has no fate, nearly: it steers."""
        low, high = max(ends[0], self.ends[0]), min(ends[1], self.ends[-1])
        return self._before(high) - self._before(low) if low < high else 0.0

    def _before(self, x: float) -> float:
        """Return how much has no fate before a place, nearly."""
        k = bisect_right(self.ends, x, 0, len(self.fates)) - 1
        return self._open[k] + (0.0 if self.fates[k] else x - self.ends[k])


def divided(width: float, known: Iterable[tuple[Pair, T]]) -> tuple[list[float], list[T | int]]:
    """Return ends that divide [0, W], and what is known between them, or 0.

    Where two intervals overlap, the first counts; what is the same of two next to each other, is
    known of one.
    """
    steps = list[tuple[float, T | int]]()  # up to which place, what
    for (low, high), what in sorted(known, key=itemgetter(0)):
        steps += [(low, NONE), (high, what)]
    ends, found = [0.0], list[T | int]()
    for end, part in [*steps, (width, NONE)]:
        if ends[-1] < end and found and found[-1] == part:
            ends[-1] = end
        elif ends[-1] < end:
            ends.append(end)
            found.append(part)
    return ends, found
