"""Launches that go on in vain: cells whose orbits stop, or leave by the ceiling, level by level.

Units F = omega = 1; launches (t, E) and flights as in `cap.checker.flow.arc`, against the friction
f, or -f: then all is about backward orbits, with t replaced by -t.  The *ceiling* is the curve W =
E + a cos(t - b) = c.  Columns cover the times in a window; at all other times, modulo 2 pi, W > c
for all E >= 0.

*What is shown.*  No orbit that meets a cell of some level stays below the ceiling without a stop.
By induction: a cell of level 0 lies above the ceiling, or all its launches stop.  From a cell of
level k > 0 all launches fly to the other wall, and land above the ceiling, or in cells of levels
below k.

*Only boundaries are followed.*  (i) At one time t, of two launches the faster is ahead in place and
in speed as long as both fly; so if a launch reaches the wall, faster ones do, and if it stops,
slower ones do.  So it is enough that an edge at the bottom stops, and that all launches of the
lower edge of a cell reach the wall.

(ii) On the open set of the launches that reach the wall without a stop, with V > 0, the flight map
G, with its time not taken modulo 2 pi, is continuous and injective: a flight can be followed
backward.  Let Q be a cell of level k > 0, a closed disk, and Y a closed set that contains
G(boundary of Q), such that at each time the set of the E in Y is an interval, perhaps unbounded, or
empty.  Then G(Q) lies in Y.  For G(boundary) is a Jordan curve, and G(interior) is its inside,
which is bounded; a point of it that is not in Y could go up or down to infinity and never meet Y.

Y is made of one run of cells of levels below k, or the run up to the top, for each column that the
image of the boundary meets, and of all E at the times without columns.  On the line between two
columns the two intervals meet where the boundary passes.  That image, which is connected, avoids
the times from 6 to 2 pi after the first line: so all of it is moved by the same multiple of 2 pi.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable
from typing import NamedTuple

from cap.checker.flow.arc import SPAN, Arc, Image, Launches, Taylor, least, negative
from cap.checker.flow.columns import UNIT, Column, Edge
from cap.checker.kernel.doubles import PI, Double, cos_sin
from cap.checker.kernel.rejection import Rejected, need

MOST = 2_000_000  # arcs: some minutes
HALVINGS = 12  # of an arc, until what is to be shown of it is certain
NO_CELL = math.inf  # where a run ends; above all levels
LATE = (1e-5, 1e-4, 1e-3, 1e-2)  # before and after a stop, v > 0 and v < 0 are tried


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


class Target(NamedTuple):
    """The interval of energies in a column into which a cell is to fly; None: no end."""

    lower: Edge | None
    upper: Edge | None


class World:
    """Flights against a friction, with columns of cells between each two ``lines``."""

    def __init__(
        self, f: Double, R: Double, ceiling: Ceiling, lines: list[float], columns: list[Column]
    ) -> None:
        self.f, self.R, self.ceiling = f, R, ceiling
        self.lines, self.columns = lines, columns
        self.arcs = 0

    def prove(self, j: int) -> None:
        """Prove what is shown of all cells of a column."""
        runs = self.columns[j]
        for run in runs:
            if run.bottom:
                need(along(self.arc(j, run.edges[0]), self.stops), "a launch may not stop")
            if run.top:
                top = self.arc(j, run.edges[-1])
                above = along(top, lambda arc: least(self.ceiling.excess(arc)) >= 0)
                need(above, "the top is not above the ceiling")
            for level, low, high in zip(run.levels, run.edges, run.edges[1:], strict=False):
                self.falls(j, level, low, high)

    def falls(self, j: int, level: int, low: Edge, high: Edge) -> None:
        """Prove it of one cell."""
        targets = dict[int, Target]()

        def lands(arc: Arc) -> bool:
            return self.lands(arc, level, targets)

        for arc in (self.arc(j, low), self.arc(j, high), *self.sides(j, low, high)):
            need(along(arc, lands), "a cell may not fly into cells of lower levels")

    def arc(self, j: int, edge: Edge) -> Arc:
        """Return an edge as an arc."""
        middle, half = self.middle(j)
        return Arc(Double(middle), Double(half), *(Double(q * UNIT) for q in edge))

    def middle(self, j: int) -> tuple[float, float]:
        """Return the middle of a column and half its width, exactly."""
        return (self.lines[j] + self.lines[j + 1]) / 2, (self.lines[j + 1] - self.lines[j]) / 2

    def sides(self, j: int, low: Edge, high: Edge) -> list[Arc]:
        """Return the two sides of a cell."""
        sides = []
        for s, t in ((-1, self.lines[j]), (1, self.lines[j + 1])):
            ends = [UNIT * (q[0] + s * q[1] + q[2]) for q in (low, high)]
            middle, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2  # exact
            zero = Double(0.0)
            sides.append(Arc(Double(t), zero, Double(middle), Double(half), zero))
        return sides

    def launches(self, arc: Arc) -> Launches:
        """Return the launches of an arc; too many arcs are refused."""
        self.arcs += 1
        if self.arcs > MOST:
            raise TooLong(f"more than {MOST} arcs would have to be followed")
        return Launches(arc, self.f, self.R)

    def stops(self, arc: Arc) -> bool:
        """Return whether all launches of an arc certainly stop.

        Let v(T) < 0 at a time T; then there is a stop or a hit before.  Let v > 0 until a time B,
        and v >= -m from B to T, m >= 0.  After a hit x would fall by m (T - B) at most: so x(T) + m
        (T - B) < R excludes it.  (B may be the time of the launch.)
        """
        launches = self.launches(arc)
        return any(self._stops_by(launches, *times) for times in self._late(launches))

    def _late(self, launches: Launches) -> list[tuple[Double, Double]]:
        """Return times B and T at which v > 0 and v < 0 are likely."""
        t, u, f = launches.near.t.mid, launches.near.u.mid, self.f.mid
        for T in launches.minima(t, t + SPAN):
            if T.mid > t and u + math.sin(T.mid) - math.sin(t) - f * (T.mid - t) < 0:
                early, late = t, T.mid
                for _ in range(40):
                    middle = (early + late) / 2
                    rises = u + math.sin(middle) - math.sin(t) - f * (middle - t) > 0
                    early, late = (middle, late) if rises else (early, middle)
                around = [(Double(early - w), Double(late + w)) for w in LATE]
                return [(launches.all.t, T), *around]
        return []

    def _stops_by(self, launches: Launches, B: Double, T: Double) -> bool:
        begin = launches.all.t
        if B is not begin:
            flies = launches.moves(B.upper) and least(launches.velocity(B)) > 0
            if not (begin.upper < B.lower and flies):
                return False
        lows = [*launches.minima(B.lower, T.upper), T]
        slowest = [least(launches.velocity(low)) for low in lows]
        if not all(v > -math.inf for v in slowest):  # `max` would pass over NaN
            return False
        depth = max(0.0, *(-v for v in slowest))
        fallen = least(negative(launches.velocity(T))) > 0
        most = -least(negative(launches.place(T)))
        return fallen and (self.R - (T - B) * depth - most).is_positive()

    def lands(self, arc: Arc, level: int, targets: dict[int, Target]) -> bool:
        """Return whether all of an arc flies to the targets; they are chosen when first met."""
        image = Image(self.launches(arc))
        begin = self.lines[0]
        turns = math.floor((image.T[0].mid + math.pi - begin) / (2 * math.pi))
        shift = PI * (1.0 - 2 * turns)
        times, t, wide = image.times + shift, image.T[0] + shift, image.all + shift
        if not begin <= times.lower <= times.upper < begin + 6:
            return False
        met = dict(targets)
        for j in range(self.column(times.lower), len(self.columns)):
            if self.lines[j] > times.upper:
                break
            place = _Place(t, wide, image, *self.middle(j))
            if j not in met:
                met[j] = self.target(j, level, place.s[0].mid, image.E[0].mid)
            if not place.within(met[j], image.E):
                return False
        targets.update(met)
        return True

    def column(self, t: float) -> int:
        """Return the first column that may contain a time, or those after it."""
        return max(0, bisect_left(self.lines, t) - 1)

    def target(self, j: int, level: int, s: float, E: float) -> Target:
        """Return the run of cells of lower levels in which a launch is; it steers only."""
        for run in self.columns[j]:
            heights = [UNIT * (q[0] + s * (q[1] + s * q[2])) for q in run.edges]
            k = sum(height <= E for height in heights)  # the number of edges below
            if not ((k > 0 or run.bottom) and (k < len(heights) or run.top)):
                continue
            levels = [0 if run.bottom else NO_CELL, *run.levels, 0 if run.top else NO_CELL]
            need(levels[k] < level, "a cell may fly into one of no lower level")
            low = high = k
            while low > 0 and levels[low - 1] < level:
                low -= 1
            while high < len(heights) and levels[high + 1] < level:
                high += 1
            return Target(
                run.edges[low - 1] if low > 0 else None,
                run.edges[high] if high < len(heights) else None,
            )
        raise Rejected("a cell may fly to where there is none")


class _Place:
    """Where an image is, in a column: s, and how edges compare."""

    def __init__(self, t: Double, wide: Double, image: Image, middle: float, half: float) -> None:
        scale = 1 / half  # a power of 2
        self.s = (t - middle) * scale, image.T[1] * scale, image.T[2] * scale
        self.all, self.ds = (wide - middle) * scale, image.dT * scale

    def within(self, target: Target, E: Taylor) -> bool:
        """Return whether the image is certainly between the edges, and not on a lower one."""
        low, high = target
        above = low is None or least(self.gap(E, low)) >= 0
        return above and (high is None or least(negative(self.gap(E, high))) >= 0)

    def gap(self, E: Taylor, edge: Edge) -> Taylor:
        """Return E - q(s): its second derivative is E'' - 2 q_2 s'^2 - (q_1 + 2 q_2 s) s''."""
        a, b, c = (q * UNIT for q in edge)
        s, s1, s2 = self.s
        value = E[0] - (s * (s * c + b) + a)
        slope = E[1] - (s * (2 * c) + b) * s1
        bend = E[2] - self.ds * self.ds * (2 * c) - (self.all * (2 * c) + b) * s2
        return value, slope, bend


def fails(world: World, j: int, level: int) -> list[tuple[Edge, Edge]]:
    """Return the cells of a level in a column of which nothing is shown: hints for a prover."""
    found = list[tuple[Edge, Edge]]()
    for run in world.columns[j]:
        if level == 0 and run.bottom and not along(world.arc(j, run.edges[0]), world.stops):
            found.append((run.edges[0], run.edges[0]))
        for k, low, high in zip(run.levels, run.edges, run.edges[1:], strict=False):
            try:
                if k == level:
                    world.falls(j, level, low, high)
            except Rejected:
                found.append((low, high))
    return found


def along(arc: Arc, holds: Callable[[Arc], bool], halvings: int = HALVINGS) -> bool:
    """Return whether something holds on an arc, or on all pieces into which it is halved."""
    try:
        if holds(arc):
            return True
    except Rejected:
        pass
    return halvings > 0 and all(along(half, holds, halvings - 1) for half in arc.halves())
