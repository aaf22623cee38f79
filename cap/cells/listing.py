"""Columns of cells as text, as `cap.checker.flow.columns` reads them."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

from cap.cells.fates import Floats
from cap.cells.fit import PIECES, UNIT, Columns

DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
BOTTOM, TOP = 1, 2

Edge = tuple[int, int, int]


class Run(NamedTuple):
    """Edges, from the lowest, the levels of the cells between them, and where it ends."""

    edges: list[Edge]
    levels: list[int]
    kind: int


def written(numbers: Iterable[int]) -> str:
    """Return integers as text: z as 2 z, or -2 z - 1 if negative, in digits of five bits."""
    text = []
    for number in numbers:
        z = 2 * number if number >= 0 else -2 * number - 1
        while z >= 32:
            text.append(DIGITS[32 + z % 32])
            z //= 32
        text.append(DIGITS[z])
    return "".join(text)


def listed(runs: Sequence[Run]) -> str:
    """Return the text of a column."""
    numbers, before = list[int](), (0, 0, 0)
    for run in runs:
        numbers += [4 * len(run.edges) + run.kind, *run.levels]
        for edge in run.edges:
            numbers += [a - b for a, b in zip(edge, before, strict=True)]
            before = edge
    return written(numbers)


def runs(columns: Columns, j: int) -> list[Run]:
    """Return the runs of a column, none above the next; what does not fit is left out."""
    found = [Run([_units(columns.bottom[j])], [], BOTTOM)] if columns.bottom[j, 0] > 0 else []
    for i in range(columns.number[j]):
        if columns.level[j, i] > 0:
            found += _pieces(columns, j, i, int(columns.level[j, i]))
    top = Run([_units(columns.top[j])], [], TOP)
    return _joined([*found, top])


def _units(p: Floats) -> Edge:
    a, b, c = (round(q / UNIT) for q in p)
    return a, b, c


def edge(columns: Columns, j: int, i: int, m: int) -> Edge:
    """Return an edge of a piece of a strip, in units: as `cap.cells.fit` computes it."""
    low, high = columns.edges[j, i, :3], columns.edges[j, i, 3:]
    a, b, c = (round((p + (q - p) * m / PIECES) / UNIT) for p, q in zip(low, high, strict=True))
    return a, b, c


def _pieces(columns: Columns, j: int, i: int, level: int) -> list[Run]:
    """Return the runs of pieces of a strip."""
    found, m = list[Run](), 0
    held = columns.held[j, i].tolist()
    while m < PIECES:
        if not held[m]:
            m += 1
            continue
        edges = [edge(columns, j, i, m)]
        while m < PIECES and held[m]:
            m += held[m]
            edges.append(edge(columns, j, i, m))
        found.append(Run(edges, [level] * (len(edges) - 1), 0))
    return found


def _joined(found: list[Run]) -> list[Run]:
    """Join runs that share an edge, and leave out those that are not above the one before."""
    joined = list[Run]()
    for run in found:
        if not all(below(*pair) for pair in pairwise(run.edges)):
            continue
        if joined and joined[-1].edges[-1] == run.edges[0]:
            last = joined.pop()
            kind = last.kind | run.kind
            joined.append(Run(last.edges + run.edges[1:], last.levels + run.levels, kind))
            continue
        if run.kind & TOP:
            while joined and not below(joined[-1].edges[-1], run.edges[0]):
                joined.pop()
        if not joined or below(joined[-1].edges[-1], run.edges[0]):
            joined.append(run)
    return joined


def below(one: Edge, two: Edge) -> bool:
    """Return whether an edge is certainly below another in the whole column."""
    a, b, c = (q - p for p, q in zip(one, two, strict=True))
    return a + c > abs(b) and (abs(b) >= 2 * c or 4 * a * c > b * b)
