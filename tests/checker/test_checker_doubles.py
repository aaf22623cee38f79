"""Intervals of doubles of the checker: they contain what exact arithmetic gives."""

from fractions import Fraction

import mpmath
import pytest
from support import rounds, seeded

from cap.checker.kernel.doubles import Double, between, cos_sin, enclosing
from cap.checker.kernel.rejection import Rejected


def random_double(random):
    """Return an interval of any size, and an exact point of it."""
    x = Double(random.uniform(-1, 1) * 10 ** random.uniform(-9, 3), 10 ** random.uniform(-18, 0))
    part = Fraction(random.choice([-1, 0, 1, random.uniform(-1, 1)]))
    return x, Fraction(x.mid) + part * Fraction(x.rad)


def contains(x, value):
    """Return whether a rational lies in an interval."""
    return abs(value - Fraction(x.mid)) <= Fraction(x.rad)


def test_arithmetic():
    """Sums, differences, products and quotients."""
    random = seeded(1)
    for _ in range(rounds(3000)):
        (x, a), (y, b) = random_double(random), random_double(random)
        assert contains(x + y, a + b)
        assert contains(x - y, a - b)
        assert contains(x * y, a * b)
        assert contains(x + y.mid, a + Fraction(y.mid))
        assert contains(x - y.mid, a - Fraction(y.mid))
        assert contains(x * y.mid, a * Fraction(y.mid))
        assert contains(-x, -a)
        if abs(y.mid) > y.rad * 1.001:
            assert contains(x / y, a / b)
        assert Fraction(x.lower) <= a <= Fraction(x.upper)
        assert abs(a) <= Fraction(x.magnitude)


def test_roots_and_cosines():
    """Compared with 50 digits."""
    random = seeded(2)
    with mpmath.workdps(50):
        for _ in range(rounds(1000)):
            x, a = random_double(random)
            point = mpmath.mpf(a.numerator) / a.denominator
            if x.mid > x.rad:
                root = x.sqrt()
                assert abs(mpmath.sqrt(point) - root.mid) <= root.rad
            y = Double(x.mid % 40, x.rad)
            t = mpmath.mpf(y.mid) + (point - x.mid)
            cos, sin = cos_sin(y)
            assert abs(mpmath.cos(t) - cos.mid) <= cos.rad
            assert abs(mpmath.sin(t) - sin.mid) <= sin.rad


def test_thin_ones_stay_thin():
    """The error of a cosine is some units of the last place."""
    cos, sin = cos_sin(Double(19.7))
    assert max(cos.rad, sin.rad) < 1e-14
    assert enclosing(Fraction(1, 3)).rad < 1e-16
    assert contains(enclosing(Fraction(1, 3)), Fraction(1, 3))
    assert contains(between(0.1, 0.7), Fraction(0.1))


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: Double(1.0) / Double(0.5, 0.5),
        lambda: Double(1e-3, 2e-3).sqrt(),
        lambda: cos_sin(Double(1e6)),
        lambda: Double(1.0) / Double(float("nan")),
    ],
)
def test_what_is_undefined_is_rejected(wrong):
    """Division by zero, roots of negative numbers, and angles that are too large."""
    with pytest.raises(Rejected):
        wrong()
