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
from functools import partial

import numpy as np

from cap.cells.backward import System
from cap.cells.listing import written
from cap.cells.regions import Limits
from cap.cells.trees import COLUMNS, CUT, GRAIN, GROW, HALVES, LEAF, Arc, Nodes, Plan, Room
from cap.cells.units import BITS, of_ball
from cap.errors import BadInput
from cap.parameters import Parameters
from cap.runner import Runner
from cap.sets import interval
from cap.sets.compiled import PROBE, require_ieee
from cap.sets.doubles import enclosing

PARTS = 16  # of an arc, a power of 2
NODES, DEEP = 1 << 18, 2000  # nodes of a part, regions that wait
FLIGHTS, SIZE = 60, 0.7
WIDEST = 8  # edges are doubles with a bounded error for walls that are not farther apart

Edge = tuple[int, int, int]
"""In units of 2^-80."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """A region that is followed: bounds of the places of its sticks, from the wall ahead.

    From it come states of the area ``area`` at least; at most ``weight`` times the measure of a set
    of places comes from them.
    """

    place: tuple[float, float]
    area: float
    weight: float
    flights: int


@dataclass(frozen=True, slots=True)
class Tree:
    """The regions of an arc: its parts, the earliest first; ``width`` is that of the walls."""

    second: bool
    width: Fraction
    parts: Sequence[Nodes]

    def leaves(self) -> Iterator[Leaf]:
        """Give the leaves that count, in the order of the text."""
        far, more = (float(self.width), 2.0**-40) if self.second else (0.0, 0.0)
        for part in self.parts:
            for k in np.flatnonzero(part.kinds > LEAF):
                area, weight, low, high = part.values[k].tolist()
                place = (far + low - more, far + high + more) if self.second else (-high, -low)
                yield Leaf(place, area, weight, int(part.kinds[k]) - LEAF)

    def text(self, kept: Sequence[bool]) -> str:
        """Return the text; of the leaves that count only those ``kept`` do."""
        return written(pruned(list(self._numbers(kept))))

    def _numbers(self, kept: Sequence[bool]) -> Iterator[list[int]]:
        """Give the numbers of the nodes."""
        counted = iter(kept)
        for n, part in enumerate(self.parts):
            yield from ([HALVES] for _ in range(_begun(n)))
            yield from _numbers(part, bottom(self.width), counted)


def _begun(n: int) -> int:
    """Return how many halvings begin with a part: those whose first part it is."""
    return (n & -n).bit_length() - 1 if n else PARTS.bit_length() - 1


def _numbers(part: Nodes, lowest: int, kept: Iterator[bool]) -> Iterator[list[int]]:
    """Give the numbers of the nodes of a part of an arc."""
    waiting: list[tuple[Edge, Edge]] = [((lowest, 0, 0), (0, 0, 0))]
    for kind, made in zip(part.kinds.tolist(), part.edges.tolist(), strict=True):
        low, high = waiting.pop()
        if kind == HALVES:
            yield [HALVES]
            waiting += [(halved(low, side), halved(high, side)) for side in (1, -1)]
        elif kind == CUT:
            edge = tuple(int(e / GRAIN) for e in made)
            mean = ((a + b) >> 41 for a, b in zip(low, high, strict=True))
            yield [CUT, *(e - m for e, m in zip(edge, mean, strict=True))]
            a, b, c = (e << 40 for e in edge)
            waiting += [((a, b, c), high), (low, (a, b, c))]
        else:
            yield [kind if kind and next(kept) else 0]


def halved(e: Edge, side: int) -> Edge:
    """Return an edge over one half of its times, exactly: at most 20 times since it was made."""
    a, b, c = e
    return a + (side * 2 * b + c) // 4, (b + side * c) // 2, c // 4


def pruned(nodes: list[list[int]]) -> Iterator[int]:
    """Give the numbers of a tree in which nothing is cut of which nothing counts."""
    built: list[list[int]] = []
    for node in reversed(nodes):
        if node[0] in (HALVES, CUT):
            first, second = built.pop(), built.pop()
            built.append([0] if first == second == [0] else node + first + second)
        else:
            built.append(node)
    (numbers,) = built
    return iter(numbers)


def bottom(width: Fraction) -> int:
    """Return the lowest edge in units of 2^-80."""
    return -(width * 2**40 // 1) << 40


def system_of(p: Parameters) -> System:
    """Return the constants, enclosed."""
    a = p.f / p.F
    with interval.workprec(BITS):
        ratio = interval.ball(a)
        theta = interval.pi() - ratio.acos()
        sine = ((1 - ratio) * (1 + ratio)).sqrt()
        balls = enclosing(a), enclosing(width_of(p)), of_ball(theta), of_ball(sine)
    return System(*(end for q in balls for end in (q.mid, q.rad)))


def width_of(p: Parameters) -> Fraction:
    """Return the distance of the walls in units of F/ω²."""
    return (p.r - p.l) * p.omega**2 / p.F


def search(p: Parameters, V: Fraction, plan: Plan, runner: Runner) -> tuple[Tree, Tree]:
    """Return trees for both arcs."""
    width = width_of(p)
    if not (p.e == 1 and p.mu == 0 and p.f > 0 and width < WIDEST):
        raise BadInput(f"sticks are followed for e = 1, mu = 0, and walls nearer than {WIDEST}")
    y, fast = system_of(p), float(V * p.omega / p.F)
    limits = Limits(fast - abs(fast) * 2.0**-52, FLIGHTS, SIZE)
    tasks = [(second, k) for second in (False, True) for k in range(PARTS)]
    grown = runner.map(partial(_grown, y, limits, plan, bottom(width)), tasks, "sticks")
    return Tree(False, width, grown[:PARTS]), Tree(True, width, grown[PARTS:])


def _grown(y: System, limits: Limits, plan: Plan, lowest: int, task: tuple[bool, int]) -> Nodes:
    """Return the nodes of a part of an arc."""
    second, k = task
    middle = -0.5 * math.pi if second else 0.5 * math.pi
    arc = Arc(middle, y.theta - 0.5 * math.pi)
    nodes, stack = empty(NODES), np.zeros((DEEP, COLUMNS))
    stack[0] = lowest * 2.0**-80, 0, 0, 0, 0, 0, (2 * k + 1) / PARTS - 1, 1 / PARTS
    count = GROW(y, arc, limits, plan, Room(PROBE, stack), nodes)
    require_ieee(count >= 0)
    return Nodes(
        nodes.kinds[:count].copy(), nodes.edges[:count].copy(), nodes.values[:count].copy()
    )


def empty(n: int) -> Nodes:
    """Return room for nodes."""
    return Nodes(np.zeros(n, np.int64), np.zeros((n, 3)), np.zeros((n, 4)))
