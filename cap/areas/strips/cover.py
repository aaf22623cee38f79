"""Compiled, in doubles: columns of cells, and whether other cells fly into them.

It steers; `cap.checker.strips.strips` says what is to be shown, and does it in intervals.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.strips.arcs import ROOM, Arc, Image, image, part
from cap.areas.strips.hits import TURN, fly
from cap.areas.strips.landing import Place, aim, beyond, placed
from cap.sets.compiled import kernel

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

SLACK = 1e-7  # by which launches that are looked up lie inside a cell
HALVINGS = 6  # of arcs
ROUND = 6.28  # images are in this time after the first line
BOTTOM, TOP, NEITHER = -3, -2, -1  # instead of the number of a cell
NO_LINK = -1


class Cover(NamedTuple):
    """Cells of the columns between lines.

    ``y``: f, R, a, b, c.  Cells ``start[j]`` to ``start[j + 1]`` are those of column j, from the
    lowest to the highest: ``cells`` (N, 6) a lower and an upper edge, ``levels`` and ``links``
    (N,): cells that touch each other, also over a line, have one link.  ``top`` and ``bottom`` (C,
    3): edges; ``has_bottom`` and ``under`` (C,): whether there is one, and its link; 0 is that of
    all tops.
    """

    lines: Floats
    y: Floats
    start: Integers
    cells: Floats
    levels: Integers
    links: Integers
    top: Floats
    bottom: Floats
    has_bottom: NDArray[np.bool_]
    under: Integers


@kernel
def at(p: Floats, s: float) -> float:
    """Return the energy of an edge."""
    return float(p[0] + s * (p[1] + s * p[2]))


@kernel
def time(lines: Floats, j: int, s: float) -> float:
    """Return the time at a place in a column."""
    return float(0.5 * (lines[j] * (1 - s) + lines[j + 1] * (1 + s)))


@kernel
def below(cover: Cover, j: int, s: float, E: float) -> int:
    """Return the highest cell of a column whose lower edge is not above a launch, or one less."""
    low, high = cover.start[j] - 1, cover.start[j + 1]
    while high - low > 1:
        middle = (low + high) // 2
        if at(cover.cells[middle, :3], s) <= E:
            low = middle
        else:
            high = middle
    return int(low)


@kernel
def found(cover: Cover, j: int, s: float, E: float, slack: float) -> int:
    """Return the cell of a column that has a launch: a number, `TOP`, `BOTTOM` or `NEITHER`."""
    if at(cover.top[j], s) + slack <= E:
        return TOP
    if cover.has_bottom[j] and at(cover.bottom[j], s) - slack >= E:
        return BOTTOM
    i = below(cover, j, s, E)
    if i >= cover.start[j]:
        p = cover.cells[i]
        if at(p[:3], s) + slack <= E <= at(p[3:], s) - slack:
            return i
    return NEITHER


@kernel
def _flown(y: Floats, t: float, E: float, near: float) -> tuple[float, float]:
    """Return when and how fast a launch hits, as `fly` does."""
    return fly(t, math.sqrt(2 * E), y[0], y[1], near) if E > 0 else (near, 0.0)


@kernel
def landed(lines: Floats, T: float, V: float) -> tuple[int, float, float]:
    """Return the column in which a launch lands, where, and its energy; -1: it stops; -2: none.

    It hits at the time T with the speed V.
    """
    if V <= 0:
        return -1, 0.0, 0.0
    t = lines[0] + (T + math.pi - lines[0]) % TURN
    if t >= lines[-1]:
        return -2, 0.0, 0.0
    j = int(np.searchsorted(lines, t, "right")) - 1
    return j, 2 * (t - lines[j]) / (lines[j + 1] - lines[j]) - 1, 0.5 * V * V


@kernel
def place(cover: Cover, t: float, E: float) -> tuple[int, float, float]:
    """Return where a launch lands."""
    T, V = _flown(cover.y, t, E, math.inf)
    return landed(cover.lines, T, V)


@kernel
def link(cover: Cover, t: float, E: float, near: float) -> tuple[int, float]:
    """Return the link of the cell into which a launch flies, or `NO_LINK`, and when it hits.

    It is found sooner if it hits ``near`` a time.
    """
    T, V = _flown(cover.y, t, E, near)
    j, s, E = landed(cover.lines, T, V)
    if j < 0:
        return 0 if j == -2 else NO_LINK, T
    i = found(cover, j, s, E, SLACK)
    if i == TOP:
        return 0, T
    if i == BOTTOM:
        return int(cover.under[j]), T
    return NO_LINK if i == NEITHER else int(cover.links[i]), T


@kernel
def same(p: Floats, q: Floats) -> bool:
    """Return whether two edges are one."""
    return bool(p[0] == q[0] and p[1] == q[1] and p[2] == q[2])


@kernel
def _start(cover: Cover, j: int, level: int, s: float, E: float) -> int:
    """Return the cell of lower level of a column in which a launch is."""
    if at(cover.top[j], s) <= E:
        return TOP
    if cover.has_bottom[j] and at(cover.bottom[j], s) > E:
        return BOTTOM
    i = below(cover, j, s, E)
    if i < cover.start[j] or not at(cover.cells[i, 3:], s) > E or cover.levels[i] >= level:
        return NEITHER
    return i


@kernel
def target(cover: Cover, j: int, level: int, s: float, E: float) -> tuple[int, int]:
    """Return the ends of the run of cells of lower levels of a column in which a launch is."""
    cells, levels, first, end = cover.cells, cover.levels, cover.start[j], cover.start[j + 1]
    low = high = _start(cover, j, level, s, E)
    if low == NEITHER:
        return low, high
    while low != BOTTOM:
        edge = cover.top[j] if low == TOP else cells[low, :3]
        under = end - 1 if low == TOP else low - 1
        if under >= first and levels[under] < level and same(cells[under, 3:], edge):
            low = under
        elif under < first and cover.has_bottom[j] and same(cover.bottom[j], edge):
            low = BOTTOM
        else:
            break
    while high != TOP:
        edge = cover.bottom[j] if high == BOTTOM else cells[high, 3:]
        over = first if high == BOTTOM else high + 1
        if over < end and levels[over] < level and same(cells[over, :3], edge):
            high = over
        elif over == end and same(cover.top[j], edge):
            high = TOP
        else:
            break
    return low, high


@kernel
def _within(cover: Cover, picture: Image, j: int, run: tuple[int, int], place: Place) -> bool:
    """Return whether the part of an image in a column is in a run."""
    low, high = run
    if low != BOTTOM:
        p = cover.top[j] if low == TOP else cover.cells[low, :3]
        if not beyond(picture, p, place, 1.0):
            return False
    if high != TOP:
        p = cover.bottom[j] if high == BOTTOM else cover.cells[high, 3:]
        return beyond(picture, p, place, -1.0)
    return True


@kernel
def _clear(seen: Integers, size: int) -> None:
    """Forget all targets but the first ones."""
    last = len(seen) - 1
    while seen[last, 0] > size:
        seen[last, 0] -= 1
        seen[seen[seen[last, 0], 2], 0] = NEITHER


@kernel
def _lands(cover: Cover, arc: Arc, level: int, seen: Integers) -> bool:
    """Return whether an arc flies to the targets ``seen`` (C + 1, 3), which it may add to.

    The last row begins with the number of columns that have one; last entries are these columns.
    """
    lines = cover.lines
    picture = image(arc, cover.y[0], cover.y[1])
    if not picture.hits:
        return False
    begin = lines[0]
    t = picture.T + math.pi - TURN * math.floor((picture.T + math.pi - begin) / TURN)
    wide = abs(picture.T1) + 0.5 * (abs(picture.T2.mid) + picture.T2.rad) + ROOM
    if not (begin <= t - wide and t + wide < begin + ROUND):
        return False
    last = len(seen) - 1
    before = seen[last, 0]
    for j in range(max(0, np.searchsorted(lines, t - wide) - 1), last):
        if lines[j] > t + wide:
            break
        place = placed(picture, t, lines[j], lines[j + 1])
        if place.last < place.first:
            continue
        if seen[j, 0] == NEITHER:
            low, high = target(cover, j, level, *aim(picture, place))
            if low == NEITHER:
                _clear(seen, before)
                return False
            seen[j, 0], seen[j, 1], seen[seen[last, 0], 2] = low, high, j
            seen[last, 0] += 1
        if not _within(cover, picture, j, (seen[j, 0], seen[j, 1]), place):
            _clear(seen, before)
            return False
    return True


@kernel
def _along(cover: Cover, arc: Arc, level: int, seen: Integers, most: int) -> int:
    """Return how many arcs are looked at until all of this one lands; above ``most``: it fails."""
    count, depth, k = 0, 0, 0  # the part k of 2^depth
    while True:
        count += 1
        if count > most:
            return count
        if _lands(cover, part(arc, 2.0**-depth, k), level, seen):
            k += 1
            while depth > 0 and k % 2 == 0:
                k, depth = k // 2, depth - 1
            if depth == 0:
                return count
        elif depth == HALVINGS:
            return most + 1
        else:
            k, depth = 2 * k, depth + 1


@kernel
def holds(cover: Cover, j: int, level: int, p: Floats, seen: Integers, most: int) -> int:
    """Return how many arcs are looked at until all of the boundary of a cell lands, or 0.

    ``seen`` then tells in which cells.
    """
    begin, end = cover.lines[j], cover.lines[j + 1]
    middle, half, count = 0.5 * (begin + end), 0.5 * (end - begin), 0
    _clear(seen, 0)
    for k in range(4):
        if k < 2:
            arc = Arc(middle, half, p[3 * k], p[3 * k + 1], p[3 * k + 2])
        else:
            s, t = (-1.0, begin) if k == 2 else (1.0, end)
            e, E = at(p[:3], s), at(p[3:], s)
            arc = Arc(t, 0.0, 0.5 * (e + E), 0.5 * (E - e), 0.0)
        count += _along(cover, arc, level, seen, most - count)
        if count > most:
            return 0
    return count
