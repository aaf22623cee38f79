"""The verification of an orbit: each way in which it might not be admissible is refused."""

from dataclasses import replace
from fractions import Fraction

import particle_orbits
import pytest
from support import holds

from cap.errors import NotProved
from cap.floats.masses.particles import Particles, follow
from cap.particles import flights
from cap.particles.derivative import state
from cap.particles.model import Model, events_of, legs_of
from cap.sets import interval
from cap.sets.interval import Ball


def verified(model, events):
    """Verify an orbit."""
    flights.least_speeds(model, events)
    flights.signs_are_conserved(model, events)


def changed(orbit, number, **fields):
    """Return the events of an orbit, one of them with other fields."""
    events = list(orbit.events)
    events[number] = events[number]._replace(**fields)
    return events


@pytest.fixture
def orbit():
    """Return the orbit of case A at its precision."""
    found = particle_orbits.orbit()
    with interval.workprec(found.setting.bits):
        yield found


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
    x, v = ([float(q.mid()) for q in side] for side in state(orbit.model, orbit.events))
    path = follow(Particles(p, orbit.model.masses), x, v, float(orbit.model.first.T.mid()))
    least = min(float(q.mid()) for q in orbit.least_speeds)
    assert path.least_speed == pytest.approx(least, abs=1e-9)


def test_an_event_that_is_not_transverse(orbit):
    """A collision of masses that separate."""
    event = orbit.events[1]
    with pytest.raises(NotProved, match="transverse"):
        flights.least_speeds(orbit.model, changed(orbit, 1, before=event.before[::-1]))


def test_events_out_of_order(orbit):
    """Two events exchanged; one before t = 0; one after T."""
    events = list(orbit.events)
    events[1], events[2] = events[2], events[1]
    with pytest.raises(NotProved, match="out of order"):
        flights.least_speeds(orbit.model, events)
    for number, t in ((0, -1), (7, 7)):
        at = orbit.model.first.moment(Ball(t))
        with pytest.raises(NotProved, match="out of order"):
            flights.least_speeds(orbit.model, changed(orbit, number, at=at))


def test_simultaneous_events(orbit):
    """A mass at its wall while the other one may be there as well, or at the other wall."""
    wall = orbit.model.first.r
    for x in ((wall, wall), (orbit.model.first.l, wall), (Ball(0, 2), wall)):
        with pytest.raises(NotProved, match="simultaneous"):
            flights.least_speeds(orbit.model, changed(orbit, 0, x=x))


def test_a_mass_that_may_stop(orbit):
    """A velocity at an event, or between two, that may vanish."""
    event = orbit.events[3]
    with pytest.raises(NotProved, match=r"velocity may vanish|may stop"):
        flights.least_speeds(orbit.model, changed(orbit, 3, after=(Ball(0, 1), event.after[1])))
    event = orbit.events[6]  # before it the first mass is slowed down, after it the second one
    slow = (event.after[0] * 0 + interval.ball(Fraction(1, 10**6)), event.after[1])
    with pytest.raises(NotProved, match="may turn or stick"):
        flights.least_speeds(orbit.model, changed(orbit, 6, after=slow))


def test_the_sum_of_signs(orbit):
    """A collision after which a sign has changed alone does not preserve the form."""
    event = orbit.events[1]
    after = (event.after[0], -event.after[1])
    with pytest.raises(NotProved, match="sum of the signs"):
        flights.signs_are_conserved(orbit.model, changed(orbit, 1, after=after))


def following(masses, gap, speeds):
    """Return the leg of two masses that move to the right from t = 2.2 to t = 4.4.

    In between both are slowed down, the lighter one more, so the gap is convex if it is behind.
    The second mass is ahead by ``gap``.
    """
    model = Model(particle_orbits.NEGATIVE, masses)
    z = [Fraction(11, 5), gap - 1, -speeds[0], speeds[1], Fraction(22, 5), 0, *speeds]
    leg = legs_of(model, events_of(model, (0, 2), list(map(interval.ball, z))))[0]
    x, v = leg.reached()
    return replace(leg, end=leg.end._replace(x=tuple(x), before=tuple(v)))


@pytest.mark.parametrize("lighter", [0, 1])
@pytest.mark.parametrize("gap", [Fraction(1, 2), Fraction(1, 10), Fraction(1, 1000)])
@pytest.mark.parametrize(
    "faster", [Fraction(-1, 2), Fraction(1, 10), Fraction(1, 2), Fraction(3, 4)]
)
def test_gaps(lighter, gap, faster):
    """Two masses that move the same way: proved to stay apart exactly if a fine grid says so."""
    masses = tuple(Fraction(2 - (i == lighter), 1) for i in range(2))
    with interval.workprec(100):
        leg = following(masses, gap, (Fraction(5, 2) + faster, Fraction(5, 2)))
        if min(gap_at(leg, Fraction(220 + k, 100)) for k in range(221)) > 0:
            flights._stay_apart(leg, 0, 1)
        else:
            with pytest.raises(NotProved, match="may meet"):
                flights._stay_apart(leg, 0, 1)


def gap_at(leg, t):
    """Return the gap at a time, in floats."""
    at = leg.model.first.moment(interval.ball(t))
    x = [o.position(g, at) for o, g in zip(leg.model.oscillators, leg.flights, strict=True)]
    return float((x[1] - x[0]).mid())


def knot(t, value, slope):
    """Return a knot of exact numbers."""
    return flights.Knot(*(interval.ball(Fraction(q)) for q in (t, value, slope)))


def test_a_convex_gap(monkeypatch):
    """The gap (t - 1)² + c on [0, 3]: positive by bisection if c > 0, refused if c < 0."""
    for c, proved in (
        (Fraction(1, 10), True),
        (Fraction(1, 10**6), True),
        (-Fraction(1, 10), False),
    ):

        def at(_leg, _i, moment, c=c):
            t = moment.t
            value = (t - 1) * (t - 1) + interval.ball(c)
            if not value > 0:
                raise NotProved("gap", "two masses may meet between events", {})
            return flights.Knot(t, value, 2 * (t - 1))

        monkeypatch.setattr(flights, "_gap", at)
        ends = knot(0, 1 + c, -2), knot(3, 4 + c, 4)
        leg = legs_of(particle_orbits.orbit().model, particle_orbits.orbit().events)[0]
        if proved:
            flights._positive(leg, 0, ends, 1)
        else:
            with pytest.raises(NotProved, match="may meet"):
                flights._positive(leg, 0, ends, 1)


def test_gaps_by_their_slopes_at_the_ends():
    """Growing, shrinking, first growing: positive at once; an uncertain slope is refused."""
    leg = legs_of(particle_orbits.orbit().model, particle_orbits.orbit().events)[0]
    for p, q in (((0, 0, 1), (1, 1, 1)), ((0, 1, -1), (1, 0, -1)), ((0, 0, 1), (1, 0, -1))):
        flights._positive(leg, 0, (knot(*p), knot(*q)), 1)
    unsure = knot(0, 0, 1)._replace(slope=Ball(0, 1))
    with pytest.raises(NotProved, match="may meet"):
        flights._positive(leg, 0, (unsure, knot(1, 1, 1)), 1)


def test_inflections():
    """All times of a flight at which cos ωt = s f/F, in order, and its ends."""
    with interval.workprec(100):
        model = Model(particle_orbits.NEGATIVE, particle_orbits.MASSES)
        z = [Fraction(1, 10), 0, -3, 3, Fraction(62, 10), 0, 3, 3]
        leg = legs_of(model, events_of(model, (0, 2), list(map(interval.ball, z))))[0]
        for s in (1, -1):
            moments = list(flights._inflections(leg, s))
            assert len(moments) == 4
            assert moments[0].t < moments[1].t < moments[2].t < moments[3].t
            for at in moments[1:3]:
                sin, cos = at.t.sin_cos()
                assert (sin.overlaps(at.sin), cos.overlaps(at.cos)) == (True, True)
                assert holds(cos, s * Fraction(2, 5), Fraction(1, 10**25))
