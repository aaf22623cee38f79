"""The fates of orbits, told by the places of their releases, and by strobes in a strip.

A *table* gives intervals of places from which all releases have one fate: in the end they are
attracted to the orbits released in A, or they converge to an orbit of the segment.  It is made in
rounds: a part of the places has the fate of the interval of the last table in which all its next
releases lie.  So the fate of each place is decided after finitely many releases.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.folded.follow import Cut, Seen, Sliced, Slow, Split, Strobe, slowest
from cap.checker.folded.numbers import Pair
from cap.checker.folded.table import NONE, SEGMENT, Table
from cap.checker.kernel import quadratic as q

_SLICES = 6  # halvings of the speeds of slow hits
_NOTHING = Seen([], None, stops=False)  # of orbits of a kind that there is not


class Strip(NamedTuple):
    """States at the time 0 that tend to the segment: |w| < d, x and x + k w in (left, right).

    w = s - v, v in [slow, fast], x = edge + p.  The numbers are rounded to the safe side.
    """

    left: float
    right: float
    slow: float
    fast: float
    d: float
    k: float
    edge: Pair

    def holds(self, strobe: Strobe) -> bool:
        """Return whether all states of a model are in the strip."""
        p, s = strobe
        low, high = q.ends(s)
        if not (self.fast - self.d < low and high < self.slow + self.d):
            return False
        x = q.moved(p, *self.edge)
        low, high = q.ends(x)
        if not (self.left < low and high < self.right):
            return False
        w = q.moved(s, -(self.fast + self.slow) / 2, self.fast - self.slow)
        low, high = q.ends(q.total(x, q.scaled(w, self.k)))
        return self.left < low and high < self.right

    def meets(self, strobe: Strobe) -> bool:
        """Return whether some states may be in the strip."""
        low, high = q.ends(strobe[1])
        if high < self.slow - self.d or low > self.fast + self.d:
            return False
        low, high = q.ends(q.moved(strobe[0], *self.edge))
        return high > self.left and low < self.right


class Judge(NamedTuple):
    """What tells fates: the strip, and the table of places."""

    strip: Strip
    table: Table

    def fate(self, part: Seen) -> int:
        """Return the fate of all orbits of a part, or 0."""
        if any(self.strip.holds(strobe) for strobe in part.strobes):
            return SEGMENT
        end = part.end
        if end is None:
            return NONE
        if isinstance(end, Cut):
            found = self.fate(end.lower)
            return found if found and found == self.fate(end.upper) else NONE
        if not isinstance(end, Split):
            return self.table.fate(q.ends(end))
        level = q.ends(end.level)
        if level[1] < 0:
            return self.fate(end.below)
        found = self.above(end, level)
        return found if found and (level[0] > 0 or found == self.fate(end.below)) else NONE

    def above(self, end: Split, level: Pair) -> int:
        """Return the fate of the orbits with a level >= 0, or 0."""
        if isinstance(end.above, Sliced):
            return end.above.table.fate(slowest(end.above.slow, level))
        return self.fate(end.above) if isinstance(end.above, Seen) else NONE

    def prepared(self, seen: Seen) -> Seen:
        """Return what matters of what is seen, with tables for slow hits."""
        strobes, end = [z for z in seen.strobes if self.strip.meets(z)], seen.end
        if isinstance(end, Cut):
            end = Cut(end.along, self.prepared(end.lower), self.prepared(end.upper))
        elif isinstance(end, Split):
            upper = end.above
            if isinstance(upper, Slow):
                edges, fates = [0.0], list[int]()
                part = self.prepared(upper.seen)
                self.sort(part, (0.0, upper.fastest), _SLICES, edges, fates)
                upper = Sliced(upper, Table(edges, fates))
            elif isinstance(upper, Seen):
                upper = self.prepared(upper)
            end = Split(end.level, self.prepared(end.below), upper)
        return Seen(strobes, end, seen.stops)

    def sort(self, part: Seen, x: Pair, depth: int, edges: list[float], fates: list[int]) -> None:
        """Add the fates of a part, in slices across X, to a table from X = x[0] to x[1]."""
        found = self.fate(part)
        if found or not depth or hopeless(part):
            edges.append(x[1])
            fates.append(found)
            return
        m = (x[0] + x[1]) / 2
        self.sort(half(part, 0, -1.0), (x[0], m), depth - 1, edges, fates)
        self.sort(half(part, 0, 1.0), (m, x[1]), depth - 1, edges, fates)


def half(part: Seen, along: int, side: float) -> Seen:
    """Return what is seen of one half of a box."""
    strobes = [(q.half(p, along, side), q.half(s, along, side)) for p, s in part.strobes]
    end = part.end
    if isinstance(end, Cut):
        if end.along == along:
            chosen = end.lower if side < 0 else end.upper
            return Seen(strobes + chosen.strobes, chosen.end, chosen.stops)
        both = (half(part, along, side) for part in (end.lower, end.upper))
        return Seen(strobes, Cut(end.along, *both), part.stops)
    if isinstance(end, Split):
        low, high = q.ends(end.level)
        below = half(end.below, along, side) if low <= 0 else _NOTHING
        above = end.above
        if isinstance(above, Seen):
            above = half(above, along, side) if high >= 0 else _NOTHING
        end = Split(q.half(end.level, along, side), below, above)
    elif end is not None:
        end = q.half(end, along, side)
    return Seen(strobes, end, part.stops)


def hopeless(part: Seen) -> bool:
    """Return whether parts of a part would tell no more: it steers."""
    end = part.end
    if part.strobes or isinstance(end, Split):
        return False
    if isinstance(end, Cut):
        return hopeless(end.lower) and hopeless(end.upper)
    return end is None or sum(abs(c) for c in end[1:6]) < 2 * end[6]
