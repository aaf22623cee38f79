"""The flow of the cells of a grid, in pieces: as many cells as one likes, in bounded memory."""

import base64
import io
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields
from fractions import Fraction
from functools import partial
from math import ceil, lcm

import numpy as np
from numpy.typing import NDArray

from cap.boxes.flow import NOWHERE, Goals, Images, flow
from cap.errors import BadInput
from cap.parameters import Parameters
from cap.runner import Plan, Runner

Floats = NDArray[np.float64]

PIECE = 25_000  # cells, times periods: a tenth of a second
LEAST = 1_000  # cells: what is done once for a piece takes less than a fifth of it


@dataclass(frozen=True, slots=True)
class Grid:
    """The cells of a rectangle: ``columns`` parts of [x_0, x_1], ``rows`` parts of [v_0, v_1].

    Row by row, from the lower left corner.  Neighbours share their edges, which are the doubles
    next to the exact ones; those of the rectangle are rounded outwards.  So the cells cover it.
    """

    x: tuple[Fraction, Fraction]
    v: tuple[Fraction, Fraction]
    columns: int
    rows: int

    def __post_init__(self) -> None:
        """Raise `BadInput` unless there is a rectangle with cells."""
        if not (self.x[0] < self.x[1] and self.v[0] < self.v[1]):
            raise BadInput("a grid needs x from left to right, and v from low to high")
        if self.columns < 1 or self.rows < 1:
            raise BadInput("a grid needs a row and a column at least")

    @property
    def count(self) -> int:
        """The number of cells."""
        return self.columns * self.rows

    def cells(self, part: slice) -> Floats:
        """Return some of the cells, (K, 4), rows (x low, x high, v low, v high)."""
        row, column = np.divmod(np.arange(part.start, part.stop), self.columns)
        first, last = int(row[0]), int(row[-1]) + 1
        xs = _edges(self.x, self.columns, 0, self.columns)
        vs = _edges(self.v, self.rows, first, last)
        row = row - first
        return np.stack([xs[column], xs[column + 1], vs[row], vs[row + 1]], axis=-1)


def _edges(ends: tuple[Fraction, Fraction], parts: int, first: int, last: int) -> Floats:
    """Return the edges of the parts from ``first`` to before ``last``."""
    low, high = Fraction(ends[0]), Fraction(ends[1])
    step = (high - low) / parts
    whole = lcm(low.denominator, step.denominator)
    origin, width = int(low * whole), int(step * whole)
    edges = np.array([(origin + width * k) / whole for k in range(first, last + 1)])  # rounded once
    if first == 0 and float(edges[0]) > low:
        edges[0] = np.nextafter(edges[0], -np.inf)
    if last == parts and float(edges[-1]) < high:
        edges[-1] = np.nextafter(edges[-1], np.inf)
    if not (edges[:-1] < edges[1:]).all():
        raise BadInput("the cells of a grid are too small for doubles")
    return edges


@dataclass(frozen=True, slots=True)
class Sweep:
    """What is asked of the cells of a grid; see `cap.boxes.flow.flow`."""

    parameters: Parameters
    grid: Grid
    periods: int | Fraction = 1
    start: Fraction = Fraction(0)
    goals: Goals = NOWHERE


def sweep(
    request: Sweep, runner: Runner, piece: int | None = None
) -> Iterator[tuple[slice, Images]]:
    """Give the images of the cells of a grid in pieces, as they come: (which cells, images).

    All pieces together are all cells, unless the runner was interrupted.  ``piece``: how many cells
    one has, by default fewer if there are more periods; an interrupt waits for those begun.
    """
    if piece is None:
        piece = max(PIECE // max(ceil(request.periods), 1), LEAST)
    if piece < 1:
        raise BadInput(f"a piece must have cells: {piece}")
    count = request.grid.count
    cuts = (slice(k, min(k + piece, count)) for k in range(0, count, piece))
    plan = Plan[slice, Images](
        key=f"{request} in pieces of {piece}",
        encode=encoded,
        decode=decoded,
        weight=lambda part: part.stop - part.start,
        total=count,
        words="cells",
        threads=True,
    )
    return runner.run(partial(_follow, request), cuts, plan)


def _follow(request: Sweep, part: slice) -> Images:
    return flow(
        request.parameters,
        request.grid.cells(part),
        request.periods,
        start=request.start,
        goals=request.goals,
    )


def encoded(images: Images) -> str:
    """Return images as a string."""
    file = io.BytesIO()
    np.savez_compressed(file, **asdict(images))
    return base64.b64encode(file.getvalue()).decode("ascii")


def decoded(text: str) -> Images:
    """Return the images of a string."""
    with np.load(io.BytesIO(base64.b64decode(text)), allow_pickle=False) as arrays:
        return Images(*(arrays[field.name] for field in fields(Images)))
