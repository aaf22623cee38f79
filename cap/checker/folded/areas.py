"""Areas of states at t = 0, by the fate of their first stops.

Let a region of stops have the area M, and a part of the states that come to it at one multiple of
pi the area m.  If stops of the area g have a fate, at least m - (M - g) of these states have it:
each stop stands for one state there, and areas are those of the stops (`cap.checker.folded.stops`).

Of sticks in a region those do not have the fate whose places have not: let these have the measure n
at most within the bounds of the edges over one of equal parts of Y, then they have the area n |s'|
dt at most.  Turns are followed forwards, by parts of the region (`cap.checker.folded.ahead`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.folded.ahead import Found, Outlook, found
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import TURN, UP
from cap.checker.folded.regions import Leaf, Region
from cap.checker.folded.stops import PARTS, Start, backwards, places_of, sticks, turns
from cap.checker.folded.table import FATES
from cap.checker.kernel import polynomials as q


class Areas(NamedTuple):
    """Areas, from below: for the attractor, the segment, either of them, and of all that stop."""

    attractor: float = 0.0
    segment: float = 0.0
    either: float = 0.0
    stops: float = 0.0


def of_sticks(y: Direction, fates: Places, V: float, side: int, leaf: Leaf) -> Areas:
    """Return the areas of the states at t = 0, slower than V, that come to a region of sticks."""
    start = sticks(y, side, leaf.region)
    return counted(y, V, leaf, start, [stuck(y, fates, start, side, leaf.region)])


def of_turns(y: Direction, o: Outlook, V: float, leaf: Leaf) -> Areas:
    """Return the areas of the states at t = 0, slower than V, that come to a region of turns."""
    return counted(y, V, leaf, turns(y, leaf.region), [found(o, part) for part in leaf.parts])


def stuck(y: Direction, fates: Places, start: Start, side: int, region: Region) -> Found:
    """Return what is found of sticks."""
    places, less = places_of(y, side, region), 2 * start.rate / PARTS * UP
    missing = (sum(fates.missing(part, fate) for part in places) * less for fate in FATES)
    return Found(q.integral(start.density), tuple(missing))


def counted(y: Direction, V: float, leaf: Leaf, start: Start, parts: Sequence[Found]) -> Areas:
    """Return the areas that come to a region, if these are its parts."""
    whole = -q.integral(q.scaled(start.density, -1.0))
    good = (math.fsum(max(0.0, p.area - p.missing[k]) for p in parts) for k in range(len(FATES)))
    less = [max(0.0, whole - area * (1 - TURN)) * UP for area in good] + [0.0]
    seen = [
        q.integral_below(start.density, strobe.excess, 0.0)
        for _, strobe in backwards(y, start.flight, leaf.flights, V)
    ]
    sums = (sum(max(0.0, area - lost) for area in seen) for lost in less)
    return Areas(*(area * (1 - 64 * TURN) for area in sums))
