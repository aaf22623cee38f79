"""Regions whose names are symbols: clusters of points of the invariant set, with gaps between;
or cells of a grid.

A half-plane orients the unstable directions: its edge is a direction that few of them have.
Clusters are those of single linkage: what is joined by steps shorter than a gap.
"""

import numpy as np

from cap.floats.coverings.leaves import Leaves, Regions
from cap.floats.coverings.planar import Floats, Planar
from cap.floats.coverings.saddles import Saddle

CELLS = 300  # of the table, in each direction
NUMBERS = (2, 6, 12, 18, 24)  # of clusters that are tried
FIRST, TRIED = (
    (5, 7),
    (4, 5),
)  # symbols before and after: of the sample, and when clusters are tried
BINS = 36  # of directions
GRID, RIM = 4, 0.02  # cells in each direction; of the rectangle


def regions(g: Planar, saddle: Saddle) -> Regions:
    """Return regions whose words tell points apart: the fewest that leave no word torn."""
    window = np.array(g.window, dtype=np.float64)
    one = np.zeros((CELLS, CELLS), dtype=np.int64)
    sample = Leaves(g, saddle, Regions(one, window, saddle.unstable), *FIRST)
    direction = _direction(np.array([piece.T for piece in sample.pieces.values()]))
    points = np.array([piece.z for piece in sample.pieces.values()])
    best = sample.torn + 1, Regions(one, window, direction)
    window, nearest = _nearest(points, g.size)
    joints = _joints(points)
    for number in NUMBERS:
        labels = _clusters(points, joints, number)
        tried = Regions(labels[nearest].reshape(CELLS, CELLS), window, direction)
        torn = Leaves(g, saddle, tried, *TRIED).torn
        best = min(best, (torn, tried), key=lambda pair: pair[0])
        if torn == 0:
            break
    return best[1]


def cells(g: Planar, saddle: Saddle, symbols: tuple[int, int] = FIRST) -> Regions:
    """Return the cells of a grid over the least rectangle around a sample: where points of the
    invariant set have no gaps between them, as on an attractor, there are no clusters.

    The sample has words of so many symbols before and after.
    """
    window, one = np.array(g.window), np.zeros((1, 1), dtype=np.int64)
    sample = Leaves(g, saddle, Regions(one, window, saddle.unstable), *symbols)
    direction = _direction(np.array([piece.T for piece in sample.pieces.values()]))
    points = np.array([piece.z for piece in sample.pieces.values()])
    low, high = points.min(axis=0), points.max(axis=0)
    rim = np.maximum(RIM * (high - low), 1e-9 * g.size)  # a sample may be one point
    window = np.stack([low - rim, high + rim], axis=1).reshape(-1)
    return Regions(np.arange(GRID**2).reshape(GRID, GRID), window, direction)


def _direction(tangents: Floats) -> Floats:
    """Return the normal of the direction that is the rarest among tangents."""
    angles = np.arctan2(tangents[:, 1], tangents[:, 0]) % np.pi
    counts = np.histogram(angles, bins=BINS, range=(0, np.pi))[0].astype(float)
    wide = sum(np.roll(counts, k) for k in (-2, -1, 0, 1, 2))
    rare = (int(np.argmin(wide)) + 0.5) * np.pi / BINS + np.pi / 2
    return np.array([np.cos(rare), np.sin(rare)])


def _joints(points: Floats) -> list[tuple[float, int, int]]:
    """Return the edges (length, i, j) of a least spanning tree, the longest first."""
    distance = np.full(len(points), np.inf)
    from_, here, joints = np.zeros(len(points), dtype=np.int64), 0, []
    free = np.ones(len(points), dtype=bool)
    for _ in range(len(points) - 1):
        free[here] = False
        now = np.hypot(*(points - points[here]).T)
        closer = free & (now < distance)
        distance[closer], from_[closer] = now[closer], here
        here = int(np.argmin(np.where(free, distance, np.inf)))
        joints.append((float(distance[here]), int(from_[here]), here))
    return sorted(joints, reverse=True)


def _clusters(
    points: Floats, joints: list[tuple[float, int, int]], number: int
) -> np.ndarray[tuple[int, ...], np.dtype[np.int64]]:
    """Return the number of the cluster of each point: the longest joints are cut."""
    labels = np.arange(len(points))
    for _, i, j in joints[number - 1 :]:
        labels[labels == labels[j]] = labels[i]
    return np.unique(labels, return_inverse=True)[1].astype(np.int64)


def _nearest(
    points: Floats, size: float
) -> tuple[Floats, np.ndarray[tuple[int], np.dtype[np.int64]]]:
    """Return a window around the points, and for each cell of its table the nearest point."""
    low, high = points.min(axis=0) - 0.05 * size, points.max(axis=0) + 0.05 * size
    steps = (np.arange(CELLS) + 0.5) / CELLS
    x, y = (low[k] + (high[k] - low[k]) * steps for k in (0, 1))
    rows = [
        np.argmin((points[:, 0, None] - here) ** 2 + (points[:, 1, None] - y) ** 2, axis=0)
        for here in x
    ]
    return np.array([low[0], high[0], low[1], high[1]]), np.concatenate(rows)
