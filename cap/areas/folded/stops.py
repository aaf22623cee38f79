"""Trees of regions of stops: which states of a box come from which places where masses stop.

The box is the states with |v| < V at the times that are multiples of the period.  A region of stops
is followed backwards (`cap.areas.folded.regions`); what it gives is a lower bound of the area of
states in the box whose first stop is in the region.  A region of turns, or its parts, are followed
forwards (`cap.areas.folded.ahead`) to the places where the masses stick.

The edges of the first region are q = 0 and the multiple of 2^-40 next above -W.  The times of the
sticks are -pi/2 + (pi/2 - theta) z, late, and pi/2 + (pi/2 - theta) z, early, those of turns theta
z, theta = arccos(f/F), z from -1 to 1.  The trees are written as in `cap.areas.folded.cuts`.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np

from cap.areas.folded.basins import compiled_basins
from cap.areas.folded.choice import Mask
from cap.areas.folded.constants import system_of
from cap.areas.folded.cuts import PARTS, UNIT, Edges, Tree, grown, joined
from cap.areas.folded.fates import Ahead
from cap.areas.folded.missing import Known
from cap.areas.folded.regions import Limits
from cap.areas.folded.trees import Arc, Floats, Nodes, Plan, Search
from cap.checker.folded.basins import Basins
from cap.checker.folded.stops import EARLY, LATE
from cap.errors import BadInput
from cap.parameters import Parameters
from cap.runner import Runner

FLIGHTS, SIZE = 60, 3.0
SPANS = 16  # parts of the times of sticks, in which places are bounded
WIDEST = 8  # edges are doubles with a bounded error for walls that are not farther apart
MORE = np.array([-(2.0**-36), 2.0**-36])  # more than the errors of edges, and of the width


class Releases(NamedTuple):
    """What is known of releases: parts of basins, and places with a fate."""

    basins: Basins
    known: Known


@dataclass(frozen=True)
class Sticks(Tree):
    """The nodes of the late or the early sticks.

    From places, seen from the wall ahead, in a set of the measure m come states of the area m
    ``weights`` at most; ``sides`` are the edges; ``side`` as in `cap.checker.folded.stops`.
    """

    weights: Floats
    sides: Floats
    side: int

    def spans(self, parts: int) -> Floats:
        """Return bounds of the places over equal parts of the times: (N, parts, 2).

        At each time the measure of a set of places in a region is at most that of its part in these
        bounds: so the mean of that over the parts, times the weight, bounds the area.
        """
        low, high = _range(self.sides[:, :3], parts)[0], _range(self.sides[:, 3:], parts)[1]
        far = self.root[0][0] * UNIT
        ends = [low - far, high - far] if self.side == LATE else [-high, -low]
        return np.asarray(np.stack(ends, axis=-1) + MORE, np.float64)


@dataclass(frozen=True)
class Turns(Tree):
    """The nodes of the turns.

    ``strobes`` (N,): how many count; ``measures`` (N, 2): bounds of the measure of a node;
    ``fated`` (N, 3): of what of it has each fate, from below.
    """

    strobes: Floats
    measures: Floats
    fated: Floats

    def onwards(self, chosen: Mask) -> Floats:
        """Return the area with a fate that each node below a chosen one, or it, would give."""
        weights = np.zeros(len(chosen))
        for n in np.flatnonzero(chosen).tolist():
            weights[n : self.past[n]] = self.strobes[n]
        return np.asarray(weights * self.fated[:, -1], np.float64)

    def lost(self, chosen: Mask) -> float:
        """Return by what all this is more than the areas with a fate, but for rounding."""
        most = self.strobes[chosen] * self.measures[chosen, 1]
        return float(np.sum(most - self.areas[chosen]))

    def areas_of(self, chosen: Mask, parts: Mask) -> Floats:
        """Return the areas with each fate from chosen nodes (N, 3), whose parts are followed."""
        good = np.zeros((len(chosen) + 1, self.fated.shape[1]))
        np.cumsum(np.where(parts[:, None], self.fated, 0.0), axis=0, out=good[1:])
        nodes = np.flatnonzero(chosen)
        have = good[np.array(self.past, np.int64)[nodes]] - good[nodes]
        lost = self.measures[nodes, 1][:, None] - have + 1e-13
        areas = self.areas[nodes][:, None] - self.strobes[nodes][:, None] * np.maximum(0.0, lost)
        return np.asarray(np.maximum(0.0, areas * (1 - 1e-12)), np.float64)


class Trees(NamedTuple):
    """The trees of all stops that are counted."""

    late: Sticks
    early: Sticks
    turns: Turns


def _range(edges: Floats, parts: int) -> tuple[Floats, Floats]:
    """Return bounds of edges (N, 3) over equal parts of [-1, 1]: (N, parts)."""
    half = 1 / parts
    Y = half * (2 * np.arange(parts) + 1) - 1
    a, b, c = (edges[:, k, None] for k in range(3))
    value, far, bend = a + Y * (b + Y * c), np.abs(b + 2 * Y * c) * half, c * half * half
    return value - far + np.minimum(0.0, bend), value + far + np.maximum(0.0, bend)


def search(p: Parameters, V: Fraction, releases: Releases, plan: Plan, runner: Runner) -> Trees:
    """Return trees for the sticks and the turns."""
    width = (p.r - p.l) * p.omega**2 / p.F
    if not (p.e == 1 and p.mu == 0 and p.f > 0 and width < WIDEST):
        raise BadInput(f"stops are followed for e = 1, mu = 0, and walls nearer than {WIDEST}")
    fast = float(V * p.omega / p.F)
    limits = Limits(fast - abs(fast) * 2.0**-52, FLIGHTS, SIZE)
    y, z = system_of(p), system_of(p, forwards=True)
    ahead = Ahead(z._replace(a=-z.a), z, compiled_basins(releases.basins), releases.known)
    arcs = (Arc(side * math.pi / 2, y.theta - math.pi / 2) for side in (LATE, EARLY))
    sticks = [Search(y, ahead, arc, limits, plan.backwards()) for arc in arcs]
    turns = Search(y, ahead, Arc(0.0, z.theta), limits, plan)
    tasks = [(each, k) for each in (*sticks, turns) for k in range(PARTS)]
    parts = runner.map(partial(_grown, root(width)), tasks, "stops are followed")
    late, early, turned = (joined(parts[k * PARTS : (k + 1) * PARTS]) for k in range(3))
    return Trees(_sticks(width, late, LATE), _sticks(width, early, EARLY), _turns(width, turned))


def root(width: Fraction) -> Edges:
    """Return the edges of all stops of an arc."""
    return (-(width * 2**40 // 1) << 40, 0, 0), (0, 0, 0)


def _sticks(width: Fraction, nodes: Nodes, side: int) -> Sticks:
    """Return the tree of late or early sticks."""
    v = nodes.values
    found = v[:, 0], v[:, 2].astype(np.int64), v[:, 1], v[:, 3:9]
    return Sticks(root(width), nodes.kinds, nodes.edges, *found, side)


def _turns(width: Fraction, nodes: Nodes) -> Turns:
    """Return the tree of turns."""
    v = nodes.values
    found = v[:, 0], v[:, 2].astype(np.int64), v[:, 9], v[:, [10, 14]], v[:, 11:14]
    return Turns(root(width), nodes.kinds, nodes.edges, *found)


def _grown(root: Edges, task: tuple[Search, int]) -> Nodes:
    """Return the nodes of a part of an arc."""
    return grown(task[0], root, task[1])
