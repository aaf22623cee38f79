"""Trees of regions of sticks: which states of a box come from which places where masses stick.

The box is the states with |v| < V at the times that are multiples of the period.  A region of
sticks is followed backwards (`cap.cells.backward`); what it gives is a lower bound of the area of
states in the box whose first stick is in the region.

*Text.*  Integers as `cap.cells.listing.written`, a node before its parts:

    0          nothing is counted
    1          the two halves of the times, the earlier one first
    2 d0 d1 d2 the parts below and above an edge: the mean of the two edges, each coefficient
               rounded down to a multiple of 2^-40, and so many times 2^-40 more
    n + 2      at most n flights are followed, n >= 1

The edges of the first region are q = 0 and the multiple of 2^-40 next above -W.  The times of the
first arc are pi/2 + (pi/2 - theta) z, those of the second -pi/2 + (pi/2 - theta) z, z from -1 to 1.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from cap.cells.backward import System
from cap.cells.listing import written
from cap.cells.regions import Limits
from cap.cells.trees import (
    COLUMNS,
    GRAIN,
    GROW,
    HALVES,
    LEAF,
    VALUES,
    Arc,
    Floats,
    Integers,
    Nodes,
    Plan,
    Room,
    Search,
)
from cap.cells.units import BITS, of_ball
from cap.errors import BadInput
from cap.parameters import Parameters
from cap.runner import Runner
from cap.sets import interval
from cap.sets.compiled import PROBE, require_ieee
from cap.sets.doubles import enclosing

PARTS = 16  # of an arc, a power of 2
NODES, DEEP = 1 << 18, 2000  # nodes of a part, regions that wait
FLIGHTS, SIZE = 60, 3.0
WIDEST = 8  # edges are doubles with a bounded error for walls that are not farther apart
FOLLOWED = 2  # plus the flights
STEPS = 30
MORE = np.array([-(2.0**-36), 2.0**-36])  # more than the errors of edges, and of the width

Edge = tuple[int, int, int]
"""In units of 2^-80."""
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Tree:
    """The nodes of an arc (N,), each before its parts, and each as if it was not cut.

    ``places`` (N, 2) bound the places of its sticks, from the wall ahead at the release.  From them
    come states of the area ``areas`` at least; from those in a set of places of the measure m, of
    at most the area m ``weights``.  ``flights`` is the number of the last that gives some of it.
    """

    lowest: int
    kinds: Integers
    edges: Floats
    areas: Floats
    weights: Floats
    flights: Integers
    places: Floats
    sides: Floats
    late: bool

    def spans(self, parts: int) -> Floats:
        """Return bounds of the places over equal parts of the times: (N, parts, 2).

        At each time the measure of a set of places in a region is at most that of its part in these
        bounds: so the mean of that over the parts, times the weight, bounds the area.
        """
        low, high = _range(self.sides[:, :3], parts)[0], _range(self.sides[:, 3:], parts)[1]
        far = self.lowest * 2.0**-80
        ends = (low - far, high - far) if self.late else (-high, -low)
        return np.asarray(np.stack(ends, axis=-1) + MORE, np.float64)

    @cached_property
    def past(self) -> list[int]:
        """The first node after each and its parts."""
        past = list(range(1, len(self.kinds) + 1))
        for n in range(len(past))[::-1]:
            if self.kinds[n] != LEAF:
                past[n] = past[past[n + 1]]
        return past

    def best(self, worths: Floats, price: float) -> Mask:
        """Return which nodes to follow for the most worth, each at a price."""
        alone, past = np.maximum(worths - price, 0.0).tolist(), self.past
        chosen, most = worths > price, list(alone)
        for n in np.flatnonzero(self.kinds != LEAF)[::-1].tolist():
            parts = most[n + 1] + most[past[n + 1]]
            if parts >= alone[n]:
                most[n], chosen[n] = parts, False
        return self._first(chosen)

    def _first(self, chosen: Mask) -> Mask:
        """Return those that are not parts of another one."""
        first, n = np.zeros_like(chosen), 0
        while n < len(chosen):
            first[n] = chosen[n]
            n = self.past[n] if chosen[n] else n + 1
        return first

    def text(self, chosen: Mask) -> str:
        """Return the text in which these nodes are followed; none is a part of another one."""
        return written(self._numbers(chosen))

    def _numbers(self, chosen: Mask) -> Iterator[int]:
        """Give the numbers of the text."""
        before = np.concatenate([[0], np.cumsum(chosen)])
        waiting: list[tuple[Edge, Edge]] = [((self.lowest, 0, 0), (0, 0, 0))]
        n = 0
        while waiting:
            low, high = waiting.pop()
            if chosen[n] or before[n] == before[self.past[n]]:
                yield FOLLOWED + int(self.flights[n]) if chosen[n] else 0
                n = self.past[n]
                continue
            yield int(self.kinds[n])
            if self.kinds[n] == HALVES:
                waiting += [(halved(low, side), halved(high, side)) for side in (1, -1)]
            else:
                new = tuple(int(e / GRAIN) for e in self.edges[n].tolist())
                yield from (e - (a + b >> 41) for e, a, b in zip(new, low, high, strict=True))
                edge = new[0] << 40, new[1] << 40, new[2] << 40
                waiting += [(edge, high), (low, edge)]
            n += 1


def _range(edges: Floats, parts: int) -> tuple[Floats, Floats]:
    """Return bounds of edges (N, 3) over equal parts of [-1, 1]: (N, parts)."""
    half = 1 / parts
    Y = half * (2 * np.arange(parts) + 1) - 1
    a, b, c = (edges[:, k, None] for k in range(3))
    value, far, bend = a + Y * (b + Y * c), np.abs(b + 2 * Y * c) * half, c * half * half
    return value - far + np.minimum(0.0, bend), value + far + np.maximum(0.0, bend)


def halved(e: Edge, side: int) -> Edge:
    """Return an edge over one half of its times, exactly: at most 20 times since it was made."""
    a, b, c = e
    return a + (side * 2 * b + c) // 4, (b + side * c) // 2, c // 4


def dearest(trees: Sequence[Tree], worths: Sequence[Floats], most: int) -> float:
    """Return a price, nearly the least, at which at most so many nodes are followed."""
    low, high = 0.0, max(float(np.max(worth)) for worth in worths)
    for _ in range(STEPS):
        price = 0.5 * (low + high)
        count = sum(np.sum(t.best(w, price)) for t, w in zip(trees, worths, strict=True))
        low, high = (price, high) if count > most else (low, price)
    return high


def search(p: Parameters, V: Fraction, plan: Plan, runner: Runner) -> tuple[Tree, Tree]:
    """Return trees for both arcs."""
    width = (p.r - p.l) * p.omega**2 / p.F
    if not (p.e == 1 and p.mu == 0 and p.f > 0 and width < WIDEST):
        raise BadInput(f"sticks are followed for e = 1, mu = 0, and walls nearer than {WIDEST}")
    y, fast = system_of(p), float(V * p.omega / p.F)
    limits = Limits(fast - abs(fast) * 2.0**-52, FLIGHTS, SIZE)
    tasks = [(middle, k) for middle in (math.pi / 2, -math.pi / 2) for k in range(PARTS)]
    parts = runner.map(partial(_grown, y, limits, plan), tasks, "sticks")
    first, second = joined(parts[:PARTS]), joined(parts[PARTS:])
    far, more = float(width), 2.0**-40
    return (
        _tree(width, first, -first.values[:, 4:2:-1], late=False),
        _tree(width, second, second.values[:, 3:5] + (far - more, far + more), late=True),
    )


def system_of(p: Parameters) -> System:
    """Return the constants, enclosed."""
    a, width = p.f / p.F, (p.r - p.l) * p.omega**2 / p.F
    with interval.workprec(BITS):
        ratio = interval.ball(a)
        theta = interval.pi() - ratio.acos()
        sine = ((1 - ratio) * (1 + ratio)).sqrt()
        found = enclosing(a), enclosing(width), of_ball(theta), of_ball(sine)
    return System(*(end for q in found for end in (q.mid, q.rad)))


def bottom(width: Fraction) -> int:
    """Return the constant of the lowest edge in units of 2^-80."""
    return -(width * 2**40 // 1) << 40


def _tree(width: Fraction, nodes: Nodes, places: Floats, *, late: bool) -> Tree:
    """Return a tree."""
    areas, weights, last = nodes.values[:, 0], nodes.values[:, 1], nodes.values[:, 2]
    found = areas, weights, last.astype(np.int64), places, nodes.values[:, 5:]
    return Tree(bottom(width), nodes.kinds, nodes.edges, *found, late)


def joined(parts: Sequence[Nodes]) -> Nodes:
    """Return the nodes of an arc, from those of its parts, after those that halve it."""
    arrays: list[Nodes] = []
    for n, part in enumerate(parts):
        whole = empty((n & -n if n else len(parts)).bit_length() - 1)
        whole.kinds[:] = HALVES
        arrays += [whole, part]
    return Nodes(*(np.concatenate(each) for each in zip(*arrays, strict=True)))


def _grown(y: System, limits: Limits, plan: Plan, task: tuple[float, int]) -> Nodes:
    """Return the nodes of a part of an arc."""
    middle, k = task
    room = Room(PROBE, np.zeros((DEEP, COLUMNS)), np.zeros((4, COLUMNS)))
    lowest = math.ceil(-y.width / GRAIN) * GRAIN
    room.stack[0, :8] = lowest, 0, 0, 0, 0, 0, (2 * k + 1) / PARTS - 1, 1 / PARTS
    nodes = empty(NODES)
    arc = Arc(middle, y.theta - 0.5 * math.pi)
    count = GROW(Search(y, arc, limits, plan), room, nodes)
    require_ieee(count >= 0)
    return Nodes(
        nodes.kinds[:count].copy(), nodes.edges[:count].copy(), nodes.values[:count].copy()
    )


def empty(n: int) -> Nodes:
    """Return room for nodes."""
    return Nodes(np.zeros(n, np.int64), np.zeros((n, 3)), np.zeros((n, VALUES)))
