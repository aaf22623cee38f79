"""The equations of periodic orbits in event unknowns, against floats and differences."""

from fractions import Fraction

import numpy as np
import particle_orbits
import pytest
from support import decimal_fraction, seeded

from cap.errors import BadInput, NotProved
from cap.parameters import PAPER
from cap.particles import equations
from cap.particles.model import Model
from cap.sets import interval
from cap.sets.interval import Ball

THREE = Fraction(1), Fraction(2, 3), Fraction(5, 4)


def random_events(random, contacts, n):
    """Return unknowns with positive and negative velocities and increasing times."""
    z = []
    for k, _ in enumerate(contacts):
        z += [k + 1 + decimal_fraction(random) / 4]
        z += [decimal_fraction(random) for _ in range(n - 1)]
        z += [random.choice([-1, 1]) * (2 + decimal_fraction(random)) for _ in range(n)]
    return z


def test_contacts_of_three_masses():
    """C is a reflection for the kinetic energy; it keeps momentum unless a wall is hit."""
    model = Model(PAPER, THREE)
    m = np.diag([float(q) for q in THREE])
    for k, word in enumerate(["hit l", "meet 1 2", "meet 2 3", "hit r"]):
        assert (model.word(k), model.contact(word)) == (word, k)
        C = np.array([[float(q.mid()) for q in row] for row in model.rules[k]])
        assert pytest.approx(np.eye(3), abs=1e-12) == C @ C
        assert C.T @ m @ C == pytest.approx(m, abs=1e-12)
        assert np.ones(3) @ m @ C == pytest.approx(np.ones(3) @ m) or k in (0, 3)
        push, normal = [float(q.mid()) for q in model.pushes[k]], model.normal(k)
        assert np.eye(3) - np.outer(push, normal) == pytest.approx(C, abs=1e-12)
    places = [Ball(3), Ball(4)]
    assert [float(q) for q in model.positions(0, places)] == [-1, 3, 4]
    assert [float(q) for q in model.positions(1, places)] == [3, 3, 4]
    assert [float(q) for q in model.positions(2, places)] == [3, 4, 4]
    assert [float(q) for q in model.positions(3, places)] == [3, 4, 1]
    for k in range(4):
        index = model.place_of(k)
        found = [float(q) for q in model.positions(k, places)]
        assert all(found[i] == 3 + place for i, place in enumerate(index) if place is not None)


@pytest.mark.parametrize(
    ("masses", "contacts"),
    [(THREE, (0, 1, 2, 3)), (particle_orbits.MASSES, (0, 1, 2)), (THREE[:1], (0, 1))],
)
def test_the_derivative(masses, contacts):
    """G' against central differences of G, at random events of one, two and three masses."""
    random = seeded(5)
    with interval.workprec(200):
        model, h = Model(PAPER, masses), Fraction(1, 10**20)
        z = random_events(random, contacts, len(masses))
        rows = equations.slope(model, contacts, list(map(interval.ball, z)))
        for j in range(len(z)):
            sides = [
                equations.value(
                    model, contacts, [interval.ball(q + s * h * (i == j)) for i, q in enumerate(z)]
                )
                for s in (1, -1)
            ]
            for i, (up, down) in enumerate(zip(*sides, strict=True)):
                difference = (up - down) / (2 * interval.ball(h))
                assert abs(float((difference - rows[i][j]).mid())) < 1e-15


def test_the_orbit_is_that_of_the_floats():
    """Events, state at t = 0, least speeds of the orbit in case A: 12 digits of the floats."""
    orbit = particle_orbits.orbit()
    guess = orbit.setting.particles
    for event, (word, t, x, v) in zip(orbit.events, guess.events, strict=True):
        assert orbit.model.word(event.contact) == word
        assert float(event.at.t.mid()) == pytest.approx(t, abs=1e-10)
        assert [float(q.mid()) for q in event.x] == pytest.approx(x, abs=1e-10)
        assert [float(q.mid()) for q in event.before] == pytest.approx(v, abs=1e-10)
    assert max(float(e.at.t.rad()) for e in orbit.events) < 1e-50


def test_what_is_no_system():
    """No masses, a mass 0, losses; events that are no contacts; a velocity that may vanish."""
    for masses in ((), (Fraction(1), Fraction(0))):
        with pytest.raises(BadInput, match="positive"):
            Model(PAPER, masses)
    model = Model(PAPER, THREE[:2])
    with pytest.raises(NotProved, match="no contact"):
        model.contact("turn 1 left")
    z = list(map(interval.ball, [1, 0, 1, Fraction(1, 3), 2, 0, 1, -1]))
    z[3] = Ball(0, 1)
    with pytest.raises(NotProved, match="a velocity may vanish"):
        equations.value(model, (0, 1), z)
