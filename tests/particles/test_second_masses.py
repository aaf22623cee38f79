"""All second masses of an interval at once: what is enclosed holds for each of them."""

from dataclasses import replace
from fractions import Fraction

import particle_orbits
import pytest

from cap.errors import BadInput
from cap.orbits.equations import Equations
from cap.orbits.free import Free
from cap.orbits.minima import minima
from cap.orbits.numbers import Balls, Floats
from cap.particles.family import rates, values
from cap.particles.itinerary import unknowns
from cap.proofs.particle_cells import Masses
from cap.sets import interval
from cap.system.lemmas import lemmas
from cap.system.masses import masses, second_mass

ONE, SECOND = Fraction(1), (Fraction(88, 100), Fraction(9, 10))


@pytest.fixture
def orbit():
    """Return an orbit at the paper's parameters."""
    found = particle_orbits.orbit(particle_orbits.NEGATIVE, "particles_saddle")
    with interval.workprec(found.setting.bits):
        yield found


def single(orbit, mass):
    """Return the equations of the same contacts, and their numbers, for one second mass."""
    system = masses(particle_orbits.NEGATIVE, (ONE, mass))
    itinerary = replace(orbit.prover.itinerary, system=system)
    return Free(Equations(itinerary), unknowns(orbit.guess)), Balls(system)


def hull(second):
    """Return the set of masses between two."""
    return interval.hull(*map(interval.ball, second))


@pytest.mark.parametrize("mass", [SECOND[0], Fraction(889, 1000), SECOND[1]])
def test_each_mass_is_in_the_family(orbit, mass):
    """G and G' of a single mass lie in those of all; they are thin if the family is."""
    all_of_them, u = Masses.of(orbit.setting, orbit.guess), orbit.hint.point
    free, of = single(orbit, mass)
    narrow = [free.value(u, of), *free.slope(u, of)]
    for q, thin in ((hull(SECOND), False), (interval.ball(mass), True)):
        problem = all_of_them.free.problem(all_of_them.prover(q).balls)
        wide = [problem.value(u), *problem.slope(u)]
        for a, b in zip(wide, narrow, strict=True):
            assert all(x.overlaps(y) for x, y in zip(a, b, strict=True))
            assert not thin or max(float(x.rad()) for x in a) < 1e-50


def test_the_derivative_by_the_mass(orbit):
    """Against differences of G; over an interval it encloses that at each mass."""
    u, h, mass = orbit.hint.point, Fraction(1, 10**20), Fraction(89, 100)
    sides = []
    for s in (1, -1):
        free, of = single(orbit, mass + s * h)
        sides.append(free.value(u, of))
    found, family = [], Masses.of(orbit.setting, orbit.guess)
    for q in (interval.ball(mass), hull(SECOND)):
        of = family.prover(q).balls
        found.append(family.free.by_parameters(u, of, rates(ONE, q)))
    for up, down, exact, wide in zip(*sides, *found, strict=True):
        difference = (up - down) / (2 * interval.ball(h))
        assert abs(float((difference - exact).mid())) < 1e-15
        assert wide.overlaps(exact)


def test_the_parameters():
    """They are what a collision needs, and their rates are their derivatives."""
    m, q, h = Fraction(3, 2), Fraction(4, 5), Fraction(1, 10**20)
    with interval.workprec(200):
        found = values(m, interval.ball(q))
        exact = {"k": 1 / q, "a": 2 * q / (m + q), "b": 2 * m / (m + q), "c": (q - m) / (m + q)}
        up, down = (values(m, interval.ball(q + s * h)) for s in (1, -1))
        for name, rate in rates(m, interval.ball(q)).items():
            assert found[name].overlaps(interval.ball(exact[name]))
            difference = (up[name] - down[name]) / (2 * interval.ball(h))
            assert abs(float((difference - rate).mid())) < 1e-15


def test_parameters_without_values():
    """Neither balls nor doubles are made of them."""
    system = second_mass(particle_orbits.NEGATIVE, ONE)
    for numbers in (Balls, Floats):
        with pytest.raises(BadInput, match=r"\['k', 'a', 'b', 'c'\] have no values"):
            numbers(system)


def test_the_times_at_which_speeds_are_least(orbit):
    """They do not depend on the second mass, if it is positive: else they are not known."""
    lemma = lemmas(second_mass(particle_orbits.NEGATIVE, ONE), "++")["stop 2"]
    system = orbit.prover.itinerary.system
    [(time, cos, _)] = minima(lemma, Balls(system, values(ONE, hull(SECOND))))
    assert float(time.rad()) < 1e-50
    assert cos.overlaps(interval.ball(Fraction(2, 5)))
    around_zero = values(ONE, hull(SECOND)) | {"k": interval.symmetric(interval.ONE)}
    assert minima(lemma, Balls(system, around_zero)) is None
