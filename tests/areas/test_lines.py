"""Models in one variable with their derivatives: each operation encloses, at exact points."""

import math
from fractions import Fraction

from support import rounds, seeded

from cap.areas.folded import lines as m

POINTS = [Fraction(x, 4) for x in (-4, -3, -1, 0, 2, 3, 4)]


class Function:
    """A function in a model: its polynomial and part cos(X + 1), of a norm of at most 5/4 part."""

    def __init__(self, p, part):
        self.p, self.part = p, part

    def value(self, x):
        """Return its value."""
        more = self.part * math.cos(x + 1)
        return sum(Fraction(c) * x**k for k, c in enumerate(self.p[:7])) + Fraction(more)

    def slope(self, x):
        """Return its derivative."""
        more = -self.part * math.sin(x + 1)
        return sum(k * Fraction(c) * x ** (k - 1) for k, c in enumerate(self.p[:7]) if k) + (
            Fraction(more)
        )


def drawn(random, middle, size, e):
    """Return a function around a number."""
    rest = [random.uniform(-1, 1) * size**k for k in range(1, 7)]
    return Function((middle, *rest, e), 0.8 * e * random.choice((-1, 1)))


def encloses(p, x, value, slope):
    """Return whether a model allows this value and this derivative at a point, but for 2^-45."""
    far = Function(p, 0.0)
    wrong = abs(far.value(x) - value) + abs(far.slope(x) - slope) / 4
    return wrong <= Fraction(p[7]) + Fraction(1, 2**45) * (1 + abs(slope))


def test_sums_and_products_enclose():
    """With operands that differ from their polynomials by nearly as much as they may."""
    random = seeded("lines")
    for _ in range(rounds(60)):
        e = 10 ** random.uniform(-12, -2)
        f = drawn(random, random.uniform(-2, 2), 0.7, e)
        g = drawn(random, random.uniform(-2, 2), 0.7, 0.1 * e)
        c = random.uniform(-2, 2)
        low, high = m.ends(f.p)
        for x in POINTS:
            a, b, da, db = f.value(x), g.value(x), f.slope(x), g.slope(x)
            assert encloses(m.product(f.p, g.p), x, a * b, a * db + b * da)
            assert encloses(m.total(f.p, g.p), x, a + b, da + db)
            other = Fraction(c) - Fraction(1, 100)
            assert encloses(m.scaled(f.p, c, 0.01), x, a * other, da * other)
            assert encloses(m.moved(f.p, c, 0.01), x, a + other, da)
            assert low <= a <= high
            assert abs(a) + abs(da) / 4 <= m.bound(f.p)
            assert abs(a - Fraction(f.p[0])) + abs(da) / 4 <= m.rest(f.p)


def test_products_are_sharp():
    """Of exact polynomials of a small degree, nothing is left but rounding."""
    p, q = (1.5, 0.25, -0.5, 0.125, 0.0, 0.0, 0.0, 0.0), (2.0, 1.0, 0.5, -1.0, 0.0, 0.0, 0.0, 0.0)
    found = m.product(p, q)
    assert found[:3] == (3.0, 2.0, 0.0)
    assert found[6] == -0.125
    assert found[7] < 1e-13
    high = (0.0,) * 6 + (1.0, 0.0)
    assert m.product(high, high)[:7] == (0.0,) * 7
    assert 1 + 12 / 4 <= m.product(high, high)[7] < 6.3  # X^12


def test_cosines_and_sines_enclose():
    """And what is left is small where the series converge."""
    random = seeded("lines, cosines")
    for _ in range(rounds(60)):
        size = random.choice((0.02, 0.2, 0.6))
        p = drawn(random, random.uniform(-30, 30), size, 0.0)
        cos, sin = m.trigonometric(p.p)
        for x in POINTS:
            a, rate = float(p.value(x)), float(p.slope(x))
            c, s = Fraction(math.cos(a)), Fraction(math.sin(a))
            assert encloses(cos, x, c, -Fraction(math.sin(a) * rate))
            assert encloses(sin, x, s, Fraction(math.cos(a) * rate))
        assert cos[7] < (1e-10 if size < 0.1 else 2.0)


def test_numbers_between_two():
    """X = -1 and X = 1 are the ends."""
    p = Function(m.across(0.1, 0.7), 0.0)
    assert encloses(p.p, Fraction(-1), Fraction(0.1), p.slope(0))
    assert encloses(p.p, Fraction(1), Fraction(0.7), p.slope(0))
    assert m.exact(m.constant(2.0, 1.0)) == (2.0, *(0.0,) * 7)
    assert m.centred(p.p, 5.0)[0] == 5.0
