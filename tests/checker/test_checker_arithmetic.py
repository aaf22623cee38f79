"""The checker's intervals: every operation contains the exact values, and hardly more."""

from __future__ import annotations

from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from checker.intervals import BITS, contains, points, some_interval


@pytest.mark.parametrize("bits", BITS)
def test_field_operations_contain_all_values_and_are_tight(bits):
    """Sums, products, negatives contain all values at points and exceed them by under an ulp."""
    rng = seeded(bits)
    for _ in range(rounds(300)):
        x, y = some_interval(rng, bits), some_interval(rng, bits)
        pairs = [(p, q) for p in points(rng, x) for q in points(rng, y)]
        for result, exact in (
            (x + y, [p + q for p, q in pairs]),
            (x - y, [p - q for p, q in pairs]),
            (x * y, [p * q for p, q in pairs]),
            (x * 7, [p * 7 for p, _ in pairs]),
            (x * -7, [p * -7 for p, _ in pairs]),
            (x + 3, [p + 3 for p, _ in pairs]),
            (x - 3, [p - 3 for p, _ in pairs]),
            (-x, [-p for p, _ in pairs]),
        ):
            assert all(contains(result, value) for value in exact)
            ulp = Fraction(1, 1 << bits)  # the corners are among the points
            assert min(exact) - result.lower < ulp
            assert result.upper - max(exact) < ulp


@pytest.mark.parametrize("bits", BITS)
def test_division_contains_all_values_and_is_tight(bits):
    """So do quotients; a divisor that contains zero rejects."""
    rng = seeded(bits + 1)
    done = 0
    while done < rounds(200):
        x, y = some_interval(rng, bits), some_interval(rng, bits)
        if y.contains_zero():
            with pytest.raises(Rejected, match="zero"):
                x / y
            continue
        done += 1
        exact = [p / q for p in points(rng, x) for q in points(rng, y)]
        result, ulp = x / y, Fraction(1, 1 << bits)
        assert all(contains(result, value) for value in exact)
        assert min(exact) - result.lower < ulp
        assert result.upper - max(exact) < ulp


@pytest.mark.parametrize(
    "divisor", [0, Interval(0, 5, 64), Interval(-5, 0, 64), Interval(-1, 1, 64)]
)
def test_division_by_an_interval_with_zero_rejects(divisor):
    """Also if zero is an end of the divisor, or the divisor is the integer 0."""
    with pytest.raises(Rejected):
        Interval(1, 2, 64) / divisor


@pytest.mark.parametrize("divisor", [1, 3, -3])
def test_division_by_an_integer(divisor):
    """Contains the exact ends, also with a negative divisor, and is narrow."""
    x = Interval(10, 20, 4)
    ends = sorted((x.lower / divisor, x.upper / divisor))
    assert (x / divisor).lower <= ends[0] <= ends[1] <= (x / divisor).upper
    assert (x / divisor).width <= 10 // abs(divisor) + 2


@pytest.mark.parametrize("bits", BITS)
def test_square_root_magnitude_of_random_intervals(bits):
    """Square, |x| and root contain all values, and their ends are within an ulp of the extremes."""
    rng = seeded(bits + 2)
    ulp = Fraction(1, 1 << bits)
    for _ in range(rounds(200)):
        x = some_interval(rng, bits)
        for value in points(rng, x):
            assert contains(x.square(), value**2)
            assert contains(x.magnitude(), abs(value))
        assert x.square().lo >= 0
        largest = max(x.lower**2, x.upper**2)
        assert x.square().upper - largest < ulp
        least = Fraction(0) if x.contains_zero() else min(x.lower**2, x.upper**2)
        assert least - x.square().lower < ulp
        assert (x.magnitude().lower == 0) == x.contains_zero()
        y = x.magnitude()
        root = y.sqrt()
        assert root.lower**2 <= y.lower < (root.lower + ulp) ** 2
        assert (root.upper - ulp) ** 2 < y.upper <= root.upper**2 or y.hi == root.hi == 0


@pytest.mark.parametrize("bits", [0, 1, 6])
def test_square_roots_of_all_small_numbers(bits):
    """Exact for squares, and otherwise one unit wide."""
    for n in range(300):
        root = Interval(n, n, bits).sqrt()
        assert root.lower**2 <= Fraction(n, 1 << bits) <= root.upper**2
        exact = root.lower**2 == Fraction(n, 1 << bits)
        assert root.width == (0 if exact else 1)


def test_square_root_of_negative_numbers_rejects():
    """An interval that reaches below zero has no square root."""
    with pytest.raises(Rejected, match="negative"):
        Interval(-1, 5, 64).sqrt()


@pytest.mark.parametrize(
    "q", [Fraction(1, 3), Fraction(-1, 3), Fraction(2), Fraction(0), Fraction(-7, 10**40)]
)
def test_enclosing_is_the_least_interval(q):
    """A rational is enclosed in one unit, or exactly if it is a multiple of the unit."""
    for bits in BITS:
        x = Interval.enclosing(q, q, bits)
        assert contains(x, q)
        assert x.width == (0 if (q * (1 << bits)).denominator == 1 else 1)


def test_enclosing_refuses_ends_that_are_not_in_order():
    """Such an interval has no points, so it would prove everything."""
    with pytest.raises(Rejected, match="not in order"):
        Interval.enclosing(Fraction(2), Fraction(1), 8)


def test_enclosing_rounds_each_end_outwards():
    """±1/3 in units 2^-8: the ends are rounded away from zero, by hand -86 and 86."""
    x = Interval.enclosing(Fraction(-1, 3), Fraction(1, 3), 8)
    assert (x.lo, x.hi) == (-86, 86)


def test_with_bits_rounds_outwards():
    """Fewer bits round each end outwards; more bits change nothing."""
    x = Interval(-5, 5, 10)
    assert (x.with_bits(9).lo, x.with_bits(9).hi) == (-3, 3)
    assert x.with_bits(20).lower == x.lower


def test_predicates_are_strict():
    """Touching is neither before nor inside nor positive; closed inclusion allows it."""
    zero, one, two = (Interval(n, n, 0) for n in (0, 1, 2))
    assert not zero.is_positive()
    assert one.is_positive()
    assert not one.is_before(one)
    assert one.is_before(two)
    assert not Interval(1, 2, 0).is_before(two)
    assert Interval(0, 1, 0).contains_zero()
    assert Interval(-1, 0, 0).contains_zero()
    assert one.lies_in(Fraction(1), Fraction(1))
    assert not one.lies_inside(Fraction(1), Fraction(2))
    assert not one.lies_inside(Fraction(0), Fraction(1))
    assert one.lies_inside(Fraction(0), Fraction(2))
    assert not one.lies_in(Fraction(0), Fraction(1, 2))
    assert not one.lies_in(Fraction(3, 2), Fraction(2))


def test_intersection():
    """Of overlapping and of touching intervals; disjoint ones reject."""
    x = Interval(0, 5, 3).intersection(Interval(2, 9, 3))
    assert (x.lo, x.hi) == (2, 5)
    assert Interval(0, 2, 3).intersection(Interval(2, 3, 3)).width == 0
    with pytest.raises(Rejected, match="disjoint"):
        Interval(0, 1, 3).intersection(Interval(2, 3, 3))


def test_different_precision_rejects():
    """Operands with different units never meet silently."""
    for operation in (Interval.__add__, Interval.__sub__, Interval.__mul__, Interval.__truediv__):
        with pytest.raises(Rejected, match="precision"):
            operation(Interval(1, 1, 3), Interval(1, 1, 4))


@pytest.mark.parametrize("value", [1, "true", [True], None, False, 0])
def test_need_takes_nothing_but_true(value):
    """A truthy value is not enough: only ``True`` passes."""
    with pytest.raises(Rejected, match="why"):
        need(value, "why")
    need(True, "why")


@pytest.mark.parametrize("ends", [(0, 0), (-1, 0), (5, 6), (-7, -2), (100, 108), (-9, 90)])
def test_the_midpoint_lies_in_the_interval_near_its_middle(ends):
    """A single point, between the ends, half a unit from the middle at most."""
    middle = Interval(*ends, 5).midpoint()
    assert middle.lo == middle.hi
    assert ends[0] <= middle.lo <= ends[1]
    assert abs(2 * middle.lo - sum(ends)) <= 1
