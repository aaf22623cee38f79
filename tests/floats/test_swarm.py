"""Many orbits at once in floats: against mpmath, and against the laws of mechanics."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import oracle_flow
import pytest
from mpmath import mp
from support import rounds, seeded

from cap.errors import BadInput
from cap.floats.engine.swarm import follow, itinerary
from cap.parameters import PAPER, Parameters

SLOW = replace(PAPER, f=Fraction(7, 10))
DAMPED = replace(PAPER, e=Fraction(4, 5), mu=Fraction(1, 20))


def drawn(random):
    """Return random parameters; one in three are the paper's."""
    if random.random() < 0.3:
        return PAPER

    def rational(low, high):
        return Fraction(round(random.uniform(low, high) * 1000), 1000)

    F, omega, l = rational(0.5, 2), rational(0.5, 2), rational(-2, -0.1)
    e = random.choice([Fraction(1), rational(0.3, 1)])
    mu = random.choice([Fraction(0), rational(0, 1), Fraction(1, 10**6)])
    return Parameters(F, omega, F * rational(0, 0.9), l, rational(0.1, 2), e, mu)


def state_of(random, p):
    """Return a random state between the walls, or at one and slow."""
    if random.random() < 0.2:
        return float(random.choice([p.l, p.r])), random.uniform(-0.2, 0.2)
    return random.uniform(float(p.l), float(p.r)), random.uniform(-2, 2)


def told(events):
    """Return the events without the bounces, of any number, that lead to a capture."""
    result = []
    for event in events:
        if event.word.startswith("capture"):
            while result and result[-1].word[:3] in ("hit", "tur"):
                if event.time - result[-1].time > 1e-5:
                    break
                result.pop()
        result.append(event)
    return result


def slope(p, event):
    """Return a bound, at most 1, of the slope of what vanishes at an event."""
    if event.word.startswith("hit"):
        return min(1, abs(event.before))
    if event.word == "stick":
        return min(1, abs(abs(p.F * np.cos(float(p.omega) * event.time)) - float(p.f)))
    return 1


def compare(p, state, periods, t0=0.0, digits=35):
    """Check the end and the events of an orbit against mpmath; return its words."""
    swarm = follow(p, [state], periods, t0, derivative=True)
    x = next((wall for wall in (p.l, p.r) if float(wall) == state[0]), state[0])
    with mp.workdps(digits):
        end = t0 + periods * 2 * mp.pi / oracle_flow.number(p.omega)
        events, expected = oracle_flow.orbit(p, t0, x, state[1], end)
        expected, events = tuple(map(float, expected)), told(events)
    error = 2e-13 * (1 + np.abs(swarm.monodromy).max())
    np.testing.assert_allclose(swarm.states[0], expected, rtol=0, atol=error)
    if not swarm.grazing[0]:
        mine = told(itinerary(p, state, periods, t0))
        if mine and mine[0].time == t0 and mine[0].word.startswith("release"):
            mine = mine[1:]  # the oracle says nothing of what rests only for that moment
        assert [event.word for event in mine] == [event.word for event in events]
        for event, true in zip(mine, events, strict=True):
            assert abs(event.time - float(true.time)) < error / slope(p, event)
            assert abs(event.x - float(true.x)) < error
            if not event.word.startswith("capture"):
                assert abs(event.before - float(true.before)) < error
            assert abs(event.after - float(true.after)) < error
    return {event.word for event in events}


@pytest.mark.slow
def test_random_orbits_against_mpmath():
    """Ends and events agree with mpmath for random parameters, states, times; all kinds occur."""
    random, words = seeded(11), set()
    for _ in range(rounds(60)):
        p = drawn(random)
        t0 = random.choice([0.0, random.uniform(-7, 7)])
        words |= compare(p, state_of(random, p), random.choice([1, 1.3, 2]), t0)
    assert len(words) == 9


@pytest.mark.slow
@pytest.mark.parametrize("speed", [30.0, 200.0])
def test_many_hits_per_period(speed):
    """A fast mass, with hundreds of hits in a period, ends where it does in mpmath."""
    compare(replace(DAMPED, mu=Fraction(0), e=Fraction(1)), (0.3, speed), 1)


@pytest.mark.parametrize("p", [PAPER, SLOW, DAMPED])
def test_time_is_additive(p):
    """To t1 and then to t2 is to t2, wherever t1 is."""
    random = seeded(3)
    states = [state_of(random, p) for _ in range(200)]
    for first, second in [(1, 1), (0.37, 0.63), (0.5, 1.2)]:
        whole = follow(p, states, first + second, 0.2, derivative=True)
        part = follow(p, states, first, 0.2)
        rest = follow(p, part.states, second, 0.2 + first * 2 * np.pi)
        error = 1e-12 * (1 + np.abs(whole.monodromy).max(axis=(1, 2)))
        assert (np.abs(rest.states - whole.states).max(axis=1) < error).all()


@pytest.mark.parametrize("p", [PAPER, SLOW, replace(DAMPED, l=Fraction(-1, 2))])
def test_reflection(p):
    """(x, v, t) -> (l + r - x, -v, t + T/2) takes orbits to orbits."""
    random = seeded(5)
    states = np.array([state_of(random, p) for _ in range(200)])
    mirrored = [float(p.l + p.r), 0] - states
    orbit = follow(p, states, 1.5, 0.3, derivative=True)
    mirror = follow(p, mirrored, 1.5, 0.3 + np.pi)
    error = 1e-12 * (1 + np.abs(orbit.monodromy).max(axis=(1, 2)))
    there = [float(p.l + p.r), 0] - mirror.states
    assert (np.abs(there - orbit.states).max(axis=1) < error).all()
    swapped = orbit.counts[:, [1, 0, 3, 2, 4, 6, 5, 8, 7]]
    assert (mirror.counts == swapped).all(axis=1).mean() > 0.99  # the last bounces may differ


def test_scaling():
    """Only f/F, R ω²/F, μ/ω and e matter; with powers of two, to the last bit."""
    random, p = seeded(6), DAMPED
    q = replace(p, F=8 * p.F, f=8 * p.f, omega=2 * p.omega, mu=2 * p.mu, l=2 * p.l, r=2 * p.r)
    states = np.array([state_of(random, p) for _ in range(100)])
    one = follow(p, states, 3.25, 0.5, derivative=True)
    two = follow(q, states * [2, 4], 3.25, 0.25, derivative=True)
    np.testing.assert_array_equal(two.states, one.states * [2, 4])
    np.testing.assert_array_equal(two.first, one.first / 2)
    np.testing.assert_array_equal(two.monodromy, one.monodromy * [[1, 0.5], [2, 1]])


def balance(p, state, periods, t0):
    """Return how energy and impulse change along an orbit, and by which causes, by quadrature."""
    F, omega, f, mu = (float(value) for value in (p.F, p.omega, p.f, p.mu))
    events, period = itinerary(p, state, periods, t0), 2 * np.pi / omega
    end = t0 + periods * period
    nodes, weights = np.polynomial.legendre.leggauss(24)
    cuts = [t0, *(event.time for event in events), end]
    energy = sum((event.after**2 - event.before**2) / 2 for event in events)
    impulse = sum(event.after - event.before for event in events)
    for a, b in pairwise(cuts):
        times = (a + b) / 2 + (b - a) / 2 * nodes
        v = np.array([follow(p, [state], (t - t0) / period, t0).states[0, 1] for t in times])
        force = np.where(v == 0, 0, F * np.cos(omega * times) - f * np.sign(v) - mu * v)
        energy += (b - a) / 2 * (weights * force * v).sum()
        impulse += (b - a) / 2 * (weights * force).sum()
    return energy, impulse


@pytest.mark.parametrize("p", [PAPER, SLOW, DAMPED])
def test_energy_and_impulse(p):
    """Work of the forcing, friction, viscosity and impacts make up the change; walls and static
    friction do the rest while the mass rests.
    """
    random = seeded(8)
    for _ in range(4):
        x, v = state_of(random, p)
        end = follow(p, [(x, v)], 1.4, 0.1).states[0, 1]
        energy, impulse = balance(p, (x, v), 1.4, 0.1)
        assert abs(energy - (end**2 - v**2) / 2) < 1e-8
        assert abs(impulse - (end - v)) < 1e-8


def test_each_orbit_is_alone():
    """An orbit is the same to the last bit in any batch, in any run, on any thread."""
    random = seeded(9)
    states = np.array([state_of(random, PAPER) for _ in range(700)])
    whole = follow(PAPER, states, 4, every=True, derivative=True)
    again = follow(PAPER, states[::-1], 4, every=True, derivative=True)
    np.testing.assert_array_equal(again.states[::-1], whole.states)
    np.testing.assert_array_equal(again.monodromy[::-1], whole.monodromy)
    for i in range(0, 700, 50):
        one = follow(PAPER, states[i : i + 1], 4, every=True)
        np.testing.assert_array_equal(one.states[0], whole.states[i])
        np.testing.assert_array_equal(one.first[0], whole.first[i])
        assert len(itinerary(PAPER, states[i], 4)) == whole.counts[i].sum()


def test_shapes():
    """States at the end, or at the start and after each period; counts and flags go together."""
    states = [(0.1, 0.5), (0.999, 0.001), (0.5, -1.0)]
    end, every = follow(PAPER, states, 2.5), follow(PAPER, states, 2.5, every=True)
    assert end.states.shape == (3, 2)
    assert every.states.shape == (3, 4, 2)
    np.testing.assert_array_equal(every.states[:, 0], states)
    np.testing.assert_array_equal(every.states[:, -1], end.states)
    assert end.monodromy is None
    assert follow(PAPER, states, 2, every=True, derivative=True).monodromy.shape == (3, 2, 2, 2)
    np.testing.assert_array_equal(follow(PAPER, states, 0).states, states)
    assert follow(PAPER, np.empty((0, 2)), 3).states.shape == (0, 2)
    np.testing.assert_array_equal(end.turned, end.count("turn left") + end.count("turn right") > 0)
    np.testing.assert_array_equal(end.captured, np.isfinite(end.first_time("capture")))
    np.testing.assert_array_equal(end.stuck, np.isfinite(end.first_time("stick")))
    first = [itinerary(PAPER, state, 2.5)[0].time for state in states]
    np.testing.assert_array_equal(np.nanmin(end.first, axis=1), first)


@pytest.mark.parametrize("state", [(np.nan, 0), (0, np.nan), (0, np.inf), (1.001, 0), (0, 1e9)])
def test_lost(state):
    """No state, or too many events: nan, and nothing happens to the other orbits."""
    swarm = follow(PAPER, [state, (0.1, 0.5)], 2, derivative=True)
    assert swarm.lost.tolist() == [True, False]
    assert np.isnan(swarm.states[0]).all()
    assert np.isnan(swarm.monodromy[0]).all()
    np.testing.assert_array_equal(swarm.states[1:], follow(PAPER, [(0.1, 0.5)], 2).states)


def test_refusals():
    """What is no array of states, no time or no event is said to be so."""
    with pytest.raises(BadInput, match="pairs"):
        follow(PAPER, [(0.1, 0.5, 0.0)], 1)
    with pytest.raises(BadInput, match="periods"):
        follow(PAPER, [(0.1, 0.5)], -1)
    with pytest.raises(BadInput, match="finite"):
        follow(PAPER, [(0.1, 0.5)], 1, np.nan)
    with pytest.raises(BadInput, match="no such event"):
        follow(PAPER, [(0.1, 0.5)], 1).count("tur")
