"""Fourier models contain the functions that they stand for, and are not much wider."""

import math
from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle, perturbed, root
from cap.sets.interval import Ball, ComplexBall

RHO = Fraction(1, 4)
PREC = 120


@pytest.fixture
def circle():
    """Functions with sixteen modes."""
    with interval.workprec(PREC):
        yield Circle(16, RHO)


def ball(rng, size=1.0):
    """Return a random complex ball that is a point."""
    return ComplexBall(rng.uniform(-size, size), rng.uniform(-size, size))


def drawn(rng, circle, size, error):
    """Return a model, and a function in it: values by any complex ball θ."""
    n = circle.degree
    decay = [size * math.exp(-0.9 * abs(k)) for k in circle.modes(n)]
    coefficients = [ball(rng, d) for d in decay]
    model = circle.model(coefficients, Ball(error))
    # what is left of the polynomial: another mode, beyond the degree too, of norm at most the error
    k, part = rng.randrange(-2 * n, 2 * n + 1), rng.random()
    other = Ball(error) * part * (-interval.ball(RHO) * abs(k)).exp()

    def value(theta):
        modes = zip(circle.modes(n), coefficients, strict=True)
        terms = [c * (theta * ComplexBall(0, j)).exp() for j, c in modes]
        return sum(terms, other * (theta * ComplexBall(0, k)).exp())

    return model, value


def contains(model, theta, value):
    """Return whether a value at θ, |Im θ| <= ρ, is as near to the polynomial as the error says."""
    modes = zip(Circle.modes(model.circle.degree), model.coefficients, strict=True)
    at = sum((c * (theta * ComplexBall(0, k)).exp() for k, c in modes), ComplexBall(0))
    return not abs(at - value) > model.error


def points(rng, count=5):
    """Give random points of the strip, its edges among them."""
    for n in range(count):
        height = float(RHO) * (1 if n == 0 else -1 if n == 1 else rng.uniform(-1, 1))
        yield ComplexBall(rng.uniform(0, 7), height)


OPERATIONS = {
    "sum": lambda u, w: u + w,
    "difference": lambda u, w: 3 - (u - w),
    "product": lambda u, w: u * w,
    "square of a product": lambda u, w: (u * w) * (u * w),
    "sine": lambda u, w: w * sine(u),
    "cosine": lambda u, w: w * cosine(5 * u + 2),
}


def sine(u):
    """Return the sine of a number or of a model."""
    return u.sin() if isinstance(u, ComplexBall) else u.sin_cos()[0]


def cosine(u):
    """Return the cosine of a number or of a model."""
    return u.cos() if isinstance(u, ComplexBall) else u.sin_cos()[1]


@pytest.mark.parametrize("name", OPERATIONS)
@pytest.mark.parametrize("error", [0, 1e-20, 1e-3, 0.3])
def test_operations_contain(name, error, circle):
    """At random complex points of the strip."""
    rng = seeded(f"{name} {error}")
    operation = OPERATIONS[name]
    for _ in range(rounds(3)):
        (u, a), (w, b) = drawn(rng, circle, 0.4, error), drawn(rng, circle, 0.4, error)
        result = operation(u, w)
        for theta in points(rng):
            assert contains(result, theta, operation(a(theta), b(theta)))


def test_they_are_tight(circle):
    """Without an error of the input there is hardly one in the output, where modes suffice."""
    u = circle.real([ComplexBall(1), ComplexBall(0.01, 0.02)])
    for result in (u * u, *u.sin_cos(), *(2 + u).sin_cos()):
        assert result.error < Ball("1e-28")
    assert (u * u.reciprocal() - 1).norm < Ball("1e-25")


def test_reciprocal(circle):
    """1/u of u > 0, near a guess; no reciprocal of what vanishes."""
    rng = seeded("reciprocal")
    u, a = drawn(rng, circle, 0.05, 1e-6)
    one = circle.constant(1)
    found = 1 / (1 + u)
    assert found.error < Ball("1e-4")
    for theta in points(rng):
        assert contains(found, theta, 1 / (1 + a(theta)))
    with pytest.raises(NotProved, match="may vanish"):
        circle.real([ComplexBall(0.1), ComplexBall(1)]).reciprocal_near(one)


def test_root(circle):
    """t + sin(t)/3 = u is solved; a slope that may vanish is not."""
    rng = seeded("root")
    u, a = drawn(rng, circle, 0.05, 1e-6)
    one = circle.constant(1)

    def slope(t):
        return lambda error: 1 + perturbed(t.sin_cos(), error)[1] / 3

    t = u.centre() * Ball("0.75")
    for _ in range(8):
        t = (t - (t + t.sin_cos()[0] / 3 - u.centre()) * Ball("0.75")).centre()
    found = root(t, t + t.sin_cos()[0] / 3 - u, slope(t), Ball("0.75") * one)
    assert found.error < Ball("1e-5")
    for theta in points(rng):
        value = a(theta)
        s = value * 3 / 4
        for _ in range(40):  # Newton's method, of a point
            s = s - (s + s.sin() / 3 - value) / (1 + s.cos() / 3)
        assert contains(found, theta, s)
    with pytest.raises(NotProved, match="no contraction"):
        root(t, t - u, lambda _: circle.constant(0), one)


def test_what_is_refused(circle):
    """Other circles, derivatives of what is known up to an error."""
    u = circle.constant(1)
    with pytest.raises(ValueError, match="norms"):
        _ = u + Circle(16, RHO).constant(1)
    with pytest.raises(ValueError, match="derivative"):
        u.widened(Ball(1)).derivative()
