"""Compiled: regions of stops, cut until what they give is nearly what there is.

At first they are cut for what is seen backwards (`cap.areas.folded.regions`); where that is enough,
for what becomes of them forwards (`cap.areas.folded.ahead`).

A part of an arc of times is cut into regions: in halves of its times, or by an edge.  Edges are
made as multiples of `GRAIN`, exactly.  The double of an edge over a half of its times is wrong by a
few roundings for each halving: with coefficients below 8 and h = 2^-53, the first by at most 16 h
and half the error of the second, and that by at most 8 h and half of itself.  After 20 halvings the
edge is wrong by less than 20 (16 + 8) h + 16 h < 2^-44 = `cap.areas.folded.regions.EDGE`.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.folded.ahead import foreseen
from cap.areas.folded.backward import Constants
from cap.areas.folded.contraction import hoped
from cap.areas.folded.edges import Look, edge, mirrored, reversed_times
from cap.areas.folded.fates import Ahead
from cap.areas.folded.regions import EDGE, Edge, Limits, Region, followed, measure
from cap.checker.folded.ahead import EVENTS
from cap.sets.compiled import IEEE, kernel, rounds_to_nearest, sources
from cap.sets.kept import kept

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

GRAIN = 2.0**-40
SHORTEST = 2.0**-20  # of an arc
LEAF, HALVES, CUT = 0, 1, 2
COLUMNS, VALUES = 21, 15
_AREA, _WEIGHT, _FLIGHTS, _ACROSS, _ALONG, _STROBES, _MEASURE, _FATED, _EXCESS, _BELOW = (
    *range(8, 16),
    19,
    20,
)
AHEAD = 0.3  # the ratio of a plan, for what is followed forwards
EQUAL = 0.02  # part of the gain by a cut that another one must have less


class Plan(NamedTuple):
    """How regions are cut: as long as ``worth`` is missing of the area of so many strobes.

    If both cuts gain as much, a region is halved if it is longer than ``ratio`` times what it is
    wide, at its end; edges are more curved than the mean of their neighbours by at most ``curved``
    times their distance.  From ``points`` of a region, in each direction, orbits tell what to hope
    for.  Forwards, as long as ``onwards`` is missing of the area with a fate; if it is infinite,
    nothing is followed forwards.
    """

    worth: float = 1e-4
    strobes: int = 12
    ratio: float = 1.5
    curved: float = 1.0
    points: int = 2
    onwards: float = math.inf

    def backwards(self) -> "Plan":
        """Return the same, where nothing is followed forwards."""
        return self._replace(onwards=math.inf)


class Arc(NamedTuple):
    """Times middle + half z, up to rounding."""

    middle: float
    half: float


class Search(NamedTuple):
    """What is searched, and how."""

    system: Constants
    ahead: Ahead
    arc: Arc
    limits: Limits
    plan: Plan


class Nodes(NamedTuple):
    """Nodes of a tree (N,), each before its parts.

    ``kinds`` (N,): see above; ``edges`` (N, 3) of cuts; ``values`` (N, 15), as if nothing was cut:
    the area, the weight and the flights of `cap.areas.folded.regions.Seen`, both edges, the
    strobes, a lower bound of the measure, those of what has each fate, and an upper bound of it.
    """

    kinds: Integers
    edges: Floats
    values: Floats


class Room(NamedTuple):
    """`PROBE`, and room for regions that wait, and those that are tried."""

    probe: Floats
    stack: Floats
    tried: Floats


@kernel
def lowest(e: Edge) -> float:
    """Return the least value of an edge, nearly."""
    e0, e1, e2 = e
    if e2 > 0 and abs(e1) < 2 * e2:
        return e0 - e1 * e1 / (4 * e2)
    return e0 - abs(e1) + e2


@kernel
def apart(low: Edge, high: Edge) -> bool:
    """Return whether an edge is certain to be above another."""
    gap = high[0] - low[0], high[1] - low[1], high[2] - low[2]
    return lowest(gap) > 4 * EDGE


@kernel
def grained(e: Edge) -> Edge:
    """Return an edge next to this one with multiples of `GRAIN`."""
    a, b, c = np.rint(e[0] / GRAIN), np.rint(e[1] / GRAIN), np.rint(e[2] / GRAIN)
    return a * GRAIN, b * GRAIN, c * GRAIN


@kernel
def _region(arc: Arc, row: Floats) -> Region:
    """Return the region of a row: two edges, and the middle and half of its times in the arc."""
    low, high = (row[0], row[1], row[2]), (row[3], row[4], row[5])
    return Region(low, high, arc.middle + arc.half * row[6], arc.half * row[7])


@kernel
def _write(row: Floats, low: Edge, high: Edge, middle: float, half: float) -> None:
    """Write the region of a row."""
    row[0], row[1], row[2] = low
    row[3], row[4], row[5] = high
    row[6], row[7] = middle, half


@kernel
def _see(search: Search, row: Floats, flights: int) -> float:
    """Follow the region of a row, and write what is seen; return how much that is worth.

    If something is above it that is followed backwards, it is followed forwards.
    """
    if row[_BELOW] > 0:
        _foresee(search, row)
        return float(row[_FATED + 2])
    limits = Limits(search.limits.V, min(flights, search.limits.flights), search.limits.size)
    seen = followed(search.system, _region(search.arc, row), limits)
    row[_AREA], row[_WEIGHT], row[_FLIGHTS] = seen.area, seen.weight, float(seen.flights)
    row[_ACROSS], row[_ALONG], row[_STROBES] = seen.across, seen.along, float(seen.strobes)
    return seen.area


@kernel
def _foresee(search: Search, row: Floats) -> None:
    """Follow the region of a row forwards, and write what is seen."""
    r = _region(search.arc, row)
    mu, most = measure(search.system, r)
    found = foreseen(search.ahead, reversed_times(r), mu, EVENTS, search.limits.size)
    row[_MEASURE], row[_FATED + 3], row[_EXCESS] = mu, most, found.excess
    row[_FATED], row[_FATED + 1], row[_FATED + 2] = found.attractor, found.segment, found.either
    if row[_BELOW] > 0:
        row[_AREA], row[_WEIGHT], row[_FLIGHTS], row[_STROBES] = 0.0, 0.0, 0.0, 0.0
        row[_ACROSS], row[_ALONG] = found.across, found.along


@kernel
def halved(e: Edge, side: float) -> Edge:
    """Return an edge over one half of its times."""
    half = 0.5 * e[1]
    return e[0] + side * half + 0.25 * e[2], half + side * 0.5 * e[2], 0.25 * e[2]


@kernel
def _halve(search: Search, row: Floats, flights: int, tried: Floats) -> float:
    """Write the halves of a region, the later one first, and return what they are worth."""
    middle, half, worth = row[6], 0.5 * row[7], 0.0
    r = _region(search.arc, row)
    for i in range(2):
        side = 1.0 - 2.0 * i
        low, high = halved(r.low, side), halved(r.high, side)
        _write(tried[i], low, high, middle + side * half, half)
        tried[i, _BELOW] = row[_BELOW]
        worth += _see(search, tried[i], flights)
    return worth


@kernel
def _cut(search: Search, row: Floats, new: Edge, flights: int, tried: Floats) -> float:
    """Write the parts of a region above and below an edge, and return what they are worth."""
    r = _region(search.arc, row)
    _write(tried[2], new, r.high, row[6], row[7])
    _write(tried[3], r.low, new, row[6], row[7])
    tried[2, _BELOW], tried[3, _BELOW] = row[_BELOW], row[_BELOW]
    return _see(search, tried[2], flights) + _see(search, tried[3], flights)


@kernel
def _note(nodes: Nodes, n: int, row: Floats) -> None:
    """Write the values of a node."""
    values = nodes.values[n]
    values[0], values[1], values[2] = row[_AREA], row[_WEIGHT], row[_FLIGHTS]
    for i in range(6):
        values[3 + i], values[9 + i] = row[i], row[_STROBES + i]


@kernel
def _new_edge(search: Search, r: Region, forwards: bool) -> Edge:
    """Return an edge by which a region is cut."""
    look = Look(forwards, search.limits.V, search.plan.strobes, search.plan.curved)
    if forwards:
        return mirrored(edge(search.ahead.flow, look, reversed_times(r)))
    return edge(search.system, look, r)


@kernel
def _divide(search: Search, row: Floats, flights: int, tried: Floats, made: Floats) -> int:
    """Cut a region in the way that gains most: 0 or 2, the first row of its parts, or -1."""
    plan, r, forwards = search.plan, _region(search.arc, row), row[_BELOW] > 0
    new = grained(_new_edge(search, r, forwards))
    made[0], made[1], made[2] = new
    cuts, halves = apart(r.low, new) and apart(new, r.high), row[7] > SHORTEST
    by_cut = _cut(search, row, new, flights, tried) if cuts else -1.0
    by_halves = _halve(search, row, flights, tried) if halves else -1.0
    if not (cuts or halves):
        return -1
    little = EQUAL * (plan.onwards / row[_BELOW] if forwards else plan.worth)
    if cuts and halves and abs(by_halves - by_cut) <= little:
        return 0 if row[_ALONG] > (AHEAD if forwards else plan.ratio) * row[_ACROSS] else 2
    return 0 if by_halves > by_cut else 2


@kernel
def _wanting(search: Search, row: Floats) -> tuple[bool, int]:
    """Return whether a region is to be cut, and how many flights its parts are followed over."""
    plan, V, flights = search.plan, search.limits.V, 0
    if row[_BELOW] == 0:
        r = _region(search.arc, row)
        hope, flights = hoped(search.system, r, V, plan.strobes, plan.points)
        if plan.onwards < math.inf:
            _foresee(search, row)
        if hope - row[_AREA] > plan.worth:
            return True, flights + 1
        row[_BELOW] = row[_STROBES]
    return row[_BELOW] * row[_EXCESS] > plan.onwards, flights


def _grow(search: Search, memory: Room, nodes: Nodes) -> int:
    """Write the nodes of the tree below the region in the first row of a stack.

    Return how many; -1 if the processor does not round as it should.
    """
    stack, tried = memory.stack, memory.tried
    if not rounds_to_nearest(memory.probe):
        return -1
    k, n, room = 0, 0, len(nodes.kinds)
    _see(search, stack[0], search.limits.flights)
    while k >= 0:
        row, first = stack[k], -1
        wanting, flights = _wanting(search, row)
        _note(nodes, n, row)
        full = n + k + 3 > room or k + 2 > len(stack)
        if wanting and not full:
            first = _divide(search, row, flights, tried, nodes.edges[n])
        if first < 0:
            nodes.kinds[n], k = LEAF, k - 1
        else:
            nodes.kinds[n] = HALVES if first == 0 else CUT
            for i in range(COLUMNS):
                stack[k, i], stack[k + 1, i] = tried[first, i], tried[first + 1, i]
            k += 1
        n += 1
    return n


GROW = kept(_grow, sources(), **IEEE)
