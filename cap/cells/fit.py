"""Compiled, in doubles: strips of launches that end alike, as cells between two parabolas.

It steers; nothing rests on it.  A cell of level k lies in a column of times; all its launches fly
to the other wall, and into cells of level k - 1 there.  See `cap.cells.fates`.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.cells.fates import NODES, Floats, Integers, fly
from cap.sets.compiled import kernel
from cap.sets.kept import kept

UNIT = 2.0**-28  # edges are multiples of it
SLACK = 1e-7  # by which images lie inside
FIRST = 3e-7  # by which the first cell tried is smaller than its strip
WIDER, TRIES = 4.0, 5
PIECES = 16  # of a strip, at most
THIN = 4e-6  # pieces are not thinner
SAMPLES = 9  # of an edge, and of a side


class Columns(NamedTuple):
    """Strips and cells of the columns between lines.

    ``number`` (C,) of strips, their ``fates`` (C, N) and ``ends`` (C, N, 5, 2).  Of cells
    ``level`` (C, N), -1 where there is none, and ``held`` (C, N, PIECES): at the first of the
    pieces that a cell consists of, how many they are.  ``edges`` (C, N, 6): the parabolas that
    bound all pieces; ``top`` (C, 3), one above the ceiling; ``bottom`` (C, 3), one below which all
    launches stop, at -1 if there is none.
    """

    number: Integers
    fates: Integers
    ends: Floats
    level: Integers
    edges: Floats
    top: Floats
    bottom: Floats
    held: NDArray[np.int8]


class Frame(NamedTuple):
    """The lines between columns, y = f, R, a, b, c, n, and room for targets and cuts of a cell."""

    lines: Floats
    y: Floats
    seen: Integers
    cuts: NDArray[np.int8]


@kernel
def _at(a: float, b: float, c: float, s: float) -> float:
    return a + s * (b + s * c)


@kernel
def _through(z: Floats, p: Floats, inward: float) -> None:
    """Write the parabola through values at -1, 0, 1, moved by more than it errs at -1/2, 1/2."""
    a, b, c = z[2], 0.5 * (z[4] - z[0]), 0.5 * (z[4] + z[0]) - z[2]
    sign = 1.0 if inward > 0 else -1.0
    miss = max(sign * (z[1] - _at(a, b, c, -0.5)), sign * (z[3] - _at(a, b, c, 0.5)), 0.0)
    p[0] = math.floor((a + inward + sign * 1.2 * miss) / UNIT) * UNIT
    p[1], p[2] = math.floor(b / UNIT) * UNIT, math.floor(c / UNIT) * UNIT


@kernel
def _time(lines: Floats, j: int, s: float) -> float:
    return float(0.5 * (lines[j] * (1 - s) + lines[j + 1] * (1 + s)))


@kernel
def _edge(columns: Columns, j: int, i: int, m: int, s: float) -> float:
    """Return an edge of a piece of a strip: between its lower and its upper parabola."""
    p, E, power = columns.edges[j, i], 0.0, 1.0
    for k in range(3):
        E += power * round((p[k] + (p[3 + k] - p[k]) * m / PIECES) / UNIT) * UNIT
        power *= s
    return float(E)


@kernel
def _run(columns: Columns, j: int, i: int, s: float, E: float) -> int:
    """Return the first piece of the run of pieces in which E is, or -1."""
    held, m = columns.held[j, i], 0
    while m < PIECES:
        first = m
        while m < PIECES and held[m] > 0:
            m += held[m]
        if m == first:
            m += 1
        elif _edge(columns, j, i, first, s) + SLACK <= E <= _edge(columns, j, i, m, s) - SLACK:
            return first
    return -1


@kernel
def _target(columns: Columns, j: int, fate: int, s: float, E: float) -> int:
    """Return the run of pieces in which a launch lies; -1 if in none.

    -2: above the top; -3: below the bottom.
    """
    if fate == 0:
        top = columns.top[j]
        return -2 if _at(top[0], top[1], top[2], s) + SLACK <= E else -1
    if fate == -1:
        bottom = columns.bottom[j]
        return -3 if _at(bottom[0], bottom[1], bottom[2], s) - SLACK >= E else -1
    for i in range(columns.number[j]):
        if columns.level[j, i] >= 0 and columns.fates[j, i] == fate:
            first = _run(columns, j, i, s, E)
            if first >= 0:
                return i * PIECES + first
    return -1


@kernel
def _lands(columns: Columns, frame: Frame, t: float, E: float, fate: int) -> bool:
    """Return whether a launch lands where the others of its cell do, by column."""
    lines, y, seen = frame.lines, frame.y, frame.seen
    if E <= 0:
        return False
    T, V = fly(t, math.sqrt(2 * E), y[0], y[1])
    if V <= 0:
        return False
    t = lines[0] + (T + math.pi - lines[0]) % (2 * math.pi)
    if t >= lines[-1]:
        return True
    j = int(np.searchsorted(lines, t, "right")) - 1
    s = 2 * (t - lines[j]) / (lines[j + 1] - lines[j]) - 1
    to = _target(columns, j, fate - 1 if fate > 0 else fate + 1, s, 0.5 * V * V)
    if to == -1 or (seen[j] != -1 and seen[j] != to):
        return False
    seen[j] = to
    return True


@kernel
def _holds(columns: Columns, frame: Frame, j: int, i: int, m: int, size: int) -> bool:
    """Return whether samples of the boundary of a cell land in one run per column."""
    for k in range(len(frame.seen)):
        frame.seen[k] = -1
    fate = columns.fates[j, i]
    for k in range(SAMPLES):
        s = 2.0 * k / (SAMPLES - 1) - 1
        t = _time(frame.lines, j, s)
        low, high = _edge(columns, j, i, m, s), _edge(columns, j, i, m + size, s)
        if low + 8 * UNIT >= high:
            return False
        last = SAMPLES - 1
        step = 1 if k in (0, last) else last
        for q in range(0, SAMPLES, step):
            if not _lands(columns, frame, t, low + q * (high - low) / last, fate):
                return False
    return True


@kernel
def _pieces(columns: Columns, frame: Frame, j: int, i: int) -> int:
    """Find pieces of a strip that hold, the largest first; return how much of it they are."""
    width = columns.edges[j, i, 3] - columns.edges[j, i, 0]
    cuts = frame.cuts
    for m in range(PIECES):
        cuts[m] = 0
    total, size = 0, PIECES
    while size >= 1 and (size == PIECES or width * size > THIN * PIECES):
        for m in range(0, PIECES, size):
            taken = False
            for q in range(m + 1):
                if cuts[q] > 0 and m < q + cuts[q]:
                    taken = True
            if not taken and _holds(columns, frame, j, i, m, size):
                cuts[m] = size
                total += size
        if total == PIECES:
            break
        size //= 2
    return total


@kernel
def _cell(columns: Columns, frame: Frame, j: int, i: int) -> bool:
    """Find the cells in a strip, which are a little smaller than that."""
    ends, edges = columns.ends[j, i], columns.edges[j, i]
    width, inward = ends[2, 1] - ends[2, 0], FIRST
    best, kept_at = 0.0, 0.0
    for _ in range(TRIES):
        if inward > 0.3 * width:
            break
        _through(ends[:, 0], edges[:3], inward)
        _through(ends[:, 1], edges[3:], -inward)
        part = _pieces(columns, frame, j, i)
        if part * (width - 2 * inward) > best:
            best, kept_at = part * (width - 2 * inward), inward
            for m in range(PIECES):
                columns.held[j, i, m] = frame.cuts[m]
        if part == PIECES:
            break
        inward *= WIDER
    if best > 0:
        _through(ends[:, 0], edges[:3], kept_at)
        _through(ends[:, 1], edges[3:], -kept_at)
    return best > 0


@kernel
def _begin(columns: Columns, frame: Frame) -> None:
    """Forget all cells, and find tops and bottoms."""
    for j in range(len(columns.top)):
        for i in range(columns.number[j]):
            columns.level[j, i] = -1
            for m in range(PIECES):
                columns.held[j, i, m] = 0
        z = columns.ends[j, -1, :, 0]  # a row that is no strip's
        for k in range(5):
            z[k] = _ceiling(frame.y, _time(frame.lines, j, NODES[k]))
        _through(z, columns.top[j], 1e-7)
        _bottom(columns, frame, j)


@kernel
def _ceiling(y: Floats, t: float) -> float:
    return float(y[4] - y[2] * math.cos(t - y[3]))


@kernel
def _stops(y: Floats, t: float, E: float) -> bool:
    return _ceiling(y, t) - SLACK > E and (E <= 0 or fly(t, math.sqrt(2 * E), y[0], y[1])[1] <= 0)


@kernel
def _bottom(columns: Columns, frame: Frame, j: int) -> None:
    """Find an edge on which launches stop."""
    z, p = columns.ends[j, -1, :, 0], columns.bottom[j]
    for k in range(5):
        t, low = _time(frame.lines, j, NODES[k]), 0.0
        high = _ceiling(frame.y, t)
        for _ in range(50):
            middle = 0.5 * (low + high)
            if _stops(frame.y, t, middle):
                low = middle
            else:
                high = middle
        z[k] = low
    inward = FIRST
    for _ in range(12):
        _through(z, p, -inward)
        good = True
        for k in range(SAMPLES):
            s = 2.0 * k / (SAMPLES - 1) - 1
            E = _at(p[0], p[1], p[2], s)
            good = good and E > 0 and _stops(frame.y, _time(frame.lines, j, s), E)
        if good:
            return
        inward *= 3
    p[0], p[1], p[2] = -1.0, 0.0, 0.0


def _fit(columns: Columns, frame: Frame, level: int) -> None:
    """Find the cells of a level, those of lower levels being known; 0 is the first.

    The last row of the strips of each column is not one of them.
    """
    if level == 0:
        _begin(columns, frame)
    for j in range(len(columns.top)):
        for i in range(columns.number[j]):
            fate = columns.fates[j, i]
            if level > 0 and fate in (level, -1 - level) and _cell(columns, frame, j, i):
                columns.level[j, i] = level


fit = kept(_fit, error_model="numpy")
