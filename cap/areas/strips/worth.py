"""Compiled, in doubles: what cells take away of what the other family leaves.

It steers; nothing rests on it.  The other family has the same columns, in the mirror of time.
"""

from cap.areas.strips.cover import (
    BOTTOM,
    TOP,
    Cover,
    Floats,
    Integers,
    at,
    holds,
)
from cap.areas.strips.fit import Wanted
from cap.sets.compiled import kernel, sources
from cap.sets.kept import kept

THIN = 1e-6  # gaps that are thinner are not looked at
MOST = 1000  # arcs for a cell


@kernel
def gaps_at(cover: Cover, j: int, s: float, thin: float, ends: Floats) -> int:
    """Write the gaps at a place in a column, in order, and return their number."""
    low, n = at(cover.bottom[j], s) if cover.has_bottom[j] else 0.0, 0
    end = cover.start[j + 1]
    for i in range(cover.start[j], end + 1):
        high = at(cover.cells[i, :3], s) if i < end else at(cover.top[j], s)
        if high - low > thin and n < len(ends):
            ends[n, 0], ends[n, 1] = low, high
            n += 1
        if i < end:
            low = at(cover.cells[i, 3:], s)
    return n


def _want(
    other: Cover, margin: float, wanted: Wanted, columns: Integers, room: tuple[Floats, Floats]
) -> None:
    """Write the energies near gaps of the other family in some columns, with room (K, 2) twice."""
    C, (gaps, found) = len(wanted.number), room
    for j in columns:
        n = 0
        for k in range(max(0, j - 1), min(C, j + 2)):
            for s in (-1.0, 0.0, 1.0):
                for i in range(gaps_at(other, C - 1 - k, s, THIN, gaps)):
                    n = _join(found, n, gaps[i, 0] - margin, gaps[i, 1] + margin)
        wanted.number[j] = min(n, wanted.ends.shape[1])
        for i in range(wanted.number[j]):
            wanted.ends[j, i, 0], wanted.ends[j, i, 1] = found[i, 0], found[i, 1]


@kernel
def _join(room: Floats, n: int, low: float, high: float) -> int:
    """Join an interval to others, which are apart and in order."""
    k = 0
    while k < n and room[k, 1] < low:
        k += 1
    m = k
    while m < n and room[m, 0] <= high:
        low, high = min(low, room[m, 0]), max(high, room[m, 1])
        m += 1
    if m == k:
        if n == len(room):
            return n
        for i in range(n, k, -1):
            room[i, 0], room[i, 1] = room[i - 1, 0], room[i - 1, 1]
        n += 1
    else:
        for i in range(m, n):
            room[k + 1 + i - m, 0], room[k + 1 + i - m, 1] = room[i, 0], room[i, 1]
        n -= m - k - 1
    room[k, 0], room[k, 1] = low, high
    return n


want = kept(_want, sources(), error_model="numpy")


def _weigh(cover: Cover, other: Cover, worth: Floats, gaps: Floats) -> None:
    """Write the areas of the cells (N,) in the gaps of the other family.

    ``gaps`` is an array in which those of a place are noted meanwhile.
    """
    C = len(cover.top)
    for j in range(C):
        width = cover.lines[j + 1] - cover.lines[j]
        for k in range(5):
            s = 0.4 * (k - 2)
            n, first = gaps_at(other, C - 1 - j, -s, 0.0, gaps), 0
            for i in range(cover.start[j], cover.start[j + 1]):
                low, high = at(cover.cells[i, :3], s), at(cover.cells[i, 3:], s)
                while first < n and gaps[first, 1] <= low:
                    first += 1
                m = first
                while m < n and gaps[m, 0] < high:
                    worth[i] += (min(high, gaps[m, 1]) - max(low, gaps[m, 0])) * width / 5
                    m += 1


weigh = kept(_weigh, sources(), error_model="numpy")


def _choose(
    cover: Cover, least: float, cells: Integers, columns: Integers, worth: Floats, seen: Integers
) -> int:
    """Add the worth of cells, from the highest, to those into which they fly, if it is enough.

    Others, and those that do not hold, get -1.  Returns how many arcs have to be followed.
    """
    arcs, last = 0, len(seen) - 1
    for i in cells:
        count = 0
        if worth[i] >= least:
            count = holds(cover, columns[i], cover.levels[i], cover.cells[i], seen, MOST)
        arcs += count
        if count == 0:
            worth[i] = -1.0
            continue
        for k in range(seen[last, 0]):
            j = seen[k, 2]
            low, high, begin, end = seen[j, 0], seen[j, 1], cover.start[j], cover.start[j + 1]
            first = end if low == TOP else (begin if low == BOTTOM else low)
            past = begin if high == BOTTOM else (end if high == TOP else high + 1)
            for m in range(first, past):
                worth[m] += worth[i]
    return arcs


choose = kept(_choose, sources(), error_model="numpy")
