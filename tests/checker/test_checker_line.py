"""Models in one variable contain the functions they stand for, and their derivatives."""

from __future__ import annotations

import math
import random

import pytest

from cap.checker.kernel import line

H = 1e-5  # of a difference


def some(rng, size=1.0):
    """Return a model, and a function in it, with its derivative."""
    c = tuple(size * rng.uniform(-1, 1) / (k + 1) ** 2 for k in range(line.DEGREE + 1))
    e = 10 ** rng.uniform(-12, -3)
    w = 2.0 * rng.uniform(0, 2)
    part = e / (1 + w / 4)  # part sin(w X + 1) has at most the norm e
    return (c, e), lambda x: sum(a * x**k for k, a in enumerate(c)) + part * math.sin(w * x + 1)


def check(p, f):
    """Check that a function is in a model: its values, and its derivative."""
    for x in (-1.0, -0.7, -0.1, 0.3, 0.8, 1.0):
        inner = max(-1 + H, min(1 - H, x))
        value = sum(a * x**k for k, a in enumerate(p[0]))
        assert abs(f(x) - value) <= p[1] + 1e-14 * line.size(p)
        slope = (f(inner + H) - f(inner - H)) / (2 * H)
        rest = slope - sum(k * a * inner ** (k - 1) for k, a in enumerate(p[0]) if k)
        assert abs(f(x) - value) + abs(rest) / 4 <= p[1] + 1e-8 * (1 + line.size(p))
        low, high = line.slopes(p)
        assert low - 1e-7 <= slope <= high + 1e-7
        low, high = line.ends(p)
        assert low <= f(x) <= high


def test_the_error_of_an_interval():
    """It is that of rounding numbers of the size of its ends, whatever their signs."""
    for ends in ((-3.0, 1.0), (1.0, 3.0), (-3.0, -1.0)):
        assert line.across(ends)[1] == sum(map(abs, ends)) * 2.0**-48


@pytest.mark.parametrize("seed", range(40))
def test_sums_products_cosines(seed):
    """Each operation on random functions."""
    rng = random.Random(seed)  # noqa: S311
    (p, f), (q, g) = some(rng), some(rng)
    a = rng.uniform(-2, 2)
    check(p, f)
    check(line.total(p, q), lambda x: f(x) + g(x))
    check(line.product(p, q), lambda x: f(x) * g(x))
    check(line.scaled(p, a, 1e-6), lambda x: (a + 0.9e-6) * f(x))
    check(line.moved(p, a, 1e-6), lambda x: a - 0.9e-6 + f(x))
    for side in (-1.0, 1.0):
        check(line.half(p, side), lambda x, side=side: f((x + side) / 2))
    c = p[0]
    angle = lambda x: sum(a * x**k for k, a in enumerate(c))  # noqa: E731
    cos, sin = line.trigonometric((c, 0.0))
    check(cos, lambda x: math.cos(angle(x)))
    check(sin, lambda x: math.sin(angle(x)))
    k = line.BEND * (line.size(cos) + line.size(sin))
    check(line.widened(cos, k * p[1]), lambda x: math.cos(f(x)))
    check(line.widened(sin, k * p[1]), lambda x: math.sin(f(x)))
    low, high = line.at_ends(p)
    assert abs(f(-1.0) - low) <= line.blur(p)
    assert abs(f(1.0) - high) <= line.blur(p)


def test_terms_of_high_degree_are_in_the_error():
    """X^n X^n is X^(2n), which a model cannot hold."""
    last = ((0.0,) * line.DEGREE + (1.0,), 0.0)
    c, e = line.product(last, last)
    assert not any(c)
    assert e == pytest.approx((1 + line.DEGREE / 4) ** 2)
    check((c, e), lambda x: x ** (2 * line.DEGREE))


def test_large_angles_and_coefficients():
    """Cosine and sine where the series leaves much: the error grows, and is no less than needed."""
    for size in (0.1, 0.5, 1.0, 2.0):
        c = (7.0, size, -size / 2, *(0.0,) * (line.DEGREE - 2))
        cos, sin = line.trigonometric((c, 0.0))
        check(cos, lambda x, s=size: math.cos(7 + s * x - s / 2 * x * x))
        check(sin, lambda x, s=size: math.sin(7 + s * x - s / 2 * x * x))


@pytest.mark.parametrize(("steep", "left"), [(None, 2.0**-8), (2.0**-9, 2.0**-9)])
def test_slopes(steep, left):
    """The derivative of 3 X + X^2/2 + r is in [2, 4] and r', |r'| <= 4 e or what is known."""
    low, high = line.slopes(((0.0, 3.0, 0.5, 0.0, 0.0, 0.0, 0.0), 2.0**-10), steep)
    assert 2 - left - 1e-9 < low <= 2 - left
    assert 4 + left <= high < 4 + left + 1e-9


def test_the_slope_of_nothing():
    """It is 0, within bounds that leave room for what is too small to be computed."""
    low, high = line.slopes(((0.0,) * 7, 0.0))
    assert low < 0 < high
