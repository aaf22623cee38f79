"""Orbits by the unknowns that the guards leave free: F and F' of two masses."""

from dataclasses import replace
from fractions import Fraction

import models
import particle_orbits
import pytest

from cap.errors import BadInput
from cap.orbits.equations import Equations
from cap.orbits.free import Free
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.numbers import Balls, Floats
from cap.sets import interval
from cap.system.masses import masses
from cap.system.model import Guard, Mode, System
from cap.system.polynomial import variables

EVENTS = [  # mode, guard, mode, t, x1, x2, v1, v2; no orbit, but contacts of all kinds
    ("++", "hit r", "+-", 1.25, 0.1, 1.0, 0.8, 1.2),
    ("+-", "meet 1 2", "--", 1.7, 0.4, 0.4, 0.6, -0.9),
    ("--", "stop 2", "-0", 2.4, -0.1, 0.7, -0.9, 0.0),
    ("-0", "hit l", "+0", 3.2, -1.0, 0.5, -1.3, 0.0),
    ("+0", "release 2 r", "++", 5.2, -0.7, -0.4, 0.3, 0.0),
]
GUESS = [q for event in EVENTS for q in event[3:]]


@pytest.fixture(scope="module")
def equations():
    """Return the equations of these contacts."""
    contacts = [Contact(*event[:3]) for event in EVENTS]
    return Equations(Itinerary(masses(particle_orbits.A, particle_orbits.MASSES), contacts))


def test_what_the_guards_say(equations):
    """The wall's place, x2 = x1, v = 0, and the velocity that is released."""
    free = Free(equations, GUESS)
    assert [(each.number, each.constant, each.weights) for each in free.solved] == [
        (1, 1, {}),
        (1, 0, {0: 1}),
        (3, 0, {}),
        (0, -1, {}),
        (3, 0, {}),
    ]
    assert [each.rate is None for each in free.solved] == [True] * 4 + [False]
    assert free.names[0] == ["x1", "v1", "v2"]
    u = free.of(GUESS)
    with interval.workprec(80):
        assert [float(q) for q in free.whole([interval.ball(Fraction(q)) for q in u])] == GUESS


def test_the_equations_are_those_of_all_unknowns(equations):
    """Without h = 0, but that of the release, which is over L h."""
    free, of = Free(equations, GUESS), Balls(equations.itinerary.system)
    with interval.workprec(80):
        u = [interval.ball(Fraction(q)) for q in free.of(GUESS)]
        full, found = equations.value(free.whole(u), of), free.value(u, of)
        rate = free.solved[-1].rate
        for k in range(5):
            misses = full[5 * k + 1 : 5 * (k + 1)]
            if k == 3:
                misses[3] = full[20] / interval.ball(rate)
            assert all(a.overlaps(b) for a, b in zip(found[4 * k : 4 * k + 4], misses, strict=True))
        t, floats = 5.2, Floats(equations.itinerary.system)
        assert float(rate) == pytest.approx(floats.clock(t)[1])  # of f - F cos wt


def test_the_derivative_is_that_of_the_equations(equations):
    """By differences, column by column."""
    free, step = Free(equations, GUESS), Fraction(1, 10**9)
    with interval.workprec(120):
        of = Balls(equations.itinerary.system)
        u = [interval.ball(Fraction(q)) for q in free.of(GUESS)]
        slope = free.slope(u, of)
        for j in range(len(u)):
            ends = []
            for sign in (1, -1):
                moved = list(u)
                moved[j] = moved[j] + sign * interval.ball(step)
                ends.append(free.value(moved, of))
            for i, (a, b) in enumerate(zip(*ends, strict=True)):
                quotient = (a - b) / (2 * interval.ball(step))
                assert float(quotient) == pytest.approx(float(slope[i][j]), abs=1e-12)


def test_one_contact_in_a_round():
    """Its row has both ends of the flight."""
    itinerary = Itinerary(models.spring(), [Contact("fly", "stop", "fly")])
    free, step = Free(Equations(itinerary), [0.3, 0.0, 0.7]), Fraction(1, 10**9)
    with interval.workprec(120):
        of = Balls(itinerary.system)
        u = [interval.ball(q) for q in (Fraction(3, 10), Fraction(7, 10))]
        slope = free.slope(u, of)
        for j in range(2):
            ends = []
            for side in (1, -1):
                moved = [q + side * (i == j) * interval.ball(step) for i, q in enumerate(u)]
                ends.append(free.value(moved, of))
            for i, (a, b) in enumerate(zip(*ends, strict=True)):
                assert float(a - b) * 5e8 == pytest.approx(float(slope[i][j]), abs=1e-12)


def test_guards_that_leave_too_much_open():
    """One of the state and the clock, and one of the clock after which nothing moves."""
    table = Itinerary(models.ball(), [Contact("fly", "table", "fly")])
    with pytest.raises(BadInput, match="contact 1: its guard is neither"):
        Free(Equations(table), [0.5, 0.6, -3.1])
    still, clock = Mode({"x": 0, "v": 0}, {}), variables("cos")[0]
    modes = {name: replace(still, guards={"g": Guard(s * clock, (to,), {"v": 0})})
             for name, to, s in (("a", "b", 1), ("b", "a", -1))}  # fmt: skip
    system = System(("x", "v"), 1, modes)
    contacts = [Contact("a", "g", "b"), Contact("b", "g", "a")]
    with pytest.raises(BadInput, match="contact 1: its guard is neither"):
        Free(Equations(Itinerary(system, contacts)), [1.5, 0, 0, 4.7, 0, 0])
