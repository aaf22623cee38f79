"""First hits of the flights of a cell: a box of (h, h') at a time.

Flights of a cell lie between those of its corners: h <= y + v s - .. grows with y and with v.  So

- h > 0 until a, if that holds for the lowest corner (y, v), and
- h < 0 at b, and h' < 0 on [a, b], if that holds for the highest one:

then each flight hits the wall once in [a, b], and not before.

*Between two times* x < y, L = y - x, let h'' = -P <= M, M >= 0.  Then h is at least its chord less
M (t - x)(y - t)/2.  So with h(x) >= 0 and h(y) > 0 it is positive on (x, y] if

    h(y) > M L^2/2,      or      min(h(x), h(y)) > M L^2/8,

or, whatever the pull, if h' < 0 on [x, y] and h(y) > 0.
"""

import math
from typing import NamedTuple

from cap.areas.resting.pull import Pull, Table, extremes, known, pull, sums
from cap.sets.compiled import kernel
from cap.sets.doubles import GROWTH, Interval, between, lower, magnitude, upper, widened

AWAY, HITS, LOST = 0, 1, 2
PIECES, LONGEST = 24, 16  # of a step of the grid, looked at; steps of the grid in one piece
MARGINS = 2.0**-36, 2.0**-30, 2.0**-24  # tried, of windows beyond their ends found in floats
ROOM = 1 + 2.0**-40  # more than a few roundings lose
WIDEST = 8.0  # the longest window, in steps of the grid


class Change(NamedTuple):
    """A derivative of (h, h') by (h, h')."""

    hh: Interval
    hv: Interval
    vh: Interval
    vv: Interval


class Cell(NamedTuple):
    """States (h, h') at the time ``s``: those of c + D [-r, r], with h' in [``down``, ``up``].

    c = (``h``, ``v``), D = ``change``; r = (``half``, ``wide``) are half the sides of the cell at
    the start.  It is known that h >= 0.
    """

    s: float
    h: Interval
    v: Interval
    change: Change
    half: float
    wide: float
    down: float
    up: float


class Hit(NamedTuple):
    """The window [a, b] of the hits of a cell: I and P over it, and the speeds -h' there."""

    found: int
    a: float
    b: float
    first: Interval
    pull: Interval
    speed: Interval


Sums = tuple[Interval, Interval]  # I and J
NOTHING = Interval(math.nan, math.nan)


@kernel
def _nothing(found: int) -> Hit:
    return Hit(found, 0.0, 0.0, NOTHING, NOTHING, NOTHING)


@kernel
def spread(cell: Cell, d: Interval) -> float:
    """Return how far h may be from that of the middle, a time d later, if nothing happens."""
    m = cell.change
    return (
        magnitude(m.hh + d * m.vh) * cell.half + magnitude(m.hv + d * m.vv) * cell.wide
    ) * GROWTH


@kernel
def _ends(cell: Cell, s: float, begin: Sums, at: Sums) -> tuple[float, float]:
    """Return bounds of h at a time, from I and J when the cell is met and then.

    Below, the larger one of those by c + D [-r, r], and by h >= 0 and h' at first.
    """
    d = Interval(s, 0.0) - cell.s
    fall = (at[1] - begin[1]) - begin[0] * d
    found = widened((cell.h + cell.v * d) - fall, spread(cell, d))
    return max(lower(found), lower(cell.down * d - fall)), upper(found)


@kernel
def _stays(before: float, after: float, least: float, length: float) -> bool:
    """Return whether h > 0 on (x, y], from lower bounds of h at both times, and of P between."""
    bend = max(0.0, -least) * length * length * ROOM
    some = before >= 0 and after > 0 and after > 0.5 * bend
    return some or min(before, after) > 0.125 * bend


@kernel
def _zero(p: Pull, cell: Cell, side: float, near: float) -> float:
    """Return about when the last (``side`` 1) or first (-1) flight hits: Newton's method."""
    w, s, m = p.omega.mid, near, cell.change
    sin, cos = math.sin(w * cell.s), math.cos(w * cell.s)
    for _ in range(12):
        d = s - cell.s
        sine, cosine = math.sin(w * s), math.cos(w * s)
        fallen = p.mean.mid * d + (p.cos.mid * (sine - sin) - p.sin.mid * (cosine - cos)) / w
        bend = p.cos.mid * (cos - cosine - w * d * sin) + p.sin.mid * (w * d * cos - sine + sin)
        far = side * (spread(cell, Interval(d, 0.0)) + cell.h.rad + d * cell.v.rad)
        h = cell.h.mid + cell.v.mid * d - 0.5 * p.mean.mid * d * d - bend / (w * w) + far
        turn = math.copysign(cell.half, m.hh.mid + d * m.vh.mid) * m.vh.mid
        turn += math.copysign(cell.wide, m.hv.mid + d * m.vv.mid) * m.vv.mid
        rate = cell.v.mid + side * turn - fallen
        if not rate < 0:
            return math.nan
        s -= h / rate
        if abs(h) < 1e-13 * (abs(rate) + 1):
            return s
    return s


class _Seen(NamedTuple):
    """h > 0 until x for all flights, perhaps not at y; ``low`` is a lower bound of h at x."""

    x: float
    y: float
    low: float


@kernel
def _until(p: Pull, grid: Table, cell: Cell, begin: Sums) -> _Seen:
    """Return how long h > 0 is certain: if x is not before the end, all fly until then.

    NaN: nothing is known.
    """
    j, stride = int(cell.s / grid.step), 4
    seen = _Seen(cell.s, cell.s, 0.0)
    while seen.x < p.late and j + 1 < grid.ends.shape[0]:
        stride = min(stride, grid.ends.shape[0] - j)
        goal, least = (j + stride) * grid.step, grid.ends[j, 0]
        for i in range(j + 1, j + stride):
            least = min(least, grid.ends[i, 0])
        after = _ends(cell, goal, begin, known(grid, j + stride))[0]
        if _stays(seen.low, after, least, goal - seen.x):
            seen, j, stride = _Seen(goal, goal, after), j + stride, min(2 * stride, LONGEST)
        elif stride > 1:
            stride //= 2
        else:
            seen = _nearer(p, cell, begin, least, _Seen(seen.x, goal, seen.low))
            if not seen.x >= goal:
                break
            j += 1
    return seen


@kernel
def _nearer(p: Pull, cell: Cell, begin: Sums, least: float, seen: _Seen) -> _Seen:
    """Return the same for a step of the grid that ends at y, in shorter ones; P >= ``least``."""
    x, y, low = seen
    goal = y
    for _ in range(PIECES):
        after = _ends(cell, goal, begin, sums(p, goal))[0]
        if _stays(low, after, least, goal - x):
            x, low, goal = goal, after, y
            if x >= y:
                return _Seen(x, y, low)
        elif after > 0:
            goal = 0.5 * (x + goal)
        else:
            return _Seen(x, goal, low)
    return _Seen(math.nan, math.nan, math.nan)


@kernel
def _flown(
    p: Pull, cell: Cell, begin: Sums, during: Interval
) -> tuple[Interval, Interval, Interval]:
    """Return I, P and -h' during some time, without a hit."""
    pulls = pull(p, during)
    first = sums(p, during.mid)[0] + pulls * Interval(0.0, during.rad)
    return first, pulls, (first - begin[0]) - between(cell.down, cell.up)


@kernel
def first_hit(p: Pull, grid: Table, cell: Cell) -> Hit:
    """Return the window of the first hits of a cell, or that it flies until the end (`AWAY`).

    `LOST`: nothing is known.
    """
    begin = sums(p, cell.s)
    seen = _until(p, grid, cell, begin)
    if seen.x >= p.late:
        return _nothing(AWAY)
    for margin in MARGINS:
        hit = _after(p, grid, cell, begin, seen, margin)
        if hit.found != LOST:
            return hit
    return _nothing(LOST)


@kernel
def _after(p: Pull, grid: Table, cell: Cell, begin: Sums, seen: _Seen, margin: float) -> Hit:
    """Return the same, from how long h > 0, by a window with a margin."""
    x, y, before = seen
    a = max(x, _zero(p, cell, -1.0, y) - margin)
    if not x <= a < y:  # NaN, too
        return _nothing(LOST)
    if a > x:
        after = _ends(cell, a, begin, sums(p, a))[0]
        falls = after > 0 and lower(_flown(p, cell, begin, between(x, a))[2]) > 0
        if not (falls or _stays(before, after, extremes(grid, x, a)[0], a - x)):
            return _nothing(LOST)
    if a >= p.late:
        return _nothing(AWAY)
    b = _zero(p, cell, 1.0, a + margin) + margin
    if not a < b < a + WIDEST * grid.step:
        return _nothing(LOST)
    return _window(p, cell, begin, a, b)


@kernel
def among(p: Pull, cell: Cell, hit: Hit) -> Hit:
    """Return the window of the hits of some of the states of a cell, from that of all."""
    begin, t = sums(p, cell.s), _zero(p, cell, 1.0, 0.5 * (hit.a + hit.b))
    first = _zero(p, cell, -1.0, t)
    for margin in MARGINS:
        a, b = max(hit.a, first - margin), min(hit.b, t + margin)
        if a < b and not (a > hit.a and not _ends(cell, a, begin, sums(p, a))[0] > 0):
            found = _window(p, cell, begin, a, b)
            if found.found == HITS:
                return found
    return _nothing(LOST)


@kernel
def _window(p: Pull, cell: Cell, begin: Sums, a: float, b: float) -> Hit:
    """Return a window of hits, before which there are none; h < 0 at b is looked at."""
    if not _ends(cell, b, begin, sums(p, b))[1] < 0:
        return _nothing(LOST)
    found = _flown(p, cell, begin, between(a, b))
    return Hit(HITS, a, b, *found) if lower(found[2]) > 0 else _nothing(LOST)
