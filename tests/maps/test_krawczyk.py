"""Krawczyk's operator: it finds known fixed points, and proves nothing where there is none."""

from dataclasses import replace
from fractions import Fraction

import pytest
from support import decimal_fraction, holds, rounds, seeded, width

from cap.errors import NotProved
from cap.flow.event import TAYLOR_MODELS
from cap.maps.krawczyk import Preconditioner, contract, operator
from cap.sets import interval, matrix
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

Half = Fraction(1, 2)


def balls(m):
    """Return a rational matrix over balls."""
    return tuple(tuple(interval.ball(entry) for entry in row) for row in m)


def inverse(m):
    """Return the inverse of a rational matrix, exactly."""
    (a, b), (c, d) = m
    det = a * d - b * c
    return (d / det, -b / det), (-c / det, a / det)


class Affine:
    """The map z -> m (z - fixed) + fixed."""

    def __init__(self, m, fixed):
        self.m, self.fixed = m, fixed

    def __call__(self, z):
        """Return the image of a point."""
        d = [a - b for a, b in zip(z, self.fixed, strict=True)]
        return tuple(
            row[0] * d[0] + row[1] * d[1] + f for row, f in zip(self.m, self.fixed, strict=True)
        )

    def slope(self, _box):
        """Return the derivative on a box."""
        return balls(self.m)

    def exact_slope(self, _z):
        """Return the derivative at a point."""
        return self.m


class Quadratic:
    """(x, v) -> (x + x² - a, v + v² - b + x - sqrt a): fixed points x = ±sqrt a, v near ±sqrt b."""

    def __init__(self, x, v):
        self.x, self.v = x, v

    def __call__(self, z):
        """Return the image of a point."""
        x, v = z
        return x + x * x - self.x**2, v + v * v - self.v**2 + x - self.x

    def slope(self, box):
        """Return the derivative on a box."""
        one, zero = interval.ball(1), interval.ball(0)
        return (1 + 2 * box[0], zero), (one, 1 + 2 * box[1])

    def exact_slope(self, z):
        """Return the derivative at a point."""
        return (1 + 2 * z[0], Fraction(0)), (Fraction(1), 1 + 2 * z[1])


def attempt(phi, centre, box, c=None):
    """Contract with the exact inverse of Φ'(m) - 1, or with ``c``."""
    (p, q), (r, s) = phi.exact_slope(centre)
    hint = Preconditioner(centre, c or inverse(((p - 1, q), (r, s - 1))))
    image = tuple(interval.ball(value) for value in phi(centre))
    return contract(hint, image, phi.slope(box), box)


def square(centre, radius):
    """Return the square of this radius around a point, over balls."""
    return tuple(interval.around(c, Fraction(radius)) for c in centre)


def random_affine(random):
    """Return a random affine map whose fixed point is well determined."""
    m = tuple(tuple(3 * decimal_fraction(random) for _ in range(2)) for _ in range(2))
    (a, b), (c, d) = m
    if abs((a - 1) * (d - 1) - b * c) < Fraction(1, 100):
        return random_affine(random)
    return Affine(m, (decimal_fraction(random, 5), decimal_fraction(random, 5)))


def test_affine_maps():
    """K contains the fixed point, is tiny (the map is affine), and lies in the box."""
    random = seeded(1)
    for _ in range(rounds(200)):
        phi = random_affine(random)
        centre = tuple(f + decimal_fraction(random) / 2 for f in phi.fixed)
        k = attempt(phi, centre, square(centre, Fraction(11, 10)))
        for inner, fixed in zip(k, phi.fixed, strict=True):
            assert holds(inner, fixed, 0)
            assert width(inner) < 1e-9


def test_quadratic_maps():
    """K contains the one fixed point of the box, also with a rough preconditioner."""
    random = seeded(2)
    for _ in range(rounds(200)):
        fixed = tuple(random.choice([-1, 1]) * (2 + decimal_fraction(random)) for _ in "xv")
        phi = Quadratic(*fixed)
        shift = Fraction(1, 100)
        centre = tuple(f + decimal_fraction(random) * shift for f in fixed)
        exact = inverse(((2 * centre[0], Fraction(0)), (Fraction(1), 2 * centre[1])))
        rough = tuple(tuple(Fraction(round(float(e), 2)) for e in row) for row in exact)
        for c in (exact, rough):
            k = attempt(phi, centre, square(centre, 3 * shift), c)
            assert all(holds(inner, f, 0) for inner, f in zip(k, fixed, strict=True))


def refused(phi, centre, box, reason, c=None):
    """Check that nothing is proved, for this reason, and that the sets are named."""
    with pytest.raises(NotProved) as caught:
        attempt(phi, centre, box, c)
    assert caught.value.step == "Krawczyk"
    assert reason in caught.value.reason
    assert caught.value.sets


def test_a_box_without_fixed_point_is_refused():
    """Just beyond the fixed point, in each direction and each coordinate, and far away."""
    random = seeded(3)
    for _ in range(rounds(100)):
        phi = random_affine(random)
        for i in (0, 1):
            for sign in (1, -1):
                for gap in (Fraction(1, 10**6), Fraction(1), Fraction(100)):
                    centre = list(phi.fixed)
                    centre[i] += sign * (1 + gap)
                    refused(phi, tuple(centre), square(centre, 1), f"in {'xv'[i]}")


def test_a_fixed_point_on_the_boundary_is_refused():
    """Inclusion must be in the interior: on a side or a corner nothing is proved."""
    m = ((Half, Fraction(0)), (Fraction(0), Fraction(3)))
    phi = Affine(m, (Fraction(1), Fraction(-2)))
    unit = (Ball((0, 0), (1, 0)), Ball((-2, 0), (1, 0)))
    for touching, centre in [
        (unit, (Fraction(0), Fraction(-2))),
        ((Ball((2, 0), (1, 0)), unit[1]), (Fraction(2), Fraction(-2))),
        ((Ball((1, 0), (1, 0)), Ball((-1, 0), (1, 0))), (Fraction(1), Fraction(-1))),
        ((Ball((1, 0), (1, 0)), Ball((-3, 0), (1, 0))), (Fraction(1), Fraction(-3))),
    ]:
        refused(phi, centre, touching, "not inside the box")
    attempt(phi, (Fraction(1), Fraction(-2)), (Ball((1, 0), (1, 0)), Ball((-2, 0), (1, 0))))


def test_two_fixed_points_are_refused():
    """A box with both, or with the double root of a degenerate map."""
    phi = Quadratic(Fraction(1, 10), Fraction(2))
    for radius in (Fraction(11, 100), Fraction(2, 10), Fraction(1)):
        for centre in ((Fraction(1, 100), Fraction(2)), (Fraction(1, 10), Fraction(2))):
            box = interval.around(centre[0], radius + Fraction(1, 10)), interval.around(2, Half / 9)
            refused(phi, centre, box, "not inside the box")
    double = Quadratic(Fraction(0), Fraction(2))
    for centre in ((Fraction(1, 1000), Fraction(2)), (Fraction(-1, 10**9), Fraction(2))):
        for radius in (Fraction(1, 100), Fraction(1, 10**6)):
            refused(double, centre, square(centre, radius), "not inside the box")


def test_the_centre_must_lie_in_the_box():
    """The mean value form needs it; K alone would be inside."""
    phi = Affine(((Half, Fraction(0)), (Fraction(0), Half)), (Fraction(0), Fraction(0)))
    for i in (0, 1):
        centre = [Fraction(0), Fraction(0)]
        centre[i] = Fraction(2)
        refused(phi, tuple(centre), square((0, 0), 1), f"the centre leaves the box in {'xv'[i]}")
    attempt(phi, (Fraction(9, 10), Fraction(-9, 10)), square((0, 0), 1))


def test_a_singular_slope_is_refused():
    """The identity (all points fixed), a shear, a translation; with any C, also zero."""
    one, zero = Fraction(1), Fraction(0)
    origin = (zero, zero)
    for m in (((one, zero), (zero, one)), ((one, one), (zero, one)), ((one, zero), (one, one))):
        for c in (
            ((one, zero), (zero, one)),
            ((zero, zero), (zero, zero)),
            ((one * 10**9, one), (-one, one)),
        ):
            refused(Affine(m, origin), origin, square((0, 0), 1), "not inside the box", c)


def test_indeterminate_input_is_refused():
    """NaN in the image, the slope or the box proves nothing."""
    good = Affine(((Half, Fraction(0)), (Fraction(0), Half)), (Fraction(0), Fraction(0)))
    hint = Preconditioner((Fraction(0),) * 2, ((Fraction(-2), Fraction(0)),) * 2)
    hint = replace(hint, matrix=((Fraction(-2), Fraction(0)), (Fraction(0), Fraction(-2))))
    box, image, slope = square((0, 0), 1), (Ball(0), Ball(0)), good.slope(None)
    contract(hint, image, slope, box)
    (a, b), (c, d) = slope
    for bad in (Ball("nan"), Ball("inf"), Ball(0, "inf")):
        for arguments in [
            ((bad, image[1]), slope, box),
            ((image[0], bad), slope, box),
            (image, ((bad, b), (c, d)), box),
            (image, ((a, bad), (c, d)), box),
            (image, ((a, b), (bad, d)), box),
            (image, ((a, b), (c, bad)), box),
            (image, slope, (bad, box[1])),
            (image, slope, (box[0], bad)),
        ]:
            with pytest.raises(NotProved):
                contract(hint, *arguments)


def test_slopes_that_are_taylor_models():
    """C (Φ' - 1) is bounded over the box as a whole; two fixed points are refused as before."""
    random = seeded(6)
    for _ in range(rounds(50)):
        fixed = tuple(random.choice([-1, 1]) * (2 + decimal_fraction(random)) for _ in "xv")
        phi, shift = Quadratic(*fixed), Fraction(1, 20)
        centre = tuple(f + decimal_fraction(random) * shift for f in fixed)
        hint = Preconditioner(
            centre, inverse(((2 * centre[0], Fraction(0)), (Fraction(1), 2 * centre[1])))
        )
        image = tuple(interval.ball(value) for value in phi(centre))
        for radius, succeeds in ((3 * shift, True), (2 * abs(fixed[0]) + 1, False)):
            box = square(centre, radius)
            reach = [side - interval.ball(c) for side, c in zip(box, centre, strict=True)]
            x, v = Domain(reach, 2).variables([interval.ball(c) for c in centre])
            slope = (1 + 2 * x, x * 0), (x * 0 + 1, 1 + 2 * v)
            if succeeds:
                k = contract(hint, image, slope, box, TAYLOR_MODELS.bound)
                assert all(holds(inner, f, 0) for inner, f in zip(k, fixed, strict=True))
            else:
                with pytest.raises(NotProved, match="not inside"):
                    contract(hint, image, slope, box, TAYLOR_MODELS.bound)


def test_operator_is_the_formula():
    """K = m - C G(m) + (1 - C G') (Z - m), against the same over fractions at points of Z."""
    random = seeded(4)
    for _ in range(rounds(100)):
        c, slope = (
            tuple(tuple(decimal_fraction(random, 3) for _ in "ab") for _ in "cd") for _ in "cs"
        )
        m, image, z = (tuple(decimal_fraction(random, 3) for _ in "xv") for _ in range(3))
        box = tuple(
            interval.hull(interval.ball(a), interval.ball(b)) for a, b in zip(m, z, strict=True)
        )
        k = operator(Preconditioner(m, c), tuple(map(interval.ball, image)), balls(slope), box)
        (p, q), (r, s) = matrix.product(c, matrix.minus_identity(slope))
        g = [a - b for a, b in zip(image, m, strict=True)]
        d = [a - b for a, b in zip(z, m, strict=True)]
        x = m[0] - c[0][0] * g[0] - c[0][1] * g[1] + (1 - p) * d[0] - q * d[1]
        v = m[1] - c[1][0] * g[0] - c[1][1] * g[1] - r * d[0] + (1 - s) * d[1]
        assert holds(k[0], x, 0)
        assert holds(k[1], v, 0)


def test_matrices():
    """Products, determinants, traces and inverses of two by two matrices, over fractions."""
    random = seeded(5)
    for _ in range(rounds(50)):
        m, n = (tuple(tuple(decimal_fraction(random, 3) for _ in "ab") for _ in "cd") for _ in "mn")
        (a, b), (c, d) = matrix.product(m, n)
        expected = [[sum(m[i][k] * n[k][j] for k in (0, 1)) for j in (0, 1)] for i in (0, 1)]
        assert [[a, b], [c, d]] == expected
        assert matrix.determinant(((a, b), (c, d))) == matrix.determinant(m) * matrix.determinant(n)
        assert matrix.trace(m) == m[0][0] + m[1][1]
        if matrix.determinant(m):
            assert matrix.product(m, matrix.inverse(m)) == ((1, 0), (0, 1))
