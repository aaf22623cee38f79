"""Theorem effective_stability: orbits in floats from the ellipse, other walls, refusals."""

import math
from fractions import Fraction

import numpy as np
import pytest

import cap
from cap.errors import BadInput, NotProved
from cap.floats.engine.reversal import retrace
from cap.floats.engine.swarm import follow
from cap.maps import approximate_integral
from cap.parameters import PAPER

THEOREM = "effective_stability"


def boundary(claims, scale=1.0):
    """Return states on the boundary of the inner ellipse, in floats."""
    angle = np.linspace(0, 2 * math.pi, 40, endpoint=False)
    u = scale * float(claims["part"]) * np.array([np.cos(angle), np.sin(angle)])
    A = np.array([[float(q) for q in row] for row in claims["axes"]])
    return np.array([float(q) for q in claims["centre"]]) + (A @ u).T


def radii(claims, states):
    """Return |u| of states."""
    A = np.array([[float(q) for q in row] for row in claims["axes"]])
    offsets = states - np.array([float(q) for q in claims["centre"]])
    return np.hypot(*np.linalg.solve(A, offsets.T))


def area(proved):
    """Return the area of the inner ellipse, in floats."""
    return float(Fraction(proved.certificate["claims"]["area"][0]))


def test_orbits_stay_in_the_ellipse():
    """From the boundary of the inner one, forwards and backwards, for what floats can follow."""
    claims = cap.prove_theorem(THEOREM, degree=6, periods=10**4, digits=12).claims
    starts = boundary(claims)
    ahead = follow(PAPER, starts, 1000, every=True)
    assert not (ahead.turned | ahead.stuck | ahead.captured).any()
    for states in (ahead.states.reshape(-1, 2), retrace(PAPER, starts, 300)):
        assert radii(claims, states).max() < 1
    assert radii(claims, ahead.states.reshape(-1, 2)).max() > float(claims["part"])


@pytest.mark.slow
def test_more_periods_a_smaller_ellipse():
    """The area decreases."""
    many = (10**4, 10**6)
    areas = [area(cap.prove_theorem(THEOREM, digits=12, degree=6, periods=n)) for n in many]
    assert areas[0] > areas[1] > 0


@pytest.mark.slow
def test_other_walls():
    """In other units the same oscillator has the same ellipse, in these units."""
    options = {"degree": 5, "periods": 100, "digits": 12}
    proved = cap.prove_theorem(THEOREM, **options)
    scaled = cap.prove_theorem(THEOREM, F=2, omega=1, f="4/5", l=-2, r=2, **options)
    assert area(scaled) / area(proved) == pytest.approx(4, rel=0.05)


@pytest.mark.parametrize(
    ("options", "phrase"),
    [
        ({"periods": 0}, "--periods must be an integer"),
        ({"periods": "3/2"}, "--periods must be an integer"),
        ({"periods": 10**19}, "--periods must be an integer"),
        ({"degree": 4}, "--degree must be an integer"),
        ({"degree": 16}, "--degree must be an integer"),
        ({"e": "9/10"}, "e"),
        ({"mu": "1/100"}, "mu"),
        ({"orbit": (-0.7914, 0.4979)}, "no elliptic orbit"),
    ],
)
def test_bad_input(options, phrase):
    """Each in a line that names what is wrong."""
    with pytest.raises(BadInput, match=phrase):
        cap.prove_theorem(THEOREM, **options)


def test_a_plan_that_does_not_succeed(monkeypatch):
    """The radii are hints: of ellipses that are too large nothing is proved."""
    plan = approximate_integral.plan

    def careless(growths, periods, largest):
        return plan(growths, periods / 10**6, largest)

    monkeypatch.setattr(approximate_integral, "plan", careless)
    with pytest.raises(NotProved, match="Lemma 3: orbits may leave the ellipse before"):
        cap.prove_theorem(THEOREM, degree=5, periods=10**6, digits=12)
