"""Basin entropy of a partition of the plane (Daza, Wagemakers, Georgeot, Guéry-Odelin, Sanjuán).

A box of ε x ε cells in which the colours have the shares p_i has the entropy Σ p_i log(1/p_i).
S_b is the mean over all boxes, S_bb over those of more than one colour.  S_b ~ ε^α, α the
uncertainty exponent: 1 for a smooth boundary, less for a fractal one.  The criterion S_bb > log 2
of these authors is sufficient for a fractal boundary in the limit ε -> 0 and of three colours or
more: of two, as here, no entropy exceeds log 2.
"""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.diagnostics import fate
from cap.floats.diagnostics.fate import LOST, Fate
from cap.floats.diagnostics.grid import Box
from cap.floats.findings import Findings, Floats, State
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

SIZES = (2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50)


class Entropy(NamedTuple):
    """S_b and S_bb (nats), the number of boxes, and of those on the boundary."""

    mean: float
    boundary: float
    boxes: int
    mixed: int


@dataclass(frozen=True, kw_only=True)
class BasinEntropy(Findings):
    """Entropies of the partition in ``basin`` over box sizes (K,), in cells.

    ``exponent`` is the slope of log S_b over log ε, with its standard error.
    """

    sizes: NDArray[np.int64]
    mean: Floats
    boundary: Floats
    boxes: NDArray[np.int64]
    mixed: NDArray[np.int64]
    exponent: float
    error: float
    intercept: float
    basin: tuple[Fate, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return one row for each box size."""
        return {
            "size": self.sizes,
            "S_b": self.mean,
            "S_bb": self.boundary,
            "boxes": self.boxes,
            "mixed": self.mixed,
        }

    def lines(self) -> list[str]:
        """Return the entropies and the exponent."""
        rows = zip(self.sizes, self.mean, self.boundary, self.mixed, self.boxes, strict=True)
        return [
            f"basin entropy at {described(self.parameters)}, of two colours at most log 2 = "
            f"{math.log(2):.4f}",
            *(
                f"  {size:>3} x {size:<3} S_b {mean:.4f}  S_bb {edge:.4f}  {mixed} of {boxes} boxes"
                for size, mean, edge, mixed, boxes in rows
            ),
            f"  uncertainty exponent {self.exponent:.4f} +- {self.error:.4f}",
        ]


def basin_entropy(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    orbit: State | None = None,
    box: Box | None = None,
    points: int = 600,
    periods: int = 25,
    boxes: tuple[int, ...] = (),
    runner: Runner | None = None,
) -> BasinEntropy:
    """Return the entropies of the two colours: never turns, and turns, sticks or is captured."""
    runner = runner or Runner()
    basin = fate.fate(p, orbit=orbit, box=box, points=points, periods=periods, runner=runner)
    sizes = boxes or tuple(size for size in SIZES if size <= points // 4) or (1,)
    if max(sizes) > points:
        raise BadInput(f"a box of {max(sizes)} cells does not fit into {points} x {points}")
    known = basin.fate != LOST
    found = [entropy(basin.dissipates, size, known) for size in sizes]
    slope, error, intercept = _fit(sizes, [each.mean for each in found])
    return BasinEntropy(
        parameters=p,
        complete=basin.complete,
        sizes=np.array(sizes),
        mean=np.array([each.mean for each in found]),
        boundary=np.array([each.boundary for each in found]),
        boxes=np.array([each.boxes for each in found]),
        mixed=np.array([each.mixed for each in found]),
        exponent=slope,
        error=error,
        intercept=intercept,
        basin=(basin,),
    )


def entropy(
    colours: NDArray[np.generic], size: int, known: NDArray[np.bool_] | None = None
) -> Entropy:
    """Return the entropy of an array (M, N) of colours with boxes of size x size cells.

    Boxes tile the array from its corner; what is left at the other edges is not counted, nor are
    boxes of which a cell is not ``known``.  nan if there is no box.
    """
    tiles = _tiles(colours, size)
    if known is not None:
        tiles = tiles[_tiles(known, size).all(axis=1)]
    if not len(tiles):
        return Entropy(math.nan, math.nan, 0, 0)
    shares = np.stack([(tiles == colour).mean(axis=1) for colour in np.unique(tiles)])
    with np.errstate(divide="ignore", invalid="ignore"):
        each = -np.where(shares > 0, shares * np.log(shares), 0.0).sum(axis=0)
    mixed = shares.max(axis=0) < 1
    edge = float(each[mixed].mean()) if mixed.any() else 0.0
    return Entropy(abs(float(each.mean())), edge, len(tiles), int(mixed.sum()))


def _tiles(cells: NDArray[Any], size: int) -> NDArray[Any]:
    """Return the boxes (K, size²) of an array."""
    rows, columns = (n // size for n in cells.shape)
    quarters = cells[: rows * size, : columns * size].reshape(rows, size, columns, size)
    return quarters.swapaxes(1, 2).reshape(rows * columns, size * size)


def _fit(sizes: tuple[int, ...], means: list[float]) -> tuple[float, float, float]:
    """Return the slope of log S_b over log ε, its standard error, and the intercept."""
    use = [
        (math.log(size), math.log(mean))
        for size, mean in zip(sizes, means, strict=True)
        if mean > 0
    ]
    if len(use) < 3:
        return math.nan, math.nan, math.nan
    x, y = np.array(use).T
    (slope, intercept), *_ = np.polyfit(x, y, 1, full=True)
    rest = y - slope * x - intercept
    spread = ((x - x.mean()) ** 2).sum()
    error = math.sqrt(float((rest**2).sum()) / max(1, len(x) - 2) / spread)
    return float(slope), error, float(intercept)
