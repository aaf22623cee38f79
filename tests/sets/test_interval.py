"""Balls contain what they are built from, print outwards, and never compare NaN as true."""

from fractions import Fraction

import pytest
from flint import ctx
from support import between, decimal_fraction, holds, inside, random_box, rounds, seeded, width

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

NAN = Ball("nan")
INFINITE = Ball("inf")
EVERYTHING = Ball(0, "inf")
PRECISIONS = [2, 3, 10, 53, 200]
EXACT = Fraction(0)


def dyadic(centre, radius, places=2):
    """Return the ball [centre ± radius] / 2^places, without rounding."""
    return Ball((centre, -places), (radius, -places))


@pytest.mark.parametrize("bits", PRECISIONS)
def test_ball_contains_its_rational(bits):
    """Also huge, tiny and dyadic ones; tight to the last bits."""
    random = seeded(bits)
    with interval.workprec(bits):
        for _ in range(rounds(100)):
            q = decimal_fraction(random) * Fraction(10) ** random.randint(-80, 80)
            ball = interval.ball(q)
            assert holds(ball, q, EXACT)
            assert width(ball) <= abs(q) * Fraction(4, 2**bits)
        assert holds(interval.ball(Fraction(1, 3)), Fraction(1, 3), EXACT)


def test_ball_of_a_float_is_not_a_ball_of_the_decimal():
    """The ball of 2/5 contains 2/5; the library never makes balls of float literals."""
    assert holds(interval.ball(Fraction(2, 5)), Fraction(2, 5), EXACT)
    assert not holds(interval.ball(Fraction(0.4)), Fraction(2, 5), EXACT)


@pytest.mark.parametrize("bits", PRECISIONS)
def test_around_and_between_contain_their_ends(bits):
    """At any precision, also with radius zero, and hardly more than that."""
    random = seeded(bits)
    with interval.workprec(bits):
        for _ in range(rounds(100)):
            centre, radius = random_box(random, 10)
            for ball in (
                interval.around(centre, radius),
                between(centre - radius, centre + radius),
            ):
                for q in (centre - radius, centre + radius, inside(random, centre, radius)):
                    assert holds(ball, q, EXACT)
                slack = (abs(centre) + radius) * Fraction(16, 2**bits) + radius / 10**6
                assert width(ball) <= 2 * radius + slack


def test_ends_are_exact_and_refuse_what_is_not_finite():
    """A dyadic ball has its own ends; NaN and infinite balls have none."""
    assert interval.ends(dyadic(6, 1, 1)) == (Fraction(5, 2), Fraction(7, 2))
    assert interval.midpoint(dyadic(6, 1, 1)) == 3
    for ball in (NAN, INFINITE, -INFINITE, EVERYTHING):
        for function in (interval.ends, interval.midpoint):
            with pytest.raises(NotProved):
                function(ball)


@pytest.mark.parametrize("exponent", [10**6, 2 * 10**6, 10**9, 10**25, 10**400])
@pytest.mark.parametrize("sign", [1, -1])
def test_numbers_too_long_to_write(exponent, sign):
    """2^±1000000 is a fraction; what is much larger or smaller is refused, in no time."""
    huge = Ball((3, sign * exponent))
    for ball in (huge, -huge, Ball((1, 0), (1, sign * exponent))):
        if exponent == 10**6:
            assert interval.ends(huge)[0] == 3 * Fraction(2) ** (sign * exponent)
            continue
        for function in (interval.ends, interval.midpoint, lambda x: interval.outward(x, 3)):
            with pytest.raises(NotProved, match="to write"):
                function(ball)
    if exponent > 10**6:
        with pytest.raises(NotProved, match="to write"):
            interval.rational(huge)


@pytest.mark.parametrize("text", ["1e10000000000000000000000000", "-2e-10000000000000000000000000"])
def test_decimals_too_long_to_write(text):
    """Exponents that a person can type and no memory holds: neither hang nor crash."""
    for function in (interval.ends, interval.midpoint):
        with pytest.raises(NotProved, match="to write"):
            function(Ball(text))
    with pytest.raises(ValueError, match="not a decimal"):
        interval.stated(text)


def test_integers_between_balls():
    """Those that are between some of their points, no others: halves, ends, huge and tiny."""
    random = seeded(8)
    for _ in range(rounds(300)):
        size = Fraction(10) ** random.choice([-20, -1, 0, 1, 5, 15, 40])
        boxes = [(decimal_fraction(random, size), abs(decimal_fraction(random))) for _ in "ab"]
        with interval.workprec(random.choice([53, 200])):
            first, last = (interval.around(*box) for box in boxes)
            low, high = interval.ends(first)[0], interval.ends(last)[1]
            found = interval.integers(first, last)
            slack = Fraction(abs(low) + abs(high)) / 2**50
        assert low - slack <= found.start < low + 1
        assert high < found.stop <= high + slack + 1
    for k in (-(10**30), -3, -1, 0, 1, 2, 10**30):
        with interval.workprec(120):
            assert list(interval.integers(Ball(k), Ball(k))) == [k]
            below, above = Ball(k) - Ball(2) ** -10, Ball(k) + Ball(2) ** -10
            assert list(interval.integers(below, above)) == [k]
            assert list(interval.integers(above, above)) == []
    assert list(interval.integers(Ball((1, -(10**30))), Ball(1, Ball((1, -(10**30)))))) == [1]
    for bad in (NAN, INFINITE, EVERYTHING, Ball((1, 10**9)), Ball((-1, 10**40))):
        with pytest.raises((NotProved, ValueError)):
            interval.integers(bad, bad)


def test_numbers_stated():
    """What is written by `decimal` or as a fraction is read as it was; nothing else is."""
    random = seeded(7)
    for _ in range(rounds(100)):
        q, decimal = decimal_fraction(random), Fraction(random.randint(-(10**9), 10**9), 10**6)
        assert interval.stated(str(q)) == q
        assert interval.stated(interval.exact_decimal(decimal)) == decimal
    for text in ("", "1e3", "1.", ".5", "+1", " 1", "1/2/3", "1/-2", "nan", "inf", "1_0", "٣"):
        with pytest.raises(ValueError, match="not a decimal"):
            interval.stated(text)
    with pytest.raises(ZeroDivisionError):
        interval.stated("1/0")


def test_symmetric_point_hull_least_intersection():
    """They contain what their docstrings say, for random balls and points in them."""
    random = seeded(1)
    for _ in range(rounds(200)):
        boxes = [random_box(random), random_box(random)]
        x, y = (interval.around(*box) for box in boxes)
        p, q = (inside(random, *box) for box in boxes)
        for value in (p, -p, abs(p), Fraction(0)):
            assert holds(interval.symmetric(x), value, EXACT)
        assert interval.point(x).rad() == 0
        assert holds(x, interval.midpoint(x), EXACT)
        for value in (p, q, (p + q) / 2):
            assert holds(interval.hull(x, y), value, EXACT)
        assert holds(interval.least(x, y), min(p, q), EXACT)
        wide = interval.around(p, Fraction(1, 3))
        common = interval.intersection(x, wide)
        assert holds(common, p, EXACT)
        assert width(common) <= 1.001 * min(width(x), width(wide)) + 1e-15


def test_nan_spreads():
    """No operation turns an indeterminate ball into a finite one."""
    for bad in (NAN, 1 / Ball(0, 1)):
        for result in (
            interval.least(bad, Ball(1)),
            interval.least(Ball(1), bad),
            interval.hull(Ball(1), bad),
            interval.symmetric(bad),
        ):
            assert not result.is_finite()
            assert not any((result > 0, result < 0, result < 10))


def test_subset():
    """Boundaries belong to a ball and not to its interior; NaN lies nowhere and holds nothing."""
    unit, inner, touching, crossing = dyadic(0, 4), dyadic(0, 2), dyadic(2, 2), dyadic(2, 3)
    assert interval.subset(inner, unit)
    assert interval.subset_interior(inner, unit)
    assert interval.subset(touching, unit)
    assert not interval.subset_interior(touching, unit)
    assert not interval.subset_interior(-touching, unit)
    assert interval.subset(unit, unit)
    assert not interval.subset_interior(unit, unit)
    assert not interval.subset_interior(Ball(1), Ball(1))
    assert not interval.subset(crossing, unit)
    assert not interval.subset(-crossing, unit)
    assert not interval.subset(unit, inner)
    for bad in (NAN, INFINITE, EVERYTHING):
        for test in (interval.subset, interval.subset_interior):
            assert not test(bad, unit)
            assert not test(unit, bad)
            assert not test(bad, bad)


def test_outward_encloses_and_is_tight():
    """Each end is rounded away from the ball, by less than one unit of the last place."""
    random = seeded(2)
    for _ in range(rounds(300)):
        centre, radius = random_box(random, Fraction(10) ** random.randint(-12, 12))
        ball, places = interval.around(centre, radius), random.randint(0, 25)
        lower, upper = interval.ends(ball)
        low, high = (Fraction(text) for text in interval.outward(ball, places))
        unit = Fraction(1, 10**places)
        assert lower - unit < low <= lower
        assert upper <= high < upper + unit


@pytest.mark.parametrize(
    ("ball", "places", "texts"),
    [
        (Ball(0), 0, ("0", "0")),
        (Ball(0), 3, ("0.000", "0.000")),
        (Ball(0.5), 0, ("0", "1")),
        (Ball(-0.5), 0, ("-1", "0")),
        (Ball(-0.5), 1, ("-0.5", "-0.5")),
        (dyadic(3, 2, 3), 2, ("0.12", "0.63")),
        (dyadic(-3, 2, 3), 2, ("-0.63", "-0.12")),
        (dyadic(0, 1, 4), 1, ("-0.1", "0.1")),
        (Ball(2) ** -200, 5, ("0.00000", "0.00001")),
        (-(Ball(2) ** -200), 5, ("-0.00001", "0.00000")),
        (Ball(2) ** 70, 1, (f"{2**70}.0", f"{2**70}.0")),
    ],
)
def test_outward_by_hand(ball, places, texts):
    """Signs, zero places, huge and tiny numbers."""
    assert interval.outward(ball, places) == texts


def test_outward_refuses_what_is_not_finite():
    """There is no decimal for NaN or an infinite ball."""
    for ball in (NAN, INFINITE, EVERYTHING):
        with pytest.raises(NotProved):
            interval.outward(ball, 3)


def test_decimal_is_exact():
    """A number with more places is refused, not rounded."""
    assert interval.decimal(Fraction(-1, 8), 3) == "-0.125"
    assert interval.decimal(Fraction(5), 0) == "5"
    assert interval.decimal(Fraction(1, 100), 4) == "0.0100"
    for value, places in ((Fraction(1, 8), 2), (Fraction(1, 3), 50), (Fraction(1, 2), 0)):
        with pytest.raises(ValueError, match="decimal places"):
            interval.decimal(value, places)


def test_short_is_a_little_less():
    """Two digits, at most the value, more than nine tenths of it; over forty decades."""
    random = seeded(3)
    for _ in range(rounds(200)):
        value = (1 + abs(decimal_fraction(random))) * Fraction(10) ** random.randint(-40, 40)
        short = interval.short(value)
        assert Fraction(9, 10) * value < short <= value
        digits = str(short.numerator * 10**60 // short.denominator).rstrip("0")
        assert len(digits) <= 2
    assert interval.short(Fraction(1, 10)) == Fraction(1, 10)


def test_precision_is_scoped():
    """It comes back after the block, also after an exception, also nested."""
    with interval.workprec(200):
        fine = interval.pi()
        with interval.workprec(10):
            assert ctx.prec == 10
            coarse = interval.pi()
        assert ctx.prec == 200
    assert ctx.prec == 53
    with pytest.raises(NotProved), interval.workprec(99):
        interval.ends(NAN)
    assert ctx.prec == 53
    assert width(fine) < 1e-58
    assert width(coarse) > 1e-5
    assert interval.subset(fine, coarse)


def test_rounding_exceeds_the_relative_error():
    """One operation at the current precision errs by less than ``rounding()``."""
    for bits in (30, 53, 200):
        with interval.workprec(bits):
            third = interval.ball(Fraction(1, 3))
            assert third.rad() * 3 < interval.rounding()
            assert interval.rounding() * 2**bits < 10**4
