"""What a curve surrounds: area, winding number, the region that contains its neighbourhood."""

from fractions import Fraction

import pytest

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.sets.interval import Ball, ComplexBall
from cap.tori.around import area, half_width, winding
from cap.tori.invariant_curve import Curve, Found

ONE = ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(1)))
SKEW = ((Fraction(3), Fraction(1)), (Fraction(0), Fraction(-1, 2)))


@pytest.fixture(autouse=True)
def working():
    """The precision."""
    with interval.workprec(120):
        yield


def ellipse(a, b, at=(0, 0)):
    """Return at + (a cos θ, b sin θ), a little deformed."""
    circle = Circle(8, Fraction(1, 10))
    x = circle.real([ComplexBall(at[0]), ComplexBall(Ball(a) / 2), ComplexBall(0)])
    v = circle.real([ComplexBall(at[1]), ComplexBall(0, -Ball(b) / 2)])
    return Curve(x, v)


def near(distance="1e-9", slope="1e-8"):
    """Return what the theorem gives."""
    return Found(Ball(distance), Ball(slope), Ball("0.1"))


def test_area():
    """That of an ellipse is in it, at either orientation, and no other."""
    for b in (2, -2):
        found = area(ellipse(3, b, (5, 7)), near())
        assert found.contains(6 * interval.pi())
        assert found.rad() < Ball("1e-6")
    with pytest.raises(NotProved, match="vanish"):
        area(ellipse(1, 1), near("1"))


def test_winding():
    """Around a point inside; not known for one outside, or if the curve is not near."""
    centre = Ball(5), Ball(7)
    for axes in (ONE, SKEW):
        assert winding(ellipse(2, 2, (5, 7)), centre, axes, Ball("1e-9")) == 1
        assert winding(ellipse(2, -2, (5, 7)), centre, axes, Ball("1e-9")) == -1
    for curve, distance in ((ellipse(2, 2), "1e-9"), (ellipse(2, 2, (5, 7)), "3")):
        with pytest.raises(NotProved, match="around"):
            winding(curve, centre, ONE, Ball(distance))


def test_the_region():
    """It is as wide as the curve, and what is near it."""
    h = half_width(ellipse(2, 1), (Ball(0), Ball(0)), ONE, Ball("0.5"))
    assert Fraction(5, 2) < h < Fraction(52, 20)
    with pytest.raises(NotProved, match="parallel"):
        half_width(
            ellipse(2, 1), (Ball(0), Ball(0)), ((Fraction(1), Fraction(1)),) * 2, Ball("0.5")
        )
