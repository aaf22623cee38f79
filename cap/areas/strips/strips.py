"""Strips of launches that end alike, in both directions of time, cut into cells flight by flight.

It steers, in doubles: what comes out is to be proved.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeVar

import numpy as np

from cap.areas.strips.causes import Chance, trace
from cap.areas.strips.cover import NEITHER, Cover, Floats, Integers
from cap.areas.strips.fit import Found, Grain, Room, Search, Wanted, fit
from cap.areas.strips.links import link
from cap.areas.strips.margins import begin
from cap.areas.strips.worth import choose, want, weigh
from cap.runner import Runner

GRAIN = Grain(step=3e-5, thin=6e-6, halvings=4, arcs=60)
FIRST = 1e-3  # strips of level k are looked for by steps of at least FIRST/2^k
MARGIN = 7e-4  # so near what the other family leaves cells are looked for
MOST = 250  # new cells of a column; energies that are looked for
GAPS = 8000  # of a column
PARTS = 32  # in which columns are given to threads: none waits long for the last one
FEW = 20  # cells of a column cost as much as so many more

R = TypeVar("R")

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
    cover, _ = family
    C = len(cover.top)
    link(cover, np.zeros(1 + C + len(cover.cells), np.int64))
    wanted = Wanted(np.zeros(C, np.int64), np.zeros((C, MOST, 2)))
    new = Found(np.zeros(C, np.int64), np.zeros((C, MOST, 6)))
    grain = grain._replace(step=max(grain.step, FIRST / 2**level))
    _by_threads(partial(_fitted, family, new, wanted, (level, grain)), C, runner)
    return New(new.number, np.concatenate([new.cells[j, :n] for j, n in enumerate(new.number)]))


def _by_threads(function: Callable[[Integers], R], C: int, runner: Runner) -> list[R]:
    """Return what a function gives of parts of the columns; these do not depend on the threads."""
    parts = [np.arange(k, C, PARTS) for k in range(PARTS)]
    return Runner(runner.jobs, whole=True).map(function, parts, "")


def _fitted(
    family: Family, new: Found, wanted: Wanted, how: tuple[int, Grain], columns: Integers
) -> None:
    """Find the cells of some columns."""
    cover, other = family
    want(other, MARGIN, wanted, columns, _gaps())
    room = Room(np.zeros((5, 2)), np.zeros(6), _seen(cover), np.zeros(3))
    fit(Search(cover, new, wanted, *how, room), columns)


def _gaps() -> tuple[Floats, Floats]:
    """Return room for the gaps of two columns."""
    return np.zeros((GAPS, 2)), np.zeros((GAPS, 2))


def _seen(cover: Cover) -> Integers:
    """Return room for targets, none of which is chosen."""
    seen = np.full((len(cover.top) + 1, 3), NEITHER, np.int64)
    seen[-1, 0] = 0
    return seen


def columns_of(cover: Cover) -> Integers:
    """Return the columns of the cells."""
    return np.repeat(np.arange(len(cover.top)), np.diff(cover.start))


def joined(cover: Cover, new: New, level: int) -> Cover:
    """Return columns with new cells, which are in order, between the ones that they have."""
    start, more = cover.start, _starts(new.number)
    known, found = cover.cells[:, 0], new.cells[:, 0]
    ends = zip(pairwise(start), pairwise(more), strict=True)
    places = [a + np.searchsorted(known[a:b], found[c:d]) for (a, b), (c, d) in ends]
    cells = np.insert(cover.cells, np.concatenate(places), new.cells, axis=0)
    levels = np.insert(cover.levels, np.concatenate(places), level)
    links = np.zeros(len(cells), np.int64)
    return cover._replace(start=start + more, cells=cells, levels=levels, links=links)


def _starts(number: Integers) -> Integers:
    return np.append(0, np.cumsum(number))


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
        start=_starts(np.bincount(own, minlength=len(cover.top))),
        cells=cover.cells[which],
        levels=cover.levels[which],
        links=cover.links[which],
    )


def lines(ends: tuple[float, float], width: Fraction) -> tuple[float, ...]:
    """Return lines from one time to another."""
    first, last = math.floor(ends[0] / width), math.ceil(ends[1] / width)
    return tuple(float(k * width) for k in range(first, last + 1))


def lossy(family: Family, flights: int, least: float, finest: float, runner: Runner) -> Integers:
    """Return into how many parts columns should be cut: 1, 2 or 4.

    That depends on what was lost there, for each cell of the column; ``finest`` is the width of the
    narrowest columns.
    """
    one, two = family
    C, width = len(one.top), np.diff(one.lines)
    lost = sum(_by_threads(partial(_traced, family, flights), C, runner), np.zeros(C))
    share = lost / (np.diff(one.start) + np.diff(two.start)[::-1] + FEW)
    parts = np.ones(C, np.int64)
    for k in (1, 2):
        parts[(share > least * k * k) & (width > 1.5 * k * finest)] = 2 * k
    return parts


def _traced(family: Family, flights: int, columns: Integers) -> Floats:
    """Return how much of what is left in some columns was lost in each column."""
    lost = np.zeros(len(family[0].top))
    trace(family, Chance(*_gaps(), flights), columns, lost)
    return lost


def window(a: float, b: float, c: float) -> tuple[float, float]:
    """Return between which times E + a cos(t - b) = c has E >= 0."""
    rest = math.acos(c / a)
    return b + rest, b + 2 * math.pi - rest
