"""exp(M d) for matrices of rational numbers, against 40 digits and closed forms."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from mpmath import mp, mpf
from support import number, rational, rounds, seeded

from cap.checker.kernel.rejection import Rejected
from cap.checker.system.exponential import Exponential
from checker.parts import Interval
from checker.springs import exponential, springy

BITS = 128
LITTLE = Fraction(1, 10**36)
DAMPED = springy()


def some_matrix(rng):
    """Return a random matrix with rational entries, some of them 0."""
    n = rng.randint(1, 4)
    entry = lambda: Fraction(rng.choice([0, rng.randint(-9, 9)]), rng.randint(1, 5))  # noqa: E731
    return [[entry() for _ in range(n)] for _ in range(n)]


def point(q):
    """Return an integer z, and z 2^-bits."""
    z = round(Fraction(q) * 2**BITS)
    return z, Fraction(z, 2**BITS)


def test_points():
    """Random matrices and times of both signs: none outside, and all to 36 digits."""
    rng = seeded(3)
    for _ in range(rounds(60)):
        M = some_matrix(rng)
        own = Exponential(M, BITS)
        z, d = point(Fraction(rng.randint(-400, 400), 100))
        with mp.workdps(60):
            truth = exponential(M, number(d))
            size = max(1, rational(max(abs(x) for x in truth)))
            for i in range(len(M)):
                for j, found in enumerate(own.at(i, z)):
                    assert found.lower <= rational(truth[i, j]) <= found.upper
                    assert found.upper - found.lower < LITTLE * size


def test_a_spring_with_damping():
    """Its closed form: e^(-c d) with the cosine and sine of the slower frequency."""
    M = [[Fraction(0), Fraction(1)], [Fraction(-1), Fraction(-1, 10)]]
    own = Exponential(M, BITS)
    z, d = point("7/3")
    with mp.workdps(60):
        c, d = mpf(1) / 20, number(d)
        w = mp.sqrt(1 - c * c)
        cos, sin = mp.exp(-c * d) * mp.cos(w * d), mp.exp(-c * d) * mp.sin(w * d) / w
        rows = [[cos + c * sin, sin], [-sin, cos - c * sin]]
        for i, row in enumerate(rows):
            for found, truth in zip(own.at(i, z), row, strict=True):
                assert found.lower <= rational(truth) <= found.upper


def test_what_is_nilpotent():
    """A polynomial in d, to the last units."""
    M = [[Fraction(q) for q in row] for row in ((0, 1, 0), (0, 0, "2/3"), (0, 0, 0))]
    z = 5 << BITS - 1
    row = Exponential(M, BITS).at(0, z)
    for found, truth in zip(row, (1, Fraction(5, 2), Fraction(25, 12)), strict=True):
        assert found.lower <= truth <= found.upper
        assert found.width < 20


@pytest.mark.slow
@pytest.mark.parametrize("part", [f"1/{10**25}", "1/1000000", "1/100", "1/5"])
def test_intervals(part):
    """All times of an interval, and derivatives: contained; where they are monotone, sharp."""
    rng, order = seeded(7), 3
    own, M = Exponential(DAMPED, BITS), sympy.Matrix(DAMPED)
    powers = [M**k for k in range(order + 1)]
    for _ in range(rounds(6)):
        a = Fraction(rng.randint(-300, 300), 100)
        d = Interval.enclosing(a, a + Fraction(part), BITS)
        for i in (0, 1):
            rows = own.over(i, d, order)
            assert [len(row) for row in rows] == [5] * (order + 1)
            with mp.workdps(50):
                for n in range(9):
                    t = number(d.lower + (d.upper - d.lower) * n / 8)
                    E = exponential(DAMPED, t)
                    for k, row in enumerate(rows):
                        P = powers[k].tolist()
                        for j, found in enumerate(row):
                            terms = (number(Fraction(str(P[i][m]))) * E[m, j] for m in range(5))
                            truth = rational(mp.fsum(terms))
                            assert found.lower <= truth <= found.upper
                            assert found.upper - found.lower < 60 * Fraction(part)


def test_an_entry_that_turns():
    """A cosine around its maximum is enclosed as one, not by its ends alone."""
    M = [[Fraction(0), Fraction(1)], [Fraction(-1), Fraction(0)]]
    d = Interval.enclosing(Fraction(-1, 4), Fraction(1, 2), BITS)
    (cos, sin), (slope, _) = Exponential(M, BITS).over(0, d, 1)
    assert cos.upper >= 1
    assert cos.lower <= Fraction("0.8776")
    assert (round(float(sin.lower), 6), round(float(sin.upper), 6)) == (-0.247404, 0.479426)
    assert (round(float(slope.lower), 6), round(float(slope.upper), 6)) == (-0.479426, 0.247404)


def test_a_point_as_an_interval():
    """It has the rows at that point; they are computed once."""
    own = Exponential(DAMPED, BITS)
    z, d = point("1/3")
    rows = own.over(1, Interval(z, z, BITS), 2)
    assert rows[0] is own.at(1, z)
    with mp.workdps(50):
        E = exponential(DAMPED, number(d))
        slopes = [
            E[1, 0] * 0 + sum(number(DAMPED[1][m]) * E[m, j] for m in range(5)) for j in range(5)
        ]
        for found, truth in zip(rows[1], slopes, strict=True):
            assert found.lower <= rational(truth) <= found.upper


def test_limits():
    """Neither a time for which the terms grow too much, nor too long an interval."""
    own = Exponential([[Fraction(100)]], 64)
    assert own.at(0, 2 << 64)[0].lower > 10**86
    own.at(0, 1 - (4 << 64))
    for z in (4 << 64, -4 << 64):
        with pytest.raises(Rejected, match="too long"):
            own.at(0, z)
    own.over(0, Interval.enclosing(0, Fraction(1, 128), 64))
    with pytest.raises(Rejected, match="too long"):
        own.over(0, Interval.enclosing(0, Fraction(1, 64), 64))


def test_the_bound_of_the_error():
    """At few bits, far out, where rounding and what is left out are seen: still contained."""
    for entry in (Fraction(-29, 3), Fraction(29, 3)):
        M = [[entry, Fraction(1)], [Fraction(-1, 7), entry]]
        for z in range(-4, 5):
            row = Exponential(M, 8).at(0, z << 7)
            with mp.workdps(60):
                truth = exponential(M, number(Fraction(z, 2)))
                for j, found in enumerate(row):
                    assert found.lower <= rational(truth[0, j]) <= found.upper


def test_what_is_left_out_counts_on_both_sides():
    """Also of a sum that is exact."""
    for z in (0, 1 << 63, -3 << 64):
        (found,) = Exponential([[Fraction(0)]], 64).at(0, z)
        assert (found.lo, found.hi) == ((1 << 64) - 1, (1 << 64) + 1)


@pytest.mark.parametrize("row", [(1, 0, 0), (0, 3, -2), (100, -1, 7)])
def test_all_of_a_piece(row):
    """A row times exp(M t) for t in [0, b], b as large as it may be, and a third of that."""
    M = [[Fraction(q) for q in part] for part in ((0, 1, "1/2"), (-1, "-1/10", 0), ("1/3", 0, -1))]
    own = Exponential(M, BITS)
    assert own.norm == Fraction(3, 2)
    for b in (Fraction(2, 3), Fraction(2, 9)):
        given = [Interval.enclosing(q, q, BITS) for q in row]
        span = Interval(0, (b.numerator << BITS) // b.denominator, BITS)
        found = own._whole(given, span)
        with mp.workdps(40):
            values = []
            for k in range(11):
                E = exponential(M, number(b * k / 10))
                values.append([mp.fsum(q * E[m, j] for m, q in enumerate(row)) for j in range(3)])
        for entry, column in zip(found, zip(*values, strict=True), strict=True):
            low, high = min(map(rational, column)), max(map(rational, column))
            assert entry.lower <= low
            assert high <= entry.upper
            room = max(map(abs, row)) * (2 * b**2 + b**3)
            assert entry.upper - entry.lower <= high - low + 2 * room
