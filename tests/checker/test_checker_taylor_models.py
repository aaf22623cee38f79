"""Taylor models in one variable, and jets over them: the true functions are always enclosed."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf
from support import rounds, seeded

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.series import cos_sinc, reciprocal, square_root
from cap.checker.one_one.taylor_model import ORDER, TaylorModel

BITS = 100


def holds(model, g, points=21):
    """Return whether a function g of y in [-1, 1] is in the Taylor model, at many points."""
    with mp.workprec(3 * BITS):
        for k in range(points):
            y = mpf(2 * k) / (points - 1) - 1
            polynomial = mp.polyval([mpf(c) for c in reversed([*model.coefficients, 0])], y)
            if abs(mp.ldexp(g(y), BITS) - polynomial) > mpf(model.error) + mpf(10) ** -9:
                return False
        return True


def random_model(random, positive=False):
    """Return a Taylor model and a function in it."""
    c = [random.randint(-(2**BITS), 2**BITS) >> k for k in range(random.randint(1, ORDER + 1))]
    if positive:
        c[0] = sum(map(abs, c)) + 2 ** (BITS - 3)
    error = random.choice([0, 1, 2**20])
    shift = random.choice([-1, 0, 1]) * error

    def g(y):
        return mp.ldexp(mp.polyval([mpf(x) for x in reversed(c)], y) + shift, -BITS)

    return TaylorModel(c, error, BITS), g


def cases(random):
    """Return models by name, each with a function that it must contain."""
    (G, g), (H, h), (P, p) = (random_model(random, positive=k == 2) for k in range(3))
    n = random.choice([-3, -1, 2, 7])
    return {
        "sum": (G + H, lambda y: g(y) + h(y)),
        "difference": (G - H, lambda y: g(y) - h(y)),
        "product": (G * H, lambda y: g(y) * h(y)),
        "quotient": (G / P, lambda y: g(y) / p(y)),
        "root": (P.sqrt(), lambda y: mp.sqrt(p(y))),
        "multiple": (G * n, lambda y: g(y) * n),
        "part": (G / n, lambda y: g(y) / n),
        "shifted": (G + n, lambda y: g(y) + n),
    }


def test_arithmetic():
    """Sums, products, quotients and roots of functions lie in those of their models."""
    random = seeded(1)
    for _ in range(rounds(60)):
        for name, (model, function) in cases(random).items():
            assert holds(model, function), name


# with few bits, where a unit counts


def small_model(random):
    """Return a Taylor model of few bits, with those functions in it that lie at its borders."""
    bits = random.randint(1, 5)
    c = [random.randint(-9, 9) for _ in range(random.randint(0, ORDER + 1))]
    return c, random.choice([0, 0, 1, 3]), bits


def value(c, y):
    """Return the value of a polynomial."""
    return sum(c_k * y**k for k, c_k in enumerate(c))


POINTS = [Fraction(k, 3) for k in (-3, -1, 2, 3)]


def test_sums_products_and_parts_to_the_unit():
    """At the borders of models of a few units, exactly: no error is off by one."""
    random = seeded(4)
    for _ in range(rounds(80)):
        (p, a, bits), (q, b, _) = small_model(random), small_model(random)
        G, H, unit = TaylorModel(p, a, bits), TaylorModel(q, b, bits), Fraction(1, 2**bits)
        n = random.choice([-7, -2, -1, 1, 3, 11])
        for model, operation in (
            (G + H, lambda g, h: g + h),
            (G - H, lambda g, h: g - h),
            (-G, lambda g, _: -g),
            (G * H, lambda g, h: g * h),
            (G * n, lambda g, _, n=n: g * n),
            (G / n, lambda g, _, n=n: g / n),
            (G + n, lambda g, _, n=n: g + n),
        ):
            for y in POINTS:
                for s in (-a, a):
                    for t in (-b, b):
                        exact = operation((value(p, y) + s) * unit, (value(q, y) + t) * unit)
                        error = abs(exact - value(model.coefficients, y) * unit)
                        assert error <= model.error * unit


def test_quotients_and_roots_to_the_unit():
    """So it is for 1/g and sqrt g, g at the borders of a model of a few units."""
    random = seeded(5)
    for _ in range(rounds(300)):
        bits = random.randint(4, 9)
        c = [random.randint(-3, 3) for _ in range(random.randint(1, ORDER + 1))]
        c[0] = random.choice([-1, 1]) * (sum(map(abs, c)) + random.randint(4, 2 << bits))
        a, unit = random.choice([0, 1, 2]), Fraction(1, 2**bits)
        model = TaylorModel(c, a, bits)
        try:
            results = [model.inverse()] if c[0] < 0 else [model.inverse(), model.sqrt()]
        except Rejected:
            continue
        for y in POINTS:
            polynomials = [value(result.coefficients, y) * unit for result in results]
            for s in (-a, a):
                g = (value(c, y) + s) * unit
                assert abs(1 / g - polynomials[0]) <= results[0].error * unit
                if c[0] > 0:
                    low, high = (polynomials[1] + t * results[1].error * unit for t in (-1, 1))
                    assert max(low, 0) ** 2 <= g <= high**2


def test_constants_and_variables_to_the_unit():
    """An interval of an odd number of units, and a cell between units, are in their models."""
    for lo, hi in ((0, 1), (-1, 0), (3, 8), (-8, -3), (-2, 5), (4, 4)):
        c = TaylorModel.constant(Interval(lo, hi, 3))
        middle = value(c.coefficients, 0)
        assert middle - c.error <= lo <= hi <= middle + c.error <= hi + 1
    random = seeded(6)
    for _ in range(rounds(200)):
        low = Fraction(random.randint(-50, 50), random.randint(1, 40))
        high, bits = low + Fraction(random.randint(1, 9), random.randint(1, 40)), 4
        x = TaylorModel.variable(low, high, bits)
        for y in POINTS:
            exact = (low + high) / 2 + y * (high - low) / 2
            assert abs(exact * 2**bits - value(x.coefficients, y)) <= x.error <= 1


def test_the_range_to_the_unit():
    """All values of functions at the border lie in the range, bounds and sizes are above them."""
    random = seeded(7)
    for _ in range(rounds(300)):
        c, a, bits = small_model(random)
        model = TaylorModel(c, a, bits)
        values = [value(c, y) for y in POINTS]
        assert model.range().lo <= min(values) - a
        assert max(values) + a <= model.range().hi
        assert model.range().bits == bits
        assert max(map(abs, values)) <= model.size() == model.bound() - a
    few = TaylorModel([1, 2, -3], 1, 4).range()
    assert (few.lo, few.hi) == (1 - 2 - 3 - 1, 1 + 2 + 1)


def test_the_range():
    """All values on the cell lie in the range; odd and even powers are told apart."""
    random = seeded(2)
    for _ in range(rounds(100)):
        model, g = random_model(random)
        values = model.range()
        with mp.workprec(2 * BITS):
            for k in range(11):
                value = mp.ldexp(g(mpf(k) / 5 - 1), BITS)
                assert values.lo - 1 <= value <= values.hi + 1
    assert TaylorModel([0, 0, 5], 1, BITS).range().lo == -1
    assert TaylorModel([0, 4, -5], 0, BITS).range().hi == 4


def test_a_variable_and_constants():
    """x on a cell, and the numbers in an interval."""
    x = TaylorModel.variable(Fraction(1, 3), Fraction(2, 3), BITS)
    assert holds(x, lambda y: mpf(1) / 2 + y / 6)
    c = TaylorModel.constant(Interval.enclosing(Fraction(1, 3), Fraction(2, 3), BITS))
    assert holds(c, lambda _: mpf(1) / 3)
    assert holds(c, lambda _: mpf(2) / 3)


def test_functions_that_may_vanish():
    """Quotients and roots that may not exist are refused."""
    x = TaylorModel.variable(Fraction(-1, 10), Fraction(1), BITS)
    zero, wide = TaylorModel([], 0, BITS), TaylorModel([1 << BITS], 2 << BITS, BITS)
    for divisor in (x, zero, wide, TaylorModel([0, 1 << BITS], 0, BITS)):
        with pytest.raises(Rejected, match="may vanish"):
            x / divisor
    for radicand in (x, zero, wide, TaylorModel([-1 << BITS], 0, BITS)):
        with pytest.raises(Rejected, match="may be negative"):
            radicand.sqrt()
    with pytest.raises(Rejected, match="precision"):
        x * TaylorModel([1], 0, BITS + 1)
    with pytest.raises(Rejected, match="precision"):
        x + TaylorModel([1], 0, BITS + 1)


@pytest.mark.parametrize("order", [0, 1, 2, 3])
@pytest.mark.parametrize("ends", [("0", "1/20"), ("1/3", "7/20"), ("3/2", "151/100")])
def test_cosine_and_sinc_with_derivatives(order, ends):
    """Also at 0, over Taylor models and over intervals."""
    low, high = map(Fraction, ends)
    x = TaylorModel.variable(low, high, BITS)
    jet = Jet(order, {(0,): x, (1,): x.integer(1)})
    point = Interval.enclosing(low, low, BITS)
    thin = Jet(order, {(0,): point, (1,): point.integer(1)})
    for over_cell, at_point, g in zip(
        cos_sinc(jet, TaylorModel.constant),
        cos_sinc(thin, lambda t: t),
        (mp.cos, mp.sinc),
        strict=True,
    ):
        for k in range(order + 1):

            def derivative(y, k=k, g=g):
                middle, radius = (
                    mpf(q.numerator) / q.denominator for q in ((low + high) / 2, (high - low) / 2)
                )
                return mp.taylor(g, middle + radius * y, k)[k]

            assert holds_loosely(over_cell.coefficients[k,], derivative)
            value = at_point.coefficients[k,]
            assert value.width < 2**12
            assert (
                value.lower - Fraction(1, 2**40)
                <= exact(derivative(mpf(-1)))
                <= value.upper + Fraction(1, 2**40)
            )


def exact(value):
    """Return a number of mpmath as a fraction."""
    return Fraction(int(mp.nint(mp.ldexp(value, BITS))), 2**BITS)


def holds_loosely(model, g):
    """Return whether g is in the model up to the error of a numerical derivative."""
    return holds(TaylorModel(model.coefficients, model.error + 2 ** (BITS - 40), BITS), g, 5)


def test_reciprocal_and_root_of_jets():
    """1/j times j is 1, and the square of the root is j, up to the order."""
    random = seeded(3)
    for n in (1, 2):
        powers = (
            [(i,) for i in range(4)] if n == 1 else [(i, j) for i in range(4) for j in range(4 - i)]
        )
        for _ in range(rounds(10)):
            jet = Jet(3, {p: Interval.enclosing(random.randint(1, 9), 10, 200) / 7 for p in powers})
            jet = Jet(3, {p: c.midpoint() for p, c in jet.coefficients.items()})
            unit, root = reciprocal(jet) * jet, square_root(jet)
            for p in powers:
                assert unit.coefficients[p].lower <= (not any(p)) <= unit.coefficients[p].upper
                rest = (root * root - jet).coefficients[p]
                assert rest.contains_zero()
                assert rest.width < 2**20
