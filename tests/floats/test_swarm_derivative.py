"""The derivatives of the float flow: against divided differences, and what is made of them."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from support import seeded
from test_swarm import state_of

from cap.floats.engine.swarm import follow, itinerary, stretch
from cap.parameters import PAPER

LOSSY = replace(PAPER, e=Fraction(3, 5), f=Fraction(3, 10))
VISCOUS = replace(LOSSY, mu=Fraction(1, 5), omega=Fraction(3, 2), F=Fraction(2))
STEP = 1e-6


def differences(p, state, periods, t0):
    """Return the central divided differences of the flow, and whether no event comes or goes."""
    moved = np.array(state) + STEP * np.array([(1, 0), (-1, 0), (0, 1), (0, -1)])
    swarm = follow(p, moved, periods, t0)
    same = all((swarm.counts == follow(p, [state], periods, t0).counts).all(axis=1))
    ends = swarm.states
    return np.stack([ends[0] - ends[1], ends[2] - ends[3]], axis=1) / (2 * STEP), same


@pytest.mark.parametrize("p", [PAPER, LOSSY, VISCOUS])
def test_divided_differences(p):
    """The monodromy is the derivative, through every kind of event."""
    random, kinds, tried = seeded(4), set(), 0
    while tried < 150:
        state, t0 = np.array(state_of(random, p)), random.uniform(0, 7)
        state[0] *= 0.99
        swarm = follow(p, [state], 0.8, t0, derivative=True)
        expected, same = differences(p, state, 0.8, t0)
        m, events = swarm.monodromy[0], itinerary(p, state, 0.8, t0)
        slowest = min((abs(e.before) for e in events if e.word[0] == "h"), default=1.0)
        if not same or (slowest < 1e-2 and not swarm.captured[0]):
            continue
        tried += 1
        kinds |= {event.word.split()[0] for event in events}
        np.testing.assert_allclose(m, expected, rtol=1e-4, atol=1e-4 * (1 + np.abs(m).max()))
    assert kinds == {"hit", "turn", "stick", "capture", "release"}


def test_determinant():
    """Hits and flights keep areas at e = 1, μ = 0; otherwise by e² and exp(-μ t); rest has none."""
    elliptic = 0.1002798898441954, 0.5419433067664584
    conserved = follow(PAPER, [elliptic], 5, derivative=True)
    assert conserved.counts[0].tolist() == [5, 5, 0, 0, 0, 0, 0, 0, 0]
    assert abs(np.linalg.det(conserved.monodromy[0]) - 1) < 1e-12
    p = replace(PAPER, e=Fraction(99, 100), mu=Fraction(1, 100))
    lossy = follow(p, [elliptic], 1, derivative=True)
    expected = 0.99 ** (2 * lossy.count("hit")[0]) * np.exp(-0.01 * 2 * np.pi)
    assert not lossy.turned[0]
    assert abs(np.linalg.det(lossy.monodromy[0]) - expected) < 1e-12
    assert follow(PAPER, [(0.999, 0.001)], 1, derivative=True).monodromy.tolist() == [[[0, 0]] * 2]
    resting = follow(PAPER, [(0.2, 0.0)], 0.05, 1.3, derivative=True)
    assert resting.monodromy.tolist() == [[[1, 0], [0, 0]]]


def test_of_each_period():
    """The derivatives of the periods multiply to that of the whole."""
    random = seeded(2)
    states = [state_of(random, VISCOUS) for _ in range(50)]
    whole = follow(VISCOUS, states, 3.5, 0.4, derivative=True).monodromy
    a, b, c, d = np.moveaxis(
        follow(VISCOUS, states, 3.5, 0.4, every=True, derivative=True).monodromy, 1, 0
    )
    np.testing.assert_allclose(d @ c @ b @ a, whole, rtol=1e-11, atol=1e-11)


def test_stretch():
    """Deviations stretch as the product of the derivatives does; alignment is seen in them."""
    saddle, elliptic = (0.34352606, 0.7753195), (0.1002798898441954, 0.5419433067664584)
    steps = follow(PAPER, [saddle, elliptic], 4, every=True, derivative=True).monodromy
    units, growth = stretch(steps, np.eye(2))
    assert units.shape == (2, 4, 2, 2)
    assert growth.shape == (2, 4, 2)
    whole = follow(PAPER, [saddle, elliptic], 4, derivative=True).monodromy
    along = units[:, -1] * np.exp(growth.sum(axis=1))[..., None]
    np.testing.assert_allclose(along, np.swapaxes(whole, 1, 2), rtol=1e-9)
    areas = np.abs(np.linalg.det(units[:, -1]))  # GALI of two deviations
    assert areas[0] < 1e-3
    assert areas[1] > 1e-1
    first, second = stretch(steps[:, :2], np.eye(2)), stretch(steps[:, 2:], units[:, 1])
    np.testing.assert_array_equal(np.concatenate([first[1], second[1]], axis=1), growth)


def test_stretch_to_nothing():
    """A capture takes every deviation to 0: growth -inf, and no warning."""
    steps = follow(PAPER, [(0.999, 0.001)], 2, every=True, derivative=True).monodromy
    units, growth = stretch(steps, np.eye(2))
    assert (growth == -np.inf).all()
    assert (units == 0).all()
