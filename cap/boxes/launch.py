"""Flights from wall to wall, over boxes of launches: what happens to all of them.

For orbits whose velocity never vanishes: a launch (t, u) from the left wall, u > 0 the speed with
which it leaves, either stops before the right wall, or leaves that at t1 with the speed u1.  In the
mirror image (t1 + T/2 modulo T, u1) is a launch from the left wall again: the map G of
`cap.proofs` about those orbits.
"""

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from cap.boxes.results import EITHER, HITS, STOPS, Launches
from cap.errors import BadInput
from cap.parameters import Parameters

__all__ = ["EITHER", "HITS", "STOPS", "Launches", "launches"]


def launches(p: Parameters, cells: ArrayLike, *, backward: bool = False) -> Launches:
    """Follow boxes of launches to the next event.

    ``cells`` (N, 4): rows (t low, t high, u low, u high), doubles, taken exactly, in units of 1/ω
    and F/ω, 0 <= t <= 7 and u >= 0.  Where u may be 0, nothing is decided.  ``backward``: with
    friction -f, for the inverse of G; assumes e = 1 and μ = 0.
    """
    from cap.boxes.engine import fly  # noqa: PLC0415 (numba is imported only here)

    boxes = np.ascontiguousarray(cells, dtype=np.float64)
    if boxes.ndim != 2 or boxes.shape[1] != 4:
        raise BadInput(f"launches must be rows (t low, t high, u low, u high), not {boxes.shape}")
    if not (np.isfinite(boxes).all() and (boxes[:, 0::2] <= boxes[:, 1::2]).all()):
        raise BadInput("the ends of a box of launches must be finite, and in order")
    if (boxes[:, 0] < 0).any() or (boxes[:, 1] > 7).any() or (boxes[:, 2] < 0).any():
        raise BadInput("launches have 0 <= t <= 7, in units of 1/ω, and u >= 0")
    if backward and not p.conserves:
        raise BadInput("flights are followed backward for elastic walls without viscosity only")
    return fly(p, boxes, Fraction(-1 if backward else 1))
