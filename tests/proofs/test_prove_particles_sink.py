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
from cap.particles import stays
from cap.particles.model import Model
from cap.particles.stopping import Equations, unknowns, words_of
from cap.proofs import particles_sink
from cap.proofs.fixed_point import Setting
from cap.sets import interval
from cap.sets.interval import Ball


@pytest.fixture(scope="module")
def found():
    """Return the orbit that the search finds."""
    request = Request(
        "particles_sink", particle_orbits.A, options={"masses": particle_orbits.MASSES}
    )
    return attracting(request).candidates[0]


@pytest.fixture(scope="module")
def proved(found):
    """Return the equations and the events proved, at 12 digits."""
    setting = Setting(particle_orbits.A, found.guess, 12)
    with interval.workprec(setting.bits):
        model = Model(setting.parameters, found.particles.masses)
        words = tuple(words_of(model, found.particles))
        system = Equations(model, words, found.particles.periods)
        problem = particles_sink.Problem(system.value, system.slope)
        guess = [Fraction(q) for q in unknowns(words, found.particles)]
        _, events = particles_sink.lemma_1_existence(setting, system, problem, guess)
        yield system, events


def refused(proved, why, k, **changes):
    """Check that an orbit with one event changed is not proved."""
    system, events = proved
    bad = list(events)
    bad[k] = replace(bad[k], **changes)
    with pytest.raises(NotProved, match=why):
        stays.verify(system, bad)


def test_what_is_no_such_orbit(proved):
    """Conditions on events, flights and rests, broken one by one."""
    system, events = proved
    stays.verify(system, events)
    words = [event.word.word for event in events]
    turn, stick = words.index("turn 2 left"), words.index("stick 1")
    refused(proved, "out of order", 4, at=events[3].at)
    refused(proved, "simultaneous", turn, x=(events[turn].x[0], Ball(1)))
    refused(proved, "hit r is not certain", 0, before=(events[0].before[0], Ball(-1)))
    for cos, k in ((Ball(1) / 5, turn), (Ball(1), turn), (Ball(1) / 2, stick)):
        at = events[k].at._replace(cos=cos)
        refused(proved, f"{words[k]} is not certain", k, at=at)
    refused(proved, "may stop", 1, before=(-events[1].before[0], events[1].before[1]))


def test_a_rest_that_the_force_ends(proved):
    """A rest past the time of a release, or under a force beyond friction, is refused."""
    system, events = proved
    k = [event.word.word for event in events].index("stick 2")
    stretch = system.stretches(events)[k]
    stays._rests(stretch)
    moment = system.model.first.moment
    late = replace(stretch, arrival=moment(stretch.arrival.t + Ball(1) / 10))
    with pytest.raises(NotProved, match="may be released"):
        stays._rests(late)
    begun = replace(stretch.start, at=moment(stretch.arrival.t + Ball(1) / 10))
    after = replace(stretch, start=begun, arrival=moment(stretch.arrival.t + Ball(1) / 5))
    with pytest.raises(NotProved, match="may not stay at rest"):
        stays._rests(after)


def test_no_contraction(proved, monkeypatch):
    """A derivative of which no power contracts is refused."""
    one = [[Ball(i == j) for j in range(4)] for i in range(4)]
    monkeypatch.setattr(stays, "derivative", lambda *_: one)
    with pytest.raises(NotProved, match="no power"):
        particles_sink.lemma_4_contraction(*proved)


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
