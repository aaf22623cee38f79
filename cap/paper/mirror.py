"""Mirror images: (x, v, t) -> (-x, -v, t + T/2) takes orbits to orbits, as l = -r."""

from collections.abc import Iterable

import numpy as np

from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search.cycles import Cycle
from cap.parameters import Parameters

DIGITS = 6  # to which the state of an orbit and of its image are compared


def mirrored(p: Parameters, state: State) -> State:
    """Return the state at t = 0 of the mirror image of an orbit."""
    x, v = swarm.follow(p, [state], 0.5).states[0].tolist()
    return float(p.l + p.r) - x, -v


def defect(p: Parameters, state: State) -> float:
    """Return how far a state is from that of the mirror image."""
    return float(np.abs(np.subtract(mirrored(p, state), state)).max())


def of_pairs(p: Parameters, cycles: Iterable[Cycle]) -> list[tuple[Cycle, int]]:
    """Return one orbit of each pair of images, and for how many it stands: 2, or it alone."""
    found = []
    for cycle in cycles:
        own = np.round((cycle.x, cycle.v), DIGITS).tolist()
        image = np.round(mirrored(p, (cycle.x, cycle.v)), DIGITS).tolist()
        if own <= image:
            found.append((cycle, 1 if own == image else 2))
    return found
