"""Truncated Taylor series: against known series, and over boxes against the truth at points."""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import accumulate
from math import comb, factorial
from operator import mul

import pytest
from mpmath import mp

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, cos_sin_jet, lift, tightened
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.substitution import substituted

BITS = 128


def thin(q):
    """Return the enclosure of a rational."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def variables(order, x, v):
    """Return the jets of x and v at a point."""
    one = thin(1)
    return Jet(order, {(0, 0): x, (1, 0): one}), Jet(order, {(0, 0): v, (0, 1): one})


def some_polynomial(rng, order):
    """Return random rational coefficients up to the order."""
    return {
        (i, n - i): Fraction(rng.randint(-99, 99), 7)
        for n in range(order + 1)
        for i in range(n + 1)
    }


def product(p, q, order):
    """Return the truncated product of two polynomials, exactly."""
    result = {}
    for (i, j), c in p.items():
        for (k, m), d in q.items():
            if i + j + k + m <= order:
                result[i + k, j + m] = result.get((i + k, j + m), 0) + c * d
    return result


def encloses(jet, exact, slack=1000):
    """Check that a jet contains exact coefficients, each within the slack in ulps."""
    assert {p for p, c in exact.items() if c} <= set(jet.coefficients)
    for power, c in jet.coefficients.items():
        assert c.lower <= exact.get(power, 0) <= c.upper
        assert c.width <= slack


@pytest.mark.parametrize("order", [0, 1, 2, 5])
def test_sums_and_products_contain_the_exact_ones(order):
    """Random polynomials with rational coefficients, at orders 0 to 5."""
    rng = random.Random(order)  # noqa: S311
    p, q = some_polynomial(rng, order), some_polynomial(rng, order)
    P, Q = (Jet(order, {k: thin(c) for k, c in w.items()}) for w in (p, q))
    encloses(P + Q, {k: p[k] + q[k] for k in p})
    encloses(P - Q, {k: p[k] - q[k] for k in p})
    encloses(-P, {k: -p[k] for k in p})
    encloses(P * Q, product(p, q, order))
    encloses(P * thin(Fraction(1, 3)), {k: c / 3 for k, c in p.items()})
    encloses(P * 3, {k: c * 3 for k, c in p.items()})


def test_the_lower_order_wins():
    """Sum and product have the lower order of the operands, and no terms beyond."""
    x, v = variables(3, thin(0), thin(0))
    assert (x * v.truncated(1)).coefficients.keys() == {(0, 0), (1, 0), (0, 1)}
    assert (x + v.truncated(1)).order == 1
    assert Jet(1, {(1, 1): thin(1), (1, 0): thin(2)}).coefficients.keys() == {(1, 0)}


def test_substitution_is_composition():
    """P(X, V) of random polynomials is the composition computed in fractions."""
    rng = random.Random(7)  # noqa: S311
    order = 4
    p, x, v = (some_polynomial(rng, order) for _ in range(3))
    p[0, 0] = x[0, 0] = v[0, 0] = Fraction(0)
    expected = {}
    for (i, j), c in p.items():
        term = {(0, 0): c}
        for factor in [x] * i + [v] * j:
            term = product(term, factor, order)
        for power, d in term.items():
            expected[power] = expected.get(power, 0) + d
    P, X, V = (Jet(order, {k: thin(c) for k, c in w.items() if c}) for w in (p, x, v))
    encloses(substituted(P, (X, V)), expected, slack=10**12)


def test_powers():
    """(2 + x)^n has the binomial coefficients."""
    x, _ = variables(6, thin(2), thin(0))
    for n, jet in enumerate(accumulate([x] * 6, mul), start=1):
        encloses(jet, {(k, 0): Fraction(comb(n, k) * 2 ** (n - k)) for k in range(n + 1)})


def test_cosine_and_sine_of_a_linear_jet():
    """The coefficients are the derivatives of cos and sin at the point, in closed form."""
    x, v = variables(5, thin(Fraction(1, 3)), thin(Fraction(2, 5)))
    angle = x + v * 3
    cos, sin = cos_sin_jet(angle)
    with mp.workprec(300):
        a = mp.mpf(1) / 3 + mp.mpf(6) / 5
        for i in range(6):
            for j in range(6 - i):
                for jet, f in ((cos, mp.cos), (sin, mp.sin)):
                    exact = f(a + (i + j) * mp.pi / 2) * 3**j / (factorial(i) * factorial(j))
                    c = jet.coefficients[i, j]
                    assert c.lo <= exact * mp.mpf(2) ** BITS <= c.hi
                    assert c.width < 1000


def test_cosine_of_a_nonlinear_jet_satisfies_pythagoras():
    """cos^2 + sin^2 = 1 in all coefficients, for a polynomial argument."""
    x, v = variables(6, thin(Fraction(1, 3)), thin(Fraction(-2, 5)))
    cos, sin = cos_sin_jet(x * v * v + x * x)
    one = cos * cos + sin * sin
    encloses(one, {(0, 0): Fraction(1)}, slack=10**6)


def box_pair(order, x, v, r):
    """The variables over the square of radius r around (x, v)."""
    r, result = Fraction(r), []
    offset = Interval.enclosing(-r, r, BITS)
    for q, d in ((Fraction(x), (1, 0)), (Fraction(v), (0, 1))):
        centre = Jet(order, {(0, 0): thin(q), d: thin(1)})
        box = Jet(order, {(0, 0): Interval.enclosing(q - r, q + r, BITS), d: thin(1)})
        result.append(Centred(centre, box, (offset, offset)))
    return result


def formula(x, v):
    """A cubic polynomial, for numbers and jets alike."""
    return x * x * v - x * v * v * 3 + x * v


def coefficients(x, v):
    """Return the Taylor coefficients of ``formula`` at a point, up to order 2, by hand."""
    return {
        (0, 0): x * x * v - 3 * x * v * v + x * v,
        (1, 0): 2 * x * v - 3 * v * v + v,
        (0, 1): x * x - 6 * x * v + x,
        (1, 1): 2 * x - 6 * v + 1,
    }


@pytest.mark.parametrize("radius", ["0", "1/1000", "1/10", "2"])
def test_the_mean_value_form_contains_every_point_and_is_tighter(radius):
    """The coefficients at 50 points of the box lie in it; it is never wider than the plain form."""
    rng = random.Random(3)  # noqa: S311
    x, v = box_pair(2, "1/2", "1/3", radius)
    result = lift(formula, x, v)
    plain = formula(x.box, v.box)
    for _ in range(50):
        dx, dv = (Fraction(rng.randint(-100, 100), 100) * Fraction(radius) for _ in range(2))
        for power, exact in coefficients(Fraction(1, 2) + dx, Fraction(1, 3) + dv).items():
            c = result[power]
            assert c.lower <= exact <= c.upper
    for power in plain.coefficients:
        assert result[power].width <= plain.coefficients[power].width
    if radius == "1/1000":
        assert result[0, 0].width < plain.coefficients[0, 0].width / 2


def test_the_factor_of_the_mean_value_form():
    """The slope of c_20 of x^3 is 3 c_30: with the factor 1 or 2 the box would lose its end."""
    x, _ = box_pair(3, "0", "0", "1/10")
    cube = lift(lambda x: x * x * x, x)
    assert cube[2, 0].upper >= Fraction(3, 10)
    assert cube[2, 0].lower <= -Fraction(3, 10)
    _, v = box_pair(3, "0", "0", "1/10")
    assert lift(lambda x: x * x * x, v)[0, 2].upper >= Fraction(3, 10)


def test_the_offsets_of_both_variables_count():
    """The width is the sum over both variables of slope times width of the offset."""
    r = Fraction(1, 10)
    wide, none = Interval.enclosing(-r, r, BITS), thin(0)
    for offsets, width in (((wide, none), 2 * r), ((none, wide), 4 * r), ((wide, wide), 6 * r)):
        centre = Jet(1, {(0, 0): thin(0)})
        box = Jet(1, {(0, 0): Interval.enclosing(-9, 9, BITS), (1, 0): thin(1), (0, 1): thin(2)})
        c = tightened(box, centre, offsets).coefficients[0, 0]
        assert abs(c.upper - c.lower - width) < Fraction(1, 1 << 100)


def test_coefficients_that_are_not_there():
    """Up to the order they are 0; beyond it nothing is known."""
    constant = Jet(2, {(0, 0): thin(5)})
    x, _ = box_pair(2, "1/2", "1/3", "1/1000")
    five = Centred(constant, constant, x.offsets)
    assert (five[1, 0].lo, five[1, 0].hi, five[0, 1].lo, five[0, 1].hi) == (0, 0, 0, 0)
    with pytest.raises(Rejected, match="beyond the order"):
        five[2, 1]


def test_a_wrong_centre_rejects():
    """A centre that the box cannot contain makes the two forms disjoint."""
    x, _ = box_pair(2, "1/2", "1/3", "1/1000")
    with pytest.raises(Rejected, match="disjoint"):
        Centred(Jet(2, {(0, 0): thin(5)}), x.box, x.offsets)
