"""Places of release in parts: nodes of a tree, pieces that are followed, and portions of cells.

A *node* (k, m) is the interval of places from k/2^m to (k + 1)/2^m of the width W; the nodes with m
= M are the *cells*.  A *piece* is a node with a model of the next place G, or none if its orbits go
to the segment at once.  Pieces are halved, at least to cells, and until G' varies little: to
*portions* with |G'| >= c.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from cap.checker.folded.numbers import UP, Pair
from cap.checker.kernel import line
from cap.checker.kernel.line import Line

_MORE = 5  # halvings of a piece in a cell
_EVEN = 0.1  # how much G' may vary, before a piece is halved, relatively
_BITS = 22  # of a width: with 30 of k, and one of a sum, doubles are exact


class Node(NamedTuple):
    """The interval of places from k/2^m to (k + 1)/2^m of the width, m <= 30."""

    k: int
    m: int

    def ends(self, width: float) -> Pair:
        """Return the ends: exactly, as the width is one of `roof`."""
        scale = 2.0**-self.m
        return width * (self.k * scale), width * ((self.k + 1) * scale)

    def half(self, upper: bool) -> Node:
        """Return a half."""
        return Node(2 * self.k + upper, self.m + 1)


class Piece(NamedTuple):
    """A node, and the next place, or None if the orbits go to the segment before."""

    node: Node
    next: Line | None


class Portion(NamedTuple):
    """An interval of places in a cell, bounds of the next place, and c with |G'| >= c.

    ``image`` is None if the orbits go to the segment before.
    """

    cell: int
    ends: Pair
    image: Pair | None
    c: float


def portions(piece: Piece, width: float, level: int) -> list[Portion]:
    """Return the portions of a piece, from the lower end to the upper one.

    With each halving the derivative of what is left by the first model is halved, but not that of
    the rounding since.
    """
    found, todo = list[Portion](), [(piece.node, piece.next)]
    left = piece.next[1] if piece.next else 0.0
    while todo:
        node, after = todo.pop()
        if after is None:
            bounds = None
        else:
            steep = 4 * (left * 2.0 ** (piece.node.m - node.m) + (after[1] - left)) * UP
            bounds = line.slopes(after, steep)
        if node.m < level or (node.m < level + _MORE and uneven(after, bounds)):
            halves = [None, None] if after is None else [line.half(after, s) for s in (-1.0, 1.0)]
            todo += [(node.half(True), halves[1]), (node.half(False), halves[0])]
        else:
            ends = node.ends(width)
            found.append(portion(node.k >> (node.m - level), ends, after, bounds))
    return found


def uneven(after: Line | None, bounds: Pair | None) -> bool:
    """Return whether G' varies much: it steers."""
    if after is None or bounds is None:
        return False
    low, high = bounds
    return high - low > _EVEN * abs(high + low) and line.rest(after) > 4 * after[1]


def portion(cell: int, ends: Pair, after: Line | None, bounds: Pair | None) -> Portion:
    """Return a portion; where G is monotone, its bounds are taken at the ends."""
    if after is None or bounds is None:
        return Portion(cell, ends, None, 0.0)
    slope = max(bounds[0], -bounds[1]) / UP
    if slope <= 0:
        return Portion(cell, ends, line.ends(after), 0.0)
    a, b = sorted(line.at_ends(after))
    e = line.blur(after)
    image = (a - e) - abs(a) * 2**-50, (b + e) + abs(b) * 2**-50
    return Portion(cell, ends, image, slope / ((ends[1] - ends[0]) / 2))


def roof(x: Fraction) -> float:
    """Return a double that is not less, of which the ends of all nodes are exact parts."""
    scale = Fraction(2) ** (_BITS - math.frexp(float(x))[1])
    return float(math.ceil(x * scale) / scale)
