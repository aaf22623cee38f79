"""Roots that interval solvers have reported at jumps and on branches, as systems: none is proved.

Where a function of a user is a branch on an interval, solvers have taken the wrong one and flagged
its root as unique (IntervalRootFinding.jl, issues 146, 181 and 184; ValidatedNumerics.jl, issue
191).  Here branches are modes: x is a fixed point of a map if and only if x at rest, and replaced
once in a period of the clock, is an orbit; a mode leaves by its own reset, to where that leads.
"""

import math
from fractions import Fraction

import pytest

from cap import Guard, Mode, System, variables
from cap.errors import NotProved
from cap.floats.models.engine import Engine
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import prove
from cap.system import form

x, sin = variables("x sin")


def beats(low, high, at=0):
    """The map x -> low(x) for x < at, high(x) for x > at, once in a period: which mode is data."""
    modes = {
        "below": Mode({"x": 0}, {"beat": Guard(sin, "after", {"x": low}), "edge": edge(at - x)}),
        "above": Mode({"x": 0}, {"beat": Guard(sin, "after", {"x": high}), "edge": edge(x - at)}),
        "after": Mode({"x": 0}, {"again": Guard(-sin, ("below", "above"))}),
    }
    return System("x", 1, modes)


def edge(value):
    """Bound a branch by the sign of a polynomial."""
    return Guard(value, ("below", "above"))


def orbit(system, *places):
    """Prove the orbit of these branches and numbers, one for each period."""
    contacts, guess = [], []
    for k, (mode, number) in enumerate(places):
        after, to = places[(k + 1) % len(places)][::-1]
        contacts += [Contact(mode, "beat", "after"), Contact("after", "again", to)]
        guess += [(2 * k + 1) * math.pi, number, (2 * k + 2) * math.pi, after]
    return prove(Itinerary(system, contacts, len(places)), guess)


def refused(system, mode, number):
    """Check that a fixed point of a branch is refused because it is not on it."""
    with pytest.raises(NotProved, match="edge"):
        orbit(system, (mode, number))


@pytest.mark.parametrize(("mode", "root"), [("below", 1.0), ("above", -1.0)])
def test_sign(mode, root):
    """x + sgn x = 0: each branch has a root, on the other side of 0."""
    refused(beats(low=1, high=-1), mode, root)


def test_its_cycle():
    """The cycle 1, -1, 1 of x -> -sgn x is proved, by what refuses the roots."""
    found = orbit(beats(low=1, high=-1), ("above", 1.0), ("below", -1.0))
    assert all(
        state[0].contains(s) for (_, state), s in zip(found.contacts[::2], (1, -1), strict=True)
    )


@pytest.mark.parametrize(("mode", "root"), [("below", 1.0), ("above", -1.0)])
def test_maximum(mode, root):
    """max(x, -x) + 1 = 0 has no root, -x + 1 = 0 and x + 1 = 0 have one."""
    half = Fraction(1, 2)
    refused(beats(x - half * (1 - x), x - half * (1 + x)), mode, root)


@pytest.mark.parametrize(("value", "right"), [(6, True), (3, False)])
def test_branch(value, right):
    """f(x) = 2x for x > 2, else -2x: f(x) = 6 at 3 and -3, but f(x) = 3 at -3/2 alone."""
    quarter = Fraction(1, 4)
    system = beats(x + quarter * (-2 * x - value), x - quarter * (2 * x - value), at=2)
    found = orbit(system, ("below", -value / 2))
    assert found.contacts[0][1][0].contains(-value / 2)
    if right:
        assert orbit(system, ("above", 3.0)).contacts[0][1][0].contains(3)
    else:
        refused(system, "above", 1.5)


def test_zero_over_x():
    """x + 0/x: 0/x is 0 from the start, and what is proved is of the reset that the data hold."""
    whole, plain = (beats(low, x / 2) for low in (x / 2 + 0 / x, x / 2))
    assert form.dumps(whole) == form.dumps(plain)


@pytest.mark.slow
def test_one_variable_in_floats():
    """The engine follows the cycle of -sgn x, and an orbit that is lost."""
    ends = Engine(beats(low=1, high=-1)).follow([[0.5], [0.5]], ["above", "below"], periods=2)
    assert ends.states[0, 0] == 1
