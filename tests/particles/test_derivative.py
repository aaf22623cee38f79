"""The jets of the period map of two masses, against orbits of the floats and of another method."""

from fractions import Fraction

import numpy as np
import particle_orbits
import pytest

from cap.floats.masses.particles import Particles, follow
from cap.particles import derivative
from cap.sets import interval
from cap.sets.interval import Ball


def floats(rows):
    """Return the middles of balls."""
    return np.array([[float(q.mid()) for q in row] for row in rows])


@pytest.fixture
def orbit():
    """Return the orbit of case A at its precision."""
    found = particle_orbits.orbit()
    with interval.workprec(found.setting.bits):
        yield found


def image(orbit, deviation):
    """Return the deviation after a period, of an orbit in floats."""
    x, v = derivative.state(orbit.model, orbit.events)
    state = np.array([float(q.mid()) for q in (*x, *v)])
    start = state + deviation
    system = Particles(orbit.setting.parameters, orbit.model.masses)
    path = follow(system, start[:2], start[2:], float(orbit.model.first.T.mid()))
    return np.array([*path.x, *path.v]) - state, path


def test_monodromy(orbit):
    """It is that of the floats, and preserves the form; not with other masses."""
    D = orbit.monodromy
    _, path = image(orbit, np.zeros(4))
    assert floats(D) == pytest.approx(path.monodromy, abs=1e-9)
    assert max(float(q.rad()) for row in D for q in row) < 1e-50
    assert all(q.contains(0) for q in derivative.symplectic_defect(orbit.model, D))

    class Equal:
        n, masses = 2, (Fraction(1), Fraction(1))

    assert not all(q.contains(0) for q in derivative.symplectic_defect(Equal, D))


def test_the_jet(orbit):
    """What it leaves of the map in floats is of order 4: it falls 16-fold when halved."""
    jets = derivative.jet(orbit.model, orbit.events)
    assert floats([j.coefficients[1:5] for j in jets]) == pytest.approx(floats(orbit.monodromy))
    direction = np.array([0.3, -0.7, 0.5, 0.4])
    left = []
    for size in (4e-4, 2e-4):
        deviation = size * direction
        value = np.array([series(j, deviation) for j in jets])
        left.append(np.abs(image(orbit, deviation)[0] - value).max())
    assert left[0] < 1e-5
    assert 12 < left[0] / left[1] < 20


def series(jet, deviation):
    """Return the value of a jet in floats."""
    return sum(
        float(Ball(c).mid()) * np.prod(deviation ** np.array(exponent))
        for exponent, c in zip(jet.space.exponents, jet.coefficients, strict=True)
    )


def test_precision():
    """At 53 bits the jet of order 3 still has digits; thick events give thick jets."""
    asked = particle_orbits.setting(digits=6, guard=6)
    with interval.workprec(53):
        orbit = particle_orbits.located(asked, asked.particles)
        jets = derivative.jet(orbit.model, orbit.events)
    assert max(float(Ball(c).rad()) for j in jets for c in j.coefficients) < 1e-3
