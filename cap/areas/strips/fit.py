"""Compiled, in doubles: cells of a level, between the cells of lower levels.

It steers; nothing rests on it.  In a gap of a column, launches that fly into cells of one link are
a strip; it is followed through the column, and bounded by two parabolas.  If what lies between them
does not hold as one cell, it is halved.
"""

import math
from typing import NamedTuple

from cap.areas.strips.cover import (
    NO_LINK,
    Cover,
    Floats,
    Integers,
    holds,
    link,
    same,
    time,
)
from cap.areas.strips.ends import CLOSE, Begin, Gap, bounds, end_of, followed, touches
from cap.sets.compiled import kernel, sources
from cap.sets.kept import kept

UNIT = 2.0**-24  # coefficients of edges are multiples of it
INWARD = 2e-7  # by which a cell is smaller than its strip at first
WIDER, TRIES = 5.0, 3


class Grain(NamedTuple):
    """How fine strips are looked for.

    The step in energy; their least width; how often they are halved; how many arcs are spent on one
    cell.
    """

    step: float
    thin: float
    halvings: int
    arcs: int


class Found(NamedTuple):
    """New cells of columns: ``number`` (C,), ``cells`` (C, K, 6)."""

    number: Integers
    cells: Floats


class Room(NamedTuple):
    """Room of a thread: ends of a strip (5, 2), its edges (6,), targets (C + 1, 3), 0 (3,)."""

    ends: Floats
    edges: Floats
    seen: Integers
    floor: Floats


class Wanted(NamedTuple):
    """Where cells are looked for: ``number`` (C,) intervals of energies, ``ends`` (C, K, 2)."""

    number: Integers
    ends: Floats


class Search(NamedTuple):
    """What the cells of a level are looked for with."""

    cover: Cover
    new: Found
    wanted: Wanted
    level: int
    grain: Grain
    room: Room


@kernel
def _rounded(x: float) -> float:
    return math.floor(x / UNIT + 0.5) * UNIT


@kernel
def _copy(p: Floats, q: Floats) -> None:
    for k in range(3):
        q[k] = p[k]


@kernel
def through(z: Floats, p: Floats, inward: float) -> None:
    """Write the parabola through values at -1, 0, 1, moved by more than it errs at -1/2, 1/2."""
    a, b, c = z[2], 0.5 * (z[4] - z[0]), 0.5 * (z[4] + z[0]) - z[2]
    sign = 1.0 if inward > 0 else -1.0
    one, two = z[1] - (a - 0.5 * b + 0.25 * c), z[3] - (a + 0.5 * b + 0.25 * c)
    miss = max(sign * one, sign * two, 0.0)
    p[0], p[1], p[2] = _rounded(a + inward + sign * 1.2 * miss), _rounded(b), _rounded(c)


@kernel
def above(p: Floats, q: Floats) -> bool:
    """Return whether the edge q is certainly above p."""
    a, b, c = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    apart = abs(b) >= 2 * c or 4 * a * c > b * b * (1 + 1e-9)
    return bool(a + c - abs(b) > 2 * UNIT and a > 2 * UNIT and apart)


@kernel
def _apart(p: Floats, q: Floats) -> bool:
    """Return whether the edge q is p, or certainly above it."""
    return same(p, q) or above(p, q)


@kernel
def _holds(search: Search, j: int, p: Floats) -> bool:
    return holds(search.cover, j, search.level, p, search.room.seen, search.grain.arcs) > 0


@kernel
def _cut(search: Search, j: int, gap: Gap) -> float:
    """Add the cells into which what lies between two edges, in a gap, can be cut; return which part
    of it they are.
    """
    new, grain, room = search.new, search.grain, search.room
    most, edges = 1 << grain.halvings, room.edges
    depth, k, total, cells = 0, 0, 0, new.cells[j]
    width, low = edges[3] - edges[0], gap.low
    while True:
        size, m = most >> depth, new.number[j]
        if m == len(cells):
            return total / most
        p, n = cells[m], k * size
        for q in range(3):
            p[q] = _rounded(edges[q] + (edges[3 + q] - edges[q]) * n / most)
            p[3 + q] = _rounded(edges[q] + (edges[3 + q] - edges[q]) * (n + size) / most)
        good = _apart(low, p[:3]) and above(p[:3], p[3:]) and _apart(p[3:], gap.high)
        if good and _holds(search, j, p):
            low = p[3:]
            total += size
            new.number[j] += 1
        elif depth < grain.halvings and width * size > grain.thin * most:
            depth, k = depth + 1, 2 * k
            continue
        k += 1
        while depth > 0 and k % 2 == 0:
            k, depth = k // 2, depth - 1
        if depth == 0:
            return total / most


@kernel
def _bounded(gap: Gap, inward: float, room: Room) -> bool:
    """Write the edges of a strip; return whether they lie within the gap."""
    ends, edges = room.ends, room.edges
    if touches(ends, gap, 0):
        _copy(gap.low, edges[:3])
    else:
        through(ends[:, 0], edges[:3], inward)
        if not above(gap.low, edges[:3]):
            return False
    if touches(ends, gap, 1):
        _copy(gap.high, edges[3:6])
    else:
        through(ends[:, 1], edges[3:6], -inward)
        if not above(edges[3:6], gap.high):
            return False
    return above(edges[:3], edges[3:6])


@kernel
def _fitted(search: Search, j: int, gap: Gap) -> None:
    """Add the cells of a strip, whose ends are known."""
    new, room = search.new, search.room
    first, best, kept_at, inward = new.number[j], 0.0, INWARD, INWARD
    width = room.ends[2, 1] - room.ends[2, 0]
    for _ in range(TRIES):
        if inward > 0.3 * width:
            break
        new.number[j] = first
        if _bounded(gap, inward, room):
            share = _cut(search, j, gap)
            if share == 1:
                return
            if share * (width - 2 * inward) > best:
                best, kept_at = share * (width - 2 * inward), inward
        inward *= WIDER
    new.number[j] = first
    if best > 0 and _bounded(gap, kept_at, room):
        _cut(search, j, gap)


@kernel
def _next(wanted: Wanted, j: int, E: float) -> float:
    """Return the least energy from E on at which cells are looked for."""
    for k in range(wanted.number[j]):
        if wanted.ends[j, k, 1] > E:
            return max(E, float(wanted.ends[j, k, 0]))
    return math.inf


@kernel
def _gap(cover: Cover, j: int, i: int, room: Room) -> Gap:
    """Return the gap below a cell of a column, or below the top."""
    low = room.floor
    if i > cover.start[j]:
        low = cover.cells[i - 1, 3:]
    elif cover.has_bottom[j]:
        low = cover.bottom[j]
    return Gap(low, cover.cells[i, :3] if i < cover.start[j + 1] else cover.top[j])


@kernel
def _column(search: Search, j: int) -> None:
    """Find the cells of a column."""
    cover, new, wanted, grain, room = (
        search.cover,
        search.new,
        search.wanted,
        search.grain,
        search.room,
    )
    t, ends, T = time(cover.lines, j, 0.0), room.ends, math.inf
    new.number[j] = 0
    for i in range(cover.start[j], cover.start[j + 1] + 1):
        gap = _gap(cover, j, i, room)
        if same(gap.low, gap.high):
            continue
        bottom, top = bounds(gap, 0.0)
        E = _next(wanted, j, bottom + min(0.5 * grain.step, 0.5 * (top - bottom)))
        while top > E:
            to, T = link(cover, t, E, T)
            if to == NO_LINK:
                E = _next(wanted, j, E + grain.step)
                continue
            lower = end_of(cover, Begin(t, E, T), to, -0.5 * grain.step, (bottom, CLOSE))
            upper = end_of(cover, Begin(t, E, T), to, 0.5 * grain.step, (top, CLOSE))
            if upper - lower > grain.thin:
                ends[2, 0], ends[2, 1] = lower, upper
                before = new.number[j]
                if followed(cover, j, gap, to, ends):
                    _fitted(search, j, gap)
                if new.number[j] > before:
                    gap = Gap(new.cells[j, new.number[j] - 1, 3:], gap.high)
                    bottom, top = bounds(gap, 0.0)
            E = _next(wanted, j, max(E, upper) + grain.step)


def _fit(search: Search, columns: Integers) -> None:
    """Find the cells of a level in some columns, those of lower levels being known."""
    for j in columns:
        _column(search, j)


fit = kept(_fit, sources(), error_model="numpy")
