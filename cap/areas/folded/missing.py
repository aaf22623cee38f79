"""Compiled: the measure of places of release without a fate, as `cap.checker.folded.masses`."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.checker.folded.masses import UNIT, Places
from cap.checker.folded.table import ATTRACTOR, EITHER, SEGMENT
from cap.sets.compiled import kernel, sources
from cap.sets.kept import kept

Floats = NDArray[np.float64]

FATES = ATTRACTOR, SEGMENT, EITHER
MORE = 1e-12  # more than rounding of sums


class Known(NamedTuple):
    """Parts of [0, W] with these ends (N + 1,), and for each fate (3, ...) the measure without it.

    ``masses`` (3, N) are those of the parts, ``sums`` (3, N + 1) those before each.
    """

    ends: Floats
    masses: Floats
    sums: Floats


def known(places: Places) -> Known:
    """Return what is known of places."""
    masses = np.array([places.masses[fate] for fate in FATES], np.float64) / UNIT
    sums = np.concatenate([np.zeros((len(FATES), 1)), np.cumsum(masses, axis=1)], axis=1)
    return Known(np.array(places.ends, np.float64), masses, sums)


@kernel
def _part(known: Known, x: float) -> int:
    """Return the number of the part that contains a place."""
    low, high = 0, known.masses.shape[1]
    while high - low > 1:
        middle = (low + high) // 2
        if known.ends[middle] <= x:
            low = middle
        else:
            high = middle
    return low


@kernel
def missing(known: Known, fate: int, low: float, high: float) -> float:
    """Return a bound of the measure of the places in an interval without a fate."""
    ends, masses, sums = known.ends, known.masses[fate], known.sums[fate]
    low, high = max(low, 0.0), min(high, ends[-1])
    i, j = _part(known, low), _part(known, high)
    if i >= j:
        return float(min(masses[i], max(0.0, high - low)) + MORE)
    whole = sums[j] - sums[i + 1]
    less = min(masses[i], ends[i + 1] - low) + min(masses[j], high - ends[j])
    return float(less + whole + MORE)


@kernel
def all_have(known: Known, fate: int, low: float, high: float) -> bool:
    """Return whether all places in an interval have a fate."""
    i, j = _part(known, max(low, 0.0)), _part(known, min(high, known.ends[-1]))
    return bool(known.sums[fate][j + 1] == known.sums[fate][i])


def _means(known: Known, fate: int, places: Floats, found: Floats) -> None:
    """Write the means of what is missing in intervals (N, K, 2): (N,)."""
    for n in range(len(found)):
        total = 0.0
        for k in range(places.shape[1]):
            total += missing(known, fate, places[n, k, 0], places[n, k, 1])
        found[n] = total / places.shape[1]


means = kept(_means, sources())
