"""Orbits that the paper's figures are about: certified, counted, followed."""

import math
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.engine import swarm
from cap.floats.search.orbits import search
from cap.paper import coexistence, escape, forcing
from cap.paper.figure import Run
from cap.parameters import PAPER, at
from cap.runner import Runner


@pytest.mark.slow
def test_the_period_of_the_sink_doubles():
    """At F = 1.529 that of the sink of F = 1.5; its mirror image is not counted twice."""
    p = at(F="1.5")
    sinks = [("1.5", c) for c in search(p).isolated if c.kind(conserves=True) == "sink focus"]
    assert len(sinks) == 2
    assert forcing.doublings(sinks, Run(Runner(1), quick=True)) == [pytest.approx(1.5292254)]


def test_which_orbits_at_1_are_all():
    """Of the kind whose velocity never vanishes there are four, and only of these it is said."""
    said = forcing.orbits_at_1()
    assert "4 (1,1) orbits, whose velocity never vanishes: 2 elliptic, 2 saddle (proved)" in said
    assert "may be more" in said


@pytest.mark.slow
def test_the_orbit_of_panel_d_is_certified():
    """It sticks after 140 periods; floats agree as long as their errors are small."""
    own = escape.escape((0.1003, 0.5419), Fraction(1, 20), 200)
    assert (own.periods, own.word) == (140, "sticks")
    assert own.after == pytest.approx(140.7303188, abs=1e-7)
    assert own.states.shape == (141, 2)
    seen = swarm.follow(PAPER, own.states[:1], 60, every=True)
    np.testing.assert_allclose(own.states[:61], seen.states[0], atol=1e-9)
    steps = swarm.follow(PAPER, own.states, 1, derivative=True)
    np.testing.assert_allclose(steps.states[:-1], own.states[1:], atol=1e-10)
    assert not (steps.turned | steps.stuck)[:-1].any()
    assert steps.first_time("stick")[-1] / (2 * math.pi) == pytest.approx(0.7303188, abs=1e-6)
    growth = np.eye(2)
    for step in steps.monodromy[:-1]:
        growth = step @ growth
    largest = np.linalg.norm(growth, 2)
    assert own.exponent == pytest.approx(math.log(largest) / (140 * 2 * math.pi), rel=1e-6)


def test_an_orbit_that_is_followed_for_a_short_time():
    """Nothing is said of what comes then."""
    short = escape.escape((0.1003, 0.5419), Fraction(1, 20), 3)
    assert (short.periods, short.word, short.after) == (3, "", 3)


def test_the_modulus_is_enclosed(monkeypatch):
    """It is the root of a number between the ends of the determinant, so it has two ends."""
    claims = {"determinant": ["0.25", "0.36"], "turning_factors": [["0.3", "0.3"]], "itinerary": []}
    monkeypatch.setattr(coexistence, "theorem", lambda *_: claims)
    monkeypatch.setattr(coexistence.events, "counted", lambda _: {})
    low, high = map(Fraction, coexistence.orbit(None, "focus")["modulus"])
    assert Fraction(49, 100) < low <= Fraction(1, 2)
    assert Fraction(3, 5) <= high < Fraction(61, 100)


def test_a_product_of_factors_is_enclosed(monkeypatch):
    """It differs from the determinant by no more than both are wide, whatever is in them."""
    claims = {
        "determinant": ["0.24", "0.26"],
        "turning_factors": [["0.4", "0.6"], ["0.5", "0.5"]],
        "itinerary": [],
    }
    monkeypatch.setattr(coexistence, "theorem", lambda *_: claims)
    monkeypatch.setattr(coexistence.events, "counted", lambda _: {})
    assert coexistence.orbit(None, "focus")["error"] == Fraction(6, 100)
