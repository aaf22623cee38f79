"""Columns of launches: cells between parabolas, in runs, as a certificate lists them.

A column is {t_0 - d <= t <= t_0 + d}, with s = (t - t_0)/d in [-1, 1] and the energy E = u^2/2. The
lines between columns are multiples of 2^-8, a power of 2 apart.  An *edge* is E = q_0 + q_1 s + q_2
s^2, its coefficients multiples of 2^-28.  A *run* is a list of edges, each below the next; between
two that follow each other lies a *cell*, with its level.  The first run may begin at the bottom, E
= 0: then all below its first edge is a cell of level 0.  The last run ends at the top: all above
its last edge is a cell of level 0.

*As text.*  A column is a sequence of integers: for each run 4 m + b, m the number of its edges, b =
1 if it begins at the bottom, 2 if it ends at the top, 3 if both, else 0; then the levels of the m -
1 cells between its edges; then the edges, by coefficient, each less that of the edge before, the
first of a run less that of the last one before it.  An integer z is written as 2 z or, if negative,
-2 z - 1, in base 64, in digits of five bits, least first, with 32 added to all but the last.
"""

from __future__ import annotations

from itertools import accumulate, pairwise
from typing import NamedTuple

from cap.checker.kernel.rejection import need

UNIT = 2.0**-28
LINE = 2.0**-8
MOST = 4096  # columns
LONGEST = 4096  # integers in a column: pairs of its gaps may have to be compared
LARGEST = 1 << 40  # of coefficients, in units; sums of three of them are exact in doubles
_DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
_VALUES = {digit: value for value, digit in enumerate(_DIGITS)}

Edge = tuple[int, int, int]


class Run(NamedTuple):
    """Edges and, between them, the levels of cells; whether it goes on to the bottom or the top."""

    edges: list[Edge]
    levels: list[int]
    bottom: bool
    top: bool


Column = list[Run]


def integers(text: str) -> list[int]:
    """Return the integers that are written in a text."""
    found, value, shift = list[int](), 0, 0
    for digit in text:
        need(digit in _VALUES and shift < 60, "a column is not a sequence of integers")
        value |= (_VALUES[digit] & 31) << shift
        shift += 5
        if _VALUES[digit] < 32:
            found.append(value >> 1 if value % 2 == 0 else -(value >> 1) - 1)
            value, shift = 0, 0
    need(shift == 0, "a column ends within an integer")
    return found


def column(text: str) -> Column:
    """Return the runs of a column, from the lowest to the highest, none above the next."""
    found = integers(text)
    need(len(found) <= LONGEST, "a column has too many edges")
    rest, runs, before = iter(found), Column(), (0, 0, 0)
    for head in rest:
        m = head >> 2
        need(m >= 1, "a run has no edge")
        need(m <= len(found), "a run has more edges than are listed")
        levels = [next(rest, -1) for _ in range(m - 1)]
        need(all(level > 0 for level in levels), "a cell has no level")
        edges = list[Edge]()
        for _ in range(m):
            a, b, c = (next(rest, LARGEST) + q for q in before)
            need(max(abs(a), abs(b), abs(c)) < LARGEST, "an edge is too far away")
            before = a, b, c
            edges.append(before)
        runs.append(Run(edges, levels, head & 1 == 1, head & 2 == 2))
    need(len(runs) > 0 and runs[-1].top, "the last run does not end at the top")
    need(not any(run.top for run in runs[:-1]), "a run ends at the top, and is not the last one")
    need(not any(run.bottom for run in runs[1:]), "a run has the bottom, and is not the first one")
    _ordered([edge for run in runs for edge in run.edges])
    return runs


def _ordered(edges: list[Edge]) -> None:
    """Check that each edge is below the next: their difference is positive at s = -1 and 1, and at
    its minimum, -d_1/(2 d_2), if that lies between.
    """
    for low, high in pairwise(edges):
        a, b, c = (q - p for p, q in zip(low, high, strict=True))
        inside = abs(b) < 2 * c
        apart = a + c > abs(b) and (not inside or 4 * a * c > b * b)
        need(apart, "an edge is not below the next")


def lines(text: str) -> list[float]:
    """Return the lines: the first one, in units 2^-8, and the widths of the columns."""
    first, *widths = integers(text) or [0]
    need(0 < len(widths) <= MOST, "there are no columns, or too many")
    need(all(w > 0 and w & (w - 1) == 0 for w in widths), "a width is not a power of 2")
    found = list(accumulate(widths, initial=first))
    need(found[0] >= 0 and found[-1] < 4096, "a line is too far away")
    return [z * LINE for z in found]
