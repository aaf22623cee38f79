"""Compiled, in doubles: an edge that cuts a region along a line that is of use; it steers.

For what comes backwards that is a contracted line; forwards a line from which all are released at
one place.  There times run the other way: edges and regions are mirrored.
"""

from typing import NamedTuple

from cap.areas.folded.backward import Constants
from cap.areas.folded.contraction import contracted, value
from cap.areas.folded.levels import level
from cap.areas.folded.regions import Edge, Region
from cap.sets.compiled import kernel

STEPS = 3  # along an edge, to each side
INSIDE = 0.1  # of the distance of its neighbours an edge is away from them


class Look(NamedTuple):
    """For which lines to look: backwards for so many strobes of speeds below V, or forwards.

    An edge is more curved than the mean of its neighbours by at most ``curved`` of their distance.
    """

    forwards: bool
    V: float
    strobes: int
    curved: float


@kernel
def mirrored(e: Edge) -> Edge:
    """Return an edge with time reversed."""
    return e[0], -e[1], e[2]


@kernel
def reversed_times(r: Region) -> Region:
    """Return a region with time reversed."""
    return Region(mirrored(r.low), mirrored(r.high), -r.middle, r.half)


@kernel
def _slope(y: Constants, look: Look, q: float, t: float) -> float:
    """Return the slope dq/dt of a line."""
    return level(y, q, t) if look.forwards else contracted(y, q, t, look.V, look.strobes)


@kernel
def _along(y: Constants, look: Look, r: Region, side: float) -> float:
    """Return where a line from the middle of a region leaves it: the midpoint rule."""
    q = 0.5 * (r.low[0] + r.high[0])
    t, step = r.middle, side * r.half / STEPS
    for _ in range(STEPS):
        first = _slope(y, look, q, t)
        q += step * _slope(y, look, q + 0.5 * step * first, t + 0.5 * step)
        t += step
    return q


@kernel
def between(low: Edge, edge: Edge, high: Edge) -> bool:
    """Return whether an edge is well between two others."""
    for Y in (-1.0, -0.5, 0.5, 1.0):
        under, over = value(low, Y), value(high, Y)
        if not INSIDE < (value(edge, Y) - under) / (over - under) < 1 - INSIDE:
            return False
    return True


@kernel
def edge(y: Constants, look: Look, r: Region) -> Edge:
    """Return an edge that cuts a region across X, along a line of use if that fits."""
    e0, m1 = 0.5 * (r.low[0] + r.high[0]), 0.5 * (r.low[1] + r.high[1])
    m2 = 0.5 * (r.low[2] + r.high[2])
    left, right = _along(y, look, r, -1.0), _along(y, look, r, 1.0)
    most = look.curved * (r.high[0] - r.low[0])
    e2 = min(max(0.5 * (right + left) - e0, m2 - most), m2 + most)
    found = e0, 0.5 * (right - left), e2
    return found if between(r.low, found, r.high) else (e0, m1, m2)
