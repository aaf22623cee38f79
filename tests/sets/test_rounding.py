"""What a certificate says of a ball contains the ball: pairs, windows, bounds."""

from fractions import Fraction

import pytest
from support import between, decimal_fraction, random_box, rounds, seeded

from cap.certificate.writer import Rounding, Units, bound, window
from cap.errors import NotProved
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.interval import Ball

BAD = [Ball("nan"), Ball("inf"), Ball(0, "inf")]


def test_decade():
    """Within one of the logarithm, for numbers of any size."""
    random = seeded(1)
    for _ in range(rounds(200)):
        value = (1 + abs(decimal_fraction(random))) * Fraction(10) ** random.randint(-400, 400)
        d = interval.decade(value)
        assert Fraction(10) ** (d - 1) < value < Fraction(10) ** (d + 2)


def test_pairs_enclose_and_are_narrow():
    """The pair contains the ball; its width obeys the rule, with the unit or the size."""
    random = seeded(2)
    for _ in range(rounds(300)):
        digits = random.randint(6, 40)
        unit = Fraction(10) ** random.randint(-8, 8) * random.randint(1, 9)
        with interval.workprec(400):
            centre = decimal_fraction(random) * Fraction(10) ** random.randint(-10, 10)
            size = max(abs(centre), unit)
            ball = interval.around(centre, size * Fraction(random.randint(0, 9), 100) / 10**digits)
            lower, upper = (Fraction(text) for text in Rounding(digits).pair(ball, unit))
            low, high = interval.ends(ball)
            assert lower <= low <= high <= upper
            assert upper - lower <= max(abs(lower), abs(upper), unit) / 10**digits


def test_too_wide_balls_are_refused():
    """A ball wider than the digits claimed, and every ball that is not finite."""
    for digits in (6, 20):
        for centre in (Fraction(0), Fraction(1), Fraction(-1000)):
            size = max(1, abs(centre))
            for factor in (Fraction(51, 100), Fraction(1), Fraction(1000)):
                with interval.workprec(200), pytest.raises(NotProved) as caught:
                    Rounding(digits).pair(interval.around(centre, factor * size / 10**digits))
                assert caught.value.step == "rounding"
        for ball in BAD:
            with pytest.raises(NotProved):
                Rounding(digits).pair(ball)


def test_a_matrix_has_the_units_of_a_jacobian():
    """Rows (1, 1/ω) and (ω, 1): each entry is as narrow as its own unit asks."""
    units = Units.of(Parameters(*map(Fraction, (2, 1000, 1, -3, 4))))
    assert (units.length, units.speed, units.time) == (7, 7000, Fraction(1, 1000))
    assert (units.force, units.area) == (2, 49000)
    with interval.workprec(200):
        wide = interval.around(Fraction(0), Fraction(1, 10**10))
        small = Ball(0)
        Rounding(9).matrix(((small, small), (wide * 100, small)), units)
        with pytest.raises(NotProved):
            Rounding(9).matrix(((small, wide), (small, small)), units)


def test_windows_and_bounds_enclose():
    """A window contains its ball and is little wider; a bound is not below its ball."""
    random = seeded(3)
    for _ in range(rounds(200)):
        centre, radius = random_box(random, Fraction(10) ** random.randint(-5, 5))
        with interval.workprec(300):
            ball = interval.around(centre, radius)
            low, high = interval.ends(ball)
            lower, upper = (Fraction(text) for text in window(ball))
            assert lower <= low <= high <= upper
            assert upper - lower <= (high - low) * Fraction(101, 100) + Fraction(1, 10**55)
            size = Fraction(bound(abs(ball)))
            assert high <= size
            assert size <= max(abs(low), high) * Fraction(102, 100) + Fraction(1, 10**55)
    for ball in BAD:
        for function in (window, bound):
            with pytest.raises(NotProved):
                function(ball)


@pytest.mark.parametrize("unit", [Fraction(1), Fraction(10) ** 20, Fraction(1, 10**20)])
@pytest.mark.parametrize(("lower", "upper"), [(0, 1), (1, 3), (Fraction(1, 1000), 7), (5, 5)])
def test_a_bound_is_of_the_upper_end_of_a_wide_ball(lower, upper, unit):
    """Not below the upper end, at most 2 % above it, of three digits or four, however wide."""
    with interval.workprec(200):
        text = bound(between(lower * unit, upper * unit))
    assert upper * unit <= Fraction(text) <= upper * unit * Fraction(102, 100)
    assert len(text.replace(".", "").strip("0")) <= 4
    assert len(text) <= 25
