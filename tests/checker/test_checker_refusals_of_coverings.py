"""What the checker of coverings refuses, one condition at a time, each for its own reason."""

import math
from fractions import Fraction

import pytest

from cap.checker.coverings import covering
from cap.checker.coverings.contact_map import FAR, interval
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.formulas import Map
from cap.checker.coverings.half_period import HalfPeriod
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.rejection import Rejected
from checker.linear import Linear
from checker.test_checker_formulas import given

SQUARE = Parallelogram([Fraction(n) for n in (0, 0, 1, 0, 0, 1)])


class Punctured(Linear):
    """The map (x, y) -> (3x, y/4), not defined where low <= |x| <= high may hold."""

    def __init__(self, low, high):
        super().__init__()
        self.low, self.high = low, high

    def image(self, x, y):
        """Enclose it, or reject."""
        nearest = max(0.0, abs(x.mid) - x.rad)
        if nearest <= self.high and x.magnitude >= self.low:
            raise Rejected("punctured")
        return super().image(x, y)


@pytest.mark.parametrize(
    ("g", "why"),
    [
        (Punctured(1.0, 1.0), "not be defined on an edge"),
        (Punctured(0.0, 0.1), "may not be defined$"),
        (Linear(0.5, 0.0, 0.0, 0.25), "an edge needs more than"),
        (Linear(3.0, 0.0, 0.0, 2.0), "a set needs more than"),
    ],
)
def test_what_covers_nothing(g, why, monkeypatch):
    """No image of an edge, or of points inside; an image that is too short, or too thick."""
    monkeypatch.setattr(covering, "MOST", 3000)
    with pytest.raises(Rejected, match=why):
        covers(g, SQUARE, [SQUARE])


class Torn(Linear):
    """A map that is no map: it sends halves of an edge to either side of a square."""

    def image(self, x, y):
        """Enclose it: with a steep derivative over a long edge."""
        known = super().image(x, y)
        steep = (Double(0.0), Double(0.0, 9.0 if y.rad > 0.6 else 0.0)), known.derivative[1]
        return known._replace(x=Double(5.0 if y.mid > 0 else -5.0), derivative=steep)


def test_an_edge_that_is_torn():
    """Its image has points on both sides."""
    with pytest.raises(Rejected, match="to both sides of a set"):
        covers(Torn(3.0, 0.0, 0.0, 0.0), SQUARE, [SQUARE])


@pytest.mark.parametrize(
    ("x", "y", "why"),
    [
        (Double(math.pi), Double(0.0), "a state that may be at a cut"),
        (Double(0.0), Double(-math.pi), "a state that may be at a cut"),
        (Double(3.0), Double(0.0, 3.0), "an image that may be at a cut"),
    ],
)
def test_cuts_of_a_torus(x, y, why):
    """Both coordinates of a state, and of an image, are certainly inside of the square."""
    g = Map(given("standard"))
    g.image(Double(0.5), Double(0.5))
    with pytest.raises(Rejected, match=why):
        g.image(x, y)


def test_states_far_away():
    """What becomes an interval of integers is bounded."""
    assert interval(Double(FAR / 2)).lo > 0
    for x in (Double(FAR), Double(-FAR), Double(0.0, FAR)):
        with pytest.raises(Rejected, match="too far away"):
            interval(x)


@pytest.mark.parametrize(("phi", "a"), [("-1/10", "1"), ("1", "1"), ("2", "1"), ("1/2", "0")])
def test_parameters_of_a_half_period(phi, a):
    """Friction is not negative and less than the force; the walls are apart."""
    with pytest.raises(Rejected, match="0 <= f < F"):
        HalfPeriod(Fraction(phi), Fraction(a))
