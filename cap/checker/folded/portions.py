"""Places of release in parts: nodes of a tree, pieces that are followed, and portions of them.

A *node* (k, m) is the interval of places from k/2^m to (k + 1)/2^m of the width W.  A *piece* is a
node with a model of the next place G, or the fate that its orbits have before.  A *portion*
is a part of a piece, by halvings, with bounds of G, and |G'| >= c.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from cap.checker.folded.numbers import UP, Pair
from cap.checker.kernel import line
from cap.checker.kernel.line import Line

_EVEN = 0.1  # how much G' may vary in a portion, relatively
_BLURRED = 4  # times the error: a range of G that halvings do not make sharper
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
    """A node, and the next place, or the fate, if all orbits are in a basin before."""

    node: Node
    next: Line | int


class Portion(NamedTuple):
    """A part of a piece, with a model of the next place.

    ``left``: what bounds 1/4 of the derivative of what is left by this model, but for rounding
    since the model of the piece; ``image``: bounds of the next place; ``c``: |G'| >= c; ``even``:
    whether it is of no use to halve it for a better c.
    """

    node: Node
    next: Line
    left: float
    ends: Pair
    image: Pair
    c: float
    even: bool

    def blurred(self) -> bool:
        """Return whether it is of no use to halve it."""
        return line.rest(self.next) <= _BLURRED * self.next[1]

    def halves(self, width: float) -> Iterator[Portion]:
        """Give the halves; the derivative of what is left is halved."""
        for upper, side in enumerate((-1.0, 1.0)):
            after = line.half(self.next, side)
            left = (self.left / 2 + (after[1] - self.next[1])) * UP
            yield portion(self.node.half(bool(upper)), after, left, width)


def portion(node: Node, after: Line, left: float, width: float) -> Portion:
    """Return a portion; where G is monotone, its bounds are taken at the ends."""
    ends = node.ends(width)
    low, high = line.slopes(after, 4 * left * UP)
    slope = max(low, -high) / UP
    if not slope > 0:
        return Portion(node, after, left, ends, line.ends(after), 0.0, even=False)
    a, b = sorted(line.at_ends(after))
    e = line.blur(after)
    image = (a - e) - abs(a) * 2**-50, (b + e) + abs(b) * 2**-50
    even = high - low <= _EVEN * abs(high + low)
    return Portion(node, after, left, ends, image, slope / ((ends[1] - ends[0]) / 2), even)


def roof(x: Fraction) -> float:
    """Return a double that is not less, of which the ends of all nodes are exact parts."""
    scale = Fraction(2) ** (_BITS - math.frexp(float(x))[1])
    return float(math.ceil(x * scale) / scale)
