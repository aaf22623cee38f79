"""Taylor models contain the functions they stand for, at every point, and hardly more."""

from fractions import Fraction

import mpmath
import pytest
from mpmath import mp
from support import (
    decimal_fraction,
    holds,
    inside,
    number,
    random_box,
    rational,
    rounds,
    seeded,
    value_at,
    width,
)

from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.taylor_model import Domain, TaylorModel

BITS = 120
DIGITS = 60
ERROR = Fraction(1, 10**50)


def sin(t):
    """Return the sine of a Taylor model or of a number."""
    return t.sin_cos()[0] if isinstance(t, TaylorModel) else mp.sin(t)


def cos(t):
    """Return the cosine of a Taylor model or of a number."""
    return t.sin_cos()[1] if isinstance(t, TaylorModel) else mp.cos(t)


FUNCTIONS = {
    "sum": lambda x, y: x + y - 3,
    "difference": lambda x, y: 2 - (x - y) - y,
    "negative": lambda x, y: -x - (-y),
    "product": lambda x, y: x * y * x,
    "square": lambda x, y: (x - y) * (x - y),
    "thirds": lambda x, y: x / 3 + 5 * y / 7,
    "quotient": lambda x, y: x / (y + 4),
    "reciprocal": lambda x, y: 1 / (x - 5) + 2 / (y + 9),
    "sine": lambda x, y: sin(x + 2 * y),
    "cosine": lambda x, y: cos(x * y - 1),
    "composition": lambda x, y: sin(x * y + x) / (2 + cos(x - 3 * y)),
    "deep": lambda x, y: sin(cos(x) * y) * (x - y) / (3 + sin(x * x)),
    "nearly a pole": lambda x, y: 1 / (8 * x + 9 + y * y),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("order", [0, 1, 2, 3, 5])
def test_containment(name, order):
    """The polynomial at a point, plus the remainder, contains the function there."""
    function, random = FUNCTIONS[name], seeded(f"{name} {order}")
    with mpmath.workdps(DIGITS), interval.workprec(BITS):
        for _ in range(rounds(6)):
            boxes = [(decimal_fraction(random), decimal_fraction(random) ** 2 / 3) for _ in "xy"]
            centre_radius = Fraction(random.choice([0, 1]), 10**6)
            reach = [interval.ball(r) for _, r in boxes]
            centre = [interval.around(c, centre_radius) for c, _ in boxes]
            model = function(*Domain(reach, order).variables(centre))
            values = model.bound()
            for _ in range(4):
                offset = [inside(random, Fraction(0), r) for _, r in boxes]
                point = [
                    inside(random, c, centre_radius) + d
                    for (c, _), d in zip(boxes, offset, strict=True)
                ]
                truth = function(*map(number, point))
                for enclosure in (value_at(model, offset), values):
                    assert not enclosure.is_finite() or holds(enclosure, truth, ERROR)
            if name != "nearly a pole" and max(r for _, r in boxes) < Fraction(1, 30):
                assert values.is_finite()


@pytest.mark.parametrize("order", [0, 1, 2, 4, 6])
@pytest.mark.parametrize("name", ["product", "quotient", "sine", "cosine", "composition"])
def test_remainders_shrink_like_the_power_of_the_radius(name, order):
    """Halving the domain divides the remainder by about 2^(order + 1); points have hardly any."""
    with interval.workprec(BITS):
        centre = [interval.ball(Fraction(1, 3)), interval.ball(Fraction(-1, 4))]
        widths = []
        for k in (6, 7):
            radius = interval.ball(Fraction(1, 2**k))
            model = FUNCTIONS[name](*Domain((radius, radius), order).variables(centre))
            widths.append(width(model.remainder))
        if name == "product" and order >= 3:
            assert widths[0] < 1e-30
        else:
            assert 0.8 * 2 ** (order + 1) < widths[0] / widths[1] < 1.3 * 2 ** (order + 1)
        point = FUNCTIONS[name](*Domain((Ball(0), Ball(0)), order).variables(centre))
        assert width(point.remainder) < 1e-30


def test_polynomial_part_is_the_taylor_polynomial():
    """It equals the jet of the same function at the centre, within rounding."""
    with interval.workprec(BITS):
        centre = [interval.ball(Fraction(1, 3)), interval.ball(Fraction(-1, 4))]
        for order in (1, 3, 5):
            domain = Domain((interval.ball(Fraction(1, 10)),) * 2, order)
            x, y = domain.variables(centre)
            p, q = Jet.variables(centre, order)
            quotient, expected = (x / (y + 4)).polynomial, p / (q + 4)
            sines, expected_sines = (x * y + x).sin_cos(), (p * q + p).sin_cos()
            for model, jet in [
                (quotient, expected),
                *((a.polynomial, b) for a, b in zip(sines, expected_sines, strict=True)),
            ]:
                for a, b in zip(model.coefficients, jet.coefficients, strict=True):
                    assert holds(a - b, 0)
                    assert width(a + Ball(0)) < 1e-28


def test_bounds_are_tight():
    """x - x is zero, even monomials are not negative, a model beats the naive ball by far."""
    with interval.workprec(BITS):
        x, y = Domain((Ball(1), Ball(0.5)), 4).variables((Ball(0), Ball(0)))
        assert width((x - x).bound()) == 0
        for even in (x * x, x * x * y * y, y * y):
            assert not even.bound() < 0
            lower, _ = interval.ends(even.bound())
            assert lower > -1e-8
        lower, upper = interval.ends((x * y).bound())
        assert (float(lower), float(upper)) == pytest.approx((-0.5, 0.5))
        lower, _ = interval.ends((x * x * x).bound())
        assert float(lower) == pytest.approx(-1)
        z = x / 100 + 1
        assert width((z * (2 - z) - 1).bound()) < 1.01e-4
        assert width((z / (z + 1)).bound()) < 1.02 * 0.005


def test_monomial_ranges_contain_their_values():
    """For all exponents up to six, in three variables, whatever the signs."""
    random = seeded(7)
    reach = [Fraction(1, 3), Fraction(2), Fraction(1, 7)]
    domain = Domain([interval.ball(r) for r in reach], 6)
    for exponent, ball in zip(domain.space.exponents, domain.monomials, strict=True):
        for _ in range(rounds(5)):
            value = Fraction(1)
            for r, power in zip(reach, exponent, strict=True):
                value *= inside(random, Fraction(0), r) ** power
            assert holds(ball, value, 0)


def test_the_domain_contains_its_reach_whatever_its_sign():
    """The reach is a size: a ball, also an inexact or negative one, counts with its upper end."""
    random = seeded(8)
    for _ in range(rounds(50)):
        centre, radius = random_box(random)
        (x,) = Domain((interval.around(centre, radius),), 1).variables((Ball(0),))
        for sign in (1, -1):
            assert holds(x.bound(), sign * inside(random, centre, radius), 0)


def test_order_zero_keeps_the_deviation():
    """A model of order zero has no linear terms: the deviation is in its remainder."""
    with interval.workprec(BITS):
        x, y = Domain((Ball(0.25), Ball(0.5)), 0).variables((Ball(1), Ball(2)))
        for value in (Fraction(3, 4), Fraction(5, 4), Fraction(1)):
            assert holds(x.bound(), value, 0)
        product = (x * y).bound()
        for value in (Fraction(25, 8), Fraction(9, 8)):
            assert holds(product, value, 0)
        assert width(product) < 2.3


@pytest.mark.parametrize("order", [0, 1, 2, 5])
@pytest.mark.parametrize(
    "centre",
    [Fraction(0), Fraction(1, 10), Fraction(-1, 10), Fraction(-99, 1000), Fraction(99, 1000)],
)
def test_division_by_a_model_that_may_vanish_is_not_finite(order, centre):
    """The range touches or contains zero, its centre perhaps not: no finite bound comes out."""
    x, y = Domain((interval.ball(Fraction(1, 10)), Ball(1)), order).variables(
        (interval.ball(centre), Ball(1))
    )
    for model in (1 / x, y / x, x / x, 1 / (x * x), (y / x).sin_cos()[0] + 1 / x):
        assert not model.bound().is_finite()
        assert not model.bound() > 0
        assert not model.bound() < 0
    for divisor in (Ball(0), Ball(0, 1)):
        assert not (y / divisor).bound().is_finite()


def test_operations_contain_remainders_and_widened_balls():
    """Models with remainders from the start: every function they enclose stays enclosed."""
    random = seeded(9)
    with mpmath.workdps(DIGITS), interval.workprec(BITS):
        for _ in range(rounds(60)):
            order, reach = random.randint(0, 3), Fraction(1, random.choice([2, 10, 100]))
            domain = Domain((interval.ball(reach),), order)
            (x,) = domain.variables((interval.ball(1),))
            noise = [random_box(random, Fraction(1, 3)) for _ in "fg"]
            noise = [(c, min(r, Fraction(1, 5))) for c, r in noise]
            f, g = (x.widened(interval.around(*box)) for box in noise)
            g = g + 2
            d = inside(random, Fraction(0), reach)
            a, b = (1 + d + inside(random, *box) for box in noise)
            b += 2
            for model, truth in [
                (f + g, a + b),
                (f - g, a - b),
                (f * g, a * b),
                (f / g, a / b),
                (1 - f, 1 - a),
                (f.sin_cos()[0], rational(mp.sin(number(a)))),
                (f.sin_cos()[1], rational(mp.cos(number(a)))),
                (f * Ball(3) + Ball(1), 3 * a + 1),
                (f / interval.ball(Fraction(1, 3)), 3 * a),
                (f / 7, a / 7),
            ]:
                assert holds(value_at(model, [d]), truth, ERROR)
