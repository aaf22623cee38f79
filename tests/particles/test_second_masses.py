"""All second masses of an interval at once: what is enclosed holds for each of them."""

from fractions import Fraction

import particle_orbits
import pytest

from cap.particles import equations
from cap.particles.family import Family
from cap.particles.model import Model
from cap.sets import interval

SECOND = Fraction(88, 100), Fraction(9, 10)


@pytest.fixture
def orbit():
    """Return an orbit at the paper's parameters."""
    found = particle_orbits.orbit(particle_orbits.NEGATIVE, "particles_saddle")
    with interval.workprec(found.setting.bits):
        yield found


def family(second):
    """Return the family of the masses between two."""
    return Family(particle_orbits.NEGATIVE, Fraction(1), second)


@pytest.mark.parametrize("mass", [SECOND[0], Fraction(889, 1000), SECOND[1]])
def test_each_mass_is_in_the_family(orbit, mass):
    """The rules, G and G' of a single mass lie in those of all; they are thin if the family is."""
    single, z = Model(particle_orbits.NEGATIVE, (Fraction(1), mass)), orbit.hint.point
    for model, thin in ((family(SECOND), False), (family((mass, mass)), True)):
        for function in (equations.value, equations.slope):
            wide, narrow = (function(each, orbit.contacts, z) for each in (model, single))
            rows = zip(wide, narrow, strict=True)
            for a, b in rows if function is equations.slope else [(wide, narrow)]:
                for p, q in zip(a, b, strict=True):
                    assert p.overlaps(q)
                    assert not thin or float(p.rad()) < 1e-50
        for a, b in zip(model.rules, single.rules, strict=True):
            for p, q in zip(a, b, strict=True):
                assert all(x.overlaps(y) for x, y in zip(p, q, strict=True))


def test_the_derivative_by_the_mass(orbit):
    """Against differences of G; over an interval it encloses that at each mass."""
    z, contacts, h = orbit.hint.point, orbit.contacts, Fraction(1, 10**20)
    mass = Fraction(89, 100)
    sides = [
        equations.value(Model(particle_orbits.NEGATIVE, (Fraction(1), mass + s * h)), contacts, z)
        for s in (1, -1)
    ]
    thin = equations.by_second_mass(family((mass, mass)), contacts, z, interval.ball(mass))
    q = interval.hull(*map(interval.ball, SECOND))
    thick = equations.by_second_mass(family(SECOND), contacts, z, q)
    for up, down, exact, wide in zip(*sides, thin, thick, strict=True):
        difference = (up - down) / (2 * interval.ball(h))
        assert abs(float((difference - exact).mid())) < 1e-15
        assert wide.overlaps(exact)
