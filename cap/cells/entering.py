"""Trees of regions of a strip: which states of a box enter it; see `cap.cells.entries`."""

from functools import partial
from typing import NamedTuple

import numpy as np

from cap.cells.constants import system_of
from cap.cells.cuts import PARTS, Edges, Tree, grown, joined
from cap.cells.entries import Strip
from cap.cells.regions import Limits
from cap.cells.sticks import FLIGHTS, SIZE
from cap.cells.trees import Arc, Plan, Search
from cap.parameters import Parameters
from cap.runner import Runner


class Half(NamedTuple):
    """A part of a strip: speeds middle + half z, z from -1 to 1, and edges, which are straight."""

    root: Edges
    speeds: Arc


def search(
    p: Parameters, strip: Strip, halves: list[Half], V: float, plan: Plan, runner: Runner
) -> list[Tree]:
    """Return a tree for each part of a strip: of what enters it, slower than V, in units."""
    y, limits = system_of(p), Limits(V, FLIGHTS, SIZE)
    trees = list[Tree]()
    for half in halves:
        found = Search(y, strip, half.speeds, limits, plan)
        parts = runner.map(partial(grown, found, half.root), range(PARTS), "strip")
        nodes = joined(parts)
        areas, last = nodes.values[:, 0], nodes.values[:, 2].astype(np.int64)
        trees.append(Tree(half.root, nodes.kinds, nodes.edges, areas, last))
    return trees
