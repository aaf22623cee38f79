"""The theorem sliding: two masses in floats, the basin, and where it is not proved."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from support import only

from cap.errors import BadInput, NotProved
from cap.floats.masses.particles import Particles, follow
from cap.parameters import PAPER
from cap.particles.guess import Guess
from cap.proofs import sliding
from cap.proofs.fixed_point import Setting

SYSTEMS = {
    "lighter second": (replace(PAPER, f=Fraction(91, 200)), ("1", "9/10")),
    "heavier second": (replace(PAPER, l=Fraction(-3, 2)), ("4/5", "5/4")),
    "equal masses, other units": (
        replace(PAPER, F=Fraction(3), omega=Fraction(2), f=Fraction(3, 2)),
        ("2", "2"),
    ),
}


def system_of(name):
    """Return a system by its name."""
    p, masses = SYSTEMS[name]
    return Particles(p, tuple(map(Fraction, masses)))


def proved(system, digits=20):
    """Return what is claimed of a system."""
    setting = Setting(system.parameters, Guess(system.masses, ()), digits)
    return sliding.prove(setting)(Fraction(1))["claims"]


def number(pair):
    """Return the middle of an enclosure."""
    return float(sum(map(Fraction, pair)) / 2)


def middles(system):
    """Return v, the bounds of the places, T and the multiplier, in floats."""
    claims = proved(system)
    v = np.array([number(pair) for pair in claims["v"]])
    places = [number(claims["places"][key]) for key in ("left", "gap", "right")]
    period = 2 * np.pi / float(system.parameters.omega)
    return claims, v, places, period


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_orbits(name):
    """From all over the triangle orbits return after a period, with two turns of each mass."""
    claims, v, (left, gap, right), period = middles(system_of(name))
    side = right - left - gap
    assert side > 0
    assert number(claims["places_area"]) == pytest.approx(side**2 / 2)
    for a, b, _ in np.random.default_rng(2).dirichlet([1, 1, 1], 12):
        x = [left + a * side, right - b * side]
        path = follow(system_of(name), x, v, period)
        np.testing.assert_allclose([path.x, path.v], [x, v], atol=1e-9)
        assert sorted(path.words) == ["turn 1 left", "turn 1 right", "turn 2 left", "turn 2 right"]
        times = sorted(event.time for event in path.events)[::2]
        expected = [number(pair) for pair in claims["turning_times"]]
        np.testing.assert_allclose(times, expected, atol=1e-9)
        found = np.sort(np.linalg.eigvals(path.monodromy).real)
        multiplier = number(claims["multiplier"])
        np.testing.assert_allclose(found, [multiplier, multiplier, 1, 1], atol=1e-6)


@pytest.mark.parametrize("name", SYSTEMS)
def test_just_beyond_the_sides(name):
    """An orbit from beyond a side of the triangle touches what lies there."""
    _, v, (left, gap, right), period = middles(system_of(name))
    side, out = right - left - gap, 1e-7
    beyond = {
        "hit l": (left - out, right - side / 3),
        "hit r": (left + side / 3, right + out),
        "meet 1 2": (left + side / 2, left + side / 2 + gap - out),
    }
    for word, x in beyond.items():
        if x[0] < x[1]:  # else they are beyond each other already
            assert word in follow(system_of(name), x, v, period).words, word


@pytest.mark.parametrize("name", only(SYSTEMS, "lighter second"))
def test_the_basin(name):
    """Random states of it touch nothing and end on the triangle; its volume is that claimed."""
    system = system_of(name)
    claims, v, (left, gap, right), period = middles(system)
    d, (a, b) = float(Fraction(claims["basin"]["speed"])), map(float, claims["basin"]["drift"])
    m, rng = np.array([float(mass) for mass in system.masses]), np.random.default_rng(3)
    u = rng.uniform(-d, d, (60_000, 2))
    e = (a * np.abs(u) + b * u**2) / m
    room = right - left - gap - e.sum(axis=1)
    assert (room >= 0).all()
    volume = (room**2 / 2).mean() * (2 * d) ** 2 / m.prod()
    assert volume == pytest.approx(number(claims["basin_volume"]), rel=0.02)
    for n in range(25):
        first, second, _ = rng.dirichlet([0.3, 0.3, 0.3]) * room[n]  # near the corners, often
        x = [left + (u[n, 0] < 0) * e[n, 0] + first, right - (u[n, 1] > 0) * e[n, 1] - second]
        path = follow(system, x, v + u[n] / m, 30 * period)
        assert not any(word.startswith(("hit", "meet")) for word in path.words)
        np.testing.assert_allclose(path.v, v, atol=1e-6)
        assert left < path.x[0]
        assert path.x[1] < right
        assert path.x[1] - path.x[0] > gap


def test_where_it_is_not_proved():
    """Masses that do not fit, that stick, or slide without friction."""
    masses = (Fraction(1), Fraction(1, 10))
    with pytest.raises(BadInput, match=r"take 15\.55912368, and r - l = 2$"):
        proved(Particles(PAPER, masses))
    with pytest.raises(BadInput, match="stick unless"):
        proved(Particles(replace(PAPER, f=Fraction(3, 5)), (Fraction(1), Fraction(1))))
    with pytest.raises(BadInput, match="stick unless") as failed:
        proved(Particles(replace(PAPER, f=Fraction(9, 10)), (Fraction(1), Fraction(1))))
    assert "nan" not in str(failed.value)
    with pytest.raises(NotProved, match="below the digits"):
        proved(Particles(PAPER, (Fraction(10**30), Fraction(1))))
    with pytest.raises(BadInput, match="friction"):
        proved(Particles(replace(PAPER, f=Fraction(0)), (Fraction(1), Fraction(1))))
