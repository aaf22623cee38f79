"""The tree of places that the checker is asked to follow: see `cap.checker.folded.tree`.

Nodes are halved where orbits have different journeys, in doubles, or the checker does not follow
them, as long as they are worth it.  A node is worth its length times a weight: how much measure it
leaves undecided, with all that comes there later.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cap.cells.journeys import OPEN, journeys
from cap.checker.folded.masses import Places
from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import Node, Piece, Portion
from cap.checker.folded.strip import Strip
from cap.checker.folded.tree import DEEPEST, FOLLOWED, HALVED, NOTHING, followed
from cap.checker.kernel import line
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Parameters

LEVEL, COARSE = 22, 18  # of portions, at last and while weights are found
GRAIN = 17  # level of nodes, of which next places are known up to a part of their range
FIRST = 6  # the tree begins with 2^6 nodes
# parts of W, times weights, that are left undecided rather than follow one more node
WORTHS = (1e-5, 4e-6, 2e-6, 1e-6, 5e-7)
MOST = 40.0  # events
NARROW = 2.0**-18  # a part of W that is followed even if the errors are large
TOLERANCE = 0.02  # errors of the next place, as a part of its range in a node of that level
PASSES = 12  # in which weights are found
TINY = 1e-13  # an error that does not matter
NONE, ONE, SEVERAL = range(3)  # journeys
TASKS = 64
_INSIDE = (0.0, 0.3, 0.5, 0.7, 1.0)  # where journeys are compared

Floats = NDArray[np.float64]
Root = tuple[Node, float]
Work = Callable[[Callable[[Any], Any], Sequence[Any]], list[Any]]


@dataclass(frozen=True)
class Growth:
    """How trees are grown from nodes with weights: a node is not worth more than ``worth``."""

    p: Parameters
    strip: Strip
    kept: Pair
    width: float
    worth: float

    def __call__(self, roots: list[Root]) -> tuple[list[Piece], list[Node]]:
        """Return the pieces, and the nodes that are not followed."""
        pieces, gaps, todo = list[Piece](), list[Node](), roots
        while todo:
            todo = [(node, weight) for node, weight in todo if not self.inside(node)]
            mixed = list[Root]()
            for (node, weight), kind in zip(todo, self.kinds(todo), strict=True):
                spent = weight * 2.0**-node.m <= self.worth or node.m == DEEPEST
                piece = attempt(self.p, self.strip, self.width, node) if kind == ONE else None
                if piece is not None and (spent or self.fine(piece)):
                    pieces.append(piece)
                elif spent or kind == NONE:
                    gaps.append(node)
                else:
                    mixed.append((node, weight))
            todo = [(half, weight) for node, weight in mixed for half in halves(node)]
        return pieces, gaps

    def inside(self, node: Node) -> bool:
        """Return whether a node is attracted anyway."""
        low, high = node.ends(self.width)
        return self.kept[0] <= low and high <= self.kept[1]

    def kinds(self, todo: Sequence[Root]) -> list[int]:
        """Return whether the orbits from nodes have one journey, several, or none that ends."""
        ends = np.array([node.ends(self.width) for node, _ in todo]).reshape(-1, 2)
        at = ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * np.array(_INSIDE)
        found = np.zeros(at.size, np.int64)
        journeys(at.ravel(), steering(self.p, self.strip, self.width), found)
        found = found.reshape(at.shape)
        same = (found == found[:, :1]).all(axis=1)
        kinds = np.where(found[:, 0] == OPEN, NONE, ONE)
        return [int(kind) for kind in np.where(same, kinds, SEVERAL)]

    def fine(self, piece: Piece) -> bool:
        """Return whether the next places are known well, from a node of the level `GRAIN`."""
        node, after = piece
        if after is None or 2.0**-node.m <= NARROW:
            return True
        low, high = line.ends(after)
        grain = 2.0 ** min(0, node.m - GRAIN)
        sharp = after[1] <= TOLERANCE * grain * line.size((0.0, *after[0][1:]))
        return sharp or after[1] < TINY or (self.kept[0] < low and high < self.kept[1])


@dataclass
class Search:
    """The tree as far as it is found: pieces that are followed, and nodes that are not."""

    p: Parameters
    strip: Strip
    kept: Pair
    width: float
    work: Work
    pieces: dict[Node, Piece] = field(default_factory=dict)
    gaps: set[Node] = field(default_factory=set)

    def run(self, worths: Sequence[float]) -> str:
        """Return the tree, in letters."""
        self.grow([(Node(k, FIRST), 1.0) for k in range(1 << FIRST)], worths[0])
        for worth in worths:
            gaps = sorted(node for node in self.gaps if node.m < DEEPEST)
            at = np.array([sum(node.ends(self.width)) / 2 for node in gaps])
            weights = self.weights(self.places(COARSE), at).tolist()
            chosen = {
                node: weight
                for node, weight in zip(gaps, weights, strict=True)
                if weight * 2.0**-node.m > worth
            }
            self.gaps -= chosen.keys()
            self.grow([(half, w) for node, w in chosen.items() for half in halves(node)], worth)
        return self.letters()

    def grow(self, roots: list[Root], worth: float) -> None:
        """Grow trees from nodes."""
        growth = Growth(self.p, self.strip, self.kept, self.width, worth)
        for pieces, gaps in self.work(growth, [roots[k::TASKS] for k in range(TASKS)]):
            self.pieces |= {piece.node: piece for piece in pieces}
            self.gaps |= set(gaps)

    def places(self, level: int) -> Places:
        """Return what is known of all places, with portions down to a level."""
        order = sorted(self.pieces, key=lambda node: node.k * 2.0**-node.m)
        return Places(self.kept, self.width, level, [self.pieces[node] for node in order])

    def weights(self, places: Places, at: Floats) -> Floats:
        """Return weights at places: 1, and those of the places that come there next."""
        ends = np.array(places.ends)
        passes = [(n, q.image, q.c) for n, q in enumerate(places.parts) if isinstance(q, Portion)]
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
                todo += halves(node)[::-1]
            else:
                found.append(FOLLOWED if node in self.pieces else NOTHING)
        return "".join(found)


def halves(node: Node) -> list[Node]:
    """Return the halves of a node."""
    return [node.half(False), node.half(True)]


def attempt(p: Parameters, strip: Strip, width: float, node: Node) -> Piece | None:
    """Follow a node, as the checker does; None if it does not."""
    try:
        return followed(p, strip, width, node)
    except (Rejected, ArithmeticError, ValueError):  # a guess out of all bounds, too
        return None


def steering(p: Parameters, strip: Strip, width: float) -> Floats:
    """Return the constants of the search, as `cap.cells.journeys` lists them."""
    left, speed = width - strip.edge[0], (strip.slow + strip.fast) / 2
    far = strip.d * (1 - 1e-6)
    edges = strip.left + left, strip.right + left
    return np.array([p.f / p.F, width, MOST, *edges, speed, far, strip.k], dtype=np.float64)
