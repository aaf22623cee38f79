"""Each example is a system, is followed in floats as by hand, and has orbits that are proved."""

import math
from fractions import Fraction
from functools import cache
from pathlib import Path

import by_hand
import models
import numpy as np
import pytest

from cap.errors import BadInput
from cap.floats.models.contacts import contacts
from cap.floats.models.engine import Engine
from cap.floats.models.source import NO_MODE
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import prove
from cap.parameters import PAPER
from cap.system import form, friction
from cap.system.files import read

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.py"))
BOXES = {  # of states from which orbits are followed
    "billiard": ([-0.5, 8, -1, -1], [0.5, 12, 1, 1]),
    "clock": ([-2, -2], [2, 2]),
    "ball": ([1.3, -2], [3, 2]),
    "belt": ([-2, -2], [2, 2]),
    "coupled_masses": ([-1, -1, -1, -1], [1, 0, 1, 1]),
    "den_hartog": ([-2, -2], [2, 2]),
    "gear_rattle": ([-0.5, -2], [0.5, 2]),
    "harvester": ([-0.25, -1], [0.25, 1]),
    "impact_oscillator": ([-2, -2], [0, 2]),
    "oscillator": ([-1, -2], [1, 2]),
}
STEPS = {"billiard": 0.001}  # it may hit twice within a small part of its period
HELD = {  # guards of resting modes
    **dict.fromkeys(("ball", "impact_oscillator", "coupled_masses"), 1),
    **dict.fromkeys(("harvester", "gear_rattle", "oscillator"), 2),
}
QUICK = ("harvester",)  # the others take longer to compile


def some(names):
    """Return parameters of tests; what is compiled for long is slow."""
    return [pytest.param(n, marks=[] if n in QUICK else pytest.mark.slow) for n in names]


@cache
def engine(name):
    """Return the engine of an example with its own parameters."""
    return Engine(read(EXAMPLES / f"{name}.py"))


@pytest.mark.parametrize("name", NAMES)
def test_it_is_a_system(name):
    """It is read, and is the same after a way through JSON."""
    system = read(EXAMPLES / f"{name}.py")
    assert form.loads(form.dumps(system)) == system
    assert not system.parameters
    assert "\nKnown: " in (EXAMPLES / f"{name}.py").read_text("utf-8")


def test_they_are_those_of_the_tests():
    """Two are the systems of the package and of its tests, written by others."""
    for f in ("2/5", "1/2"):
        system = friction.friction().at({"f": Fraction(f), **numbers()})
        assert read(EXAMPLES / "oscillator.py", {"f": f}) == system
    assert read(EXAMPLES / "billiard.py", {"a": 2, "e": "0.8", "E": 1}) == models.parabola()


def numbers():
    """Return the parameters of the oscillator, without the friction."""
    return {name: getattr(PAPER, name) for name in friction.NAMES if name != "f"}


@pytest.mark.parametrize("name", NAMES)
def test_what_rests_is_released_by_the_contact_force(name):
    """A mass held at h = 0 leaves where L² h of the mode it leaves to becomes positive."""
    system = read(EXAMPLES / f"{name}.py")
    held = [
        (guard.value, release)
        for mode in system.modes.values()
        for guard in mode.guards.values()
        if guard.rest
        for release in system.modes[guard.rest].guards.values()
    ]
    assert len(held) == HELD.get(name, 0)
    for h, release in held:
        (to,) = release.to
        start = {z: new.numerator for z, new in release.reset.items()}
        speed = system.lie(to, h)
        assert not speed.substituted(start)
        assert system.lie(to, speed).substituted(start) == -release.value


@pytest.mark.parametrize("name", some(BOXES))
def test_as_by_hand(name):
    """The same state, mode and number of events after two periods, of orbits away from grazes."""
    E, modes = engine(name), getattr(by_hand, name)()
    span = 2 * 2 * math.pi / float(E.system.omega.evaluated({}, float, math.pi))
    states = np.random.default_rng(4).uniform(*BOXES[name], size=(12, len(E.system.state)))
    found = E.follow(states, periods=2)
    moving = {"belt": 2, "oscillator": 2, "den_hartog": 2, "clock": 3}
    starts = E.modes[: moving.get(name, 1)]
    compared = 0
    for k, state in enumerate(states):
        start, *_ = (m for m in starts if E.inside(states)[E.modes.index(m), k])
        other = by_hand.follow(modes, start, state, span, longest=STEPS.get(name, 0.05))
        if other is None or other[3] < 0.05 or other[2] > 16:  # no end, a graze, chatter
            continue
        mode, y, count, _ = other
        assert not found.flags[k]
        assert (E.modes[found.modes[k]], found.counts[k].sum()) == (mode, count)
        assert found.states[k] == pytest.approx(y, abs=1e-8)
        compared += 1
    assert compared >= 4


# name: periods, the contacts, the product of the multipliers
ORBITS = {
    "ball": (1, "table", 0.5**2),
    "belt": (2, "back catch", 0),
    "coupled_masses": (2, "wall", 0.8**2 * math.exp(-0.8 * math.pi)),
    "den_hartog": (1, "stop stop", None),
    "gear_rattle": (1, "front front back back front", 0.5**10 * math.exp(-0.2 * math.pi)),
    "harvester": (1, "top bottom", 0.5**4),
    "impact_oscillator": (1, "wall", 0.8**2 * math.exp(-0.1 * math.pi)),
}
AFTER = 300  # periods
STARTS = {"ball": [2.0, -2.6], "belt": [-0.75, -0.3]}


def settled(name):
    """Return the itinerary and the guess of the orbit at which a start ends."""
    periods, E = ORBITS[name][0], engine(name)
    start = STARTS.get(name, [-0.1] * len(E.system.state))
    ends = E.follow([start], periods=AFTER)
    return contacts(E, ends.states[0], E.modes[ends.modes[0]], periods)


@pytest.mark.parametrize("name", some(ORBITS))
def test_an_orbit_is_proved(name):
    """It attracts in floats; the product of its multipliers follows from divergence and resets."""
    periods, words, product = ORBITS[name]
    itinerary, guess = settled(name)
    orbit = prove(itinerary, guess, 12)
    assert sorted(c.guard for c in itinerary.contacts) == sorted(words.split())
    assert (itinerary.periods, len(orbit.contacts)) == (periods, len(words.split()))
    if product is not None:
        assert abs(float(orbit.symmetric[-1]) - product) < 1e-12
    assert abs(float(orbit.symmetric[-1])) < 1
    near = [float(q) for t, q in orbit.contacts for q in (t, *q)]
    assert near == pytest.approx(guess, abs=1e-5)


@pytest.mark.parametrize(("A", "stable"), [("1.05", True), ("1.52", True), ("1.53", False)])
def test_the_window_of_the_ball(A, stable):
    """It hits where it should, and flips at A² = (pi (1 - e)/(1 + e))² + (2 (1 + e²)/(1 + e)²)²."""
    t = math.acos(math.pi / 3 / float(A))
    guess = [t, float(A) * math.sin(t), math.pi / 3 - 4 / 3 * math.pi]
    system = read(EXAMPLES / "ball.py", {"A": A})
    orbit = prove(Itinerary(system, [Contact("fly", "table", "fly")]), guess, 12)
    assert abs(float(orbit.contacts[0][0]) - t) < 1e-12
    trace, product = orbit.symmetric
    assert (1 + trace + product > 0) == stable
    assert (1 + trace + product < 0) != stable


def test_an_orbit_of_the_billiard():
    """A row of the published tables, a = 1.8, e = 0.75, E = 1.5."""
    rows = (
        (0.85201211, 1.421469821, 2.699873969, -1.61604321),
        (1.241059515, -0.22802519, -4.23983039, -4.07646981),
    )
    height = [1.8 * x**2 + 1.5 * math.sin(2 * math.pi * t) for t, x, _, _ in rows]
    guess = [q for (t, x, v, w), y in zip(rows, height, strict=True) for q in (t, x, y, v, w)]
    contact = Contact("fly", "table", "fly")
    orbit = prove(Itinerary(read(EXAMPLES / "billiard.py"), [contact] * 2), guess, 12)
    assert orbit.symmetric[3].contains(0.75**4)


def test_what_has_no_list_of_contacts():
    """No contact, too many, a capture, a start outside: each is told in one line."""
    E = engine("harvester")
    for state, mode, periods, message in (
        ([0.0, 0.7], "free", 40, "from 1 to 64"),
        ([0.25, 0.0], "at the top", 1, "accumulate|begins in the mode"),
        ([0.3, 0.7], "free", 1, "guard of its mode is negative"),
    ):
        with pytest.raises(BadInput, match=message) as refusal:
            contacts(E, state, mode, periods)
        assert "\n" not in str(refusal.value)


@pytest.mark.slow
def test_a_catch_that_friction_cannot_hold_is_flagged():
    """At x = -3 the spring pulls with more than s = 3/2: no mode fits after the catch."""
    found = engine("belt").follow([[-3.0, 0.49], [-0.75, -0.3]], ["slower", "slower"])
    assert found.flags.tolist() == [NO_MODE, 0]
    assert np.isnan(found.states[0]).all()
