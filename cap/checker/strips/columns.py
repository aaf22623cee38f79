"""Columns of launches: cells between parabolas, in runs, as a certificate lists them.

A column is {t_0 - d <= t <= t_0 + d}, with s = (t - t_0)/d in [-1, 1] and the energy E = u^2/2.
The lines between columns are multiples of 2^-11, a power of 2 of them apart.  An *edge* is E = q_0
+ q_1 s + q_2 s^2, its coefficients multiples of 2^-24.  A *run* is a list of edges, each below the
next; between two that follow each other lies a *cell*, with its level.  The first run may begin at
the bottom, E = 0: then all below its first edge is a cell of level 0.  The last run ends at the
top: all above its last edge is a cell of level 0.

*As text.*  A family is a sequence of integers: the number of its columns; for each column, for each
of its runs, 4 m + b, m the number of its edges, b = 1 if it begins at the bottom, 2 if it ends at
the top, 3 if both, else 0, then the levels of the m - 1 cells between its edges; then q_0 of all
edges, less that of the edge before in the same column, if there is one; then q_1 and q_2 likewise.
Integers are written as in `cap.checker.kernel.parabolas`.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate, islice
from typing import NamedTuple

from cap.checker.kernel.parabolas import Edge, integers, ordered
from cap.checker.kernel.rejection import need

UNIT = 2.0**-24
LINE = 2.0**-11
LAST = 16  # no line is later
MOST = 4096  # columns
LONGEST = 2048  # edges of a column: pairs of its gaps may have to be compared
LARGEST = 1 << 40  # of coefficients, in units; sums of three of them are exact in doubles


class Run(NamedTuple):
    """Edges and, between them, the levels of cells; whether it goes on to the bottom or the top."""

    edges: list[Edge]
    levels: list[int]
    bottom: bool
    top: bool


Column = list[Run]
Head = tuple[int, list[int], bool, bool]


def columns(text: str) -> list[Column]:
    """Return the columns of a family."""
    rest = integers(text)
    number = next(rest, 0)
    need(0 < number <= MOST, "there are no columns, or too many")
    heads = [_head(rest) for _ in range(number)]
    sizes = [sum(size for size, *_ in head) for head in heads]
    deltas = [[list(islice(rest, size)) for size in sizes] for _ in range(3)]
    need(next(rest, None) is None, "a family goes on after its columns")
    return [_column(*each) for each in zip(heads, *deltas, strict=True)]


def _head(rest: Iterator[int]) -> list[Head]:
    """Return the runs of a column: numbers of edges, levels, whether to the bottom or the top."""
    found, long, top = list[Head](), 0, False
    while not top:
        head = next(rest, 0)
        m, bottom, top = head >> 2, head & 1 == 1, head & 2 == 2
        need(m >= 1, "a run has no edge, or the last run does not end at the top")
        long += m
        need(long <= LONGEST, "a column has too many edges")
        need(not (found and bottom), "a run has the bottom, and is not the first one")
        levels = list(islice(rest, m - 1))
        need(all(level > 0 for level in levels), "a cell has no level")
        found.append((m, levels, bottom, top))
    return found


def _column(heads: list[Head], *deltas: list[int]) -> Column:
    """Return the runs of a column, from the lowest to the highest, none above the next."""
    size = sum(m for m, *_ in heads)
    need(all(len(each) == size for each in deltas), "edges are missing")
    qs = [list(accumulate(each)) for each in deltas]
    need(all(-LARGEST < q < LARGEST for each in qs for q in each), "an edge is too far away")
    edges = list[Edge](zip(*qs, strict=True))
    ordered(edges)
    rest = iter(edges)
    return [Run(list(islice(rest, m)), levels, bottom, top) for m, levels, bottom, top in heads]


def lines(text: str) -> list[float]:
    """Return the lines: the first one, in units `LINE`, and the widths of the columns."""
    first, *widths = [*islice(integers(text), MOST + 2)] or [0]
    need(0 < len(widths) <= MOST, "there are no columns, or too many")
    need(all(w > 0 and w & (w - 1) == 0 for w in widths), "a width is not a power of 2")
    found = list(accumulate(widths, initial=first))
    need(found[0] >= 0 and found[-1] * LINE < LAST, "a line is too far away")
    return [z * LINE for z in found]
