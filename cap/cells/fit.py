"""Compiled, in doubles: strips of launches that end alike, as cells between two parabolas.

It steers; nothing rests on it.  A cell of level k lies in a column of times; all its launches fly
to the other wall, and into cells of level k - 1 there.  See `cap.cells.fates`.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from cap.cells.fates import NODES, Floats, Integers, fly
from cap.sets.kept import kept

UNIT = 2.0**-28  # edges are multiples of it
SLACK = 1e-7  # by which images lie inside
FIRST = 3e-7  # by which the first cell tried is smaller than its strip
WIDER, TRIES = 4.0, 5
PIECES = 16  # of a strip, at most
NEAR = 1e-8  # strips that are nearer touch
THIN = 4e-6  # pieces are not thinner
SAMPLES = np.linspace(-1, 1, 9)

_kernel: Any = register_jitable(error_model="numpy")


class Columns(NamedTuple):
    """Strips and cells of the columns [start + j h, start + (j + 1) h].

    ``count`` (C,), ``fates`` (C, N), ``ends`` (C, N, 5, 2) of strips; of cells ``level`` (C, N), -1
    where there is none, ``edges`` (C, N, 6): the lower and the upper parabola; ``top`` (C, 3).
    """

    count: Integers
    fates: Integers
    ends: Floats
    level: Integers
    edges: Floats
    top: Floats
    held: NDArray[np.int8]
    linked: NDArray[np.bool_]


@_kernel
def _at(p: Floats, s: float) -> float:
    return p[0] + s * (p[1] + s * p[2])


@_kernel
def _through(z: Floats, p: Floats, inward: float) -> None:
    """Write the parabola through the values at -1, 0, 1, moved up by more than it errs at ±1/2."""
    p[0], p[1], p[2] = z[2], 0.5 * (z[4] - z[0]), 0.5 * (z[4] + z[0]) - z[2]
    sign = 1.0 if inward > 0 else -1.0
    miss = max(sign * (z[1] - _at(p, -0.5)), sign * (z[3] - _at(p, 0.5)), 0.0)
    p[0] += inward + sign * 1.2 * miss
    for k in range(3):
        p[k] = round(p[k] / UNIT) * UNIT


@_kernel
def _time(lines: Floats, j: int, s: float) -> float:
    return 0.5 * (lines[j] * (1 - s) + lines[j + 1] * (1 + s))


@_kernel
def _tops(columns: Columns, lines: Floats, y: Floats) -> None:
    """Write parabolas above the ceiling."""
    z = np.empty(5)
    for j in range(len(columns.top)):
        for i in range(5):
            z[i] = y[4] - y[2] * math.cos(_time(lines, j, NODES[i]) - y[3])
        _through(z, columns.top[j], 1e-7)


@_kernel
def _edge(columns: Columns, j: int, i: int, m: int, s: float) -> float:
    """Return an edge of a piece of a strip: between its lower and its upper parabola."""
    edges, E, power = columns.edges[j, i], 0.0, 1.0
    for k in range(3):
        E += power * round((edges[k] + (edges[3 + k] - edges[k]) * m / PIECES) / UNIT) * UNIT
        power *= s
    return E


@_kernel
def _first(columns: Columns, j: int, i: int, m: int) -> int:
    """Return where the run of pieces begins that goes up to the piece before m."""
    first = m
    while first > 0:
        q = first - 1
        while q > 0 and columns.held[j, i, q] == 0:
            q -= 1
        if columns.held[j, i, q] == 0 or q + columns.held[j, i, q] != first:
            break
        first = q
    return first


@_kernel
def _last(columns: Columns, j: int, i: int, m: int) -> int:
    """Return where the run of pieces ends that begins with m."""
    while m < PIECES and columns.held[j, i, m] > 0:
        m += columns.held[j, i, m]
    return m


@_kernel
def _target(columns: Columns, j: int, fate: int, level: int, s: float, E: float) -> int:
    """Return the run of pieces, of levels below ``level``, in which a launch lies; -1 if in none."""
    n = columns.count[j]
    i, first, m = n, 0, 0
    if fate < 0 or E < _at(columns.top[j], s):
        i = 0
        while i < n and not (
            0 <= columns.level[j, i] < level
            and (fate >= 0) == (columns.fates[j, i] >= 0)
            and _edge(columns, j, i, 0, s) <= E <= _edge(columns, j, i, PIECES, s)
        ):
            i += 1
        if i == n:
            return -1
        while m < PIECES:
            first = m
            m = _last(columns, j, i, m)
            if m > first and _edge(columns, j, i, first, s) <= E <= _edge(columns, j, i, m, s):
                break
            if m == first:
                m += 1
                first = m
        if m == first:
            return -1
    upper = i
    while upper < n and m == PIECES and columns.linked[j, upper]:
        upper, m = upper + 1, 0
        if upper < n:
            if not 0 <= columns.level[j, upper] < level:
                upper, m = upper - 1, PIECES
                break
            m = _last(columns, j, upper, 0)
    if upper < n and E > _edge(columns, j, upper, m, s) - SLACK:
        return -1
    while first == 0 and i > 0 and columns.linked[j, i - 1] and 0 <= columns.level[j, i - 1] < level:
        begin = _first(columns, j, i - 1, PIECES)
        if begin == PIECES:
            break
        i, first = i - 1, begin
    low = _edge(columns, j, i, first, s) if i < n else _at(columns.top[j], s)
    return i * PIECES + first if low + SLACK <= E else -1


@_kernel
def _lands(
    columns: Columns, t: float, E: float, fate: int, lines: Floats, y: Floats, seen: Integers
) -> bool:
    """Return whether a launch lands where the others of its cell do, by column (``seen``)."""
    if E <= 0:
        return False
    T, V = fly(t, math.sqrt(2 * E), y[0], y[1])
    if V <= 0:
        return False
    to = fate - 1 if fate > 0 else fate + 1
    t = lines[0] + (T + math.pi - lines[0]) % (2 * math.pi)
    if t >= lines[-1]:
        return True
    j = np.searchsorted(lines, t, "right") - 1
    s = 2 * (t - lines[j]) / (lines[j + 1] - lines[j]) - 1
    level = fate if fate > 0 else -1 - fate
    i = _target(columns, j, to, level, s, 0.5 * V * V)
    if i == -1 or (seen[j] != -1 and seen[j] != i):
        return False
    seen[j] = i
    return True


@_kernel
def _holds(
    columns: Columns, j: int, i: int, m: int, size: int, lines: Floats, y: Floats, seen: Integers
) -> bool:
    """Return whether samples of the boundary of a cell land in one run per column."""
    seen[:] = -1
    fate = columns.fates[j, i]
    for k in range(len(SAMPLES)):
        s = SAMPLES[k]
        low, high = _edge(columns, j, i, m, s), _edge(columns, j, i, m + size, s)
        if not low + 8 * UNIT < high:
            return False
        t = _time(lines, j, s)
        if not _lands(columns, t, low, fate, lines, y, seen):
            return False
        if not _lands(columns, t, high, fate, lines, y, seen):
            return False
        if k == 0 or k == len(SAMPLES) - 1:
            for q in range(1, 8):
                if not _lands(columns, t, low + q * (high - low) / 8, fate, lines, y, seen):
                    return False
    return True


@_kernel
def _pieces(
    columns: Columns, j: int, i: int, lines: Floats, y: Floats, seen: Integers, held: NDArray[np.int8]
) -> int:
    """Find pieces of a strip that hold, the largest first; return how much."""
    width = columns.edges[j, i, 3] - columns.edges[j, i, 0]
    held[:] = 0
    total, size = 0, PIECES
    while size >= 1 and (size == PIECES or width * size > THIN * PIECES):
        for m in range(0, PIECES, size):
            taken = False
            for q in range(PIECES):
                if held[q] > 0 and q <= m < q + held[q]:
                    taken = True
            if not taken and _holds(columns, j, i, m, size, lines, y, seen):
                held[m] = size
                total += size
        if total == PIECES:
            break
        size //= 2
    return total


@_kernel
def _join(columns: Columns, j: int, i: int) -> None:
    """Let a strip below the ceiling share edges with those beside it, of lower levels."""
    n, fate, ends, edges = columns.count[j], columns.fates[j, i], columns.ends, columns.edges
    if fate == 1 and i == n - 1:
        edges[j, i, 3:] = columns.top[j]
        columns.linked[j, i] = True
    if i + 1 < n and 0 <= columns.fates[j, i + 1] < fate and columns.held[j, i + 1, 0] > 0:
        if ends[j, i + 1, 2, 0] - ends[j, i, 2, 1] < NEAR:
            edges[j, i, 3:] = edges[j, i + 1, :3]
            columns.linked[j, i] = True
    if i > 0 and 0 <= columns.fates[j, i - 1] < fate and _first(columns, j, i - 1, PIECES) < PIECES:
        if ends[j, i, 2, 0] - ends[j, i - 1, 2, 1] < NEAR:
            edges[j, i, :3] = edges[j, i - 1, 3:]
            columns.linked[j, i - 1] = True


@_kernel
def _unjoin(columns: Columns, j: int, i: int) -> None:
    """Take back what is shared, where the pieces at the ends do not hold."""
    if columns.held[j, i, 0] == 0 and i > 0:
        columns.linked[j, i - 1] = False
    if _first(columns, j, i, PIECES) == PIECES:
        columns.linked[j, i] = False


@_kernel
def _cell(
    columns: Columns, j: int, i: int, lines: Floats, y: Floats, seen: Integers, held: NDArray[np.int8]
) -> bool:
    """Find the cells in a strip, a little smaller than that."""
    ends, edges = columns.ends[j, i], columns.edges[j, i]
    width, inward = ends[2, 1] - ends[2, 0], FIRST
    best, kept_at = 0.0, 0.0
    joins = columns.fates[j, i] > 0
    for attempt in range(TRIES + 1):
        if attempt == TRIES or inward > 0.3 * width:
            if best == 0:
                return False
            inward = kept_at
        _through(ends[:, 0], edges[:3], inward)
        _through(ends[:, 1], edges[3:], -inward)
        if joins:
            _join(columns, j, i)
        if inward == kept_at:
            return True
        total = _pieces(columns, j, i, lines, y, seen, held) * (width - 2 * inward)
        if total > best:
            best, kept_at = total, inward
            columns.held[j, i] = held
        if total == PIECES * (width - 2 * inward):
            return True
        inward *= WIDER
    return True


def _fit(columns: Columns, lines: Floats, y: Floats, level: int) -> None:
    """Find the cells of a level, those of lower levels being known; y: f, R, a, b, c.

    At level 0 what was there is forgotten.
    """
    if level == 0:
        _tops(columns, lines, y)
        columns.level[:] = -1
        columns.held[:] = 0
        columns.linked[:] = False
    seen = np.empty(len(columns.top), np.int64)
    held = np.zeros(PIECES, np.int8)
    for j in range(len(columns.top)):
        for i in range(columns.count[j]):
            fate = columns.fates[j, i]
            if (fate if fate >= 0 else -1 - fate) != level:
                continue
            if level == 0:
                _through(columns.ends[j, i, :, 1], columns.edges[j, i, 3:], -FIRST)
                columns.edges[j, i, 0] = -1.0
                columns.edges[j, i, 1:3] = 0.0
                columns.held[j, i, 0] = PIECES
                columns.level[j, i] = 0
            elif _cell(columns, j, i, lines, y, seen, held):
                columns.level[j, i] = level
                _unjoin(columns, j, i)


fit = kept(_fit, error_model="numpy")


@_kernel
def _gaps(columns: Columns, j: int, s: float, out: Floats) -> int:
    """Write the ends of the runs at s, and return twice their number."""
    n = 0
    for i in range(columns.count[j]):
        if columns.level[j, i] < 0:
            continue
        m = 0
        while m < PIECES:
            first = m
            while m < PIECES and columns.held[j, i, m] > 0:
                m += columns.held[j, i, m]
            if m > first:
                out[n], out[n + 1] = _edge(columns, j, i, first, s), _edge(columns, j, i, m, s)
                n += 2
            else:
                m += 1
    return n


def _kept_area(forward: Columns, backward: Columns, lines: Floats, samples: int) -> float:
    """Return about the area between the cells of both, columns of ``backward`` in reverse."""
    total = 0.0
    C = len(forward.top)
    one = np.empty(2 * PIECES * forward.fates.shape[1])
    two = np.empty(2 * PIECES * backward.fates.shape[1])
    for j in range(C):
        h = lines[j + 1] - lines[j]
        for m in range(samples):
            s = 2 * (m + 0.5) / samples - 1
            n1, n2 = _gaps(forward, j, s, one), _gaps(backward, C - 1 - j, -s, two)
            top = _at(forward.top[j], s)
            i1, i2, done = 0, 0, 0.0
            while done < top:
                while i1 < n1 and one[i1 + 1] <= done:
                    i1 += 2
                while i2 < n2 and two[i2 + 1] <= done:
                    i2 += 2
                l1 = one[i1] if i1 < n1 else top
                l2 = two[i2] if i2 < n2 else top
                if i1 < n1 and l1 <= done:
                    done = one[i1 + 1]
                elif i2 < n2 and l2 <= done:
                    done = two[i2 + 1]
                else:
                    new = min(l1, l2, top)
                    total += (new - done) * h / samples
                    done = new
    return total


kept_area = kept(_kept_area, error_model="numpy")
