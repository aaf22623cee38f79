"""From a rough state to a periodic orbit, or to the reason why there is none."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from systems import CASES, FRICTIONS

from cap.errors import BadInput
from cap.floats.engine import flow
from cap.floats.search import periodic
from cap.flow.itinerary import oscillator
from cap.parameters import PAPER


@pytest.mark.parametrize(("p", "hits"), CASES)
def test_near_finds_each_orbit_again(p, hits):
    """A state 1e-5 off leads back to each orbit of the search."""
    for g in periodic.orbits(p, hits):
        h = periodic.near(p, g.x + 1e-5, g.v - 1e-5)
        assert (h.x, h.v) == pytest.approx((g.x, g.v), abs=1e-11)
        assert h.trace == pytest.approx(g.trace, rel=1e-8)


@pytest.mark.parametrize("f", FRICTIONS)
def test_near_starts_from_turning_orbits_and_odd_itineraries(f):
    """Beside a saddle of trace 5740 or 1336, orbits turn, or miss a hit."""
    p, d = replace(PAPER, f=f), 3e-4
    for g in periodic.orbits(p, 2):
        for dx, dv in [(d, -d), (-d, d), (d, d), (-d, -d)]:
            h = periodic.near(p, g.x + dx, g.v + dv)
            assert (h.x, h.v) == pytest.approx((g.x, g.v), abs=1e-11)


def test_near_drops_a_last_hit_that_is_one_too_many():
    """From a guess with three hits, an orbit with two is found."""
    times = flow.hit_times(oscillator(PAPER), -0.95, 0.6)
    assert len(times) == 3
    assert len(periodic.near(PAPER, -0.95, 0.6).hit_times) == 2


def test_near_starts_from_either_direction():
    """At f = 0 and R = 4, one of the two orbits with four hits moves left at t = 0."""
    p, hits = CASES[-1]
    assert {g.v > 0 for g in periodic.orbits(p, hits)} == {True, False}
    for g in periodic.orbits(p, hits):
        assert periodic.near(p, g.x, g.v).v == pytest.approx(g.v, abs=1e-12)


def test_near_says_why_it_ends_without_an_orbit():
    """Four ways to fail, each with its own reason: turns, diverges, no hit, hit at t = 0."""
    slow = replace(PAPER, f=Fraction(3, 10))
    with pytest.raises(BadInput, match="not genuine: it turns before t = "):
        periodic.near(slow, 0.0311905, 0.5087892)  # the pair at f = 0.3 is formal
    with pytest.raises(BadInput, match="does not converge"):
        periodic.near(replace(PAPER, f=Fraction(7, 10)), 0.1, 0.5)
    with pytest.raises(BadInput, match="before it hits a wall"):
        periodic.near(replace(PAPER, r=Fraction(100)), 0.0, 1.0)
    with pytest.raises(BadInput, match="hits a wall at t = 0"):
        periodic.near(replace(PAPER, f=Fraction(0)), 1 - 1e-7, 4 / math.pi)


@pytest.mark.parametrize(
    ("x", "v", "words"),
    [
        (1.0, 0.5, "between the walls"),
        (-3.0, 0.5, "between the walls"),
        (0.0, 0.0, "must not be 0"),
        (math.nan, 0.5, "finite"),
        (0.0, math.inf, "finite"),
        (0.0, 1e9, "too fast"),
    ],
)
def test_bad_guesses(x, v, words):
    """Guesses that are no states between the walls are refused in one line that says why."""
    with pytest.raises(BadInput, match=words) as error:
        periodic.near(PAPER, x, v)
    assert "\n" not in str(error.value)


def test_grazing_start_is_bad_input():
    """A start next to the wall that turns at once is reported as turning, not as a crash."""
    p = replace(PAPER, f=1 - Fraction(1, 10**21), l=Fraction(0))
    with pytest.raises(BadInput, match="turns at t"):
        periodic.near(p, 1 - 2.0**-53, 1e-308)
