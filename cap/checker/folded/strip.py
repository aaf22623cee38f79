"""A part of the basin of the segment: states at the time 0, or pi folded."""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.folded.numbers import Pair
from cap.checker.kernel import line
from cap.checker.kernel.line import Line

Strobe = tuple[Line, Line]
"""The distance to the wall ahead, negative, and the speed, at a multiple of 2 pi."""


class Strip(NamedTuple):
    """States at the time 0 that tend to the segment: |w| < d, x and x + k w in (left, right).

    w = s - v, v in [slow, fast], x = edge + p.  The numbers are rounded to the safe side.  Where d
    is 0 there are none.
    """

    left: float
    right: float
    slow: float
    fast: float
    d: float
    k: float
    edge: Pair

    def holds(self, strobe: Strobe) -> bool:
        """Return whether all states of models are in the strip."""
        p, s = strobe
        x = line.moved(p, *self.edge)
        w = line.moved(s, -(self.fast + self.slow) / 2, self.fast - self.slow)
        both = line.total(x, line.scaled(w, self.k))
        return self.contains(line.ends(s), line.ends(x), line.ends(both))

    def contains(self, speeds: Pair, *places: Pair) -> bool:
        """Return whether states with these bounds of s, of x and of x + k w are in the strip."""
        slow, fast = self.fast - self.d < speeds[0], speeds[1] < self.slow + self.d
        return slow and fast and all(self.left < x[0] and x[1] < self.right for x in places)


NOWHERE = Strip(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, (0.0, 0.0))
