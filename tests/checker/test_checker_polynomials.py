"""Models in two variables of the checker: they enclose exactly, at the corners, of any size."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import product

import pytest
from support import rounds, seeded

from cap.checker.kernel import polynomials as q
from cap.checker.kernel.rejection import Rejected

CORNERS = [(Fraction(x), Fraction(y)) for x, y in product((-1, 1), (-1, 0, 1))]


def drawn(random, size):
    """Return a model with coefficients of all sizes up to one, some of them 0."""
    p = [random.choice((-1, 0, 1)) * size * 2.0 ** -random.randrange(60) for _ in q.MONOMIALS]
    return (*p, random.choice((0.0, size * 2.0 ** -random.randrange(70))))


def small(random, middle):
    """Return a model close to a number."""
    rest = [random.uniform(-1, 1) / 32 for _ in q.MONOMIALS[1:]]
    return (middle, *(abs(middle or 1) * c for c in rest), abs(middle) * 2.0**-30)


def value(p, point):
    """Return the value of the polynomial of a model."""
    x, y = point
    return sum(Fraction(c) * x**i * y**j for c, (i, j) in zip(p, q.MONOMIALS, strict=False))


def taken(random, p, point):
    """Return a value that the model allows at a point."""
    return value(p, point) + Fraction(p[q.LAST]) * random.choice((-1, 1))


def encloses(p, point, exact):
    """Return whether a model allows a value at a point."""
    return abs(value(p, point) - exact) <= Fraction(p[q.LAST])


def waves(x):
    """Return the cosine and the sine of a number below 2 in size, to 2^-100."""
    terms = [x**n / math.factorial(n) for n in range(40)]
    return tuple(sum(t * (-1) ** k for k, t in enumerate(terms[n::2])) for n in (0, 1))


def test_sums_and_products():
    """With operands of very different sizes."""
    random = seeded("checker polynomials")
    for _ in range(rounds(60)):
        n, m = random.choice((-300, -40, 0, 20, 100)), random.choice((-300, -10, 0, 5, 40))
        p, r, c = drawn(random, 2.0**n), drawn(random, 2.0**m), random.uniform(-3, 3) * 2.0**m
        for point in CORNERS:
            a, b = taken(random, p, point), taken(random, r, point)
            assert encloses(q.product(p, r), point, a * b)
            assert encloses(q.total(p, r), point, a + b)
            assert encloses(q.scaled(p, c, abs(c) / 8), point, a * Fraction(c) * Fraction(9, 8))
            assert encloses(q.moved(p, c, abs(c)), point, a + 2 * Fraction(c))
            low, high = q.ends(p)
            assert low <= a <= high


def test_products_of_monomials():
    """Up to degree 4 they are monomials; above, errors."""
    for (n, (i, j)), (m, (k, l)) in product(enumerate(q.MONOMIALS), repeat=2):
        one, other = (tuple(float(x == at) for x in range(q.LAST + 1)) for at in (n, m))
        found = q.product(one, other)
        high = (i + k, j + l) not in q.MONOMIALS
        assert (0 < found[q.LAST] < 1e-12) if not high else (1 <= found[q.LAST] < 1.001)
        at = None if high else q.MONOMIALS.index((i + k, j + l))
        assert found[: q.LAST] == tuple(float(x == at) for x in range(q.LAST))


def test_where_all_that_is_left_out_has_one_sign():
    """All of the model's size, at a corner."""
    for size in (0.1, 0.3, 0.5):
        for sign in (-1, 1):
            p = (1.0, sign * size, *[0.0] * (q.LAST - 1))
            exact = Fraction(sign * size)
            corner = (Fraction(0), Fraction(1))
            assert encloses(q.inverse(p), corner, 1 / (1 + exact))
            for model, wave in zip(q.trigonometric((0.0, *p[1:])), waves(exact), strict=True):
                assert encloses(model, corner, wave)


def test_inverse_cosine_and_sine():
    """Where what is left out counts."""
    random = seeded("checker polynomials, inverse")
    for _ in range(rounds(15)):
        p = small(random, random.choice((-1, 1)) * 2.0 ** random.randrange(-20, 20))
        r = small(random, random.choice((0.0, 1.0, -0.7)))
        for point in CORNERS:
            assert encloses(q.inverse(p), point, 1 / taken(random, p, point))
            exact = waves(taken(random, r, point))
            assert all(map(encloses, q.trigonometric(r), (point, point), exact))


def test_nothing_is_shown_of_what_is_too_large():
    """Bounds become infinite: no comparison with them is true, and there is no inverse."""
    cos, sin = q.trigonometric((0.5, 1e80, *[0.0] * q.LAST)[: q.LAST + 1])
    for p in (cos, sin):
        low, high = q.ends(p)
        assert not low > -math.inf
        assert not high < math.inf
        with pytest.raises(Rejected):
            q.inverse(p)


@pytest.mark.parametrize("v", [-0.5, 0.0, 0.5])
def test_an_integral_below_a_value(v):
    """Of the density 3 + Y, at least 2, at most 4, over X < v, a part (1 + v)/2 of the square."""
    constant = q.integral_below(q.model(one=3.0), q.model(X=1.0), v)
    assert 6 * (1 + v) - 1e-9 < constant <= 6 * (1 + v)
    most = max(4 * (1 + v), 12 - 8 * (1 - v))
    assert most - 1e-9 < q.integral_below(q.model(one=3.0, Y=1.0), q.model(X=1.0), v) <= most
