"""The equations for the hit times, against differences and dense sampling."""

import numpy as np
import pytest

from cap.floats.engine import lifted
from cap.floats.engine.lifted import PERIOD, Ratios

RATIOS = [Ratios(0.4, 2.0), Ratios(0.0, 0.3), Ratios(0.9, 50.0)]


@pytest.mark.parametrize("hits", [2, 4, 6])
@pytest.mark.parametrize("ratios", RATIOS)
def test_jacobian_is_the_derivative(hits, ratios):
    """Each entry is the central difference quotient of the equations."""
    times, h = lifted.seeds(hits, 20), 1e-6
    _, jacobian = lifted.equations(times, ratios)
    for k in range(hits):
        shift = h * (np.arange(hits) == k)
        plus, _ = lifted.equations(times + shift, ratios)
        minus, _ = lifted.equations(times - shift, ratios)
        scale = np.abs(jacobian).max()
        np.testing.assert_allclose(
            jacobian[:, :, k] / scale, (plus - minus) / (2 * h * scale), atol=1e-7
        )


@pytest.mark.parametrize("hits", [2, 4, 6])
@pytest.mark.parametrize("ratios", RATIOS)
def test_first_equation_is_the_sum_of_the_jumps(hits, ratios):
    """It is the sum of (end velocity - start velocity) over the flights."""
    times = lifted.seeds(hits, 20)
    _, _, start, end = lifted.flights(times, ratios)
    value, _ = lifted.equations(times, ratios)
    np.testing.assert_allclose(value[:, 0], (end - start).sum(axis=1), atol=1e-11 * ratios.rho)


@pytest.mark.parametrize("ratios", RATIOS)
def test_each_flight_covers_the_distance_of_the_walls(ratios):
    """Sampled at 4001 times: the mean velocity gives ρ, and the least is where ``slowest`` says."""
    times = lifted.seeds(4, 20)
    s, d, start, end = lifted.flights(times, ratios)
    part = np.linspace(0, 1, 4001)[:, None, None]
    at = times + part * d
    u = start + s * (np.sin(at) - np.sin(times)) - ratios.alpha * (at - times)
    np.testing.assert_allclose((u[1:] + u[:-1]).mean(axis=0) / 2 * d, ratios.rho, rtol=1e-4)
    np.testing.assert_allclose(u[-1], end, atol=1e-12 * ratios.rho + 1e-12)
    when, least = lifted.slowest(times, ratios)
    np.testing.assert_allclose(u.min(axis=0), least, atol=1e-5)
    assert (u.min(axis=0) >= least - 1e-12 * ratios.rho - 1e-12).all()
    assert ((when >= times) & (when <= times + d)).all()


@pytest.mark.parametrize("hits", [2, 4, 6, 8])
def test_seeds_are_ordered_and_the_same_every_time(hits):
    """Consecutive hits are a fifth of the mean gap apart, also across the period."""
    times = lifted.seeds(hits)
    closed = np.concatenate([times, times[:, :1] + PERIOD], axis=1)
    assert (np.diff(closed, axis=1) >= 0.2 * PERIOD / hits - 1e-12).all()
    assert np.array_equal(times, lifted.seeds(hits))


def test_mirror_twice_is_the_same_orbit():
    """Two shifts by half a period with reflection leave the states as they were."""
    times, ratios = lifted.seeds(6, 20), Ratios(0.1, 2.0)
    twice = lifted.mirror(lifted.mirror(times))
    np.testing.assert_allclose(lifted.states(times, ratios), lifted.states(twice, ratios))


@pytest.mark.parametrize("hits", [2, 4])
def test_newton_keeps_the_order_of_the_hits(hits):
    """Most seeds converge, and no flight of a solution is shorter than 0.1."""
    ratios = Ratios(0.0, 0.3)
    found = lifted.newton(lifted.seeds(hits), ratios)
    assert len(found) > 900
    assert (lifted.flights(found, ratios).duration > 0.1).all()


def test_a_row_that_fails_does_not_spoil_the_others():
    """A seed with a Jacobian that is not finite is dropped; the other solutions are unchanged."""
    ratios, good = Ratios(0.4, 2.0), lifted.seeds(2, 3)
    bad = np.array([[0.5, 0.5]])  # no time between the hits: the Jacobian is not finite
    found = lifted.newton(np.concatenate([bad, good]), ratios)
    np.testing.assert_array_equal(found, lifted.newton(good, ratios))


def test_singular_matrices_are_solved_by_least_squares(monkeypatch):
    """If numpy refuses to solve the batch, the same solutions are found without it."""

    def solve(*_):
        raise np.linalg.LinAlgError

    ratios, times = Ratios(0.4, 2.0), lifted.seeds(2, 20)
    expected = lifted.newton(times, ratios)
    monkeypatch.setattr(np.linalg, "solve", solve)
    bad = np.array([[0.5, 0.5]])
    found = lifted.newton(np.concatenate([bad, times]), ratios)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_only_determined_orbits_are_isolated():
    """Without friction and with far walls solutions form curves: none is called isolated."""
    times = lifted.newton(lifted.seeds(4), Ratios(0.0, 1e4))
    assert len(times)
    assert not lifted.is_isolated(times, Ratios(0.0, 1e4)).any()
