"""Models of degree 4: each operation encloses, and is sharp where they are small."""

import math
from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.areas.folded import polynomials as m

MONOMIALS = [(i, degree - i) for degree in range(5) for i in range(degree + 1)]
POINTS = [(Fraction(x, 4), Fraction(y, 4)) for x in (-4, -1, 3, 4) for y in (-4, 1, 2, 4)]


def drawn(random, middle, size=0.3, error=0.0):
    """Return a model around a number, coefficients of higher degree being smaller."""
    rest = [random.uniform(-1, 1) * size ** (i + j) / 2 for i, j in MONOMIALS[1:]]
    return (middle, *rest, error)


def value(p, point):
    """Return the value of the polynomial of a model at a point."""
    x, y = point
    return sum(Fraction(c) * x**i * y**j for c, (i, j) in zip(p[: m.LAST], MONOMIALS, strict=True))


def encloses(p, point, exact):
    """Return whether a model of a quantity allows this value."""
    return abs(value(p, point) - exact) <= Fraction(p[m.LAST])


def test_sums_and_products_enclose():
    """Exactly, at every point, with operands that take any value within their errors."""
    random = seeded("polynomials")
    for _ in range(rounds(40)):
        p, q = drawn(random, random.uniform(-2, 2), 0.8, 0.01), drawn(random, 1.5, 0.8, 0.002)
        c = random.uniform(-2, 2)
        for point in POINTS:
            a = value(p, point) + Fraction(p[m.LAST]) * random.choice((-1, 1))
            b = value(q, point) + Fraction(q[m.LAST]) * random.choice((-1, 1))
            assert encloses(m.product(p, q), point, a * b)
            assert encloses(m.total(p, q), point, a + b)
            assert encloses(m.scaled(p, c, 0.01), point, a * (Fraction(c) - Fraction(1, 100)))
            assert encloses(m.moved(p, c, 0.01), point, a + Fraction(c) + Fraction(1, 100))
            low, high = m.ends(p)
            assert low <= a <= high
            assert abs(a) <= m.bound(p)


def test_inverse_and_trigonometric_functions_enclose():
    """With room for the rounding of the test itself."""
    random = seeded("polynomials, functions")
    for _ in range(rounds(40)):
        p = drawn(random, random.choice((-1, 1)) * random.uniform(1, 40), 0.3)
        r, (cos, sin) = m.inverse(p), m.trigonometric(p)
        for point in POINTS:
            a = float(value(p, point))
            assert abs(float(value(r, point)) - 1 / a) <= r[m.LAST] + 1e-15
            assert abs(float(value(cos, point)) - math.cos(a)) <= cos[m.LAST] + 1e-14
            assert abs(float(value(sin, point)) - math.sin(a)) <= sin[m.LAST] + 1e-14


def test_errors_are_of_the_fifth_order():
    """Halving the size divides them by 32, nearly."""
    errors = []
    for size in (0.1, 0.05):
        p = drawn(seeded("polynomials, order"), 2.0, size)
        errors.append([f[m.LAST] for f in (m.inverse(p), *m.trigonometric(p), m.product(p, p))])
    assert all(b < a / 25 for a, b in zip(*errors, strict=True))


def test_a_model_that_may_vanish_has_no_inverse():
    """NaN says nothing."""
    zero, one = m.constant(0.0, 0.0), m.constant(1.0, 0.7)
    assert all(math.isnan(m.inverse(p)[m.LAST]) for p in (one, m.widened(one, math.inf)))
    with pytest.raises(ZeroDivisionError):
        m.inverse(zero)


def test_integral():
    """It is below the exact integral by the error, and a little."""
    p = drawn(seeded("polynomials, integral"), 0.7, 0.9, 0.001)
    exact = 4 * sum(
        Fraction(c, (i + 1) * (j + 1))
        for c, (i, j) in zip(map(Fraction, p[: m.LAST]), MONOMIALS, strict=True)
        if i % 2 == j % 2 == 0
    )
    assert 0.004 <= float(exact - Fraction(m.integral(p))) < 0.004 + 1e-13
