"""Newton's method for fixed points of Φⁿ from many seeds at once, by compiled code.

The seeds are those of Roberts' sequence R2, which fills a rectangle evenly for any number of them.
"""

import numpy as np
from numpy.typing import NDArray

from cap.floats import swarm
from cap.floats.grid import whole
from cap.floats.study import Floats
from cap.parameters import Parameters

SEEDS = 20_000
MOST_EVENTS = 20_000_000  # that all seeds together may have in a step: a few seconds
TRIED = 100  # seeds by which this is estimated
STEPS = 40
LONGEST = 0.2  # step, in units of R and Rω
CLOSE = 1e-9  # the last step, in the same units
SAME = 1e-7
ALONE = 1e-10  # least determinant of Φ' - 1, over the square of its size, of an isolated orbit
PLASTIC = 1.32471795724474602596


def fixed_points(p: Parameters, periods: int) -> Floats:
    """Return the distinct states (N, 2) that Newton's method reaches from all over the plane.

    The seeds fill the rectangle of `cap.floats.grid.whole`; there are fewer if they have many
    events.
    """
    unit = np.array([float(p.R), float(p.R * p.omega)])
    left, right, low, high = whole(p)
    corner, span = np.array([left, low]) / unit, np.array([right - left, high - low]) / unit
    seeds = corner + span * _sequence(_count(p, periods, corner, span))
    return reached(p, periods, seeds * unit)


def reached(p: Parameters, periods: int, seeds: Floats, longest: float = LONGEST) -> Floats:
    """Return the distinct states (N, 2) that Newton's method for Φⁿ reaches from seeds (M, 2).

    No step is longer than ``longest``, in units of R and Rω.  Orbits that leave the walls, or are
    lost, are given up.
    """
    unit = np.array([float(p.R), float(p.R * p.omega)])
    left, right, *_ = whole(p)
    z, found = seeds / unit, [np.empty((0, 2))]
    for _ in range(STEPS):
        step = _step(p, periods, z, unit)
        size = np.abs(step).max(axis=1)
        found.append(z[size < CLOSE])
        keep = (size >= CLOSE) & (size < 1e6)
        z, step, size = z[keep], step[keep], size[keep]
        z = z + step * np.minimum(1, longest / size)[:, None]
        z = z[(z[:, 0] >= left / unit[0]) & (z[:, 0] <= right / unit[0])]
    return np.asarray(_distinct(np.concatenate(found)) * unit)


def _sequence(count: int) -> Floats:
    """Return points (N, 2) of the unit square."""
    k = np.arange(count)[:, None]
    return np.asarray((0.5 + k / PLASTIC ** np.array([1, 2])) % 1)


def _count(p: Parameters, periods: int, corner: Floats, span: Floats) -> int:
    """Return how many seeds there may be."""
    unit = np.array([float(p.R), float(p.R * p.omega)])
    tried = swarm.follow(p, (corner + span * _sequence(TRIED)) * unit, periods)
    events = max(1.0, float(tried.counts.sum(axis=1).mean()))
    return int(min(SEEDS, MOST_EVENTS / events))


def _step(p: Parameters, periods: int, z: Floats, unit: Floats) -> Floats:
    """Return the steps (N, 2) of Newton's method, in natural units; nan where there is none.

    There is none to orbits that are not isolated, such as those between the walls without a hit.
    """
    found = swarm.follow(p, z * unit, periods, derivative=True)
    if found.monodromy is None:  # it was asked for
        raise TypeError
    defect = found.states / unit - z
    a = np.eye(2) - found.monodromy / unit[:, None] * unit
    with np.errstate(all="ignore"):
        det = a[:, 0, 0] * a[:, 1, 1] - a[:, 0, 1] * a[:, 1, 0]
        first = a[:, 1, 1] * defect[:, 0] - a[:, 0, 1] * defect[:, 1]
        second = a[:, 0, 0] * defect[:, 1] - a[:, 1, 0] * defect[:, 0]
        det[np.abs(det) < ALONE * (a * a).sum(axis=(1, 2))] = np.nan
        return np.asarray(np.stack([first, second], axis=-1) / det[:, None])


def _distinct(z: Floats) -> Floats:
    """Return one of all states that are the same."""
    chosen: list[NDArray[np.float64]] = []
    while len(z):
        chosen.append(z[0])
        z = z[np.abs(z - z[0]).max(axis=1) > SAME]
    return np.array(chosen).reshape(-1, 2)
