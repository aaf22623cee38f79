"""A part of the basin of the segment: states at the time 0, or pi folded."""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.folded.numbers import Pair
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model

Strobe = tuple[Model, Model]
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
        """Return whether all states of a model are in the strip."""
        p, s = strobe
        low, high = q.ends(s)
        if not (self.fast - self.d < low and high < self.slow + self.d):
            return False
        x = q.moved(p, *self.edge)
        low, high = q.ends(x)
        if not (self.left < low and high < self.right):
            return False
        w = q.moved(s, -(self.fast + self.slow) / 2, self.fast - self.slow)
        low, high = q.ends(q.total(x, q.scaled(w, self.k)))
        return self.left < low and high < self.right
