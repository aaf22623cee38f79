"""The flights of any mode in balls, where there is no closed form (springs), or in resonance.

y = (state, cos wt, sin wt, 1) has y' = M y, so y(t_0 + d) = exp(M d) y(t_0).
"""

from __future__ import annotations

from collections.abc import Sequence

from cap.sets import interval
from cap.sets.interval import Ball, Matrix
from cap.system.polynomial import Polynomial


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
