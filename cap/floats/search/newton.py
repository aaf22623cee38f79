"""Newton's method for fixed points of Φⁿ from many seeds at once, by compiled code.

The seeds are those of Roberts' sequence R2, which fills a rectangle evenly for any number of them;
some are followed through a transient first, which brings them near the sinks.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.diagnostics.grid import whole
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.floats.search.cycles import CLOSE, LONGEST, SAME
from cap.flow.itinerary import MOST_EVENTS
from cap.parameters import Parameters

SEEDS = 20_000
SETTLED = 256  # of the seeds are followed through a transient, too
TRANSIENT = 30  # times n periods
MOST_FOLLOWED = 2_000_000  # events that all seeds together may have in a step: half a second
TRIED = 100  # seeds by which this is estimated
STEPS = 40
ALONE = 1e-10  # least determinant of Φ' - 1, over the square of its size, of an isolated orbit
PLASTIC = 1.32471795724474602596

Tell = Callable[[float], None]


def fixed_points(p: Parameters, periods: int, tell: Tell = lambda _part: None) -> Floats:
    """Return the distinct states (N, 2) that Newton's method reaches from all over the plane.

    The seeds fill the rectangle of `cap.floats.diagnostics.grid.whole`; there are fewer if they
    have many events.  ``tell`` hears which part is done.  Raises `BadInput` if the orbits have so
    many events that `cap.flow.itinerary` cannot follow them.
    """
    unit = np.array([float(p.R), float(p.R * p.omega)])
    left, right, low, high = whole(p)
    corner, span = np.array([left, low]) / unit, np.array([right - left, high - low]) / unit
    seeds = (corner + span * _sequence(SEEDS)) * unit
    seeds = seeds[: _count(p, periods, seeds)]
    late = swarm.follow(p, seeds[:SETTLED], TRANSIENT * periods).states
    late = late[np.isfinite(late).all(axis=1)]
    return reached(p, periods, np.concatenate([seeds, late]), tell=tell)


def reached(
    p: Parameters,
    periods: int,
    seeds: Floats,
    longest: float = LONGEST,
    tell: Tell = lambda _part: None,
) -> Floats:
    """Return the distinct states (N, 2) that Newton's method for Φⁿ reaches from seeds (M, 2).

    No step is longer than ``longest``, in units of R and Rω.  Orbits that leave the walls, or are
    lost, are given up.
    """
    unit = np.array([float(p.R), float(p.R * p.omega)])
    left, right, *_ = whole(p)
    z, found = seeds / unit, [np.empty((0, 2))]
    for k in range(STEPS):
        step = _step(p, periods, z, unit)
        size = np.abs(step).max(axis=1)
        found.append(z[size < CLOSE])
        keep = (size >= CLOSE) & (size < 1e6)
        z, step, size = z[keep], step[keep], size[keep]
        z = z + step * np.minimum(1, longest / size)[:, None]
        z = z[(z[:, 0] >= left / unit[0]) & (z[:, 0] <= right / unit[0])]
        tell((k + 1) / STEPS)
    return np.asarray(_distinct(np.concatenate(found)) * unit)


def _sequence(count: int) -> Floats:
    """Return points (N, 2) of the unit square."""
    k = np.arange(count)[:, None]
    return np.asarray((0.5 + k / PLASTIC ** np.array([1, 2])) % 1)


def _count(p: Parameters, periods: int, seeds: Floats) -> int:
    """Return how many seeds there may be."""
    tried = swarm.follow(p, seeds[:TRIED], periods)
    events = tried.counts.sum(axis=1)
    if (tried.lost | (events > MOST_EVENTS)).all():
        raise BadInput(
            "the orbits have too many events in a period for a search (a guess can be given with "
            "--orbit X V)"
        )
    return int(min(SEEDS, MOST_FOLLOWED / max(1.0, float(events.mean()))))


def _step(p: Parameters, periods: int, z: Floats, unit: Floats) -> Floats:
    """Return the steps (N, 2) of Newton's method, in natural units; nan where there is none.

    There is none to orbits that are not isolated, such as those between the walls without a hit.
    """
    found = swarm.follow(p, z * unit, periods, derivative=True)
    defect = found.states / unit - z
    a = np.eye(2) - found.derivatives / unit[:, None] * unit
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
