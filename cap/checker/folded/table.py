"""Tables of fates, by intervals."""

from __future__ import annotations

from bisect import bisect_right

from cap.checker.folded.numbers import Pair

NONE, ATTRACTOR, SEGMENT = 0, 1, 2


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

    def fate(self, ends: Pair) -> int:
        """Return the fate of all that lies in an interval, or 0; nothing is beyond the table."""
        low, high = max(ends[0], self.ends[0]), min(ends[1], self.ends[-1])
        k = bisect_right(self.ends, low, 0, len(self.fates)) - 1
        return self.fates[k] if low <= high <= self.ends[k + 1] else NONE


def first_table(width: float, kept: Pair) -> Table:
    """Return the table that knows of one interval only, which is attracted."""
    return Table([0.0, *kept, width], [NONE, ATTRACTOR, NONE])
