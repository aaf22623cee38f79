"""Trees of regions of sticks: which states of a box come from which places where masses stick.

The box is the states with |v| < V at the times that are multiples of the period.  A region of
sticks is followed backwards (`cap.cells.backward`); what it gives is a lower bound of the area of
states in the box whose first stick is in the region.

The edges of the first region are q = 0 and the multiple of 2^-40 next above -W.  The times of the
first arc are pi/2 + (pi/2 - theta) z, those of the second -pi/2 + (pi/2 - theta) z, z from -1 to 1.
The trees are written as in `cap.cells.cuts`.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

import numpy as np

from cap.cells.backward import System
from cap.cells.constants import system_of
from cap.cells.cuts import PARTS, UNIT, Edges, Tree, grown, joined
from cap.cells.entries import NOWHERE
from cap.cells.regions import Limits
from cap.cells.trees import Arc, Floats, Nodes, Plan, Search
from cap.errors import BadInput
from cap.parameters import Parameters
from cap.runner import Runner

FLIGHTS, SIZE = 60, 3.0
WIDEST = 8  # edges are doubles with a bounded error for walls that are not farther apart
MORE = np.array([-(2.0**-36), 2.0**-36])  # more than the errors of edges, and of the width


@dataclass(frozen=True)
class Sticks(Tree):
    """The nodes of an arc.

    ``places`` (N, 2) bound the places of its sticks, from the wall ahead at the release.  From
    those in a set of places of the measure m come states of the area m ``weights`` at most.
    """

    weights: Floats
    places: Floats
    sides: Floats
    late: bool

    def spans(self, parts: int) -> Floats:
        """Return bounds of the places over equal parts of the times: (N, parts, 2).

        At each time the measure of a set of places in a region is at most that of its part in these
        bounds: so the mean of that over the parts, times the weight, bounds the area.
        """
        low, high = _range(self.sides[:, :3], parts)[0], _range(self.sides[:, 3:], parts)[1]
        far = self.root[0][0] * UNIT
        ends = (low - far, high - far) if self.late else (-high, -low)
        return np.asarray(np.stack(ends, axis=-1) + MORE, np.float64)


def _range(edges: Floats, parts: int) -> tuple[Floats, Floats]:
    """Return bounds of edges (N, 3) over equal parts of [-1, 1]: (N, parts)."""
    half = 1 / parts
    Y = half * (2 * np.arange(parts) + 1) - 1
    a, b, c = (edges[:, k, None] for k in range(3))
    value, far, bend = a + Y * (b + Y * c), np.abs(b + 2 * Y * c) * half, c * half * half
    return value - far + np.minimum(0.0, bend), value + far + np.maximum(0.0, bend)


def search(p: Parameters, V: Fraction, plan: Plan, runner: Runner) -> tuple[Sticks, Sticks]:
    """Return trees for both arcs."""
    width = (p.r - p.l) * p.omega**2 / p.F
    if not (p.e == 1 and p.mu == 0 and p.f > 0 and width < WIDEST):
        raise BadInput(f"sticks are followed for e = 1, mu = 0, and walls nearer than {WIDEST}")
    y, fast = system_of(p), float(V * p.omega / p.F)
    limits = Limits(fast - abs(fast) * 2.0**-52, FLIGHTS, SIZE)
    tasks = [(middle, k) for middle in (math.pi / 2, -math.pi / 2) for k in range(PARTS)]
    parts = runner.map(partial(_grown, y, limits, plan, root(width)), tasks, "sticks")
    first, second = joined(parts[:PARTS]), joined(parts[PARTS:])
    far, more = float(width), 2.0**-40
    return (
        _tree(width, first, -first.values[:, 4:2:-1], late=False),
        _tree(width, second, second.values[:, 3:5] + (far - more, far + more), late=True),
    )


def root(width: Fraction) -> Edges:
    """Return the edges of all sticks of an arc."""
    return (-(width * 2**40 // 1) << 40, 0, 0), (0, 0, 0)


def _tree(width: Fraction, nodes: Nodes, places: Floats, *, late: bool) -> Sticks:
    """Return a tree."""
    areas, weights, last = nodes.values[:, 0], nodes.values[:, 1], nodes.values[:, 2]
    found = areas, last.astype(np.int64), weights, places, nodes.values[:, 5:]
    return Sticks(root(width), nodes.kinds, nodes.edges, *found, late)


def _grown(y: System, limits: Limits, plan: Plan, root: Edges, task: tuple[float, int]) -> Nodes:
    """Return the nodes of a part of an arc."""
    middle, k = task
    arc = Arc(middle, y.theta - 0.5 * math.pi)
    return grown(Search(y, NOWHERE, arc, limits, plan), root, k)
