"""Fixed points of Φ in a sweep: existence, uniqueness, itinerary, trace and rotation number."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.cells.flow import boxes_of
from cap.errors import BadInput
from cap.parameters import Parameters

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class FixedPoints:
    """What is proved of N boxes.

    ``proved`` (N,): Φ maps the box smoothly, has exactly one fixed point in it, and this lies in
    the interior of the box, in ``boxes`` (N, 2, 2), lower and upper ends of x and v.  For a range
    of frictions: at each of them.
    ``itinerary`` (N,): the events of all orbits from the box, as a number (`flow.words_of`).
    ``trace`` (N, 2): lower and upper ends of the trace of Φ' on the whole box.  ``rotation``
    (N, 2): the same for Θ/2π in (0, 1/2) with 2 cos Θ = trace, NaN unless |trace| < 2 is certain;
    where det Φ' = 1, the multipliers are exp(±iΘ).
    NaN, and -1, where the box is not mapped smoothly, which is not proved to be so then.
    """

    proved: NDArray[np.bool_]
    itinerary: NDArray[np.int64]
    boxes: Floats
    trace: Floats
    rotation: Floats


def fixed_points(
    p: Parameters, cells: ArrayLike, *, frictions: ArrayLike | None = None
) -> FixedPoints:
    """Prove a fixed point of Φ in each box, where possible.

    ``cells`` (N, 4): rows (x low, x high, v low, v high), doubles, taken exactly.  ``frictions``
    (N, 2): lower and upper ends of f/F, 0 <= f/F < 1, to be taken instead of that of ``p``.
    """
    from cap.cells.engine import search  # noqa: PLC0415 (numba is imported only here)

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
