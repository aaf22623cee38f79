"""Strips of launches that end alike: found column by column, and cut into cells level by level.

It steers, in doubles: what comes out is to be proved.
"""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np

from cap.cells.fates import Floats, Integers, column
from cap.cells.fit import PIECES, Columns, Frame, fit
from cap.cells.listing import Edge, Run, edge, runs
from cap.runner import Plan, Runner

MOST = 4000  # strips in a column
STEP = 5e-5  # energies are tried so far apart
THICK = 1e-5  # strips thinner than this are left out

Check = Callable[[list[list[Run]], list[int], int], list[tuple[int, Edge, Edge]]]
"""Given the runs of all columns, some columns, and a level: the cells of it that do not hold."""


@dataclass(frozen=True)
class World:
    """Flights against the friction f over R; the ceiling E + a cos(t - b) = c; lines of columns.

    Launches are followed for so many ``flights``.
    """

    f: float
    R: float
    a: float
    b: float
    c: float
    lines: tuple[float, ...]
    flights: int

    @property
    def numbers(self) -> Floats:
        """What compiled code takes."""
        return np.array([self.f, self.R, self.a, self.b, self.c, self.flights])

    @property
    def mirrored(self) -> World:
        """The world of backward orbits."""
        lines = tuple(-t for t in reversed(self.lines))
        return replace(self, f=-self.f, b=-self.b, lines=lines)


class Strips(NamedTuple):
    """The strips of a column: fates (N,) and ends (N, 5, 2)."""

    fates: Integers
    ends: Floats


def strips(world: World, j: int) -> Strips:
    """Find the strips of a column in which launches end within so many flights."""
    low, high = world.lines[j], world.lines[j + 1]
    fates, ends = np.zeros(MOST, np.int64), np.zeros((MOST, 5, 2))
    middle, half = (low + high) / 2, (high - low) / 2
    found = column(middle, half, world.numbers, np.array([STEP, THICK]), fates, ends)
    return Strips(fates[:found].copy(), ends[:found].copy())


def all_strips(world: World, runner: Runner) -> Columns:
    """Find the strips of all columns."""
    count = len(world.lines) - 1
    key = f"strips {world} {STEP} {THICK}"
    plan = Plan[int, Strips](key, encode=_text, decode=_strips, total=count, words="strips")
    found = dict(runner.run(partial(strips, world), range(count), plan))
    return together([found[j] for j in range(count)])


def _text(found: Strips) -> str:
    buffer = io.BytesIO()
    np.savez(buffer, *found)
    return base64.b64encode(buffer.getvalue()).decode()


def _strips(text: str) -> Strips:
    with np.load(io.BytesIO(base64.b64decode(text))) as arrays:
        return Strips(*(arrays[name] for name in arrays.files))


def together(found: Sequence[Strips]) -> Columns:
    """Return the strips of all columns in arrays, without cells."""
    C, N = len(found), 1 + max(len(each.fates) for each in found)
    columns = Columns(
        np.array([len(each.fates) for each in found]),
        np.zeros((C, N), np.int64),
        np.zeros((C, N, 5, 2)),
        np.full((C, N), -1),
        np.zeros((C, N, 6)),
        np.zeros((C, 3)),
        np.zeros((C, 3)),
        np.zeros((C, N, PIECES), np.int8),
    )
    for j, each in enumerate(found):
        columns.fates[j, : len(each.fates)], columns.ends[j, : len(each.fates)] = each
    return columns


def cut(world: World, columns: Columns, check: Check) -> list[list[Run]]:
    """Cut strips into cells, level by level; those that do not hold are halved, or left out."""
    every = range(len(columns.number))
    room = np.empty(len(every), np.int64), np.empty(PIECES, np.int8)
    frame = Frame(np.array(world.lines), world.numbers, *room)
    for level in range(world.flights + 1):
        fit(columns, frame, level)
        wanted = [j for j in every if level == 0 or (columns.level[j] == level).any()]
        while wanted:
            bad = check([runs(columns, j) for j in every], wanted, level)
            for j, low, high in bad:
                _halve(columns, j, level, low, high)
            wanted = sorted({j for j, *_ in bad})
    return [runs(columns, j) for j in every]


def _halve(columns: Columns, j: int, level: int, low: Edge, high: Edge) -> None:
    """Halve a cell, given by its edges, or take it back if it is one piece."""
    if level == 0:
        columns.bottom[j, 0] = -1.0
    for i in np.flatnonzero(columns.level[j] == level).tolist():
        for m in np.flatnonzero(columns.held[j, i]).tolist():
            size = int(columns.held[j, i, m])
            if (edge(columns, j, i, m), edge(columns, j, i, m + size)) == (low, high):
                columns.held[j, i, m] = size // 2
                if size > 1:
                    columns.held[j, i, m + size // 2] = size // 2


def even(a: Fraction, b: Fraction, c: Fraction, width: Fraction) -> tuple[float, ...]:
    """Return lines so far apart, around the times at which E + a cos(t - b) = c has E >= 0."""
    rest = math.acos(float(c / a))
    first = math.floor((float(b) + rest) / width)
    last = math.ceil((float(b) + 2 * math.pi - rest) / width)
    return tuple(float(j * width) for j in range(first, last + 1))
