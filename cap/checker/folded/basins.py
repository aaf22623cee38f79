"""Parts of basins: states all orbits of which have the same fate.

They are states at the multiples of 2 pi of the folded time: of the unfolded one, those at 0 that
move to the right, and those at pi that move to the left, mirrored; or at the odd multiples of pi:
the other way round.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from cap.checker.folded.flights import Flight, Model
from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import TURN, Pair
from cap.checker.folded.table import ATTRACTOR, NONE, SEGMENT

Bounds = Callable[[Pair, Pair], Pair]
"""Bounds of a p + b s over some states, for numbers a, b that are known up to an error."""


class Row(NamedTuple):
    """The numbers low < a p + b s < high; a and b are rounded to nearest."""

    a: float
    b: float
    low: float
    high: float


class Region(Protocol):
    """States between rows: a strip of `cap.checker.attracting.segment`, an ellipse of ``sinks``."""

    @property
    def rows(self) -> tuple[Row, ...]:
        """The rows that sums of its states are between."""

    def contains(self, bounds: Bounds) -> bool:
        """Return whether some states are in it."""


class Basins(NamedTuple):
    """What is known of basins: at even multiples of pi strips and ellipses, ellipses at ``odd``."""

    strips: tuple[Region, ...] = ()
    ellipses: tuple[Region, ...] = ()
    odd: tuple[Region, ...] = ()

    def fate(self, k: int, bounds: Bounds) -> int:
        """Return the fate of states at a multiple k pi, if it is known, or 0."""
        if k % 2 == 0 and any(each.contains(bounds) for each in self.strips):
            return SEGMENT
        ellipses = self.odd if k % 2 else self.ellipses
        return ATTRACTOR if any(each.contains(bounds) for each in ellipses) else NONE

    def seen(self, y: Direction, f: Flight, until: float) -> int:
        """Return the fate of all states of a flight, if it is known at a multiple of pi that all
        pass before a time, or 0.
        """
        k = math.ceil(f.begun[1] / math.pi)
        while any(self) and k * math.pi < until:
            t, error = y.multiple(k)
            passed = self.at(k) and f.begun[1] < t - error and t + error < until
            if passed and (known := self.fate(k, bounds_of(y.q, *y.states(f, t, error)))):
                return known
            k += 1
        return NONE

    def at(self, k: int) -> bool:
        """Return whether something is known at a multiple k pi."""
        return bool(self.odd if k % 2 else self.strips or self.ellipses)


def bounds_of(q: Any, p: Model, s: Model) -> Bounds:
    """Return what gives bounds of sums of p and s, models of the module q."""

    def bounds(a: Pair, b: Pair) -> Pair:
        low, high = q.ends(q.total(q.scaled(p, *a), q.scaled(s, *b)))
        return low, high

    return bounds


def rounded(a: float) -> Pair:
    """Return what a double was rounded from."""
    return a, abs(a) * TURN
