"""The theorem ``particles_sink``: what is proved, and what is refused."""

from dataclasses import replace
from fractions import Fraction

import particle_orbits
import pytest
from support import proving

from cap.errors import BadInput, NotProved
from cap.floats.candidates import Request, attracting
from cap.floats.masses import particle_candidates
from cap.floats.masses.particles import Particles
from cap.orbits.choice import without_choice
from cap.particles import contacts
from cap.particles.itinerary import itinerary
from cap.proofs import particle_orbit, particles_sink
from cap.proofs.fixed_point import Setting
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.masses import masses


@pytest.fixture(scope="module")
def found():
    """Return the orbit that the search finds."""
    request = Request(
        "particles_sink", particle_orbits.A, options={"masses": particle_orbits.MASSES}
    )
    return attracting(request).candidates[0]


@pytest.fixture(scope="module")
def orbit(found):
    """Return this orbit, at 12 digits."""
    setting = Setting(particle_orbits.A, found.guess, 12)
    with interval.workprec(setting.bits):
        yield particle_orbit.solved(setting, found.particles)


def refused(orbit, why, k, number, value):
    """Check that an orbit is not proved of which t, x1, x2, v1 or v2 is another at an event."""
    bad = list(orbit.box)
    bad[5 * k + number] = value(bad[5 * k + number])
    with pytest.raises(NotProved, match=why):
        particle_orbit.nothing_else(replace(orbit, box=tuple(bad)))


def place_of(orbit, word):
    """Return the number of the first event with a word."""
    return [word for word, *_ in orbit.guess.events].index(word)


def test_what_is_no_such_orbit(orbit):
    """Conditions on events and flights, broken one by one."""
    particle_orbit.nothing_else(orbit)
    turn, stick = place_of(orbit, "turn 2 left"), place_of(orbit, "stick 1")
    refused(orbit, "may not be in order", stick, 0, lambda _: orbit.box[5 * (stick - 1)])
    refused(orbit, "'hit r' is not certain to be positive", turn, 2, lambda _: Ball(1))
    refused(orbit, "'stop 2' is negative", 0, 4, lambda v: -v)
    refused(orbit, "'stop 1' is negative", 1, 3, lambda v: -v)
    for k, time, modes in ((turn, 1.5, "'-0' .* '--'"), (stick, 3.2, "'--' .* '0-'")):
        bad = list(orbit.box)
        bad[5 * k] = Ball(time)
        with pytest.raises(NotProved, match=modes):
            without_choice(orbit.prover, tuple(bad))
    begun = replace(orbit, box=(Ball(0), *orbit.box[1:]))
    with pytest.raises(NotProved, match="not between two contacts"):
        particles_sink.lemma_4_contraction(begun.setting, begun.monodromy)


def test_a_rest_that_the_force_ends(orbit):
    """A rest that lasts until after the force is beyond friction is refused."""
    hit = place_of(orbit, "stick 1") + 1
    refused(orbit, "'release 1 r' is negative", hit, 0, lambda t: t + 1)
    refused(orbit, "'release 1 l' is negative", hit - 1, 0, lambda t: t - Ball(0.5))


def test_no_contraction(orbit):
    """A derivative of which no power contracts is refused."""
    one = [[Ball(i == j) for j in range(4)] for i in range(4)]
    with pytest.raises(NotProved, match="no power"):
        particles_sink.lemma_4_contraction(orbit.setting, one)


def test_a_box_in_which_directions_are_not_certain(orbit):
    """After a contact in it a mass may go the other way; one that stops there is not asked."""
    contacts.directions(orbit.prover, orbit.box)
    bad = list(orbit.box)
    bad[4] = Ball(0, 1)
    with pytest.raises(NotProved, match="a velocity may vanish after a contact"):
        contacts.directions(orbit.prover, tuple(bad))


def test_words_that_are_no_contacts(found):
    """A word is a guard of the system, or refused."""
    model = masses(particle_orbits.A, particle_orbits.MASSES)
    (_, *rest), *others = found.particles.events
    with pytest.raises(NotProved, match="no contact"):
        itinerary(model, replace(found.particles, events=(("hit x", *rest), *others)))


def test_bad_input(capsys):
    """One line each."""
    assert proving(capsys, "particles_sink")[0] == 2
    assert proving(capsys, "particles_sink", "--masses", "1,9/10", "--orbit", "0", "1")[0] == 2
    with pytest.raises(BadInput, match="two masses"):
        attracting(Request("particles_sink", particle_orbits.A))
    frictionless = replace(particle_orbits.A, f=Fraction(0))
    masses = {"masses": (Fraction(1), Fraction(9, 10))}
    with pytest.raises(BadInput, match="needs friction"):
        attracting(Request("particles_sink", frictionless, options=masses))


def test_nothing_found(monkeypatch):
    """The search tells how far it is, and ends with one line: what was asked, searched, and met."""
    ends = iter([particle_candidates.NO_CONTACT, *[particle_candidates.NOT_PERIODIC] * 3])
    monkeypatch.setattr(particle_candidates, "_settled", lambda *_: next(ends))
    monkeypatch.setattr(particle_candidates, "SEEDS", 4)
    told = []
    masses = {"masses": particle_orbits.MASSES}
    request = Request("particles_sink", particle_orbits.A, options=masses, progress=told.append)
    with pytest.raises(BadInput) as failure:
        attracting(request)
    assert told[0] == "searching: 0 of 4 random states followed"
    assert len(told) == 4
    line = str(failure.value)
    assert "m = 1, 9/10, f = 91/200: of 4 random states 3 did not repeat in 8 T after 150" in line
    assert "1 came to an orbit without contacts; try other" in line


def test_why_a_state_does_not_settle():
    """It comes to rest between the walls, it does not repeat so soon, or it cannot be followed."""
    nearly = Particles(replace(particle_orbits.A, f=Fraction(19, 20)), particle_orbits.MASSES)
    rest = particle_candidates._settled(nearly, (-0.5, 0.5, 0.0, 0.0))
    assert rest == particle_candidates.NO_CONTACT
    outside = particle_candidates._settled(nearly, (0.5, -0.5, 0.0, 0.0))
    assert outside == particle_candidates.NOT_FOLLOWED
