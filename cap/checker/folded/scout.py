"""What comes next in a flight, nearly: it steers, and what it says is proved elsewhere."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from cap.checker.folded.numbers import zero
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.flight import place, velocity


class Middle(NamedTuple):
    """A flight (`cap.checker.system.flight`): s = v with V = A, p = x with X = B, d = t - ref."""

    drag: float
    A: float
    B: float
    ref: float

    def speed(self, t: float) -> float:
        """Return s."""
        return velocity(self.A, t - self.ref, self.drag, math.sin(t))

    def ahead(self, t: float) -> float:
        """Return -p, the distance to the wall ahead."""
        return -place(self.B, self.A, t - self.ref, self.drag / 2, math.cos(t))


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
