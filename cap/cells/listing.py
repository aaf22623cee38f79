"""Columns of cells as text, as `cap.checker.flow.columns` reads them."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from cap.cells.cover import Cover, Floats
from cap.cells.fit import UNIT

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


def runs(cover: Cover, j: int) -> list[Run]:
    """Return the runs of a column."""
    found = [Run([_units(cover.bottom[j])], [], BOTTOM)] if cover.has_bottom[j] else []
    for i in range(cover.start[j], cover.start[j + 1]):
        low, high = edges_of(cover, i)
        if not (found and found[-1].edges[-1] == low):
            found.append(Run([low], [], 0))
        found[-1].edges.append(high)
        found[-1].levels.append(int(cover.levels[i]))
    top = _units(cover.top[j])
    if found and found[-1].edges[-1] == top:
        last = found.pop()
        found.append(last._replace(kind=last.kind | TOP))
    else:
        found.append(Run([top], [], TOP))
    return found


def edges_of(cover: Cover, i: int) -> tuple[Edge, Edge]:
    """Return the edges of a cell."""
    return _units(cover.cells[i, :3]), _units(cover.cells[i, 3:])


def _units(p: Floats) -> Edge:
    a, b, c = (round(float(q) / UNIT) for q in p)
    return a, b, c
