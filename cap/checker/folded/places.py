"""The leaves of a box at t = 0."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from cap.checker.folded.fates import Judge
from cap.checker.folded.flights import System
from cap.checker.folded.follow import Box, Seen, follow
from cap.checker.folded.numbers import TURN, Pair
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.theorem import Parameters


class Leaf(NamedTuple):
    """A rectangle at t = 0, in the units of the flow: x from the left wall on, v of one sign."""

    x: Pair
    v: Pair
    cuts: int = 0
    depth: int = 0

    def cut(self, cuts: int, more: int) -> Leaf:
        """Return the leaf, to be cut so often, and halved so many times more when judged."""
        return self._replace(cuts=cuts, depth=cuts + more)


@cache
def system(p: Parameters) -> System:
    """Return the constants at these parameters."""
    return System(p)


def across(ends: Pair, along: int) -> Model:
    """Return the model of a coordinate, from one end of an interval to the other."""
    mid, rad = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
    error = (abs(ends[0]) + abs(ends[1])) * TURN
    return (mid, 0.0, rad, 0.0, 0.0, 0.0, error) if along else (mid, rad, 0.0, 0.0, 0.0, 0.0, error)


def seen_in(p: Parameters, judge: Judge, leaf: Leaf) -> Seen:
    """Return what is seen of the orbits from a leaf.

    A state with v < 0 is, folded, one at the time pi with the distance to the left wall ahead.
    """
    y, x, v = system(p), across(leaf.x, 0), across(leaf.v, 1)
    left = leaf.v[1] <= 0
    p_ahead = q.scaled(x, -1.0) if left else q.moved(x, -y.width[0], y.width[1])
    f = y.launched(p_ahead, q.scaled(v, -1.0) if left else v, left)
    seen = follow(y, f, Box(leaf.cuts))
    if not left:
        seen = seen._replace(strobes=[(p_ahead, v), *seen.strobes])
    return judge.prepared(seen)


def shares(p: Parameters, judge: Judge, leaf: Leaf) -> tuple[int, int, int]:
    """Return how many of the 2^depth parts of a leaf are attracted, go to the segment, or stop."""
    return judge.shares(seen_in(p, judge, leaf), leaf.depth)
