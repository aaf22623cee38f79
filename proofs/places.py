"""The tree of places that the checker is asked to follow: see `cap.checker.folded.tree`.

Nodes are halved where `cap.areas.folded.next_releases` does not follow them, as long as they are
worth it. A node is worth its length times a weight: how much measure it leaves undecided, with all
that comes there later.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cap.areas.folded.backward import Constants
from cap.areas.folded.constants import system_of
from cap.areas.folded.next_releases import HELD, next_releases
from cap.areas.folded.paths import LOST
from cap.checker.folded.basins import Basins
from cap.checker.folded.masses import Places
from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import Node, Piece, Portion
from cap.checker.folded.tree import DEEPEST, FOLLOWED, HALVED, NOTHING
from cap.checker.kernel import line
from cap.parameters import Parameters

LEVEL, COARSE = 23, 18  # of portions, at last and while weights are found
# level of nodes that are followed at any rate; larger ones, if it is well known where to
GRAIN = 24
FIRST = 6  # the tree begins with 2^6 nodes
# parts of W, times weights, that are left undecided rather than follow one more node
WORTHS = (1e-5, 4e-6, 2e-6, 1e-6, 4e-7)
MOST = 60_000  # gaps are halved at once: where there are more, orbits do not come to sticks
TOLERANCE = 0.02  # errors of the next place, as a part of its range in a node of the level `GRAIN`
PASSES = 12  # in which weights are found
TINY = 1e-13  # an error that does not matter
BEYOND = 1e-4  # part of a node by which more is followed: so the checker follows the node, too

Floats = NDArray[np.float64]
Roots = dict[Node, float]
"""Nodes with their weights."""


@dataclass
class Search:
    """The tree as far as it is found: pieces that are followed, and nodes that are not."""

    p: Parameters
    basins: Basins
    kept: Sequence[Pair]
    width: float
    tell: Callable[[str, float], None] = lambda _words, _part: None
    pieces: dict[Node, Piece] = field(default_factory=dict)
    gaps: set[Node] = field(default_factory=set)

    @cached_property
    def system(self) -> Constants:
        """The constants."""
        return system_of(self.p, forwards=True)

    def run(self, worths: Sequence[float]) -> str:
        """Return the tree, in letters; worths are tried as long as there are few gaps."""
        self.grow({Node(k, FIRST): 1.0 for k in range(1 << FIRST)}, worths[0])
        for k, worth in enumerate(worths):
            self.tell("places are followed to their release", k / len(worths))
            gaps = sorted(node for node in self.gaps if node.m < DEEPEST)
            weights = self.weights(self.places(COARSE), self.ends(gaps).mean(axis=1)).tolist()
            chosen = {
                node: weight
                for node, weight in zip(gaps, weights, strict=True)
                if weight * 2.0**-node.m > worth
            }
            if len(chosen) > MOST:
                break
            self.gaps -= chosen.keys()
            self.grow(halves(chosen), worth)
        return self.letters()

    def ends(self, nodes: Sequence[Node]) -> Floats:
        """Return the ends of nodes (N, 2)."""
        return np.array([node.ends(self.width) for node in nodes], np.float64).reshape(-1, 2)

    # growing

    def grow(self, todo: Roots, worth: float) -> None:
        """Grow trees from nodes: one is not worth more than ``worth``."""
        while todo:
            todo = {node: weight for node, weight in todo.items() if not self.inside(node)}
            mixed: Roots = {}
            for node, piece in self.tried(list(todo)):
                spent = todo[node] * 2.0**-node.m <= worth or node.m == DEEPEST
                if piece is not None and (spent or self.fine(piece)):
                    self.pieces[node] = piece
                elif spent:
                    self.gaps.add(node)
                else:
                    mixed[node] = todo[node]
            todo = halves(mixed)

    def inside(self, node: Node) -> bool:
        """Return whether a node is attracted anyway."""
        low, high = node.ends(self.width)
        return any(a <= low and high <= b for a, b in self.kept)

    def tried(self, nodes: Sequence[Node]) -> list[tuple[Node, Piece | None]]:
        """Return nodes with pieces, where they are followed."""
        ends = self.ends(nodes)
        beyond = np.diff(ends) * BEYOND * np.array([-1, 1])
        sure = next_releases(self.system, self.basins, ends + beyond).kinds != LOST
        found = next_releases(self.system, self.basins, ends[sure])
        pieces = dict[Node, Piece]()
        for n, kind, model in zip(np.flatnonzero(sure).tolist(), *found, strict=True):
            after = tuple(model[:-1].tolist()), float(model[-1])
            if kind != LOST:
                pieces[nodes[n]] = Piece(nodes[n], int(kind) - HELD if kind > HELD else after)
        return [(node, pieces.get(node)) for node in nodes]

    def fine(self, piece: Piece) -> bool:
        """Return whether the next places are known well, from a node of the level `GRAIN`."""
        node, after = piece
        if isinstance(after, int) or node.m >= GRAIN:
            return True
        low, high = line.ends(after)
        grain = 2.0 ** (node.m - GRAIN)
        sharp = after[1] <= TOLERANCE * grain * line.rest(line.exact(after))
        return sharp or after[1] < TINY or any(a < low and high < b for a, b in self.kept)

    # what is known

    def places(self, level: int) -> Places:
        """Return what is known of all places, with portions down to a level."""
        order = sorted(self.pieces, key=lambda node: node.k * 2.0**-node.m)
        return Places(self.kept, self.width, level, [self.pieces[node] for node in order])

    def weights(self, places: Places, at: Floats) -> Floats:
        """Return weights at places: 1, and those of the places that come there next."""
        ends = np.array(places.ends)
        passes = [(n, q.image, q.c) for n, q in enumerate(places.parts) if isinstance(q, Portion)]
        if not passes:
            return np.ones(len(at))
        numbers, images, slopes = map(np.array, zip(*passes, strict=True))
        borders, jumps = images.T.ravel(), np.concatenate([1 / slopes, -1 / slopes])
        order = np.argsort(borders)
        middles = (ends[:-1] + ends[1:])[numbers] / 2
        weights = np.ones(len(numbers))

        def after(x: Floats) -> Floats:
            steps = np.concatenate([[0.0], np.cumsum((np.tile(weights, 2) * jumps)[order])])
            return np.asarray(1 + steps[np.searchsorted(borders[order], x)], np.float64)

        for _ in range(PASSES):
            weights = after(middles)
        return after(at)

    def letters(self) -> str:
        """Return the tree."""
        inner = {Node(n.k >> j, n.m - j) for n in self.pieces for j in range(1, n.m + 1)}
        found, todo = list[str](), [Node(0, 0)]
        while todo:
            node = todo.pop()
            if node in inner:
                found.append(HALVED)
                todo += [node.half(True), node.half(False)]
            else:
                found.append(FOLLOWED if node in self.pieces else NOTHING)
        return "".join(found)


def halves(roots: Roots) -> Roots:
    """Return the halves of nodes, with their weights."""
    return {node.half(upper): w for node, w in roots.items() for upper in (False, True)}
