"""Kneading sequences: tent maps, period doubling, logistic maps whose entropy is known."""

import math
from fractions import Fraction
from itertools import islice

import pytest

from cap.release.kneading import compared, doubling, slopes, tent
from cap.sets import interval


def logistic(a, count):
    """Return the kneading sequence of a x (1 - x) in floats."""
    x, found = a / 4, ""
    for _ in range(count):
        found += "L" if x < 0.5 else "R"
        x = a * x * (1 - x)
    return found


@pytest.mark.parametrize("s", ["1.05", "1.2", "1.4", "1.5", "1.618", "1.9", "1.999"])
def test_the_slope_of_a_tent_map(s):
    """It is found again from its own symbols, from both sides, as sharply as they tell."""
    with interval.workprec(400):
        symbols = "".join(islice(tent(interval.ball(Fraction(s))), 200))
        lower, upper = slopes(symbols, 60)
        assert lower < Fraction(s) < upper
        sharp = Fraction(s) ** -150 if float(s) > 1.3 else Fraction(1, 100)
        assert upper - lower < max(sharp, Fraction(4, 2**60))


@pytest.mark.parametrize(
    ("a", "slope"),
    [
        (3.8318740552833155, (1 + math.sqrt(5)) / 2),
        (3.9999999, 2.0),
        (3.6785735104283220, math.sqrt(2)),
    ],
)
def test_logistic_maps(a, slope):
    """At period 3, at full chaos, and where two bands merge."""
    symbols = logistic(a + 1e-9 if a < 3.99 else a, 40)
    with interval.workprec(200):
        lower, upper = slopes(symbols[:24], 40)
        assert float(lower) - 2e-3 < slope < float(upper) + 2e-3
        assert float(upper - lower) < 5e-3


def test_no_entropy():
    """Below the limit of period doubling the slope is 1, exactly; beyond it there is a bound."""
    for a in (2.5, 3.2, 3.5, 3.55, 3.566):
        assert slopes(logistic(a, 60), 40) == (1, 1)
    with interval.workprec(200):
        lower, upper = slopes(logistic(3.58, 60), 40)
        assert 1 < lower < upper < 1.2


def test_comparison():
    """It is an order, and the beginning of a sequence decides nothing against it."""
    assert compared("R", iter("L")) == 1
    assert compared("RL", iter("RR")) == 1
    assert compared("RLR", iter("RLR")) == 0
    assert compared("RL", iter("RLR")) == 0
    limit = "".join(islice(doubling(), 7))
    assert limit == "RLRRRLR"


def test_a_tent_ends_where_it_is_uncertain():
    """With few bits only the first symbols of a sequence are given."""
    with interval.workprec(30):
        few = "".join(tent(interval.ball(Fraction(17, 10))))
    with interval.workprec(300):
        many = "".join(islice(tent(interval.ball(Fraction(17, 10))), 200))
    assert 10 < len(few) < 60
    assert many.startswith(few)
