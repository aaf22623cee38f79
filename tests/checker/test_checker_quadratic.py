"""Quadratic models in doubles: every operation contains what it encloses, in exact arithmetic."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from mpmath import mp, workdps

from cap.checker.kernel import quadratic as q
from cap.checker.kernel.rejection import Rejected

SIZES = (1.0, 1e-3, 1e-9, 30.0)


def model(rng, size=1.0, middle=1.0):
    """Return a random model."""
    return (rng.uniform(-middle, middle), *(rng.uniform(-size, size) for _ in range(5)), size / 50)


def at(p, x, y, r):
    """Return a value that a model allows at a point, exactly; r in [-1, 1] chooses it."""
    a, b, c, d, e, f, rest = map(Fraction, p)
    return a + b * x + c * y + d * x * x + e * x * y + f * y * y + rest * r


def point(rng):
    """Return a point of the box, often a corner, and a choice of the rest."""
    corner = [Fraction(rng.choice((-1, 1))) for _ in range(3)]
    return corner if rng.random() < 0.5 else [Fraction(rng.uniform(-1, 1)) for _ in range(3)]


def holds(p, value, x, y):
    """Check that a model allows a value at a point."""
    assert abs(at(p, x, y, 0) - value) <= Fraction(p[6])


@pytest.mark.parametrize("size", SIZES)
def test_sums_and_products(size):
    """Sums, products, multiples by uncertain numbers, halves of the box, bounds."""
    rng = random.Random(1)  # noqa: S311
    for _ in range(300):
        p, r = model(rng, size), model(rng, size)
        x, y, t = point(rng)
        u, w = at(p, x, y, t), at(r, x, y, -t)
        holds(q.total(p, r), u + w, x, y)
        holds(q.product(p, r), u * w, x, y)
        c, d = rng.uniform(-3, 3), rng.uniform(0, 0.1)
        holds(q.scaled(p, c, d), u * (Fraction(c) + Fraction(d) * t), x, y)
        holds(q.moved(p, c, d), u + Fraction(c) + Fraction(d) * t, x, y)
        low, high = q.ends(p)
        assert Fraction(low) <= u <= Fraction(high)
        assert abs(u) <= Fraction(q.bound(p))
        for along, side in ((0, -1), (0, 1), (1, -1), (1, 1)):
            inner = (2 * x - side, y) if along == 0 else (x, 2 * y - side)
            if abs(inner[along]) <= 1:
                holds(q.half(p, along, float(side)), at(p, x, y, t), *inner)


@pytest.mark.parametrize("size", [0.05, 1e-4])
def test_inverses(size):
    """1/p, and nothing where p may vanish."""
    rng = random.Random(2)  # noqa: S311
    for _ in range(300):
        p = (rng.choice((-1, 1)) * rng.uniform(0.7, 5), *model(rng, size)[1:])
        x, y, t = point(rng)
        holds(q.inverse(p), 1 / at(p, x, y, t), x, y)
    with pytest.raises(Rejected, match="may vanish"):
        q.inverse((0.1, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0))


@pytest.mark.parametrize("size", [0.3, 1e-3, 1e-12])
def test_cosine_and_sine(size):
    """Of models, against mpmath."""
    rng = random.Random(3)  # noqa: S311
    with workdps(40):
        for _ in range(200):
            p = model(rng, size, 40)
            x, y, t = point(rng)
            value = at(p, x, y, t)
            exact = mp.mpf(value.numerator) / value.denominator
            for found, f in zip(q.trigonometric(p), (mp.cos, mp.sin), strict=True):
                middle = at(found, x, y, 0)
                gap = abs(f(exact) - mp.mpf(middle.numerator) / middle.denominator)
                assert gap <= found[6]


def test_cosine_and_sine_of_doubles():
    """At random numbers, and next to the multiples of pi/2, where the reduction cancels most."""
    rng = random.Random(4)  # noqa: S311
    hard = [float(k * mp.pi / 2) for k in range(-40, 40)]
    with workdps(40):
        for a in [rng.uniform(-90, 90) for _ in range(3000)] + hard:
            cos, sin = q.cos_sin(a)
            assert abs(mp.cos(a) - cos) <= 2.0**-50
            assert abs(mp.sin(a) - sin) <= 2.0**-50
    with pytest.raises(Rejected, match="too large"):
        q.cos_sin(1e6)
