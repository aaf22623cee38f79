"""Compiled, in doubles: in which columns that was lost which is left over.

It steers; nothing rests on it.  What no cell of either family takes away may stop or leave
nevertheless.  The last launch of its orbit that is in no cell was *lost*: the next one is in a cell
or stops, so it might have been in one, if its column had been narrower.  What flies there is lost
with it, again and again.
"""

from typing import NamedTuple

from cap.areas.strips.cover import NEITHER, Cover, Floats, Integers, found, place, time
from cap.areas.strips.worth import gaps_at
from cap.sets.compiled import kernel, sources
from cap.sets.kept import kept

PLACES = 7  # in each column
GOLDEN = 0.6180339887498949


class Chance(NamedTuple):
    """Gaps of both families at a place (K, 2); how many flights are followed."""

    one: Floats
    two: Floats
    flights: int


@kernel
def _lost(cover: Cover, j: int, s: float, E: float, flights: int) -> int:
    """Return the column in which a launch was lost, or -1 if it goes on."""
    last = j
    for _ in range(flights):
        j, s, E = place(cover, time(cover.lines, j, s), E)
        if j < 0:
            return last
        if found(cover, j, s, E, 0.0) != NEITHER:
            return last
        last = j
    return -1


@kernel
def _column(family: tuple[Cover, Cover], j: int, chance: Chance, lost: Floats) -> None:
    """Add the areas of the gaps of a column to ``lost`` (C,), by the column that lost them."""
    one, two = family
    C, width, g, h = len(lost), one.lines[j + 1] - one.lines[j], chance.one, chance.two
    for k in range(PLACES):
        s = (2 * k + 1) / PLACES - 1
        n, m = gaps_at(one, j, s, 0.0, g), gaps_at(two, C - 1 - j, -s, 0.0, h)
        a = b = 0
        while a < n and b < m:
            low, high = max(g[a, 0], h[b, 0]), min(g[a, 1], h[b, 1])
            if high > low:
                E, size = low + (high - low) * ((k + a + b) * GOLDEN % 1), (high - low) / PLACES
                own = _lost(one, j, s, E, chance.flights)
                other = _lost(two, C - 1 - j, -s, E, chance.flights)
                if own >= 0:
                    lost[own] += size * width
                if other >= 0:
                    lost[C - 1 - other] += size * width
            if g[a, 1] < h[b, 1]:
                a += 1
            else:
                b += 1


def _trace(family: tuple[Cover, Cover], chance: Chance, columns: Integers, lost: Floats) -> None:
    """Add where what both families leave in some columns was lost."""
    for j in columns:
        _column(family, j, chance, lost)


trace = kept(_trace, sources(), error_model="numpy")
