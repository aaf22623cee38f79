"""The theorem segment: orbits in floats, its basin, and where it is not proved."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from conftest import STARTS

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.parameters import PAPER
from cap.proofs import segment
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted

SYSTEMS = {
    "paper": PAPER,
    "with losses": replace(PAPER, e=Fraction(1, 2), mu=Fraction(1, 5)),
    "other units": replace(
        PAPER, F=Fraction(3), omega=Fraction(2), f=Fraction(3, 2), r=Fraction(2)
    ),
}


def claims_at(p, digits=20):
    """Return the claims at some parameters."""
    return segment.prove(Setting(p, STARTS["elliptic"], digits))(Fraction(1))["claims"]


def number(pair):
    """Return the middle of an enclosure."""
    return float(sum(map(Fraction, pair)) / 2)


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_orbits(name):
    """From all along the segment orbits return after a period, and turn twice only."""
    p = SYSTEMS[name]
    claims = claims_at(p)
    left, right, v = (number(claims[k]) for k in ("left", "right", "v"))
    x = np.linspace(left, right, 22)[1:-1]
    found = swarm.follow(p, np.stack([x, np.full_like(x, v)], axis=1), 1, derivative=True)
    np.testing.assert_allclose(found.states[:, 0], x, atol=1e-9)
    np.testing.assert_allclose(found.states[:, 1], v, atol=1e-9)
    assert (found.count("turn right") == 1).all()
    assert found.counts.sum() == 2 * len(x)
    multipliers = np.linalg.eigvals(found.monodromy)
    expected = [number(pair) for pair in claims["multipliers"][::-1]]
    np.testing.assert_allclose(np.sort(multipliers.real, axis=1), [expected] * len(x), atol=1e-8)


@pytest.mark.parametrize("name", SYSTEMS)
def test_just_beyond_the_ends(name):
    """An orbit from beyond an end hits a wall."""
    p = SYSTEMS[name]
    claims = claims_at(p)
    v = number(claims["v"])
    beyond = [number(claims["left"]) - 1e-7, number(claims["right"]) + 1e-7]
    found = swarm.follow(p, [[x, v] for x in beyond], 1)
    assert (found.count("hit") > 0).all()


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_basin(name):
    """Random states of it touch no wall and end on the segment; its area is that claimed."""
    p = SYSTEMS[name]
    claims = claims_at(p)
    left, right, v = (number(claims[k]) for k in ("left", "right", "v"))
    d, (a, b) = float(claims["basin"]["speed"]), map(float, claims["basin"]["drift"])
    u, part = np.random.default_rng(1).uniform([[-d], [0]], [[d], [1]], (2, 4000))
    room = right - left - a * np.abs(u) - b * u**2
    assert (room > 0).all()
    x = np.where(u >= 0, left + part * room, right - part * room)
    found = swarm.follow(p, np.stack([x, v + u], axis=1), 60)
    assert not found.count("hit").any()
    np.testing.assert_allclose(found.states[:, 1], v, atol=1e-6)
    assert ((left < found.states[:, 0]) & (found.states[:, 0] < right)).all()
    assert 2 * d * room.mean() == pytest.approx(number(claims["basin_area"]), rel=0.05)


def test_without_viscosity_the_stroke_is_that_of_the_formula():
    """2 F cos a/ω², sin a = πf/(2F), and the limit of existence 2F/sqrt(4 + π²)."""
    stroke = 2 * math.sqrt(1 - (math.pi / 5) ** 2)
    assert number(claims_at(PAPER)["stroke"]) == pytest.approx(stroke, rel=1e-14)
    limit = Fraction(2 / math.sqrt(4 + math.pi**2))
    assert claims_at(replace(PAPER, f=limit - Fraction(1, 10**9)))
    for more in (limit + Fraction(1, 10**9), Fraction(7, 10), Fraction(99, 100)):
        with pytest.raises(BadInput, match=r"stick unless f/F < 2/sqrt\(4") as refused:
            claims_at(replace(PAPER, f=more))
        assert "nan" not in str(refused.value)
    with pytest.raises(BadInput, match=r"wall stick$"):
        claims_at(replace(PAPER, f=Fraction(7, 10), mu=Fraction(1, 10)))


def test_few_digits():
    """The bound of the drift is one for the turn as it is claimed, with as few digits."""
    for digits in (6, 7):
        assert accepted(THEOREMS["segment"], Setting(PAPER, STARTS["elliptic"], digits))


def test_what_is_refused():
    """No friction, walls too near."""
    with pytest.raises(BadInput, match="f > 0"):
        claims_at(replace(PAPER, f=Fraction(0)))
    with pytest.raises(BadInput, match=r"their stroke is 1\.555912368, and r - l = 3/2"):
        claims_at(replace(PAPER, r=Fraction(1, 2)))
