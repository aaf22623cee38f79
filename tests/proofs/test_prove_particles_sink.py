"""The theorem ``particles_sink``: what is proved, and what is refused."""

from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import particle_orbits
import pytest
from support import proving

from cap.errors import BadInput, NotProved
from cap.floats.candidates import Request, attracting
from cap.floats.masses import particle_candidates
from cap.floats.masses.particles import Particles
from cap.orbits.choice import without_choice
from cap.orbits.equations import Equations
from cap.orbits.free import Free
from cap.orbits.periodic import Prover
from cap.particles.itinerary import itinerary, unknowns
from cap.proofs import particles_sink
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
def proved(found):
    """Return the setting, what proves orbits with the itinerary, and this orbit, at 12 digits."""
    setting, guess = Setting(particle_orbits.A, found.guess, 12), found.particles
    with interval.workprec(setting.bits):
        model = masses(setting.parameters, guess.masses)
        prover = Prover(Equations(itinerary(model, guess)))
        free = Free(prover.equations, unknowns(guess))
        start = [Fraction(q) for q in free.of(unknowns(guess))]
        units = particles_sink.units_of(setting, free)
        problem = free.problem(prover.balls)
        _, box = particles_sink.lemma_1_existence(setting, problem, units, start)
        words = [word for word, *_ in guess.events]
        yield SimpleNamespace(
            setting=setting, prover=prover, box=tuple(free.whole(box)), words=words
        )


def refused(proved, why, k, number, value):
    """Check that an orbit is not proved of which t, x1, x2, v1 or v2 is another at an event."""
    bad = list(proved.box)
    bad[5 * k + number] = value(bad[5 * k + number])
    with pytest.raises(NotProved, match=why):
        particles_sink.lemma_2_events(proved.prover, tuple(bad))


def test_what_is_no_such_orbit(proved):
    """Conditions on events and flights, broken one by one."""
    particles_sink.lemma_2_events(proved.prover, proved.box)
    turn, stick = proved.words.index("turn 2 left"), proved.words.index("stick 1")
    refused(proved, "may not be in order", stick, 0, lambda _: proved.box[5 * (stick - 1)])
    refused(proved, "not between two contacts", 0, 0, lambda _: Ball(0))
    refused(proved, "'hit r' is not certain to be positive", turn, 2, lambda _: Ball(1))
    refused(proved, "'stop 2' is negative", 0, 4, lambda v: -v)
    refused(proved, "'stop 1' is negative", 1, 3, lambda v: -v)
    for k, time, modes in ((turn, 1.5, "'-0' .* '--'"), (stick, 3.2, "'--' .* '0-'")):
        bad = list(proved.box)
        bad[5 * k] = Ball(time)
        with pytest.raises(NotProved, match=modes):
            without_choice(proved.prover, tuple(bad))


def test_a_rest_that_the_force_ends(proved):
    """A rest that lasts until after the force is beyond friction is refused."""
    hit = proved.words.index("stick 1") + 1
    refused(proved, "'release 1 r' is negative", hit, 0, lambda t: t + 1)
    refused(proved, "'release 1 l' is negative", hit - 1, 0, lambda t: t - Ball(0.5))


def test_no_contraction(proved, monkeypatch):
    """A derivative of which no power contracts is refused."""
    one = [[Ball(i == j) for j in range(4)] for i in range(4)]
    monkeypatch.setattr(particles_sink, "derivative", lambda *_: one)
    with pytest.raises(NotProved, match="no power"):
        particles_sink.lemma_4_contraction(proved.setting, None)


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
