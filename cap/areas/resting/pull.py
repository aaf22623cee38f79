"""The pull towards a wall, -h'' = P(t), where it depends on the clock alone; its integrals.

The time s is that since the start t_0.  P = m + c cos(w s) + d sin(w s) has the integrals, from 0,

    I = m s + (c sin(w s) + d (1 - cos(w s)))/w,
    J = m s^2/2 + (c (1 - cos(w s))/w + d (s - sin(w s)/w))/w,

and a flight with (h, h') = (y, v) at the time T has at the time s, for as long as it lasts,

    h' = v - (I(s) - I(T)),      h = y + v (s - T) - (J(s) - J(T) - I(T) (s - T)).

Intervals are those of `cap.sets.doubles`: each contains what it stands for.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.sets.circular import sin_cos
from cap.sets.compiled import compiled, kernel
from cap.sets.doubles import Interval, between, lower, square, upper

Floats = NDArray[np.float64]


class Pull(NamedTuple):
    """m, c, d, w and 1/w; e, the restitution; and the ``end``, a time s in doubles.

    Not more than ``late`` and not less than ``early`` are upper and lower doubles of the end.
    """

    mean: Interval
    cos: Interval
    sin: Interval
    omega: Interval
    per: Interval
    e: Interval
    early: float
    late: float


class Table(NamedTuple):
    """Enclosures on a grid of times s_j = j ``step``, the step a power of 2.

    ``sums`` (n + 1, 4): middle and radius of I(s_j), and of J(s_j); ``ends`` (n, 2): P between s_j
    and s_j+1 is at least and at most so much.
    """

    step: float
    sums: Floats
    ends: Floats


@kernel
def pull(p: Pull, s: Interval) -> Interval:
    """Return P during some time."""
    sine, cosine = sin_cos(p.omega * s)
    return p.mean + (p.cos * cosine + p.sin * sine)


@kernel
def sums(p: Pull, s: float) -> tuple[Interval, Interval]:
    """Return I and J at a time."""
    t = Interval(s, 0.0)
    sine, cosine = sin_cos(p.omega * t)
    rest = 1.0 - cosine
    first = p.mean * t + p.per * (p.cos * sine + p.sin * rest)
    second = p.per * (p.per * (p.cos * rest) + p.sin * (t - p.per * sine))
    return first, p.mean * (0.5 * square(t)) + second


@compiled
def fill(p: Pull, step: float, values: Floats, ends: Floats) -> None:
    """Write a table."""
    for j in range(values.shape[0]):
        first, second = sums(p, j * step)
        values[j] = first.mid, first.rad, second.mid, second.rad
    for j in range(ends.shape[0]):
        found = pull(p, between(j * step, (j + 1) * step))
        ends[j] = lower(found), upper(found)


def table(p: Pull) -> Table:
    """Return the table of a pull until the end and one step more: 64 to 128 steps a period."""
    step = 2.0 ** math.floor(math.log2(2 * math.pi / p.omega.mid / 64))
    n = math.ceil(p.late / step) + 2
    values, ends = np.empty((n + 1, 4)), np.empty((n, 2))
    fill(p, step, values, ends)
    return Table(step, values, ends)


@kernel
def known(grid: Table, j: int) -> tuple[Interval, Interval]:
    """Return I and J at a time of the grid."""
    a, b, c, d = grid.sums[j]
    return Interval(a, b), Interval(c, d)


@kernel
def extremes(grid: Table, a: float, b: float) -> tuple[float, float]:
    """Return bounds of P between two times, 0 <= a <= b <= the last of the grid; NaN if not."""
    if not 0 <= a <= b < grid.step * grid.ends.shape[0]:
        return math.nan, math.nan
    low, high = math.inf, -math.inf
    for j in range(int(a / grid.step), int(b / grid.step) + 1):
        low, high = min(low, grid.ends[j, 0]), max(high, grid.ends[j, 1])
    return low, high
