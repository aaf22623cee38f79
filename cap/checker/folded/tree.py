"""The places of release, divided by a tree of halvings; and what follows from it.

A tree is written in letters, from its root, the interval [0, W]: 2 for a node that is halved, with
the lower half next, and the upper one then; 1 for one that is followed; 0 for one of which nothing
is shown.
"""

from __future__ import annotations

from cap.checker.folded.basins import Basins
from cap.checker.folded.motion import Direction
from cap.checker.folded.paths import next_release
from cap.checker.folded.portions import Node, Piece
from cap.checker.kernel.rejection import Rejected, need

NOTHING, FOLLOWED, HALVED = "0", "1", "2"
LETTERS = NOTHING + FOLLOWED + HALVED
DEEPEST, MOST = 30, 1 << 16  # a node, and how many may be followed


def nodes(tree: str) -> list[Node]:
    """Return the nodes of a tree that are followed, in order."""
    need(tree.count(FOLLOWED) <= MOST, "there are too many places to follow")
    found, todo = list[Node](), [Node(0, 0)]
    for letter in tree:
        need(bool(todo), "the tree of places goes on after its end")
        node = todo.pop()
        if letter == HALVED:
            need(node.m < DEEPEST, "the tree of places is too deep")
            todo += [node.half(True), node.half(False)]
        elif letter == FOLLOWED:
            found.append(node)
    need(not todo, "the tree of places is not whole")
    return found


def followed(y: Direction, basins: Basins, width: float, node: Node) -> list[Piece]:
    """Return the releases from a node, with the next ones; nothing, if these are not certain."""
    try:
        return [Piece(node, next_release(y, basins, node.ends(width)))]
    except Rejected:
        return []
