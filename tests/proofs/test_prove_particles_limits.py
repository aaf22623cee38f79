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
from cap.floats.masses.particle_orbits import continued, reduced_traces
from cap.floats.masses.particles import Particles
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import particle_cells, particles_limits, theorems
from cap.proofs.fixed_point import Setting
from cap.sets.interval import Ball

EQUAL = Fraction(1), Fraction(1)


@cache
def setting():
    """Return the setting at the paper's parameters."""
    found = lighter(Request("particles_limits", PAPER, options={"masses": EQUAL})).candidates[0]
    return Setting(PAPER, found.guess, 10)


@cache
def claims():
    """Return the claims of ten digits."""
    return particles_limits.prove(setting())(Fraction(1))["claims"]


def near(mass):
    """Return the orbit in floats for a second mass, continued from 9/10."""
    orbit = particle_orbits.orbit(particle_orbits.NEGATIVE, "particles_saddle")
    state = particle_orbits.state_of(orbit)
    first, last = (Particles(PAPER, (Fraction(1), m)) for m in (Fraction(9, 10), mass))
    return continued(first, last, state)[1]


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
            particle_cells.Masses.of(setting(), setting().particles),
            lambda _solved: Ball(1),
            (None, None),
        )
    monkeypatch.setattr(
        particles_limits.twist_matrix, "reduced_traces", lambda _D: (Ball(3), Ball(-2, 1))
    )
    with pytest.raises(NotProved, match="no change of sign"):
        particles_limits.prove(setting())


def test_cells_that_are_too_wide(monkeypatch):
    """Where Krawczyk's inclusion fails for all widths, the family is not proved."""
    monkeypatch.setattr(particle_cells, "WIDTH", Fraction(1, 20))
    monkeypatch.setattr(particle_cells, "NARROWEST", Fraction(1, 40))
    with pytest.raises(NotProved, match="Krawczyk"):
        particles_limits.prove(setting())


def test_too_many_cells(monkeypatch):
    """A list of nodes that the checker would refuse is not begun."""
    monkeypatch.setattr(particle_cells, "MOST_NODES", 3)
    with pytest.raises(NotProved, match="more than 3 nodes of masses are needed"):
        particles_limits.prove(setting())


def test_as_many_nodes_as_the_checker_reads(monkeypatch):
    """One more would be too much work for it."""
    asked = Setting(PAPER, Start(0.1, 0.54, ()), 10)
    bits, most = asked.checker_bits, particle_cells._most_nodes(asked, 8)
    assert 64 < most < particle_cells.MOST_NODES
    limit = particle_cells.MOST_WORK
    assert particle_cells.work(bits, 8, most) <= limit < particle_cells.work(bits, 8, most + 1)
    monkeypatch.setattr(particle_cells, "MOST_WORK", 1)
    assert particle_cells._most_nodes(asked, 8) == 0


def test_the_checker_may_follow_with_wider_rates():
    """A velocity that would only just stay positive is refused, and so the cell is halved."""
    rate = particle_cells._wider(Ball(1, 2))
    assert abs(float(rate.lower()) + 2) < 1e-6
    assert abs(float(rate.upper()) - 4) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "flip", "stop"),
    [
        ({"f": Fraction(21, 50)}, 0.887187, 0.844932),  # the last cell is halved
        ({"l": Fraction(-11, 10), "r": Fraction(11, 10)}, 0.834669, 0.786455),  # see `orbit`
    ],
)
def test_other_parameters(change, flip, stop):
    """A velocity that is slow in the last cell; a contact that passes a critical moment."""
    p = replace(PAPER, **change)
    found = lighter(Request("particles_limits", p, options={"masses": EQUAL})).candidates[0]
    asked = Setting(p, found.guess, 10)
    claimed = theorems.accepted(theorems.THEOREMS["particles_limits"], asked)["claims"]
    for name, mass in (("flip", flip), ("stop", stop)):
        assert abs(float(claimed[name][0]) - mass) < 2e-6


def test_a_speed_that_falls_in_a_cell(monkeypatch):
    """Whatever is not certain to stay positive is refused."""
    monkeypatch.setattr(particle_cells, "NARROWEST", Fraction(1, 100))
    monkeypatch.setattr(particle_cells, "_rate", lambda *_: Ball(-1000))
    with pytest.raises(NotProved, match="a mass may stop for some mass of a cell"):
        particles_limits.prove(setting())


def test_guesses_that_are_none():
    """Without the two orbits nothing is begun."""
    alone = replace(setting().particles, further=())
    for guess, why in ((Start(0.0, 0.0, ()), "several masses"), (alone, "two equal masses")):
        with pytest.raises(BadInput, match=why):
            particles_limits.prove(replace(setting(), guess=guess))


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
    stored = json.loads((particle_orbits.STORED / "particles_limits.json").read_text("utf-8"))[
        "claims"
    ]
    for name in ("flip", "stop"):
        (a, b), (c, d) = (tuple(map(Fraction, each[name])) for each in (stored, claims()))
        assert c <= a < b <= d
