"""Fixed points of Φ in a sweep: existence, uniqueness, itinerary, trace and rotation number."""

import numpy as np
from numpy.typing import ArrayLike

from cap.boxes.flow import boxes_of
from cap.boxes.results import FixedPoints
from cap.errors import BadInput
from cap.parameters import Parameters

__all__ = ["FixedPoints", "fixed_points"]


def fixed_points(
    p: Parameters, cells: ArrayLike, *, frictions: ArrayLike | None = None
) -> FixedPoints:
    """Prove a fixed point of Φ in each box, where possible.

    ``cells`` (N, 4): rows (x low, x high, v low, v high), doubles, taken exactly.  ``frictions``
    (N, 2): lower and upper ends of f/F, 0 <= f/F < 1, to be taken instead of that of ``p``.
    """
    from cap.boxes.engine import search  # noqa: PLC0415 (numba is imported only here)

    boxes = boxes_of(p, cells)
    ranges = np.zeros((0, 2))
    if frictions is not None:
        ranges = np.ascontiguousarray(frictions, dtype=np.float64)
        if ranges.shape != (len(boxes), 2):
            raise BadInput(
                f"give the ends of f/F for each box: ({len(boxes)}, 2), not {ranges.shape}"
            )
        if not ((ranges[:, 0] >= 0) & (ranges[:, 0] <= ranges[:, 1]) & (ranges[:, 1] < 1)).all():
            raise BadInput("f/F must be at least 0 and less than 1, its ends in order")
    return search(p, boxes, ranges)
