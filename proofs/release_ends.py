"""Ends of cells that a map of releases takes near to ends of cells: coverings lose little.

G turns at c, and is monotone between turns.  Ends are taken at c, G(c), G²(c), ..., and at points
that G takes to them.  No image of an end is exactly an end: each stands for two, e - d and e + d,
with d so large that the images of the two ends at a point before lie between the two at the next.
Nothing is proved here.
"""

from bisect import bisect_left
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.releases import Releases
from cap.floats import candidates

FINE, FINER = 10**10, 10**24  # of times; of ends
ROOM = Fraction(1, 10**5)  # of windows around times that floats have
TURN, LARGEST = 1e-9, 1e-4  # of I: d at a turn, and the largest
MORE, LESS = 1.2, 0.8  # than d times the derivative
FOLD = 8  # for the image of a turn: it is enclosed with a derivative over 2 d
FORWARD, BACKWARD, STEPS = 24, 8, 6  # images of a turn; rounds of points before; Newton's steps
NARROW = 48  # cells in I, if they were of one length
CLOSE = 1e-20


class Point(NamedTuple):
    """G(t), and G'(t)."""

    value: Fraction
    slope: float


def near(t: float) -> Fraction:
    """Return a decimal near a double."""
    return Fraction(round(t * FINE), FINE)


def aligned(stay: candidates.Stay, given: Releases, a: Fraction, b: Fraction) -> list[Fraction]:
    """Return the ends of cells from a to b, in their order."""
    return _Ends(stay, given, a, b).listed()


class _Ends:
    """Points e in I with their d."""

    def __init__(self, stay: candidates.Stay, given: Releases, a: Fraction, b: Fraction) -> None:
        self.stay, self.given, self.a, self.b = stay, given, a, b
        self.size = float(b - a)
        self.found = dict[Fraction, float]()
        self.turns = [c for low, high in self._brackets() if (c := self._turn(low, high))]
        for c in self.turns:
            self._forward(c)
        for _ in range(BACKWARD):
            if not self._backward():
                break

    def listed(self) -> list[Fraction]:
        """Return a, e - d and e + d for all points, b."""
        ends = [self.a]
        for e, d in sorted(self.found.items()):
            pair = [_decimal(e - Fraction(d)), _decimal(e + Fraction(d))]
            if ends[-1] < pair[0] < pair[1] < self.b:
                ends += pair
        return [*ends, self.b]

    def map(self, t: Fraction) -> Point | None:
        """Return G and G' at a time, if they are found."""
        bits, times = self.given.bits, map(near, self.stay.times(float(t)))
        windows = [Interval.enclosing(s - ROOM, s + ROOM, bits) for s in times]
        try:
            found = self.given.at(Interval.enclosing(t, t, bits), windows)
        except Rejected:
            return None
        value = found.time - self.given.period * self.stay.periods
        return Point(value.midpoint().lower, float(found.by[0].midpoint().lower))

    def _brackets(self) -> Iterator[tuple[Fraction, Fraction]]:
        """Yield intervals in which G turns, in the table of floats."""
        at, images = self.stay.within, self.stay.images
        inside = (float(self.a) < at) & (at < float(self.b))
        t, rising = at[inside], np.diff(images[inside]) > 0
        for k in np.flatnonzero(rising[1:] != rising[:-1]).tolist():
            yield near(t[k]), near(t[k + 2])

    def _turn(self, low: Fraction, high: Fraction) -> Fraction | None:
        """Return where G' changes its sign."""
        end = self.map(high)
        while high - low > TURN * self.size * 1e-4:
            middle = _decimal((low + high) / 2)
            there = self.map(middle)
            if end is None or there is None:
                return None
            low, high = (low, middle) if there.slope * end.slope > 0 else (middle, high)
        return high

    def _add(self, e: Fraction, d: float) -> bool:
        """Add a point, if it is in I, d is not too large, and no other point is near."""
        listed = sorted(self.found)
        k = bisect_left(listed, e)
        apart = all(abs(e - x) > 2 * (d + self.found[x]) for x in listed[max(k - 1, 0) : k + 1])
        fits = d < LARGEST * self.size and self.a + d < e < self.b - d
        if fits and apart:
            self.found[e] = d
        return fits and apart

    def _forward(self, c: Fraction) -> None:
        """Add a turn and its images."""
        d = TURN * self.size
        here, aside = self.map(c), [self.map(c + s * Fraction(d)) for s in (-1, 1)]
        if not here or not self._add(c, d):
            return
        e = _decimal(here.value)
        d = FOLD * max((float(abs(p.value - here.value)) for p in aside if p), default=0.0)
        for _ in range(FORWARD):
            there = self.map(e)
            if there is None or not self._add(e, d):
                return
            e, d = _decimal(there.value), MORE * abs(there.slope) * d

    def _backward(self) -> bool:
        """Add points before the known ones, where they are far apart; return whether any is."""
        ends = [self.a, *sorted(self.found), self.b]
        wide = [pair for pair in pairwise(ends) if float(pair[1] - pair[0]) * NARROW > self.size]
        more = False
        for e, d in [*self.found.items()] if wide else []:
            for t in self._before(float(e)):
                if any(low < t < high for low, high in wide):
                    more |= self._before_exactly(e, d, near(t))
        return more

    def _before(self, e: float) -> Iterator[float]:
        """Yield the places between turns that G takes to a point, in the table of floats."""
        at, images = self.stay.within, self.stay.images
        for low, high in pairwise([self.a, *sorted(self.turns), self.b]):
            inside = (float(low) < at) & (at < float(high))
            t, y = at[inside], images[inside]
            if len(t) > 1 and min(y[0], y[-1]) < e < max(y[0], y[-1]):
                order = slice(None) if y[0] < y[-1] else slice(None, None, -1)
                yield float(np.interp(e, y[order], t[order]))

    def _before_exactly(self, e: Fraction, d: float, t: Fraction) -> bool:
        """Add the point near t that G takes to e; return whether it is found."""
        for _ in range(STEPS):
            there = self.map(t)
            if there is None or not there.slope:
                return False
            step = float(there.value - e) / there.slope
            if abs(step) < CLOSE:
                return self._add(t, LESS * d / abs(there.slope))
            if abs(step) > self.size / NARROW:
                return False
            t = _decimal(t - (there.value - e) / Fraction(there.slope))
        return False


def _decimal(t: Fraction) -> Fraction:
    """Return a decimal near a time."""
    return Fraction(round(t * FINER), FINER)
