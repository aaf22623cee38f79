"""The flights of any mode in balls, where there is no closed form (springs), or in resonance.

y = (state, cos wt, sin wt, 1) has y' = M y, so y(t_0 + d) = exp(M d) y(t_0).
"""

from __future__ import annotations

from collections.abc import Sequence

from cap.sets import interval
from cap.sets.interval import Ball, Matrix
from cap.system.polynomial import Polynomial
from cap.system.spectral import spectral

BITS = 64  # where doubles are wanted


def enclosed(rows: Sequence[Sequence[Polynomial]]) -> Matrix:
    """Return an enclosure of a matrix of numbers."""
    return interval.matrix([[number(q) for q in row] for row in rows])


def exponential(A: Matrix, d: Ball) -> Matrix:
    """Return an enclosure of exp(A t) for all t in d.

    With d = m + [-r, r] it is exp(A m) exp(A [-r, r]), which is narrower than exp(A d) at once.
    """
    middle = interval.point(d)
    at_middle, aside = (A * middle).exp(), d - middle
    return at_middle if aside.is_zero() else at_middle * (A * aside).exp()


def number(q: Polynomial) -> Ball:
    """Return a ball that contains a number, a sum of rationals times powers of pi."""
    value: Ball = q.evaluated({}, interval.ball, interval.pi())
    return value


class Exponential:
    """The first rows of exp(N d), entry by entry, as a function of d: by eigenvalues if N has them.

    It holds at any precision; at one much higher than here it is wider than need be.
    """

    def __init__(self, rows: Sequence[Sequence[Polynomial]], count: int) -> None:
        """Take N, and how many of its rows are wanted."""
        self._matrix, self._size = enclosed(rows), count * len(rows)
        self._spectral = spectral(rows, self._size)

    def __call__(self, d: Ball) -> Sequence[Ball]:
        """Return enclosures of the entries for all numbers in d."""
        if self._spectral:
            return self._spectral(d)
        return exponential(self._matrix, d).entries()[: self._size]

    def near(self, d: float) -> Sequence[float]:
        """Return doubles near the entries; nothing is rounded outwards."""
        if self._spectral:
            return self._spectral.near(d)
        with interval.workprec(BITS):
            return [float(x) for x in self(Ball(d))]
