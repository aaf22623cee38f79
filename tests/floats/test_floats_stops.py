"""Orbits that are left when they first stop: the same orbits, and the same first times."""

import math

import numpy as np
import pytest

from cap.floats.diagnostics.fate import fate
from cap.floats.diagnostics.stops import KINDS, stops
from cap.floats.engine import swarm
from cap.parameters import PAPER

BOX = 0.0, 0.2, 0.4, 0.7


def states(n):
    """Return states around the elliptic orbit, few of them in its island."""
    chance = np.random.default_rng(3)
    return np.stack([chance.uniform(0, 0.2, n), chance.uniform(0.4, 0.7, n)], axis=-1)


@pytest.mark.parametrize("periods", [0, 1, 3, 40])
def test_who_stops_and_when(periods):
    """As for orbits that are followed to the end; the first stop is at the same time."""
    starts = states(200)
    found, whole = stops(PAPER, starts, periods), swarm.follow(PAPER, starts, periods)
    stopped = whole.turned | whole.stuck | whole.captured
    assert np.array_equal(found.never, ~stopped & ~whole.lost)
    first = np.fmin.reduce([whole.first_time(kind) for kind in KINDS])
    assert np.array_equal(np.fmin.reduce(found.first), first, equal_nan=True)
    if periods == 40:
        assert 100 < stopped.sum() < 195


def test_fates_until_the_first_stop():
    """Who stops, and when, is the same; the fate is the kind of the first stop."""
    brief, whole = (
        fate(PAPER, box=BOX, points=20, periods=30, briefly=each) for each in (True, False)
    )
    assert np.array_equal(brief.dissipates, whole.dissipates)
    assert np.array_equal(brief.first, whole.first, equal_nan=True)
    times = np.stack([whole.turn, whole.stick, whole.capture])
    kinds = np.where(np.isnan(times), math.inf, times).argmin(axis=0) + 1
    assert np.array_equal(brief.fate, np.where(whole.dissipates, kinds, 0))
