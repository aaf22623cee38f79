"""The checker's functions on the circle: products are exact, operations contain."""

import cmath
import math
from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.fourier import Circle, Function, product, root
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.tori.invariant_curve import Shift

PLACES = 30
CIRCLE = Circle(12, Fraction(1, 5), PLACES)
UNIT = CIRCLE.unit


def drawn(rng, size=0.3, error=0):
    """Return a function whose coefficients fall."""
    parts = [
        tuple(int(UNIT * size * math.exp(-k) * rng.uniform(-1, 1)) for _ in range(2))
        for k in range(CIRCLE.degree + 1)
    ]
    parts[0] = parts[0][0], 0
    return Function(CIRCLE, parts, error)


def value(u, theta):
    """Return the value of the polynomial at a complex θ, in doubles."""
    total = complex(u.coefficients[0][0] / UNIT)
    for k, (re, im) in enumerate(u.coefficients[1:], 1):
        c = complex(re / UNIT, im / UNIT)
        total += c * cmath.exp(1j * k * theta) + c.conjugate() * cmath.exp(-1j * k * theta)
    return total


def points(rng):
    """Give points of the strip |Im θ| <= ρ, of its edges too."""
    for height in (0, 0.2, -0.2, rng.uniform(-0.2, 0.2)):
        yield complex(rng.uniform(0, 7), height)


def contains(u, theta, expected):
    """Return whether a value is within the error, up to the rounding of doubles."""
    return abs(value(u, theta) - expected) <= u.error / UNIT + 1e-12


def test_products_are_exact():
    """By the definition, for random integers of very different sizes."""
    rng = seeded("exact")
    for _ in range(rounds(20)):
        n = rng.randrange(1, 9)
        u, w = (
            [
                (rng.randrange(-(10 ** rng.randrange(1, 30)), 10**20), rng.randrange(-999, 999))
                for _ in range(n + 1)
            ]
            for _ in range(2)
        )
        u[0], w[0] = (u[0][0], 0), (w[0][0], 0)
        if rng.random() < 0.1:
            w = [(0, 0)] * (n + 1)
        for k, found in enumerate(product(u, w)):
            pairs = [(at(u, j), at(w, k - j)) for j in range(-n, n + 1)]
            re = sum(a * c - b * d for (a, b), (c, d) in pairs)
            im = sum(a * d + b * c for (a, b), (c, d) in pairs)
            assert found == (re, im)


def at(p, k):
    """Return the coefficient of any k."""
    re, im = p[abs(k)] if abs(k) < len(p) else (0, 0)
    return re, im if k >= 0 else -im


@pytest.mark.parametrize("error", [0, 10**20, 10**27, 10**29])
def test_operations_contain(error):
    """At random points of the strip, with and without an error."""
    rng = seeded(f"contain {error}")
    for _ in range(rounds(4)):
        u, w = drawn(rng, error=error), drawn(rng, error=error)
        shift = error / UNIT * rng.uniform(-1, 1)  # a function in the model: a constant more
        cos, sin = (u * 3 + 1).cos_sin()
        c = Interval.enclosing(Fraction(2, 7), Fraction(3, 7), 120)
        for theta in points(rng):
            a, b = value(u, theta) + shift, value(w, theta) - shift
            assert contains(u * w, theta, a * b)
            assert contains(u + w - 2, theta, a + b - 2)
            assert contains(cos, theta, cmath.cos(3 * a + 1))
            assert contains(sin, theta, cmath.sin(3 * a + 1))
            assert contains(u * c, theta, a * 0.4)
            assert contains(u.divided(7), theta, a / 7)


def test_products_of_what_is_known_and_what_is_not():
    """Each error counts, also where the other function has none."""
    rng = seeded("one error")
    u, w, far = drawn(rng), drawn(rng), 10**29
    for a, b in ((u.with_error(far), w), (u, w.with_error(far))):
        found, p, q = a * b, a.error / UNIT, b.error / UNIT
        for theta in points(rng):
            for sign in (1, -1):
                exact = (value(u, theta) + sign * p) * (value(w, theta) + sign * q)
                assert contains(found, theta, exact)


@pytest.mark.parametrize("error", [0, 10**26])
def test_shifts_contain(error):
    """u(theta + 2 pi alpha), alpha known up to a little; the error of u is one of the shift."""
    rng = seeded(f"shift {error}")
    u = drawn(rng, error=error)
    for wide in (Fraction(0), Fraction(1, 10**6)):
        alpha = Interval.enclosing(Fraction(2, 7) - wide, Fraction(2, 7) + wide, 120)
        moved = Shift(CIRCLE, alpha, pi(120))(u)
        assert moved.error >= error
        for theta in points(rng):
            for turns in (alpha.lower, alpha.upper):
                there = value(u, theta + 2 * math.pi * float(turns))
                assert contains(moved.with_error(moved.error - error), theta, there)


def test_they_are_tight():
    """Without an error of the input the output has few."""
    u = Function(CIRCLE, [(UNIT // 3, 0), (UNIT // 100, -UNIT // 70)], 0)
    for found in (u * u, *u.cos_sin(), u.divided(3)):
        assert found.error < 10 ** (PLACES - 20)


def test_inverse_and_root():
    """1/u, and t + t²/4 = u; refused where there is none."""
    rng = seeded("root")
    u = drawn(rng, 0.05, 10**20)
    one = CIRCLE.constant(1)
    guess = one
    for _ in range(6):
        guess = (guess * (one * 2 - (u + 1) * guess)).with_error(0)
    found = (u + 1).inverse_near(guess)
    t = u.with_error(0)
    for _ in range(40):
        t = (t - (t + (t * t).divided(4) - u)).with_error(0)
    solved = root(t, t + (t * t).divided(4) - u, lambda e: one + t.with_error(e).divided(2), one)
    assert solved.error < 10**25
    for theta in points(rng):
        a = value(u, theta)
        assert contains(found, theta, 1 / (1 + a))
        assert contains(solved, theta, 2 * (cmath.sqrt(1 + a) - 1))
    with pytest.raises(Rejected, match="may vanish"):
        u.inverse_near(one)
    with pytest.raises(Rejected, match="no contraction"):
        root(t, t - u, lambda _: CIRCLE.constant(0), one)
    with pytest.raises(Rejected, match="up to an error"):
        u.derivative()
    with pytest.raises(Rejected, match="too many"):
        Function(CIRCLE, [(0, 0)] * 99, 0)
