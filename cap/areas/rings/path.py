"""Compiled: the ring through good links of a grid that has the least area inside.

Links go from a column to the next one, up or down by at most `JUMP` rows: so it is a shortest path
in an acyclic graph, around several times; after once around it comes back to where it was.
"""

import math

import numpy as np
from numpy.typing import NDArray

from cap.areas.rings.half_periods import Floats
from cap.sets.compiled import compiled

JUMP = 8  # rows
WRAPS = 3
Links = NDArray[np.bool_]
Integers = NDArray[np.int64]


@compiled
def link(
    forward: NDArray[np.uint64], backward: NDArray[np.uint64], jump: int, links: Links
) -> None:
    """Write which links (N, M, 2 JUMP + 1) join points with a number of half periods in common."""
    columns, rows = forward.shape
    for i in range(columns):
        n = (i + 1) % columns
        for j in range(rows):
            for m in range(2 * jump + 1):
                k = j + m - jump
                if 0 <= k < rows:
                    common = (forward[i, j] & forward[n, k]) | (backward[i, j] & backward[n, k])
                    links[i, j, m] = common != 0


@compiled
def shortest(
    area: Floats, links: Links, wraps: int, tilt: float, costs: Floats, origin: Integers
) -> None:
    """Write the least costs (wraps N + 1, M), and from which row each comes.

    A link costs the mean of the areas (N, M) at its ends, and ``tilt`` times what they differ.
    """
    columns, rows, width = links.shape
    jump = width // 2
    costs[0] = 0.0
    for step in range(wraps * columns):
        i, n = step % columns, (step + 1) % columns
        costs[step + 1] = math.inf
        for j in range(rows):
            if costs[step, j] < math.inf:
                for m in range(width):
                    if links[i, j, m]:
                        k = j + m - jump
                        change = abs(area[n, k] - area[i, j])
                        cost = costs[step, j] + 0.5 * (area[i, j] + area[n, k]) + tilt * change
                        if cost < costs[step + 1, k]:
                            costs[step + 1, k] = cost
                            origin[step + 1, k] = j


def ring(area: Floats, links: Links, tilt: float) -> Integers | None:
    """Return the rows, column by column, of the ring; None if no path goes around."""
    columns, rows, _ = links.shape
    costs = np.empty((WRAPS * columns + 1, rows))
    origin = np.zeros(costs.shape, np.int64)
    shortest(area, links, WRAPS, tilt, costs, origin)
    k = int(np.argmin(costs[-1]))
    if not costs[-1, k] < math.inf:
        return None
    path = [k]
    for step in range(WRAPS * columns, 0, -1):
        path.append(int(origin[step, path[-1]]))
    along = np.array(path[::-1])
    same = np.flatnonzero(along[columns:] == along[:-columns])
    if not same.size:
        return None
    begin = int(same[len(same) // 2])
    rows_of = along[begin : begin + columns]
    return np.roll(rows_of, begin % columns)
