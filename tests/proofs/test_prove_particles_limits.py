"""Where an orbit of two masses loses its ellipticity, and where a mass stops: against floats."""

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache

import particle_orbits
import pytest
from support import proving

from cap.errors import BadInput, NotProved
from cap.floats.candidates import Request, lighter
from cap.floats.particle_orbits import continued, reduced_traces
from cap.floats.particles import Particles
from cap.parameters import PAPER
from cap.proofs import particle_cells, particles_limits
from cap.proofs.fixed_point import Setting
from cap.sets.interval import Ball

EQUAL = Fraction(1), Fraction(1)


@cache
def setting():
    """Return the setting at the paper's parameters."""
    found = lighter(Request("particles_limits", PAPER, masses=EQUAL)).candidates[0]
    return Setting(PAPER, found.start, 10, particles=found.particles)


@cache
def claims():
    """Return the claims of ten digits."""
    return particles_limits.prove(setting())(Fraction(1))["claims"]


def near(mass):
    """Return the orbit in floats for a second mass, continued from 9/10."""
    masses = [Fraction(9, 10) + (mass - Fraction(9, 10)) * k / 8 for k in range(9)]
    orbit = particle_orbits.orbit(particle_orbits.NEGATIVE, "particles_saddle")
    state = particle_orbits.state_of(orbit)
    return continued([Particles(PAPER, (Fraction(1), m)) for m in masses], state)[1]


@pytest.mark.parametrize(("part", "elliptic"), [(1, True), (-1, False)])
def test_the_flip(part, elliptic):
    """A millionth above the orbit in floats is elliptic, a millionth below it is not."""
    flip = Fraction(claims()["flip"][0])
    high, low = reduced_traces(near(flip + part * Fraction(1, 10**6)).monodromy)
    assert high.imag == low.imag == 0
    assert -2 < high.real < 2
    assert (low.real > -2) is elliptic
    assert abs(low.real + 2) < 1e-4


def test_the_stop():
    """A millionth above the least speed in floats is about a millionth."""
    stop = Fraction(claims()["stop"][1])
    assert 0 < near(stop + Fraction(1, 10**6)).least_speed < 2e-6
    width = stop - Fraction(claims()["stop"][0])
    assert 0 < width < Fraction(1, 10**10)


def test_no_change_of_sign(monkeypatch):
    """A quantity that keeps its sign, another pair that leaves the unit circle."""
    with pytest.raises(NotProved, match="no change of sign"):
        particles_limits._proved(
            setting(), setting().particles, lambda _m, _e: Ball(1), (Unseen(), Unseen())
        )
    monkeypatch.setattr(
        particles_limits.twist_matrix, "reduced_traces", lambda _D: (Ball(3), Ball(-2, 1))
    )
    with pytest.raises(NotProved, match="no change of sign"):
        particles_limits.prove(setting())


class Unseen:
    """What stands for a solved system that is not looked at."""

    model, events = None, None


def test_cells_that_are_too_wide(monkeypatch):
    """Where Krawczyk's inclusion fails for all widths, the family is not proved."""
    monkeypatch.setattr(particle_cells, "WIDTH", Fraction(1, 20))
    monkeypatch.setattr(particle_cells, "NARROWEST", Fraction(1, 40))
    with pytest.raises(NotProved, match=r"Krawczyk|a velocity may vanish"):
        particles_limits.prove(setting())


def test_too_many_cells(monkeypatch):
    """A list of nodes that the checker would refuse is not begun."""
    monkeypatch.setattr(particle_cells, "MOST", 3)
    with pytest.raises(NotProved, match="more than 3 cells"):
        particles_limits.prove(setting())


def test_a_speed_that_falls_in_a_cell(monkeypatch):
    """Whatever is not certain to stay positive is refused."""
    monkeypatch.setattr(particle_cells, "NARROWEST", Fraction(1, 100))
    monkeypatch.setattr(particle_cells, "_rate", lambda *_: Ball(-1000))
    with pytest.raises(NotProved, match="a mass may stop for some mass of a cell"):
        particles_limits.prove(setting())


def test_guesses_that_are_none():
    """Without the two orbits nothing is begun."""
    for guess in (None, replace(setting().particles, further=())):
        with pytest.raises(BadInput, match="two equal masses"):
            particles_limits.prove(replace(setting(), particles=guess))


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("--masses", "1,9/10"), "two equal masses"),
        ((), "two equal masses"),
        (("--masses", "1,1", "--orbit", "1", "1"), "finds its orbits itself"),
        (("--masses", "1,1", "--f", "9/10"), "no elliptic orbit"),
    ],
)
def test_requests_that_make_no_sense(capsys, words, reason):
    """One line, status 2."""
    status, out, err = proving(capsys, "particles_limits", *words)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert reason in err


def test_the_stored_certificate_has_the_same_masses():
    """With thirty digits, inside those of ten."""
    stored = json.loads((particle_orbits.STORED / "particles_limits.json").read_text())["claims"]
    for name in ("flip", "stop"):
        (a, b), (c, d) = (tuple(map(Fraction, each[name])) for each in (stored, claims()))
        assert c <= a < b <= d
