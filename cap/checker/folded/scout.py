"""What comes next in a flight, nearly: it steers, and what it says is proved elsewhere."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from cap.checker.folded.numbers import zero
from cap.checker.kernel.rejection import Rejected


class Middle(NamedTuple):
    """The flight s = sin t - a d + A, p = -cos t - a d^2/2 + A d + B, d = t - ref, a the drag."""

    drag: float
    A: float
    B: float
    ref: float

    def speed(self, t: float) -> float:
        """Return s."""
        return math.sin(t) - self.drag * (t - self.ref) + self.A

    def ahead(self, t: float) -> float:
        """Return -p, the distance to the wall ahead."""
        d = t - self.ref
        return math.cos(t) - d * (self.A - self.drag * d / 2) - self.B


def scout(
    f: Middle, low: float, slows: Iterable[tuple[int, float]], fall: float
) -> tuple[str, float, int]:
    """Return whether a hit or a stop is next after a time, when, and in which arc.

    ``slows`` are the slow times, with their numbers; before each the speed falls for so long.
    """
    for k, slow in slows:
        if slow <= low:
            continue
        high, stops = slow, f.speed(slow) <= 0
        if stops:
            high = zero(f.speed, max(low, slow - fall), slow)
        if f.ahead(high) <= 0:
            return "hit", zero(f.ahead, low, high), k
        if stops:
            return "stop", high, k
        low = slow
    raise Rejected("a flight is too long")
