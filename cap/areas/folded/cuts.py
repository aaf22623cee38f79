"""Trees of regions as arrays, the choice of those that are followed, and their text.

*Text.*  Integers as `cap.areas.listing.written`, a node before its parts:

    0          nothing is counted
    1          the two halves Y < 0 and Y > 0, the first one first
    2 d0 d1 d2 the parts below and above an edge: the mean of the two edges, each coefficient
               rounded down to a multiple of 2^-40, and so many times 2^-40 more
    n + 2      at most n flights are followed backwards, n >= 1

Of a region of turns that is followed backwards, parts are followed forwards.  It is followed by a
tree of its own, with 0, 1, and 2 as before, and

    3          followed forwards
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cap.areas.folded.choice import Mask, choose, ends
from cap.areas.folded.trees import (
    COLUMNS,
    GRAIN,
    GROW,
    HALVES,
    VALUES,
    Floats,
    Integers,
    Nodes,
    Room,
    Search,
)
from cap.areas.listing import written
from cap.sets.compiled import PROBE, require_ieee

PARTS = 16  # of an arc, a power of 2
NODES, DEEP = 1 << 18, 2000  # nodes of a part, regions that wait
FOLLOWED, ONWARDS = 2, 3  # plus the flights; forwards
STEPS, LOWEST = 22, 1e-9  # of a search for a price; of the highest one
UNIT = 2.0**-80

Edge = tuple[int, int, int]
"""In units of 2^-80."""
Edges = tuple[Edge, Edge]


@dataclass(frozen=True)
class Tree:
    """The nodes of a region (N,), each before its parts, and each as if it was not cut.

    ``root`` are the edges of the whole.  From a node come states of the area ``areas`` at least;
    ``flights`` is the number of the last that gives some of it.
    """

    root: Edges
    kinds: Integers
    edges: Floats
    areas: Floats
    flights: Integers

    @cached_property
    def _past(self) -> Integers:
        past = np.empty(len(self.kinds), np.int64)
        ends(self.kinds, past)
        return past

    @cached_property
    def past(self) -> list[int]:
        """The first node after each and its parts."""
        past: list[int] = self._past.tolist()
        return past

    def best(self, worths: Floats, price: float) -> Mask:
        """Return which nodes to follow for the most worth, each at a price."""
        chosen = np.empty(len(self.kinds), np.bool_)
        choose(self.kinds, self._past, np.asarray(worths, np.float64), price, chosen)
        return chosen

    def text(self, chosen: Mask, parts: Mask | None = None) -> str:
        """Return the text in which these nodes are followed; none is a part of another one.

        Of each of them those of the ``parts``, if there are any, are followed forwards.
        """

        def inside(n: int, edges: Edges) -> Iterator[int]:
            yield FOLLOWED + int(self.flights[n])
            if parts is not None:
                yield from self._numbers(parts, (n, edges), lambda _n, _edges: (ONWARDS,))

        return written(self._numbers(chosen, (0, self.root), inside))

    def _numbers(
        self,
        chosen: Mask,
        begin: tuple[int, Edges],
        inside: Callable[[int, Edges], Iterable[int]],
    ) -> Iterator[int]:
        """Give the numbers for the nodes below one with these edges; ``inside`` of chosen ones."""
        n, past = begin[0], self.past[begin[0]]
        before = np.concatenate([[0], np.cumsum(chosen[n:past])])
        first, waiting = n, [begin[1]]
        while waiting:
            low, high = waiting.pop()
            if chosen[n] or before[n - first] == before[self.past[n] - first]:
                yield from inside(n, (low, high)) if chosen[n] else (0,)
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


def halved(e: Edge, side: int) -> Edge:
    """Return an edge over one half of its times, exactly: at most 20 times since it was made."""
    a, b, c = e
    return a + (side * 2 * b + c) // 4, (b + side * c) // 2, c // 4


def dearest(trees: Sequence[Tree], worths: Sequence[Floats], most: int) -> float:
    """Return a price, nearly the least, at which at most so many nodes are followed."""
    return _price(trees, worths, lambda count, _worth: count > most)[1]


def cheapest(trees: Sequence[Tree], worths: Sequence[Floats], enough: float) -> float:
    """Return a price, nearly the greatest, at which the nodes that are followed are worth enough.

    If that is none, almost 0.
    """
    return _price(trees, worths, lambda _count, worth: worth >= enough)[0]


def _price(
    trees: Sequence[Tree], worths: Sequence[Floats], low_at: Callable[[int, float], bool]
) -> tuple[float, float]:
    """Return prices next to each other: the lower one is too low, the other is not."""
    high = max(float(np.max(worth)) for worth in worths)
    low = LOWEST * high
    for _ in range(STEPS):
        price, count, worth = math.sqrt(low * high), 0, 0.0
        for tree, w in zip(trees, worths, strict=True):
            chosen = tree.best(w, price)
            count, worth = count + int(np.sum(chosen)), worth + float(np.sum(w[chosen]))
        low, high = (price, high) if low_at(count, worth) else (low, price)
    return low, high


def joined(parts: Sequence[Nodes]) -> Nodes:
    """Return the nodes of an arc, from those of its parts, after those that halve it."""
    arrays: list[Nodes] = []
    for n, part in enumerate(parts):
        whole = empty((n & -n if n else len(parts)).bit_length() - 1)
        whole.kinds[:] = HALVES
        arrays += [whole, part]
    return Nodes(*(np.concatenate(each) for each in zip(*arrays, strict=True)))


def grown(search: Search, root: Edges, k: int) -> Nodes:
    """Return the nodes of one of the `PARTS` of a region, whose edges are no parabolas."""
    room = Room(PROBE, np.zeros((DEEP, COLUMNS)), np.zeros((4, COLUMNS)))
    middle = (2 * k + 1) / PARTS - 1
    for i, (a, b, _) in enumerate(root):
        slope = b * UNIT
        room.stack[0, 3 * i : 3 * i + 2] = a * UNIT + slope * middle, slope / PARTS
    room.stack[0, 6:8] = middle, 1 / PARTS
    nodes = empty(NODES)
    count = GROW(search, room, nodes)
    require_ieee(count >= 0)
    return Nodes(
        nodes.kinds[:count].copy(), nodes.edges[:count].copy(), nodes.values[:count].copy()
    )


def empty(n: int) -> Nodes:
    """Return room for nodes."""
    return Nodes(np.zeros(n, np.int64), np.zeros((n, 3)), np.zeros((n, VALUES)))
