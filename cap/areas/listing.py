"""Columns of cells as text, as `cap.checker.strips.columns` reads them."""

import base64
import zlib
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from cap.areas.strips.cover import Cover, Floats, Integers
from cap.areas.strips.fit import UNIT

BOTTOM, TOP = 1, 2

Edge = tuple[int, int, int]


class Run(NamedTuple):
    """Edges, from the lowest, the levels of the cells between them, and where it ends."""

    edges: list[Edge]
    levels: list[int]
    kind: int


def written(numbers: Iterable[int]) -> str:
    """Return integers as text: z as 2 z, or -2 z - 1 if negative, in bytes of seven bits."""
    data = bytearray()
    for number in numbers:
        z = 2 * number if number >= 0 else -2 * number - 1
        while z >= 128:
            data.append(128 + z % 128)
            z //= 128
        data.append(z)
    return base64.b85encode(zlib.compress(bytes(data), 9)).decode()


def listed(columns: Sequence[Sequence[Run]]) -> str:
    """Return the text of columns."""
    heads = [n for column in columns for run in column for n in _head(run)]
    deltas = np.concatenate([_deltas(column) for column in columns])
    return written([len(columns), *heads, *deltas.T.ravel().tolist()])


def _head(run: Run) -> list[int]:
    return [4 * len(run.edges) + run.kind, *run.levels]


def _deltas(column: Sequence[Run]) -> Integers:
    """Return the coefficients of the edges, each less that of the edge before."""
    edges = [edge for run in column for edge in run.edges]
    return np.diff(np.array(edges), axis=0, prepend=0)


def runs(cover: Cover, j: int) -> list[Run]:
    """Return the runs of a column."""
    bottom, top = _edges(np.stack([cover.bottom[j], cover.top[j]]))
    found = [Run([bottom], [], BOTTOM)] if cover.has_bottom[j] else []
    own = slice(cover.start[j], cover.start[j + 1])
    lows, highs = _edges(cover.cells[own, :3]), _edges(cover.cells[own, 3:])
    for low, high, level in zip(lows, highs, cover.levels[own].tolist(), strict=True):
        if not (found and found[-1].edges[-1] == low):
            found.append(Run([low], [], 0))
        found[-1].edges.append(high)
        found[-1].levels.append(level)
    if found and found[-1].edges[-1] == top:
        last = found.pop()
        found.append(last._replace(kind=last.kind | TOP))
    else:
        found.append(Run([top], [], TOP))
    return found


def _edges(coefficients: Floats) -> list[Edge]:
    """Return edges, given by rows of coefficients (N, 3)."""
    return [(a, b, c) for a, b, c in np.rint(coefficients / UNIT).astype(np.int64).tolist()]
