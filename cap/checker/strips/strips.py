"""Launches that go on in vain: cells whose orbits stop, or leave by the ceiling, level by level.

Units F = omega = 1; launches (t, E) and flights as in `cap.checker.strips.arc`, against the
friction f, or -f: then all is about backward orbits, with t replaced by -t.  The *ceiling* is the
curve W = E + a cos(t - b) = c.  Columns cover the times in a window; at all other times, modulo 2
pi, W > c for all E >= 0.

*What is shown.*  No orbit that meets a cell of some level stays below the ceiling without a stop.
By induction: a cell of level 0 lies above the ceiling, or all its launches stop.  From a cell of
level k > 0 all launches fly to the other wall, and land above the ceiling, or in cells of levels
below k.

*A cell at once.*  Of a cell that is not tall it is tried to show that all of it lands in runs of
cells of lower levels, one for each column, as in `cap.checker.strips.patches`.

*Else only its boundary is followed.*  (i) At one time t, of two launches the faster is ahead in
place and in speed as long as both fly; so if a launch reaches the wall, faster ones do, and if it
stops, slower ones do.  So it is enough that an edge at the bottom stops, and that all launches of
the lower edge of a cell reach the wall.

(ii) On the open set of the launches that reach the wall without a stop, with V > 0, the flight map
G, with its time not taken modulo 2 pi, is continuous and injective: a flight can be followed
backward.  Let Q be a cell of level k > 0, a closed disk, and Y a closed set that contains
G(boundary of Q), such that at each time the set of the E in Y is an interval, perhaps unbounded, or
empty.  Then G(Q) lies in Y.  For G(boundary) is a Jordan curve, and G(interior) is its inside,
which is bounded; a point of it that is not in Y could go up or down to infinity and never meet Y.

Y is made of one run of cells of levels below k, or the run up to the top, for each column that the
image of the boundary meets, and of all E at the times without columns.  On the line between two
columns the two intervals meet where the boundary passes.  That image, which is connected, avoids
the times from 6.28 to 2 pi after the first line: so all of it is moved by one multiple of 2 pi.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple, Protocol, Self, TypeVar

from cap.checker.kernel.doubles import PI, Double, cos_sin
from cap.checker.kernel.parabolas import Edge
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.strips.arc import Arc, Launches, Taylor, least
from cap.checker.strips.columns import UNIT, Column
from cap.checker.strips.images import Image, image
from cap.checker.strips.landing import Ends, Place, Target
from cap.checker.strips.patches import Patch, Spread
from cap.checker.strips.stopping import stops

MOST = 1 << 27  # units of work for a family: columns that are met
ARC, LONG = 16, 128  # an arc takes as long as so many, and so many cells of a run as one
HALVINGS = 12  # of an arc, until what is to be shown of it is certain
TALL = 1 / 256  # of cells that are higher only the boundary is followed
ROUND = 6.28  # less than 2 pi
NEITHER = False, False  # end is known to land in a target
NO_CELL = math.inf  # where a run ends; above all levels


class TooLong(Exception):
    """Nothing was found wrong, but the work is too much."""


class Ceiling(NamedTuple):
    """The curve E = c - a cos(t - b)."""

    a: Double
    b: Double
    c: Double

    def excess(self, arc: Arc) -> Taylor:
        """Return W - c on an arc."""
        cos, sin = cos_sin(arc.t - self.b)
        far = cos_sin(arc.t.widened(arc.dt.magnitude) - self.b)[0]
        value, slope = arc.e + self.a * cos - self.c, arc.e1 - self.a * sin * arc.dt
        return value, slope, arc.e2 * 2.0 - self.a * far * arc.dt * arc.dt


class World:
    """Flights against a friction, with columns of cells between each two ``lines``."""

    def __init__(
        self, f: Double, R: Double, ceiling: Ceiling, lines: list[float], columns: list[Column]
    ) -> None:
        self.f, self.R, self.ceiling = f, R, ceiling
        self.lines, self.columns = lines, columns
        self.stacks = dict[int, tuple[list[Edge], list[float]]]()
        self.work = 0

    def prove(self, j: int) -> None:
        """Prove what is shown of all cells of a column."""
        self.ends(j)
        for run in self.columns[j]:
            for (low, high), level in zip(pairwise(run.edges), run.levels, strict=True):
                self.falls(j, level, low, high)

    def ends(self, j: int) -> None:
        """Prove it of the bottom and of the top of a column."""
        for run in self.columns[j]:
            if run.bottom:
                stop = along(self.arc(j, run.edges[0]), lambda arc: stops(self.launches(arc)))
                need(stop, "a launch may not stop")
            if run.top:
                top = self.arc(j, run.edges[-1])
                above = along(top, self.above)
                need(above, "the top is not above the ceiling")

    def above(self, arc: Arc) -> bool:
        """Return whether an arc is not below the ceiling."""
        self.count(ARC)
        return least(self.ceiling.excess(arc)) >= 0

    def falls(self, j: int, level: int, *edges: Edge) -> None:
        """Prove it of one cell: of all of it at once or, if that fails, of its boundary."""
        low, high = (self.arc(j, edge) for edge in edges)
        if self.spreads(Patch(low, high), level):
            return
        targets = dict[int, Target]()

        def lands(arc: Side) -> bool:
            return self.lands(image(self.launches(arc.arc)), level, targets, arc.ends)

        for arc in (Side(low, NEITHER), Side(high, NEITHER), *self.sides(j, *edges)):
            need(along(arc, lands), "a cell may not fly into cells of lower levels")

    def arc(self, j: int, edge: Edge) -> Arc:
        """Return an edge as an arc."""
        middle, half = self.middle(j)
        return Arc(Double(middle), Double(half), *(Double(q * UNIT) for q in edge))

    def middle(self, j: int) -> tuple[float, float]:
        """Return the middle of a column and half its width, exactly."""
        return (self.lines[j] + self.lines[j + 1]) / 2, (self.lines[j + 1] - self.lines[j]) / 2

    def sides(self, j: int, low: Edge, high: Edge) -> list[Side]:
        """Return the two sides of a cell; their ends are those of its edges."""
        sides, zero = list[Side](), Double(0.0)
        for s, t in ((-1, self.lines[j]), (1, self.lines[j + 1])):
            ends = [UNIT * (q[0] + s * q[1] + q[2]) for q in (low, high)]
            middle, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2  # exact
            arc = Arc(Double(t), zero, Double(middle), Double(half), zero)
            sides.append(Side(arc, (True, True)))
        return sides

    def launches(self, arc: Arc) -> Launches:
        """Return the launches of an arc; too many arcs are refused."""
        self.count(ARC)
        return Launches(arc, self.f, self.R)

    def count(self, work: int) -> None:
        """Count work; too much is refused."""
        self.work += work
        if self.work > MOST:
            raise TooLong("too many arcs would have to be followed, or meet too many columns")

    def lands(
        self, image: Image, level: int, targets: dict[int, Target], ends: Ends = NEITHER
    ) -> bool:
        """Return whether all of an image is in the targets; some of its ends are known to be.

        Targets are chosen when first met.
        """
        image.move(self.shift(image.T[0]))
        columns, met = self.crossed(image.times), dict(targets)

        def holds(j: int) -> bool:
            self.count(1)
            place = Place(image, self.between(j))
            if place.part is None:
                return True
            found = met.get(j)
            if found is None:
                s, E = place.launch()
                found = self.target(j, level, max(-1.0, min(1.0, s)), E)
            if found is None or not place.within(found, ends):
                return place.core is None  # the column is not met
            met[j] = found
            return True

        if columns is None or not all(map(holds, columns)):
            return False
        targets.update(met)
        return True

    def spreads(self, patch: Patch, level: int) -> bool:
        """Return whether certainly all of a patch flies to cells of lower levels."""
        if patch.height > TALL:
            return False
        self.count(2 * ARC)
        try:
            spread = Spread(patch, self.f, self.R)
            shift = self.shift(spread.bends.T)
            if self.spread(spread.roughly(shift), level):
                return True
            self.count(2 * ARC)
            return self.spread(spread.sharply(shift), level)
        except Rejected:
            return False

    def spread(self, spread: Spread, level: int) -> bool:
        """Return whether all of the image of a patch is in runs of such cells."""

        columns = self.crossed(spread.times)

        def holds(j: int) -> bool:
            self.count(1)
            low, high = spread.places(self.between(j))
            if low.part is None or high.part is None:
                return True
            (s, E), (t, e) = low.launch(), high.launch()
            found = self.target(j, level, (s + t) / 2, (E + e) / 2)
            return found is not None and spread.lands(low, high, found)

        return columns is not None and all(map(holds, columns))

    def shift(self, times: Double) -> Double:
        """Return the odd multiple of pi by which times of hits are to be moved."""
        turns = math.floor((times.mid + math.pi - self.lines[0]) / (2 * math.pi))
        return PI * (1.0 - 2 * turns)

    def crossed(self, times: Double) -> range | None:
        """Return the columns that times may be in, or None if they are not all in one turn."""
        begin = self.lines[0]
        if not begin <= times.lower <= times.upper < begin + ROUND:
            return None
        last = bisect_right(self.lines, times.upper)
        return range(self.column(times.lower), min(last, len(self.columns)))

    def between(self, j: int) -> tuple[float, float]:
        """Return the lines of a column."""
        return self.lines[j], self.lines[j + 1]

    def column(self, t: float) -> int:
        """Return the first column that may contain a time, or those after it."""
        return max(0, bisect_left(self.lines, t) - 1)

    def target(self, j: int, level: int, s: float, E: float) -> Target | None:
        """Return the run of cells of lower levels in which a launch is, or None; it steers only."""
        if j not in self.stacks:
            self.stacks[j] = stacked(self.columns[j])
        edges, levels = self.stacks[j]
        low = high = bisect_right(edges, E / UNIT, key=lambda q: q[0] + s * (q[1] + s * q[2]))
        if not levels[low] < level:
            return None
        while low > 0 and levels[low - 1] < level:
            low -= 1
        while high < len(edges) and levels[high + 1] < level:
            high += 1
        self.count((high - low) // LONG)
        return Target(
            edges[low - 1] if low > 0 else None, edges[high] if high < len(edges) else None
        )


def stacked(column: Column) -> tuple[list[Edge], list[float]]:
    """Return all edges, and the levels of what lies below, between and above them."""
    edges, levels = list[Edge](), list[float]()
    for run in column:
        edges += run.edges
        levels += [0 if run.bottom else NO_CELL, *run.levels]
    return edges, [*levels, 0 if column[-1].top else NO_CELL]


class Side(NamedTuple):
    """An arc of a boundary, and which of its ends are known to land in targets."""

    arc: Arc
    ends: Ends

    def halves(self) -> tuple[Side, Side]:
        """Return the halves."""
        (one, two), (first, last) = self.arc.halves(), self.ends
        return Side(one, (first, False)), Side(two, (False, last))


class Halved(Protocol):
    """An arc that can be halved."""

    def halves(self) -> tuple[Self, Self]:
        """Return the halves."""


H = TypeVar("H", bound=Halved)


def along(arc: H, holds: Callable[[H], bool], halvings: int = HALVINGS) -> bool:
    """Return whether something holds on an arc, or on all pieces into which it is halved."""
    try:
        if holds(arc):
            return True
    except Rejected:
        pass
    return halvings > 0 and all(along(half, holds, halvings - 1) for half in arc.halves())
