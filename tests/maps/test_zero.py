"""Krawczyk's operator in n dimensions: known zeros, no zeros, and the operator of the plane."""

from fractions import Fraction

import pytest
from support import decimal_fraction, holds, rounds, seeded

from cap.errors import NotProved
from cap.maps import krawczyk
from cap.maps.zero import Hint, Problem, refined
from cap.sets import interval
from cap.sets.interval import Ball

SIZE = 5
IDENTITY = tuple(tuple(Fraction(i == j) for j in range(SIZE)) for i in range(SIZE))


def quadratic(zeros):
    """Return z_i² + z_(i+1)/8 - c_i, which vanishes at the ``zeros``, and c is exact."""
    following = [*zeros[1:], zeros[0]]
    c = [interval.ball(a * a + b / 8) for a, b in zip(zeros, following, strict=True)]

    def value(z):
        return [a * a + b / 8 - q for a, b, q in zip(z, [*z[1:], z[0]], c, strict=True)]

    def slope(z):
        n = len(z)
        return [
            [2 * z[i] if i == j else Ball(1) / 8 if j == (i + 1) % n else Ball(0) for j in range(n)]
            for i in range(n)
        ]

    return Problem(value, slope)


def inverses(zeros):
    """Return the inverse of the diagonal of the derivative."""
    return tuple(
        tuple(Fraction(i == j) / (2 * z) for j in range(SIZE)) for i, z in enumerate(zeros)
    )


def test_zeros_are_isolated():
    """K contains the zero; Newton's iteration finds it to all digits asked for."""
    random = seeded(1)
    for _ in range(rounds(20)):
        zeros = [random.choice([-1, 1]) * (1 + decimal_fraction(random) / 4) for _ in range(SIZE)]
        with interval.workprec(100):
            problem, c = quadratic(zeros), inverses(zeros)
            near = [z + decimal_fraction(random) / 50 for z in zeros]
            k = problem.isolate(Hint(tuple(near), c), [Fraction(1, 10)] * SIZE)
            assert all(holds(inner, z, 0) for inner, z in zip(k, zeros, strict=True))
            hint = refined(problem, near, c, [20] * SIZE)
            assert max(abs(m - z) for m, z in zip(hint.centre, zeros, strict=True)) < 1e-18
            tight = problem.tightened(hint, problem.isolate(hint, [Fraction(1, 10**15)] * SIZE))
            assert all(holds(inner, z, 0) for inner, z in zip(tight, zeros, strict=True))
            assert max(float(inner.rad()) for inner in tight) < 1e-24


def test_two_zeros_or_none_are_refused():
    """A box with a zero and its reflection; a box beside the zero; a useless preconditioner."""
    zeros = [Fraction(1)] * SIZE
    problem, c = quadratic(zeros), inverses(zeros)
    for centre, reach, rows in (
        ([Fraction(1)] * SIZE, Fraction(3), c),
        ([Fraction(3, 2)] * SIZE, Fraction(1, 10), c),
        ([Fraction(1)] * SIZE, Fraction(1, 10), tuple((Fraction(0),) * SIZE for _ in range(SIZE))),
        ([Fraction(1)] * SIZE, Fraction(1, 10), IDENTITY),
    ):
        with pytest.raises(NotProved, match="not inside the box"):
            problem.isolate(Hint(tuple(centre), rows), [reach] * SIZE)


def test_newton_is_given_up():
    """Far from a zero, with a bad matrix, nothing is returned."""
    with pytest.raises(NotProved):
        refined(quadratic([Fraction(1)] * SIZE), [Fraction(3)] * SIZE, IDENTITY, [10] * SIZE)


def roots(middle, width, inverse):
    """Return z_i² - q = 0 for all q around a middle, with its hint."""
    q = interval.around(middle, width)
    problem = Problem(
        lambda z: [a * a - interval.ball(middle) for a in z],
        lambda z: [[2 * a if i == j else Ball(0) for j in range(SIZE)] for i, a in enumerate(z)],
        q - interval.ball(middle),
        lambda z: [Ball(-1) for _ in z],
    )
    rows = tuple(tuple(inverse * (i == j) for j in range(SIZE)) for i in range(SIZE))
    return problem, Hint((Fraction(2),) * SIZE, rows)


def test_a_parameter():
    """K contains the zeros for all q, and dz/dq = 1/(2 sqrt q) is enclosed."""
    problem, hint = roots(Fraction(4), Fraction(1, 100), Fraction(1, 4))
    k = problem.isolate(hint, [Fraction(1, 100)] * SIZE)
    moving = problem.velocity(hint, k)
    for q in (3.99, 4.0, 4.01):
        for side, rate in zip(k, moving, strict=True):
            assert side.overlaps(Ball(q).sqrt())
            assert rate.contains(0.5 / q**0.5)
            assert float(rate.rad()) < 0.01


def test_zeros_that_may_not_move_smoothly():
    """A useless preconditioner, and zeros that may be double, give no derivative."""
    problem, hint = roots(Fraction(4), Fraction(1, 100), Fraction(3))
    with pytest.raises(NotProved, match="may not move"):
        problem.velocity(hint, hint.point)
    with pytest.raises(NotProved, match="may not move"):
        problem.velocity(roots(Fraction(4), Fraction(1), Fraction(1, 4))[1], (Ball(0, 9),) * SIZE)


def test_indeterminate_values_are_refused():
    """NaN in a value or in a derivative proves nothing."""
    zeros = [Fraction(1)] * SIZE
    good, hint = quadratic(zeros), Hint(tuple(zeros), inverses(zeros))
    bad = [Ball("nan"), *[Ball(0)] * (SIZE - 1)]
    for problem in (
        Problem(lambda _z: bad, good.slope),
        Problem(good.value, lambda z: [*good.slope(z)[1:], bad]),
    ):
        with pytest.raises(NotProved):
            problem.isolate(hint, [Fraction(1, 10)] * SIZE)


def test_in_the_plane_it_is_the_other_operator():
    """The same K as `cap.maps.krawczyk` gives for the fixed points of G + 1."""
    random = seeded(2)
    for _ in range(rounds(50)):
        rows, slope = (
            tuple(tuple(decimal_fraction(random, 3) for _ in "ab") for _ in "cd") for _ in "rs"
        )
        m, value = (tuple(decimal_fraction(random, 3) for _ in "xv") for _ in range(2))
        problem = Problem(
            lambda _z, value=value: list(map(interval.ball, value)),
            lambda _z, slope=slope: [list(map(interval.ball, row)) for row in slope],
        )
        hint = Hint(m, rows)
        box = hint.box([Fraction(1, 7)] * 2)
        image = tuple(interval.ball(a + b) for a, b in zip(m, value, strict=True))
        (a, b), (c, d) = (tuple(map(interval.ball, row)) for row in slope)
        other = krawczyk.operator(
            krawczyk.Preconditioner(m, rows), image, ((a + 1, b), (c, d + 1)), box
        )
        for one, two in zip(problem.operator(hint, box), other, strict=True):
            assert one.overlaps(two)
            assert abs(float(one.rad() / two.rad()) - 1) < 1e-8


def test_a_matrix_of_doubles_is_exact_at_any_precision():
    """Also where the precision is below that of doubles."""
    with interval.workprec(20):
        rows = Hint((), ((0.1, 1 / 3), (-1e300, 5e-324))).rows
        assert [interval.rational(x) for x in rows.entries()] == [
            Fraction(x) for x in (0.1, 1 / 3, -1e300, 5e-324)
        ]
