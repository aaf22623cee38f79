"""From one release to the next over intervals of places, by the thousand.

The release map G of `cap.release.passage`, in intervals of doubles: a cell is an interval of places
of releases to the right.

    from cap.boxes.release import passages
    found = passages(PAPER, [[0.1, 0.101]], 4)
    found.value, found.slope     # G and G' on the cell, if all its masses have the same events
"""

import numpy as np
from numpy.typing import ArrayLike

from cap.boxes.results import Passages
from cap.errors import BadInput
from cap.parameters import Parameters


def passages(p: Parameters, cells: ArrayLike, periods: int) -> Passages:
    """Follow the masses of ``cells`` (N, 2), rows (x low, x high), for some periods.

    The ends are doubles, taken exactly.  Raises `BadInput` unless they are between the walls.
    """
    from cap.boxes.engine import released  # noqa: PLC0415 (numba is imported only here)

    if periods < 1:
        raise BadInput(f"masses must be followed for one period at least, not {periods}")
    ends = np.ascontiguousarray(cells, dtype=np.float64).reshape(-1, 2)
    if not (np.isfinite(ends).all() and (ends[:, 0] <= ends[:, 1]).all()):
        raise BadInput("the ends of a cell must be finite, and in order")
    if len(ends) and not (p.l <= min(ends[:, 0].tolist()) and max(ends[:, 1].tolist()) <= p.r):
        raise BadInput("the places of releases must lie between the walls")
    return released(p, ends, periods)
