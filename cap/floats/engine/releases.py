"""The release map in floats, of many places at once (see `cap.release.passage`).

Between the walls every orbit rests just before its release, or not at all.  So the orbits are
followed from there for half a period, mirrored, and looked at: who rests has arrived.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters

EARLY = 1e-9  # periods before the release
LONGEST = 32  # half-periods
MIRRORED = [1, 0, 3, 2, 4, 6, 5, 8, 7]  # of `cap.flow.words.WORDS`


@dataclass(frozen=True)
class Images:
    """The next releases of N masses: ``value`` (N,), ``slope`` G' (N,), nan where there is none.

    ``half_periods`` (N,) until then, 0 if there is none.  ``counts`` (N, 9) of all events.
    """

    value: Floats
    slope: Floats
    half_periods: NDArray[np.int64]
    counts: NDArray[np.int64]


def images(p: Parameters, x: ArrayLike) -> Images:
    """Return where masses released to the right at places (N,) are released next, mirrored."""
    place = np.asarray(x, dtype=float)
    states = np.stack([place, np.zeros_like(place)], axis=1)
    tangent = np.tile([[1.0], [0.0]], (len(place), 1, 1))
    found = Images(
        np.full(len(place), np.nan),
        np.full(len(place), np.nan),
        np.zeros(len(place), dtype=np.int64),
        np.zeros((len(place), 9), dtype=np.int64),
    )
    left = np.flatnonzero((place > float(p.l)) & (place < float(p.r)))
    for n in range(1, LONGEST + 1):
        if not len(left):
            break
        done = swarm.follow(p, states[left], 0.5, _before_release(p), derivative=True)
        states[left] = [float(p.l + p.r), 0.0] - done.states
        tangent[left] = -(_given(done.monodromy) @ tangent[left])
        order = MIRRORED if n % 2 == 0 else list(range(9))
        found.counts[left] += done.counts[:, order]
        rests = (states[left, 1] == 0) & (states[left, 0] < float(p.r))
        here = left[rests]
        found.value[here], found.slope[here] = states[here, 0], tangent[here, 0, 0]
        found.half_periods[here] = n
        left = left[~rests & ~done.lost]
    return found


def period_of(iterates: Floats, close: float) -> int:
    """Return the least period of all columns of (N, K), at most N/2, to within so much; or 0.

    Columns that end, with NaN, do not count, unless all do.
    """
    kept = iterates[:, np.isfinite(iterates).all(axis=0)]
    if kept.shape[1]:
        for n in range(1, len(kept) // 2 + 1):
            if (np.abs(kept[n:] - kept[:-n]) < close).all():
                return n
    return 0


def _before_release(p: Parameters) -> float:
    """Return a time just before a release to the right."""
    period = 2 * math.pi / float(p.omega)
    return (2 * math.pi - math.acos(p.f / p.F)) / float(p.omega) - EARLY * period


def _given(monodromy: Floats | None) -> Floats:
    if monodromy is None:  # it was asked for
        raise TypeError
    return monodromy
