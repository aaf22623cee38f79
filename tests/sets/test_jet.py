"""Jets: exact over fractions, Taylor expansions of functions, containment over balls."""

from fractions import Fraction
from itertools import product

import mpmath
import pytest
from mpmath import mp, mpf
from support import decimal_fraction, holds, inside, random_box, rounds, seeded

from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet, Space

SHAPES = [(1, 0), (1, 1), (1, 6), (2, 0), (2, 1), (2, 2), (2, 3), (2, 5), (3, 1), (3, 3), (3, 6)]
BITS, TOLERANCE = 200, Fraction(1, 10**45)


def random_jet(random, space):
    """Return a jet of the space with random rational coefficients."""
    return Jet(space, [decimal_fraction(random, 3) for _ in space.exponents])


def polynomial(jet):
    """Return the coefficients of a jet by exponent."""
    return dict(zip(jet.space.exponents, jet.coefficients, strict=True))


def multiplied(p, q, order):
    """Multiply two polynomials, given as dictionaries, term by term."""
    result = {}
    for (a, c), (b, d) in product(p.items(), q.items()):
        exponent = tuple(i + j for i, j in zip(a, b, strict=True))
        if sum(exponent) <= order:
            result[exponent] = result.get(exponent, 0) + c * d
    return result


def value(p, point):
    """Return the polynomial at a point."""
    total = 0
    for exponent, coefficient in p.items():
        term = coefficient
        for x, power in zip(point, exponent, strict=True):
            term = term * x**power
        total += term
    return total


@pytest.mark.parametrize(("variables", "order"), SHAPES)
def test_space_lists_all_monomials_by_degree(variables, order):
    """Each exponent of degree at most the order once, by degree; spaces are shared."""
    space = Space(variables, order)
    everything = [e for e in product(range(order + 1), repeat=variables) if sum(e) <= order]
    assert sorted(space.exponents) == sorted(everything)
    assert [sum(e) for e in space.exponents] == sorted(map(sum, everything))
    assert space is Space(variables, order)
    assert [space.exponents[space.index[e]] for e in everything] == everything


@pytest.mark.parametrize(("variables", "order"), SHAPES)
def test_ring_operations_are_exact(variables, order):
    """Sums and products of jets over fractions are those of polynomials, truncated."""
    random, space = seeded(order), Space(variables, order)
    for _ in range(rounds(5)):
        f, g = random_jet(random, space), random_jet(random, space)
        p, q = polynomial(f), polynomial(g)
        assert polynomial(f * g) == multiplied(p, q, order)
        assert polynomial(f + g) == {e: p[e] + q[e] for e in p}
        assert polynomial(f - g) == {e: p[e] - q[e] for e in p}
        assert polynomial(-f) == {e: -p[e] for e in p}


@pytest.mark.parametrize(("variables", "order"), SHAPES)
def test_scalars_mix_with_jets(variables, order):
    """A scalar on either side of + - * / is the jet of a constant function."""
    random, space = seeded(order), Space(variables, order)
    f, c = random_jet(random, space), Fraction(-5, 7)
    f.coefficients[0] += 4
    constant = Jet.constant(c, space)
    for mixed, pure in [
        (f + c, f + constant),
        (c + f, constant + f),
        (f - c, f - constant),
        (c - f, constant - f),
        (f * c, f * constant),
        (c * f, constant * f),
        (f / c, f / constant),
        (c / f, constant / f),
    ]:
        assert mixed.coefficients == pure.coefficients


@pytest.mark.parametrize(("variables", "order"), SHAPES)
def test_quotients_are_exact(variables, order):
    """Over fractions the reciprocal times the jet is exactly one, to the order."""
    random, space = seeded(order), Space(variables, order)
    for _ in range(rounds(5)):
        f, g = random_jet(random, space), random_jet(random, space)
        g.coefficients[0] = Fraction(random.choice([-2, -1, 1, 3]), 2)
        assert (g.reciprocal() * g).coefficients == [1] + [0] * (space.size - 1)
        assert ((f / g) * g).coefficients == f.coefficients


def test_variables_divided_by_integers_stay_exact():
    """A coefficient one is a scalar: over integers 1/3 would be a float, and a wrong enclosure."""
    with interval.workprec(BITS):
        for order in (1, 2, 4):
            x, y = Jet.variables((interval.ball(Fraction(1, 7)), interval.ball(0)), order)
            assert holds((x / 3)[1, 0], Fraction(1, 3))
            assert holds((x / 3 + y / 7)[0, 1], Fraction(1, 7))
    (x,) = Jet.variables((Fraction(2),), 3)
    assert (x / 3).coefficients == [Fraction(2, 3), Fraction(1, 3), 0, 0]


@pytest.mark.parametrize("order", range(7))
@pytest.mark.parametrize("at", [Fraction(0), Fraction(3, 7), Fraction(-5, 2), Fraction(40)])
def test_one_variable_against_mpmath(order, at):
    """sin, cos and the reciprocal have the Taylor coefficients that mpmath finds."""
    with mpmath.workdps(60), interval.workprec(BITS):
        (x,) = Jet.variables((interval.ball(at),), order)
        sin, cos = x.sin_cos()
        inverse = (x + 50).reciprocal()
        z = mpf(at.numerator) / at.denominator
        cycle = [mp.sin(z), mp.cos(z), -mp.sin(z), -mp.cos(z)]
        for k in range(order + 1):
            assert holds(sin[(k,)] + Ball(0), cycle[k % 4] / mp.factorial(k))
            assert holds(cos[(k,)] + Ball(0), cycle[(k + 1) % 4] / mp.factorial(k))
            assert holds(inverse[(k,)] + Ball(0), (-1) ** k / (z + 50) ** (k + 1))


@pytest.mark.parametrize(("variables", "order"), SHAPES)
def test_functions_obey_their_equations(variables, order):
    """sin² + cos² = 1 and ∂ sin(g) = cos(g) ∂g, for jets over balls."""
    random, space = seeded(order), Space(variables, order)
    with interval.workprec(BITS):
        g = Jet(space, [interval.ball(c) for c in random_jet(random, space).coefficients])
        sin, cos = g.sin_cos()
        squares = (sin * sin + cos * cos).coefficients
        assert all(holds(a, b) for a, b in zip(squares, [1] + [0] * (space.size - 1), strict=True))
        for i in range(variables if order else 0):
            left = sin.derivative(i)
            right = cos.truncated(order - 1) * g.derivative(i)
            for a, b in zip(left.coefficients, right.coefficients, strict=True):
                assert holds(a - b, 0)
                assert a.rad() < 1e-40


@pytest.mark.parametrize("order", [0, 1, 3, 6])
def test_composition_in_two_variables_against_divided_differences(order):
    """sin(xy + x)/(2 + cos(x - 3y)) has the coefficients of a two-dimensional difference table."""

    def f(x, y, sin, cos):
        return sin(x * y + x) / (2 + cos(x - 3 * y))

    with mpmath.workdps(80), interval.workprec(BITS):
        x, y = Jet.variables((interval.ball(Fraction(1, 3)), interval.ball(Fraction(-2, 5))), order)
        jet = f(x, y, lambda t: t.sin_cos()[0], lambda t: t.sin_cos()[1])
        a, b = mpf(1) / 3, -mpf(2) / 5
        for i, j in jet.space.exponents:
            truth = mpmath.diff(lambda s, t: f(s, t, mp.sin, mp.cos), (a, b), (i, j))
            truth /= mp.factorial(i) * mp.factorial(j)
            assert holds(jet[i, j] + Ball(0), truth, Fraction(1, 10**20))
            assert (jet[i, j] + Ball(0)).rad() < 1e-50


@pytest.mark.parametrize(("variables", "order"), SHAPES)
def test_derivative_truncated_extended(variables, order):
    """They are those of polynomials."""
    random, space = seeded(order), Space(variables, order)
    f = random_jet(random, space)
    for low in range(order + 1):
        short = f.truncated(low)
        expected = {e: c for e, c in polynomial(f).items() if sum(e) <= low}
        assert polynomial(short) == expected
        padded = polynomial(short.extended(order))
        assert padded == {e: c if sum(e) <= low else 0 for e, c in polynomial(f).items()}
    assert f.above(0).coefficients == [0, *f.coefficients[1:]]
    for i in range(variables if order else 0):
        expected = {}
        for e, c in polynomial(f).items():
            if e[i]:
                lowered = tuple(n - (k == i) for k, n in enumerate(e))
                expected[lowered] = c * e[i]
        assert polynomial(f.derivative(i)) == expected


def test_containment_over_balls():
    """Coefficients over a box contain those at every point of it, at any precision."""
    random = seeded(4)
    for _ in range(rounds(40)):
        order, bits = random.randint(0, 4), random.choice([10, 53, 150])
        space = Space(2, order)
        boxes = [[random_box(random) for _ in space.exponents] for _ in (0, 1)]
        boxes[1][0] = (Fraction(random.choice([-3, 3])), Fraction(1))
        points = [[inside(random, *box) for box in row] for row in boxes]
        with interval.workprec(bits):
            f, g = (Jet(space, [interval.around(*box) for box in row]) for row in boxes)
            wide = [f + g, f - g, f * g, f / g]
        with interval.workprec(BITS + 100):
            exact = [Jet(space, row) for row in points]
            fine = [Jet(space, [interval.ball(c) for c in row]).sin_cos() for row in points]
        f0, g0 = exact
        for left, right in zip(wide, [f0 + g0, f0 - g0, f0 * g0, f0 / g0], strict=True):
            for a, b in zip(left.coefficients, right.coefficients, strict=True):
                assert not a.is_finite() or holds(a, b, 0)
        for jet, truth in zip((f, g), fine, strict=True):
            with interval.workprec(bits):
                sine_and_cosine = jet.sin_cos()
            with interval.workprec(BITS + 100):
                for a, b in zip(sine_and_cosine, truth, strict=True):
                    for p, q in zip(a.coefficients, b.coefficients, strict=True):
                        assert holds(p + Ball(0), interval.midpoint(q + Ball(0)))


def test_reciprocal_of_a_jet_that_may_vanish_is_not_finite():
    """Where the value may be zero no coefficient is finite and wrong."""
    x, y = Jet.variables((Ball(0, 1), Ball(3)), 3)
    for jet in (x.reciprocal(), y / x, 1 / (x * y)):
        for exponent in ((0, 0), (1, 0), (2, 0), (3, 0)):
            assert not (jet[exponent] + Ball(0)).is_finite()


def test_jets_of_different_shapes_do_not_mix():
    """Adding or multiplying jets of different sizes is an error, not a truncation."""
    (x,) = Jet.variables((Fraction(1),), 3)
    y, _ = Jet.variables((Fraction(1), Fraction(2)), 3)
    for operation in (lambda: x + y, lambda: x - y, lambda: x * y, lambda: x + x.truncated(2)):
        with pytest.raises(ValueError):  # noqa: PT011
            operation()


def test_polynomials_at_points():
    """A jet over fractions of a polynomial of low degree is that polynomial."""
    random = seeded(5)
    for _ in range(rounds(20)):
        centre = [decimal_fraction(random, 2) for _ in range(2)]
        x, y = Jet.variables(centre, 4)
        jet = polynomial((x * x - 3 * y) * (y + 2) * x / 5)
        dx, dy = (decimal_fraction(random, 2) for _ in range(2))
        a, b = centre[0] + dx, centre[1] + dy
        assert value(jet, (dx, dy)) == (a * a - 3 * b) * (b + 2) * a / 5
