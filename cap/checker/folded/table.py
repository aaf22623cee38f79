"""Tables of fates, by intervals."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from itertools import accumulate, pairwise

from cap.checker.folded.numbers import Pair

NONE, ATTRACTOR, SEGMENT = 0, 1, 2
EITHER = ATTRACTOR | SEGMENT  # what has one of both has it

Known = tuple[Pair, int]
"""An interval, and the fate of all that lies in it."""


class Table:
    """Intervals between these ends, in order, each with a fate or 0."""

    def __init__(self, ends: list[float], fates: list[int]) -> None:
        self.ends, self.fates = [ends[0]], list[int]()
        for end, fate in zip(ends[1:], fates, strict=True):
            if self.fates and self.fates[-1] == fate:
                self.ends[-1] = end
            else:
                self.fates.append(fate)
                self.ends.append(end)
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


def table(width: float, known: Iterable[Known]) -> Table:
    """Return the table of [0, W] that knows of these intervals, which do not overlap."""
    ends, fates = [0.0], list[int]()
    for (low, high), fate in sorted(known):
        if low > ends[-1]:
            ends.append(low)
            fates.append(NONE)
        ends.append(high)
        fates.append(fate)
    if ends[-1] < width:
        ends.append(width)
        fates.append(NONE)
    return Table(ends, fates)
