"""exp(N d): by eigenvalues and by series, at points, over balls, in doubles."""

from fractions import Fraction

import pytest
from support import seeded

from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.exponential import Exponential, enclosed, exponential
from cap.system.polynomial import PI, Polynomial, variable
from cap.system.spectral import spectral

CASES = {
    "spring": [[0, 1, 0], [-1, Fraction(-1, 10), Fraction(1, 3)], [0, 0, 0]],
    "saddle": [[0, 1], [2, Fraction(1, 2)]],
    "two springs": [[0, 0, 1, 0], [0, 0, 0, 1], [-2, 1, 0, 0], [1, -2, 0, Fraction(-1, 5)]],
    "three rates": [[-1, 1, 0], [0, -2, 1], [0, 0, Fraction(1, 3)]],
}
DEFECTIVE = [[-1, 1], [0, -1]]


def matrix(rows):
    """Return numbers as the entries of a generator."""
    return [[Polynomial.of(q) for q in row] for row in rows]


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("radius", [0.0, 1e-12, 1e-3, 0.1, 0.5])
def test_by_eigenvalues(name, radius):
    """What is enclosed contains exp(N t) for t in the ball, and is no wider than by series.

    Over long balls it is somewhat wider for some matrices, and narrower for others.
    """
    rows, random = matrix(CASES[name]), seeded(name)
    with interval.workprec(96):
        size = len(rows)
        of, N = Exponential(rows, size), enclosed(rows)
        assert spectral(rows, size * size)
        for _ in range(20):
            middle = random.uniform(-2, 3)
            d = Ball(middle, radius)
            ours, series = of(d), exponential(N, d).entries()
            inside = Ball(middle) + Ball(random.uniform(-radius, radius))
            with interval.workprec(200):
                truth = exponential(enclosed(rows), inside).entries()
            assert all(x.contains(t) for x, t in zip(ours, truth, strict=True))
            widths = [max(float(x.rad()) for x in entries) for entries in (ours, series)]
            assert widths[0] < (1.01 if radius < 0.2 else 1.4) * widths[1] + 1e-25


@pytest.mark.parametrize("name", CASES)
def test_first_rows(name):
    """They are the rows of all; doubles lie near to them."""
    rows = matrix(CASES[name])
    with interval.workprec(64):
        d = Ball(1.25)
        all_rows, first = Exponential(rows, len(rows)), Exponential(rows, 1)
        assert len(first(d)) == len(rows)
        assert all(x.overlaps(y) for x, y in zip(first(d), all_rows(d), strict=False))
        near = zip(first.near(1.25), first(d), strict=True)
        assert all(abs(x - float(y)) < 1e-14 for x, y in near)


@pytest.mark.parametrize(
    "rows",
    [
        matrix(DEFECTIVE),
        [[Polynomial.of(0), variable(PI)], [Polynomial.of(-1), Polynomial.of(0)]],
        matrix([[0, 1], [Fraction(-1, 10**6), 0]]),
    ],
    ids=["no basis of eigenvectors", "pi", "close eigenvalues"],
)
def test_by_series(rows):
    """Where eigenvalues are of no use the series serves."""
    with interval.workprec(96):
        assert spectral(rows, 4) is None
        d = Ball(0.75, 1e-6)
        found = Exponential(rows, 2)
        ours, series = found(d), exponential(enclosed(rows), d).entries()
        assert all(x.contains(y) and y.contains(x) for x, y in zip(ours, series, strict=True))
        near = zip(found.near(0.75), found(Ball(0.75)), strict=True)
        assert all(abs(x - float(y)) < 1e-15 for x, y in near)
