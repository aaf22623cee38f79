"""Orbits of two masses that never stop: what is claimed, against floats; what is refused."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import particle_orbits
import pytest

from cap.errors import NotProved
from cap.floats.masses.particles import Particles, follow
from cap.orbits.itinerary import Contact
from cap.parameters import PAPER
from cap.particles import contacts
from cap.proofs import particle_orbit
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.masses import masses


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
    state = np.array(particle_orbits.state_of(orbit))
    start = state + deviation
    system = Particles(orbit.setting.parameters, orbit.guess.masses)
    period = float(orbit.prover.balls.period.mid())
    path = follow(system, start[:2], start[2:], period)
    return np.array([*path.x, *path.v]) - state, path


def test_the_orbit_is_that_of_the_floats():
    """Events of the orbit in case A: 10 digits of the floats."""
    orbit = particle_orbits.orbit()
    for (time, state), (_, t, x, v) in zip(orbit.contacts, orbit.guess.events, strict=True):
        assert float(time.mid()) == pytest.approx(t, abs=1e-10)
        assert [float(q.mid()) for q in state] == pytest.approx([*x, *v], abs=1e-10)
    assert max(float(t.rad()) for t, _ in orbit.contacts) < 1e-50


def test_monodromy(orbit):
    """It is that of the floats, and preserves the form; not with other masses."""
    D = orbit.monodromy
    _, path = image(orbit, np.zeros(4))
    assert floats(D) == pytest.approx(path.monodromy, abs=1e-9)
    assert max(float(q.rad()) for row in D for q in row) < 1e-50
    assert all(q.contains(0) for q in contacts.symplectic_defect(orbit.masses, D))
    equal = [Ball(1), Ball(1)]
    assert not all(q.contains(0) for q in contacts.symplectic_defect(equal, D))


def test_the_jet(orbit):
    """What it leaves of the map in floats is of order 4: it falls 16-fold when halved."""
    jets = orbit.jet(3)
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
    """At 53 bits the jet of order 3 still has a digit."""
    asked = particle_orbits.setting(digits=6, guard=6)
    with interval.workprec(53):
        jets = particle_orbit.located(asked, asked.particles).jet(3)
    assert max(float(Ball(c).rad()) for j in jets for c in j.coefficients) < 0.1


@pytest.mark.parametrize(
    ("p", "kind"),
    [
        (particle_orbits.A, "particles"),
        (particle_orbits.B, "particles"),
        (particle_orbits.NEGATIVE, "particles_saddle"),
    ],
)
def test_least_speeds(p, kind):
    """They are those of the floats, which follow the orbit from its state at t = 0."""
    orbit = particle_orbits.orbit(p, kind)
    with interval.workprec(orbit.setting.bits):
        speeds = contacts.least_speeds(orbit.prover, orbit.box)
    _, path = image(orbit, np.zeros(4))
    assert path.least_speed == pytest.approx(min(float(q.mid()) for q in speeds), abs=1e-9)


def test_where_a_speed_is_least(orbit):
    """A minimum that may lie outside of the leg is none that is claimed."""
    speed = contacts.least_speeds(orbit.prover, orbit.box)[0]
    minima = [
        (h.leg.number, time, h.height(time, clock))
        for h, time, clock in orbit.prover.moments(orbit.box, "stop 1")
    ]
    assert min(float(q.mid()) for *_, q in minima) == pytest.approx(float(speed.mid()))
    k, time, _ = minima[0]
    bad = list(orbit.box)
    bad[5 * k] = time + Ball(0, 1e-9)
    with pytest.raises(NotProved, match="has a minimum where the leg may end"):
        contacts.least_speeds(orbit.prover, tuple(bad))


def refused(orbit, why, k, number, value):
    """Check that an orbit is not proved of which t, x1, x2, v1 or v2 is another at an event."""
    bad = list(orbit.box)
    bad[5 * k + number] = value(bad[5 * k + number])
    wrong = replace(orbit, box=tuple(bad))
    with pytest.raises(NotProved, match=why):
        particle_orbit.lemma_2_flights(wrong)


def test_what_is_no_orbit(orbit):
    """Events out of order, two at a time, a mass that may stop at an event or between two."""
    refused(orbit, "may not be in order", 2, 0, lambda _: orbit.box[5])
    assert orbit.guess.events[6][0] == "hit l"
    refused(orbit, "'hit r' is not certain to be positive", 6, 2, lambda _: Ball(1))
    refused(orbit, "'stop 1' is not certain to be positive", 3, 3, lambda _: Ball(0, 1))
    refused(orbit, "'stop 1' is negative", 1, 3, lambda v: -v)


def test_the_time_of_the_contacts(orbit):
    """All in one period."""
    contacts.in_one_period(orbit.prover, orbit.box)
    last = len(orbit.box) - 5
    for number, time in ((0, -1), (0, 0), (last, 7)):
        bad = list(orbit.box)
        bad[number] = Ball(time)
        with pytest.raises(NotProved, match="out of order"):
            contacts.in_one_period(orbit.prover, tuple(bad))


def test_a_contact_that_is_not_transverse(orbit):
    """A collision of masses that separate."""
    (t, (x1, x2, v1, v2)), *rest = orbit.contacts[1:]
    wrong = [orbit.contacts[0], (t, (x1, x2, v2, v1)), *rest]
    assert all(q > 0 for q in contacts.closing_speeds(orbit.prover, orbit.contacts))
    with pytest.raises(NotProved, match="transverse"):
        contacts.closing_speeds(orbit.prover, wrong)


def test_speeds_at_contacts(orbit):
    """Those of the modes, before a contact and after it."""
    contacts.speeds_at_contacts(orbit.prover, orbit.box)
    bad = list(orbit.box)
    bad[3] = Ball(0, 1)
    with pytest.raises(NotProved, match="'stop 1' is not certain to be positive"):
        contacts.speeds_at_contacts(orbit.prover, tuple(bad))


def test_the_sum_of_signs(orbit):
    """A collision after which a sign has changed alone does not preserve the form."""
    itinerary = orbit.prover.itinerary
    contacts.signs_are_kept(itinerary)
    wrong = replace(
        itinerary, contacts=[Contact("+-", "meet 1 2", "--"), Contact("--", "hit l", "+-")]
    )
    with pytest.raises(NotProved, match="sum of the signs"):
        contacts.signs_are_kept(wrong)
    contacts.never_rest(orbit.guess)
    stopped = replace(orbit.guess, events=(("turn 1 left", *orbit.guess.events[0][1:]),))
    with pytest.raises(NotProved, match="a mass stops"):
        contacts.never_rest(stopped)


def test_collisions_of_three_masses():
    """The reset is a reflection for the kinetic energy; it keeps momentum unless a wall is hit."""
    m = Fraction(1), Fraction(2, 3), Fraction(5, 4)
    system = masses(PAPER, m)
    for mode in ("+--", "++-", "-+0"):
        for guard in system.modes[mode].guards:
            reset = system.reset(mode, guard)
            if guard.startswith(("hit", "meet")):
                C = np.array(
                    [[number(reset[f"v{i}"], f"v{j}") for j in (1, 2, 3)] for i in (1, 2, 3)]
                )
                M = np.diag([float(q) for q in m])
                assert pytest.approx(np.eye(3), abs=1e-12) == C @ C
                assert pytest.approx(M, abs=1e-12) == C.T @ M @ C
                kept = np.ones(3) @ M @ C == pytest.approx(np.ones(3) @ M)
                assert kept == guard.startswith("meet")


def number(quotient, name):
    """Return the coefficient of a variable."""
    return float(quotient.numerator.derivative(name).terms.get((), 0))
