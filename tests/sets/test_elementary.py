"""Square root, arcsine and sin x/x, over balls, jets and Taylor models, against mpmath."""

from fractions import Fraction
from math import comb, factorial

import mpmath
import pytest
from mpmath import mp, workdps
from support import (
    between,
    decimal_fraction,
    holds,
    inside,
    number,
    rational,
    rounds,
    seeded,
    value_at,
    width,
)

from cap.sets import interval
from cap.sets.elementary import asin, sinc, sqrt
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.taylor_model import Domain

BITS = 200
ORDER = 6
FUNCTIONS = {
    "sqrt": (sqrt, mpmath.sqrt, (Fraction(1, 50), Fraction(40))),
    "asin": (asin, mpmath.asin, (Fraction(-49, 50), Fraction(49, 50))),
    "sinc": (sinc, mpmath.sinc, (Fraction(-2), Fraction(2))),
}
every = pytest.mark.parametrize("name", FUNCTIONS)


def within(random, pair):
    """Return a random rational of an interval; its ends are among them."""
    low, high = pair
    return (low + high) / 2 + (high - low) / 2 * decimal_fraction(random)


def coefficients(name, c, order):
    """Return g⁽ᵏ⁾(c)/k! in mpmath, right to 50 digits."""
    with workdps(120):
        return mp.taylor(FUNCTIONS[name][1], number(c), order)


@every
@pytest.mark.parametrize("bits", [53, BITS, 700])
def test_values(name, bits):
    """Of points, to the working precision."""
    ours, theirs, where = FUNCTIONS[name]
    random = seeded(name)
    with interval.workprec(bits), workdps(230):
        for _ in range(rounds(60)):
            x = within(random, where)
            ball = ours(interval.ball(x))
            assert holds(ball, theirs(number(x)), Fraction(1, 10**215))
            assert width(ball) < 2.0 ** (12 - bits)


@every
def test_values_over_balls(name):
    """The value at each point of a ball lies in the ball; a thin ball gives a thin one."""
    ours, theirs, where = FUNCTIONS[name]
    random = seeded(name)
    with interval.workprec(BITS), workdps(60):
        for _ in range(rounds(60)):
            a, b = sorted(within(random, where) for _ in range(2))
            b = a + (b - a) / random.choice([1, 10, 10**9])
            ball = ours(between(a, b))
            for x in (a, b, within(random, (a, b))):
                assert holds(ball, theirs(number(x)))
            assert width(ball) < 20 * float(b - a) + 1e-50


@every
def test_jets(name):
    """The coefficients of g(c + h) in one variable are the Taylor coefficients of g."""
    ours, _, where = FUNCTIONS[name]
    random = seeded(name)
    with interval.workprec(400):
        for _ in range(rounds(6)):
            c = within(random, where)
            (variable,) = Jet.variables((interval.ball(c),), ORDER)
            for ball, value in zip(
                ours(variable).coefficients, coefficients(name, c, ORDER), strict=True
            ):
                assert holds(ball, value)
                assert width(ball) < 1e-80


@every
def test_jets_over_balls(name):
    """Over a ball the coefficients enclose those at each of its points."""
    ours, _, where = FUNCTIONS[name]
    random = seeded(name)
    with interval.workprec(BITS):
        for _ in range(rounds(4)):
            a = within(random, where)
            b = min(a + Fraction(1, 200), where[1])
            (variable,) = Jet.variables((between(a, b),), 4)
            jet = ours(variable)
            for c in (a, b, within(random, (a, b))):
                for ball, value in zip(jet.coefficients, coefficients(name, c, 4), strict=True):
                    assert holds(ball, value)


IDENTITIES = {
    "sqrt": lambda z: sqrt(z) * sqrt(z) - z,
    "asin": lambda z: asin(z).sin_cos()[0] - z,
    "sinc": lambda z: sinc(z) * z - z.sin_cos()[0],
}


@every
def test_jets_of_several_variables(name):
    """sqrt² = id, sin∘asin = id, x sinc = sin, in all coefficients."""
    _, _, where = FUNCTIONS[name]
    random = seeded(name)
    with interval.workprec(BITS):
        for _ in range(rounds(5)):
            h, k = Jet.variables((Ball(0), Ball(0)), 5)
            z = h + k * k / 3 - h * k / 7 + interval.ball(within(random, where))
            for ball in IDENTITIES[name](z).coefficients:
                assert Ball(ball).contains(0)
                assert Ball(ball).rad() < 1e-30


@every
def test_taylor_models(name):
    """At each point of the domain the model contains the value, and it is sharp."""
    ours, theirs, where = FUNCTIONS[name]
    random, low, high = seeded(name), *where
    with interval.workprec(BITS), workdps(60):
        for _ in range(rounds(8)):
            reach = Fraction(1, random.choice([100, 1000, 10**6]))
            c = max(low + 2 * reach, min(high - 2 * reach, within(random, where)))
            (variable,) = Domain([interval.ball(reach)], 8).variables((interval.ball(c),))
            model = ours(variable + variable * variable / 100 - interval.ball(c * c / 100))
            assert model.remainder.is_finite()
            assert model.remainder.rad() < 1e-6
            for _ in range(5):
                h = inside(random, 0, reach)
                x = c + h + ((c + h) ** 2 - c**2) / 100
                assert holds(value_at(model, [h]), theirs(number(x)))


@every
def test_jets_over_taylor_models(name):
    """The coefficient k of the jet is a model of g⁽ᵏ⁾/k! on the domain."""
    ours, _, where = FUNCTIONS[name]
    random, low, high = seeded(name), *where
    reach = Fraction(1, 200)
    with interval.workprec(BITS):
        for _ in range(rounds(3)):
            c = max(low + 2 * reach, min(high - 2 * reach, within(random, where)))
            (variable,) = Domain([interval.ball(reach)], 10).variables((interval.ball(c),))
            (jet,) = Jet.variables((variable,), 3)
            h = inside(random, 0, reach)
            for model, value in zip(
                ours(jet).coefficients, coefficients(name, c + h, 3), strict=True
            ):
                assert holds(value_at(model, [h]), value)
                assert model.remainder.rad() < 1e-4


def test_sinc_at_and_near_zero():
    """At 0 it is 1, exactly; its coefficients are 1/(n + 1)! with signs; near 0 nothing is lost."""
    with interval.workprec(BITS):
        assert sinc(Ball(0)).contains(1)
        assert width(sinc(Ball(0))) < 1e-60
        (variable,) = Jet.variables((Ball(0),), 8)
        for n, ball in enumerate(sinc(variable).coefficients):
            value = Fraction((-1) ** (n // 2), factorial(n + 1)) if n % 2 == 0 else 0
            assert holds(ball, value, 0)
            assert width(ball) < 1e-55
        for x in (Fraction(1, 10**40), -Fraction(1, 10**12), Fraction(1, 10**200)):
            with workdps(80):
                assert holds(sinc(interval.ball(x)), mp.sin(number(x)) / number(x))
            assert width(sinc(interval.ball(x))) < 1e-55
        around = sinc(between(Fraction(-1, 100), Fraction(1, 50)))
        assert holds(around, 1, 0)
        assert width(around) < 1e-3
        (model,) = Domain([Ball(1) / 1000], 6).variables((Ball(0),))
        assert holds(value_at(sinc(model), [Fraction(0)]), 1, 0)
        assert sinc(model).remainder.rad() < 1e-20


def test_sinc_of_large_arguments():
    """Where its series would not do it is indeterminate, and right where it does."""
    with interval.workprec(BITS), workdps(60):
        for x in (Fraction(5), Fraction(-12), Fraction(25)):
            assert holds(sinc(interval.ball(x)), mp.sinc(number(x)))
        for ball in (Ball(1000), Ball("nan"), Ball("inf"), Ball(0, 1e9)):
            assert not sinc(ball).is_finite()


@pytest.mark.parametrize(
    ("function", "ball"),
    [
        (sqrt, Ball(-1)),
        (sqrt, Ball(0.5, 1)),
        (sqrt, Ball("nan")),
        (asin, Ball(2)),
        (asin, Ball(0.9, 0.2)),
        (asin, Ball("nan")),
    ],
)
def test_outside_of_the_domain(function, ball):
    """Nothing finite, of balls, jets and Taylor models."""
    assert not function(ball).is_finite()
    (variable,) = Jet.variables((ball,), 2)
    assert not any(Ball(c).is_finite() for c in function(variable).coefficients)
    (model,) = Domain([Ball(1) / 1000], 3).variables((ball,))
    assert not function(model).bound().is_finite()
    (jet,) = Jet.variables((model,), 1)
    assert not any(c.bound().is_finite() for c in function(jet).coefficients)


@pytest.mark.parametrize("function", [sqrt, asin])
def test_models_that_leave_the_domain(function):
    """The centre is inside, but not all of the domain."""
    (model,) = Domain([Ball(1) / 10], 3).variables((Ball(1) / 20,))
    leaving = model if function is sqrt else model + Ball(0.95)
    assert not function(leaving).bound().is_finite()


def test_the_bound_on_the_rest_of_the_series():
    """binom(k + m, k)/(k + m + 1)! <= 1/(k! m!), of which the rest is the exponential series."""
    for k in range(12):
        for m in range(60):
            left = Fraction(comb(k + m, k), factorial(k + m + 1))
            assert left <= Fraction(1, factorial(k) * factorial(m))
    with workdps(50):
        for terms in (20, 33, 70):
            x = mp.mpf(terms) / 2
            rest = mp.exp(x) - mp.fsum(x**m / factorial(m) for m in range(terms))
            assert rational(rest) <= rational(2 * x**terms / factorial(terms))
