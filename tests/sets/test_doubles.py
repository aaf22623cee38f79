"""Intervals of doubles contain what they must, exactly, and little more."""

import math
import operator
from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.sets import doubles
from cap.sets.doubles import (
    UNIT,
    Interval,
    below,
    between,
    clipped,
    enclosing,
    hull,
    is_finite,
    is_negative,
    is_positive,
    lower,
    magnitude,
    square,
    upper,
    widened,
)
from sets.draw import bounded, double, holds, interval, point

OPERATIONS = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


@pytest.mark.parametrize("symbol", OPERATIONS)
def test_arithmetic_contains(symbol):
    """The exact result for any two points lies in the result, if that is bounded."""
    random, operation, seen = seeded(1), OPERATIONS[symbol], 0
    for _ in range(rounds(4000)):
        x, y = interval(random), interval(random)
        result = operation(x, y)
        if bounded(result):
            seen += 1
            a, b = point(random, x), point(random, y)
            assert holds(result, operation(a, b)), (x, y)
    assert seen > rounds(4000) / 3


@pytest.mark.parametrize("symbol", OPERATIONS)
def test_arithmetic_with_a_double(symbol):
    """A float operand stands for itself, on either side."""
    random, operation = seeded(2), OPERATIONS[symbol]
    for _ in range(rounds(1000)):
        x, y = interval(random, 100), double(random, 100)
        for result, exact in (
            (operation(x, y), operation),
            (operation(y, x), lambda a, b: operation(b, a)),
        ):
            if bounded(result):
                assert holds(result, exact(point(random, x), Fraction(y)))


@pytest.mark.parametrize("symbol", OPERATIONS)
def test_arithmetic_is_tight(symbol):
    """The radius is what the operands' radii ask for, and two roundings."""
    random, operation = seeded(3), OPERATIONS[symbol]
    for _ in range(rounds(500)):
        x, y = (Interval(random.uniform(1, 2), random.choice((0, 1e-9))) for _ in range(2))
        result = operation(x, y)
        ends = [operation(x.mid + s * x.rad, y.mid + t * y.rad) for s in (-1, 1) for t in (-1, 1)]
        assert result.rad <= (max(ends) - min(ends)) / 2 * (1 + 1e-6) + 3 * UNIT * abs(result.mid)


def test_negative_and_square():
    """-x is exact; the square is that of the points, and not of two independent ones."""
    random = seeded(4)
    for _ in range(rounds(3000)):
        x = interval(random, 150)
        a = point(random, x)
        assert holds(-x, -a)
        assert holds(square(x), a * a)
    assert upper(square(Interval(0.0, 2.0))) <= 4 * (1 + 1e-14)


def test_square_root():
    """The square root of each positive point; nothing where one may not be positive."""
    random = seeded(5)
    for _ in range(rounds(3000)):
        x = interval(random)
        root = doubles.sqrt(x)
        if x.mid > x.rad:
            a = point(random, x)
            low, high = max(Fraction(lower(root)), Fraction(0)), Fraction(upper(root))
            assert low**2 <= a <= high**2
        else:
            assert not is_finite(root)
    assert doubles.sqrt(Interval(2.0, 0.0)).rad < 3e-16


def test_bounds():
    """Upper, lower and absolute bounds, and what is certain of signs and order."""
    random = seeded(6)
    for _ in range(rounds(4000)):
        x, y = interval(random), interval(random)
        a, b = point(random, x), point(random, y)
        if bounded(x) and x.rad < 1e300:
            assert Fraction(lower(x)) <= a <= Fraction(upper(x))
            assert abs(a) <= Fraction(magnitude(x))
        assert not is_positive(x) or a > 0
        assert not is_negative(x) or a < 0
        assert not below(x, y) or a < b
        assert is_positive(x) == (Fraction(x.mid) > Fraction(x.rad))


def test_sets():
    """Hulls, intersections with a range, widening, and the interval between two doubles."""
    random = seeded(7)
    for _ in range(rounds(3000)):
        x, y = interval(random, 200), interval(random, 200)
        a, b = point(random, x), point(random, y)
        both = hull(x, y)
        assert holds(both, a)
        assert holds(both, b)
        low, high = sorted((double(random, 100), double(random, 100)))
        span = between(low, high)
        assert holds(span, Fraction(low))
        assert holds(span, Fraction(high))
        part = clipped(x, low, high)
        assert not low <= a <= high or holds(part, a)
        more = abs(double(random, 100))
        assert holds(widened(x, more), a + random.choice((-1, 1)) * Fraction(more))
    assert not is_finite(clipped(Interval(3.0, 0.5), 0.0, 1.0))
    assert not is_finite(between(1.0, 0.5))


def test_rationals():
    """A rational lies in its interval, which is a point if it is a double."""
    random = seeded(8)
    for _ in range(rounds(2000)):
        value = Fraction(random.randint(-(10**9), 10**9), random.randint(1, 10**12))
        assert holds(enclosing(value), value)
        assert enclosing(value).rad <= abs(value) * Fraction(2) ** -52
        assert enclosing(Fraction(float(value))).rad == 0


NOTHING = Interval(math.nan, 0.0), Interval(0.0, math.nan), Interval(math.inf, math.inf)


@pytest.mark.parametrize("x", NOTHING, ids=str)
def test_nothing_is_certain_of_what_is_not_bounded(x):
    """NaN and infinity spread, and no comparison holds."""
    one = Interval(1.0, 0.5)
    for operation in OPERATIONS.values():
        assert not is_finite(operation(x, one))
        assert not is_finite(operation(one, x))
    for result in (hull(x, one), square(x), doubles.sqrt(x), clipped(x, -1.0, 1.0)):
        assert not is_finite(result)
    assert not any((below(x, one), below(one, x), is_positive(x), is_negative(x)))


def test_overflow_and_division_by_zero_are_no_results():
    """A product beyond the range, and a quotient by what may be 0."""
    assert not is_finite(Interval(1e200, 0.0) * Interval(1e200, 0.0))
    assert not is_finite(Interval(1.7e308, 0.0) + Interval(1.7e308, 0.0))
    for y in (Interval(0.0, 0.0), Interval(1.0, 1.0), Interval(-1.0, 2.0)):
        assert not is_finite(Interval(1.0, 0.0) / y)
