"""Strips of launches that end alike, in both directions of time, cut into cells flight by flight.

It steers, in doubles: what comes out is to be proved.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np

from cap.cells.causes import Chance, trace
from cap.cells.cover import NEITHER, Cover, Floats, Integers
from cap.cells.fit import Found, Grain, Room, Search, Wanted, fit
from cap.cells.links import link
from cap.cells.margins import begin
from cap.cells.worth import choose, want, weigh
from cap.runner import Runner

GRAIN = Grain(step=3e-5, thin=6e-6, halvings=4, arcs=60)
FIRST = 1e-3  # strips of level k are looked for by steps of at least FIRST/2^k
MARGIN = 7e-4  # so near what the other family leaves cells are looked for
MOST = 250  # new cells of a column; energies that are looked for
GAPS = 8000  # of a column
FEW = 20  # cells of a column cost as much as so many more

Family = tuple[Cover, Cover]


class New(NamedTuple):
    """The number (C,) of new cells of each column, and these cells (N, 6)."""

    number: Integers
    cells: Floats


@dataclass(frozen=True)
class World:
    """Flights against the friction f over R; the ceiling E + a cos(t - b) = c; lines of columns."""

    f: float
    R: float
    a: float
    b: float
    c: float
    lines: tuple[float, ...]

    @property
    def mirrored(self) -> World:
        """The world of backward orbits."""
        lines = tuple(-t for t in reversed(self.lines))
        return replace(self, f=-self.f, b=-self.b, lines=lines)

    def cut(self, parts: Integers) -> World:
        """The same with narrower columns."""
        widths = np.repeat(np.diff(self.lines) / parts, parts)
        return replace(
            self, lines=tuple((self.lines[0] + np.append(0, np.cumsum(widths))).tolist())
        )

    def cover(self) -> Cover:
        """Return columns without cells, but with what is above the ceiling and stops at once."""
        C = len(self.lines) - 1
        none, edges = np.zeros(0, np.int64), np.zeros((C, 3))
        cover = Cover(
            np.array(self.lines),
            np.array([self.f, self.R, self.a, self.b, self.c]),
            np.zeros(C + 1, np.int64),
            np.zeros((0, 6)),
            none,
            none,
            edges,
            edges.copy(),
            np.zeros(C, np.bool_),
            np.zeros(C, np.int64),
        )
        begin(cover, np.zeros(5))
        return cover


def grown(family: Family, level: int, grain: Grain, runner: Runner) -> New:
    """Find the cells of one more level of the first columns, near what the second ones leave."""
    cover, other = family
    C = len(cover.top)
    link(cover, np.zeros(1 + C + len(cover.cells), np.int64))
    wanted = Wanted(np.zeros(C, np.int64), np.zeros((C, MOST, 2)))
    want(other, MARGIN, wanted, np.zeros((GAPS, 2)), np.zeros((GAPS, 2)))
    new = Found(np.zeros(C, np.int64), np.zeros((C, MOST, 6)))
    parts = [np.arange(k, C, 8) for k in range(8)]
    quiet = Runner(runner.jobs, whole=True)
    grain = grain._replace(step=max(grain.step, FIRST / 2**level))
    quiet.map(partial(_fitted, cover, new, wanted, (level, grain)), parts, "")
    return New(new.number, np.concatenate([new.cells[j, :n] for j, n in enumerate(new.number)]))


def _fitted(
    cover: Cover, new: Found, wanted: Wanted, how: tuple[int, Grain], columns: Integers
) -> None:
    room = Room(np.zeros((5, 2)), np.zeros(6), _seen(cover), np.zeros(3))
    fit(Search(cover, new, wanted, *how, room), columns)


def _seen(cover: Cover) -> Integers:
    """Return room for targets, none of which is chosen."""
    seen = np.full((len(cover.top) + 1, 3), NEITHER, np.int64)
    seen[-1, 0] = 0
    return seen


def columns_of(cover: Cover) -> Integers:
    """Return the columns of the cells."""
    return np.repeat(np.arange(len(cover.top)), np.diff(cover.start))


def joined(cover: Cover, new: New, level: int) -> Cover:
    """Return columns with new cells."""
    own = np.concatenate([columns_of(cover), np.repeat(np.arange(len(cover.top)), new.number)])
    cells = np.concatenate([cover.cells, new.cells])
    levels = np.append(cover.levels, np.full(len(new.cells), level))
    order = np.lexsort((cells[:, 0], own))
    return cover._replace(
        start=_starts(own, len(cover.top)),
        cells=cells[order],
        levels=levels[order],
        links=np.zeros(len(order), np.int64),
    )


def _starts(own: Integers, C: int) -> Integers:
    return np.append(0, np.cumsum(np.bincount(own, minlength=C)))


def worthy(family: Family, least: float) -> Family:
    """Return the cells that take away at least so much area of what the others leave.

    What is taken away by cells that fly into a cell, is taken away by it, too.
    """
    one, two = family
    one = _chosen(one, two, least)
    return one, _chosen(two, one, least)


def _chosen(cover: Cover, other: Cover, least: float) -> Cover:
    worth, own = np.zeros(len(cover.cells)), columns_of(cover)
    weigh(cover, other, worth, np.zeros((GAPS, 2)))
    order = np.argsort(-cover.levels, kind="stable")
    choose(cover, least, order, own, worth, _seen(cover))
    return kept(cover, worth >= least)


def kept(cover: Cover, which: np.ndarray) -> Cover:
    """Return columns with some of their cells."""
    own = columns_of(cover)[which]
    return cover._replace(
        start=_starts(own, len(cover.top)),
        cells=cover.cells[which],
        levels=cover.levels[which],
        links=cover.links[which],
    )


def lines(ends: tuple[float, float], width: Fraction) -> tuple[float, ...]:
    """Return lines from one time to another."""
    first, last = math.floor(ends[0] / width), math.ceil(ends[1] / width)
    return tuple(float(k * width) for k in range(first, last + 1))


def lossy(family: Family, flights: int, least: float, finest: float) -> Integers:
    """Return into how many parts columns should be cut: 1, 2 or 4.

    That depends on what was lost there, for each cell of the column; ``finest`` is the width of the
    narrowest columns.
    """
    one, two = family
    lost, width = np.zeros(len(one.top)), np.diff(one.lines)
    trace(family, Chance(np.zeros((GAPS, 2)), np.zeros((GAPS, 2)), flights), lost)
    share = lost / (np.diff(one.start) + np.diff(two.start)[::-1] + FEW)
    parts = np.ones(len(lost), np.int64)
    for k in (1, 2):
        parts[(share > least * k * k) & (width > 1.5 * k * finest)] = 2 * k
    return parts


def window(a: float, b: float, c: float) -> tuple[float, float]:
    """Return between which times E + a cos(t - b) = c has E >= 0."""
    rest = math.acos(c / a)
    return b + rest, b + 2 * math.pi - rest
