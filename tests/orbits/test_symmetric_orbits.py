"""Symmetries of systems, and half a round of symmetric orbits."""

from fractions import Fraction

import pytest

from cap.errors import BadInput
from cap.orbits.equations import Equations
from cap.orbits.halves import half
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import Prover
from cap.sets import interval
from cap.system.files import read
from cap.system.symmetry import symmetries

OSCILLATOR = {"f": Fraction(9, 20), "e": Fraction(9, 10)}
ROUND = [Contact("right", "wall", "left"), Contact("left", "wall", "right")]
GUESS = [0.6829, 1, 0.9775, 3.8245, -1, -0.9775]


def oscillator(**given):
    """Return the oscillator with losses."""
    return read("examples/oscillator.py", {**OSCILLATOR, **given})


def test_which_systems_have_one():
    """The oscillator between like walls, and Den Hartog's; not a ball, nor unlike walls."""
    (found,) = symmetries(oscillator())
    assert found.signs == (-1, -1)
    assert found.modes["held left"] == "held right"
    assert found.guards["right", "wall"] == "wall"
    assert found.guards["rest", "to left"] == "to right"
    (found,) = symmetries(read("examples/den_hartog.py", {}))
    assert found.modes["rest"] == "rest"
    assert not list(symmetries(oscillator(r=Fraction(11, 10))))
    assert not list(symmetries(read("examples/ball.py", {})))


def test_multipliers_of_a_round_are_squares():
    """Half a round has multipliers a, b; the round has a^2 + b^2 and a^2 b^2."""
    with interval.workprec(96):
        whole = Itinerary(oscillator(), ROUND)
        full = Prover(Equations(whole)).prove(GUESS, 12)
        near = [float(x) for x in full.box]
        found = half(whole, near)
        assert found is not None
        assert found.contacts == ROUND[:1]
        orbit = Prover(Equations(found)).prove(near[:3], 12)
    assert all(a.overlaps(b) for a, b in zip(orbit.box, full.box[:3], strict=True))
    total, product = orbit.symmetric
    for x, y in ((total * total - 2 * product, full.symmetric[0]), (product**2, full.symmetric[1])):
        assert x.overlaps(y)
        assert float(x.rad()) < 1e-9


def test_an_orbit_that_is_not_symmetric():
    """A contact moved by 1/100 is not the image of the other."""
    whole = Itinerary(oscillator(), ROUND)
    guess = list(GUESS)
    guess[3] += 0.01
    assert half(whole, guess) is None
    assert half(Itinerary(oscillator(r=Fraction(11, 10)), ROUND), GUESS) is None


def test_an_even_number_of_periods():
    """After an even number of half periods the clock is what it was."""
    system = oscillator()
    (found,) = symmetries(system)
    with pytest.raises(BadInput, match="an odd number of periods"):
        Itinerary(system, ROUND[:1], 2, found)
