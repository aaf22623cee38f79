"""Chains of islands around P*, found by Newton's method from seeds in the island."""

from fractions import Fraction

import numpy as np
import pytest

from cap.floats.diagnostics.chains import chains
from cap.floats.diagnostics.portrait import portrait
from cap.floats.engine import swarm
from cap.parameters import PAPER

KNOWN = [Fraction(q) for q in ("2/7", "7/25", "5/18", "8/29", "3/11")]


@pytest.fixture(scope="module")
def found():
    """Return the chains with q <= 29."""
    seen = portrait(PAPER, radius=0.025, orbits=400, periods=100)
    seeds = seen.states[~seen.turned].reshape(-1, 2)
    return seen.centre, chains(PAPER, seen.centre, seeds[::20], 29)


@pytest.mark.slow
def test_the_chains_of_the_island(found):
    """Also those that no orbit on the ray along x meets: 8/29 and 3/11."""
    assert [chain.number for chain in found[1]] == KNOWN


@pytest.mark.slow
def test_they_are_elliptic_orbits_that_never_turn(found):
    """Of period qT and no shorter one, with multipliers on the unit circle."""
    for chain in found[1]:
        q = chain.number.denominator
        assert chain.states.shape == (q, 2)
        once = swarm.follow(PAPER, chain.states, 1)
        assert not (once.turned | once.stuck | once.captured).any()
        np.testing.assert_allclose(once.states, np.roll(chain.states, -1, axis=0), atol=1e-8)
        apart = np.abs(chain.states[1:] - chain.states[0]).max(axis=1)
        assert apart.min() > 1e-4
        whole = swarm.follow(PAPER, chain.states[:1], q, derivative=True).monodromy[0]
        assert np.linalg.det(whole) == pytest.approx(1, abs=1e-6)
        assert abs(np.trace(whole)) < 2


@pytest.mark.slow
def test_they_turn_p_times_in_q_periods(found):
    """In the plane of x and v itself, where each step is from x to v, by less than half a turn."""
    centre, known = found
    for chain in known:
        z = (chain.states - centre) @ [1, 1j]
        turns = np.angle(np.roll(z, -1) / z) % (2 * np.pi)
        assert turns.max() < np.pi
        assert turns.sum() / (2 * np.pi) == pytest.approx(chain.number.numerator)


@pytest.mark.slow
def test_no_seeds_lead_to_no_chain(found):
    """Where nothing is to be found, nothing is said to be."""
    assert chains(PAPER, found[0], np.array([found[0]]), 8) == []
