"""Compiled: regions of sticks, cut until what they give is nearly what there is.

A part of an arc of times is cut into regions: in halves of its times, or by an edge.  Edges are
made as multiples of `GRAIN`, exactly.  The double of an edge over a half of its times is wrong by a
few roundings for each halving: with coefficients below 8 and h = 2^-53, the first by at most 16 h
and half the error of the second, and that by at most 8 h and half of itself.  After 20 halvings the
edge is wrong by less than 20 (16 + 8) h + 16 h < 2^-44 = `cap.cells.regions.EDGE`.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.cells.backward import System
from cap.cells.contraction import edge, hoped
from cap.cells.regions import EDGE, Edge, Limits, Region, Seen, followed
from cap.sets.compiled import IEEE, kernel, rounds_to_nearest, sources
from cap.sets.kept import kept

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

GRAIN = 2.0**-40
SHORTEST = 2.0**-20  # of an arc
HALVES, CUT, LEAF = 1, 2, 2  # what is written of a node; of a leaf LEAF and the flights
COLUMNS = 8


class Plan(NamedTuple):
    """How regions are cut: as long as ``worth`` is missing of the area of so many strobes.

    A region is halved if it is longer than ``ratio`` times what it is wide, at its end; edges are
    more curved than the mean of their neighbours by at most ``curved`` times their distance.
    """

    worth: float = 1e-4
    strobes: int = 10
    ratio: float = 1.5
    curved: float = 0.1


class Arc(NamedTuple):
    """Times middle + half z, up to rounding."""

    middle: float
    half: float


class Nodes(NamedTuple):
    """Nodes of a tree (N,), each before its parts.

    ``kinds`` (N,): see `cap.cells.sticks`; ``edges`` (N, 3) of cuts; ``values`` (N, 4) of leaves:
    the area and the weight of `cap.cells.regions.Seen`, and bounds of q.
    """

    kinds: Integers
    edges: Floats
    values: Floats


class Room(NamedTuple):
    """`PROBE`, and room for regions that wait."""

    probe: Floats
    stack: Floats


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
    """Write a row."""
    row[0], row[1], row[2] = low
    row[3], row[4], row[5] = high
    row[6], row[7] = middle, half


@kernel
def halved(e: Edge, side: float) -> Edge:
    """Return an edge over one half of its times."""
    half = 0.5 * e[1]
    return e[0] + side * half + 0.25 * e[2], half + side * 0.5 * e[2], 0.25 * e[2]


@kernel
def _halve(r: Region, stack: Floats, k: int) -> None:
    """Write the halves of a region over its row, the earlier one above the other."""
    middle, half = stack[k, 6], 0.5 * stack[k, 7]
    for i in range(2):
        side = 1.0 - 2.0 * i
        low, high = halved(r.low, side), halved(r.high, side)
        _write(stack[k + i], low, high, middle + side * half, half)


@kernel
def _leaf(nodes: Nodes, n: int, r: Region, seen: Seen) -> None:
    """Write a leaf."""
    nodes.kinds[n] = LEAF + seen.flights if seen.area > 0 else 0
    (a, b, c), more, row = r.high, 4 * EDGE, nodes.values[n]
    row[0], row[1] = seen.area, seen.weight
    row[2], row[3] = lowest(r.low) - more, more - lowest((-a, -b, -c))


def _grow(y: System, arc: Arc, limits: Limits, plan: Plan, memory: Room, nodes: Nodes) -> int:
    """Write the nodes of the tree below the region in the first row of a stack.

    Return how many; -1 if the processor does not round as it should.
    """
    stack = memory.stack
    if not rounds_to_nearest(memory.probe):
        return -1
    k, n, room = 0, 0, len(nodes.kinds)
    while k >= 0:
        r = _region(arc, stack[k])
        seen = followed(y, r, limits)
        short = n + k + 3 > room or k + 2 > len(stack) or not stack[k, 7] > SHORTEST
        if short or not hoped(y, r, limits, plan.strobes) - seen.area > plan.worth:
            _leaf(nodes, n, r, seen)
            n, k = n + 1, k - 1
            continue
        cut = seen.across * plan.ratio >= seen.along
        new = grained(edge(y, r, limits, plan.strobes, plan.curved))
        if cut and apart(r.low, new) and apart(new, r.high):
            nodes.kinds[n] = CUT
            made = nodes.edges[n]
            made[0], made[1], made[2] = new
            middle, half = stack[k, 6], stack[k, 7]
            _write(stack[k], new, r.high, middle, half)
            _write(stack[k + 1], r.low, new, middle, half)
        else:
            nodes.kinds[n] = HALVES
            _halve(r, stack, k)
        n, k = n + 1, k + 1
    return n


GROW = kept(_grow, sources(), **IEEE)
