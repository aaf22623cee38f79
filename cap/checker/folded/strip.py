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

    w = s - v, v in [slow, fast], x = edge + p.  The numbers are rounded to the safe side.
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
        low, high = line.ends(s)
        if not (self.fast - self.d < low and high < self.slow + self.d):
            return False
        x = line.moved(p, *self.edge)
        low, high = line.ends(x)
        if not (self.left < low and high < self.right):
            return False
        w = line.moved(s, -(self.fast + self.slow) / 2, self.fast - self.slow)
        low, high = line.ends(line.total(x, line.scaled(w, self.k)))
        return self.left < low and high < self.right
