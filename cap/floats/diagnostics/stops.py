"""When orbits first turn, stick or are captured: those that have are not followed any longer."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters

KINDS = "turn", "stick", "capture"
_STAGES = 2, 16, 128, 1024  # periods


class Stops(NamedTuple):
    """The times t of the first of each kind (3, N), nan for none; which orbits (N,) were lost.

    Soon after the first one an orbit is left: of the other kinds there may be some later.
    """

    first: Floats
    lost: NDArray[np.bool_]

    @property
    def never(self) -> NDArray[np.bool_]:
        """Which orbits, (N,), do not stop, and are not lost."""
        return np.isnan(self.first).all(axis=0) & ~self.lost


def stops(p: Parameters, states: Floats, periods: int) -> Stops:
    """Follow the orbits of states (N, 2), each until it stops, or for so many periods.

    In stages, each from the start on, so that an orbit is the same as without them.
    """
    n = len(states)
    found = Stops(np.full((len(KINDS), n), np.nan), np.zeros(n, dtype=np.bool_))
    left = np.arange(n)
    for stage in [*(each for each in _STAGES if 2 * each <= periods), periods]:
        seen = swarm.follow(p, states[left], stage)
        found.first[:, left] = [seen.first_time(kind) for kind in KINDS]
        found.lost[left] = seen.lost
        left = left[found.never[left]]
    return found
