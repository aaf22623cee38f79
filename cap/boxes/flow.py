"""The flow of cells: boxes of states in, enclosures of all that becomes of them out.

A cell is the set of the states (x, v) of a box between the walls.  What is written of it holds for
each of its states, by the arithmetic of `cap.sets.doubles`: hits, turns, sticking and release,
captures, losses, as in `cap.flow.strobe`.  Where it is undecided which of several things happens
next, for all states of the cell, each of them is followed, and what is written is the union.

    from cap.boxes.flow import flow
    images = flow(PAPER, [[0.1, 0.101, 0.5, 0.501]], 1)
    images.states        # a box with the states after one period
    images.derivative    # the derivative of Φ, if it is smooth on the cell
"""

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from cap.boxes.results import (
    NOWHERE,
    OPEN,
    SMOOTH,
    UNION,
    Floats,
    Goals,
    Images,
    Region,
    number_of,
    words_of,
)
from cap.errors import BadInput
from cap.parameters import Parameters

__all__ = [
    "NOWHERE",
    "OPEN",
    "SMOOTH",
    "UNION",
    "Floats",
    "Goals",
    "Images",
    "Region",
    "boxes_of",
    "flow",
    "number_of",
    "words_of",
]


def flow(
    p: Parameters,
    cells: ArrayLike,
    periods: int | Fraction = 1,
    *,
    start: Fraction = Fraction(0),
    goals: Goals = NOWHERE,
) -> Images:
    """Follow cells from the time ``start`` T for some periods T, or for a part of one.

    ``cells`` (N, 4): rows (x low, x high, v low, v high), doubles, taken exactly; where v = 0 the
    mass is at rest.  Follows them one after the other, in this thread.  Raises `BadInput` if there
    is a cell without a state between the walls.  Each cell is the same, to the last bit, whatever
    the others are.
    """
    from cap.boxes.engine import follow  # noqa: PLC0415 (numba is imported only here)

    boxes = boxes_of(p, cells)
    whole = Fraction(periods)
    if not (0 < whole < 1 or whole.denominator == 1) or whole < 0:
        raise BadInput(f"give a whole number of periods, or a part of one: not {periods}")
    if not 0 <= start < 1:
        raise BadInput(f"give the start as a part of a period: 0 <= start < 1, not {start}")
    return follow(p, boxes, whole, start, goals)


def boxes_of(p: Parameters, cells: ArrayLike) -> Floats:
    """Return the cells as an array; raise `BadInput` if they are not cells."""
    boxes = np.ascontiguousarray(cells, dtype=np.float64)
    if boxes.ndim != 2 or boxes.shape[1] != 4:
        raise BadInput(f"cells must be rows (x low, x high, v low, v high), not {boxes.shape}")
    low, high = boxes[:, 0::2], boxes[:, 1::2]
    if not (np.isfinite(boxes).all() and (low <= high).all()):
        raise BadInput("the ends of a cell must be finite, and in order")
    outside = (boxes[:, 0] > float(p.r)) | (boxes[:, 1] < float(p.l))
    if outside.any():
        k = int(np.flatnonzero(outside)[0])
        raise BadInput(f"cell {k} is not between the walls: x from {boxes[k, 0]} to {boxes[k, 1]}")
    return boxes
