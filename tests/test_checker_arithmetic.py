"""The checker's arithmetic: every operation contains the truth, and hardly more.

Oracles: exact fractions for the field operations, mpmath's plain numbers and python-flint's balls
at a much higher precision for the functions.
"""

from __future__ import annotations

import os
import random
from fractions import Fraction

import flint
import pytest
from mpmath import mp

from cap.checker.elementary import (
    _arctan_of_inverse,
    _cos_sin_at,
    _sine_series,
    arccos,
    cos_sin,
    pi,
)
from cap.checker.interval import Interval
from cap.checker.rejection import Rejected, need

TIMES = int(os.environ.get("CAP_TEST_MULTIPLIER", "1"))
BITS = (8, 53, 64, 200, 300)


def some_integer(rng, bits):
    kind = rng.randrange(6)
    if kind == 0:
        return rng.choice((0, 1, -1, 1 << bits, -(1 << bits), (1 << bits) + 1, (1 << bits) - 1))
    size = rng.choice((4, bits // 2, bits, bits + 8, 3 * bits))
    return rng.randint(-(1 << size), 1 << size)


def some_interval(rng, bits):
    a = some_integer(rng, bits)
    width = rng.choice((0, 0, 1, 2, 1 << (bits // 2), 1 << bits, 1 << (2 * bits)))
    return Interval(a, a + rng.randint(0, width), bits)


def points(rng, x):
    inner = [rng.randint(x.lo, x.hi) for _ in range(2)]
    return [Fraction(n, 1 << x.bits) for n in (x.lo, x.hi, *inner)]


def contains(x, q):
    return x.lower <= q <= x.upper


@pytest.mark.parametrize("bits", BITS)
def test_field_operations_contain_all_values_and_are_tight(bits):
    rng = random.Random(bits)  # noqa: S311
    for _ in range(300 * TIMES):
        x, y = some_interval(rng, bits), some_interval(rng, bits)
        pairs = [(p, q) for p in points(rng, x) for q in points(rng, y)]
        for result, exact in (
            (x + y, [p + q for p, q in pairs]),
            (x - y, [p - q for p, q in pairs]),
            (x * y, [p * q for p, q in pairs]),
            (x * 7, [p * 7 for p, _ in pairs]),
            (x * -7, [p * -7 for p, _ in pairs]),
            (x + 3, [p + 3 for p, _ in pairs]),
            (x - 3, [p - 3 for p, _ in pairs]),
            (-x, [-p for p, _ in pairs]),
        ):
            assert all(contains(result, value) for value in exact)
            ulp = Fraction(1, 1 << bits)  # the corners are among the points
            assert min(exact) - result.lower < ulp
            assert result.upper - max(exact) < ulp


@pytest.mark.parametrize("bits", BITS)
def test_division_contains_all_values_and_is_tight(bits):
    rng = random.Random(bits + 1)  # noqa: S311
    done = 0
    while done < 200 * TIMES:
        x, y = some_interval(rng, bits), some_interval(rng, bits)
        if y.contains_zero():
            with pytest.raises(Rejected, match="zero"):
                x / y
            continue
        done += 1
        exact = [p / q for p in points(rng, x) for q in points(rng, y)]
        result, ulp = x / y, Fraction(1, 1 << bits)
        assert all(contains(result, value) for value in exact)
        assert min(exact) - result.lower < ulp
        assert result.upper - max(exact) < ulp


@pytest.mark.parametrize(
    "divisor", [0, Interval(0, 5, 64), Interval(-5, 0, 64), Interval(-1, 1, 64)]
)
def test_division_by_an_interval_with_zero_rejects(divisor):
    with pytest.raises(Rejected):
        Interval(1, 2, 64) / divisor


@pytest.mark.parametrize("divisor", [1, 3, -3])
def test_division_by_an_integer(divisor):
    x = Interval(10, 20, 4)
    ends = sorted((x.lower / divisor, x.upper / divisor))
    assert (x / divisor).lower <= ends[0] <= ends[1] <= (x / divisor).upper
    assert (x / divisor).width <= 10 // abs(divisor) + 2


@pytest.mark.parametrize("bits", BITS)
def test_square_root_magnitude_of_random_intervals(bits):
    rng = random.Random(bits + 2)  # noqa: S311
    ulp = Fraction(1, 1 << bits)
    for _ in range(200 * TIMES):
        x = some_interval(rng, bits)
        for value in points(rng, x):
            assert contains(x.square(), value**2)
            assert contains(x.magnitude(), abs(value))
        assert x.square().lo >= 0
        largest = max(x.lower**2, x.upper**2)
        assert x.square().upper - largest < ulp
        least = Fraction(0) if x.contains_zero() else min(x.lower**2, x.upper**2)
        assert least - x.square().lower < ulp
        assert (x.magnitude().lower == 0) == x.contains_zero()
        y = x.magnitude()
        root = y.sqrt()
        assert root.lower**2 <= y.lower < (root.lower + ulp) ** 2
        assert (root.upper - ulp) ** 2 < y.upper <= root.upper**2 or y.hi == root.hi == 0


def test_square_root_of_negative_numbers_rejects():
    with pytest.raises(Rejected, match="negative"):
        Interval(-1, 5, 64).sqrt()


@pytest.mark.parametrize(
    "q", [Fraction(1, 3), Fraction(-1, 3), Fraction(2), Fraction(0), Fraction(-7, 10**40)]
)
def test_enclosing_is_the_least_interval(q):
    for bits in BITS:
        x = Interval.enclosing(q, q, bits)
        assert contains(x, q)
        assert x.width == (0 if (q * (1 << bits)).denominator == 1 else 1)


def test_enclosing_rounds_each_end_outwards():
    x = Interval.enclosing(Fraction(-1, 3), Fraction(1, 3), 8)
    assert (x.lo, x.hi) == (-86, 86)


def test_with_bits_rounds_outwards():
    x = Interval(-5, 5, 10)
    assert (x.with_bits(9).lo, x.with_bits(9).hi) == (-3, 3)
    assert x.with_bits(20).lower == x.lower


def test_predicates_are_strict():
    zero, one, two = (Interval(n, n, 0) for n in (0, 1, 2))
    assert not zero.is_positive()
    assert one.is_positive()
    assert not one.is_before(one)
    assert one.is_before(two)
    assert not Interval(1, 2, 0).is_before(two)
    assert Interval(0, 1, 0).contains_zero()
    assert Interval(-1, 0, 0).contains_zero()
    assert one.lies_in(Fraction(1), Fraction(1))
    assert not one.lies_inside(Fraction(1), Fraction(2))
    assert not one.lies_inside(Fraction(0), Fraction(1))
    assert one.lies_inside(Fraction(0), Fraction(2))
    assert not one.lies_in(Fraction(0), Fraction(1, 2))
    assert not one.lies_in(Fraction(3, 2), Fraction(2))


def test_intersection():
    x = Interval(0, 5, 3).intersection(Interval(2, 9, 3))
    assert (x.lo, x.hi) == (2, 5)
    assert Interval(0, 2, 3).intersection(Interval(2, 3, 3)).width == 0
    with pytest.raises(Rejected, match="disjoint"):
        Interval(0, 1, 3).intersection(Interval(2, 3, 3))


def test_different_precision_rejects():
    for operation in (Interval.__add__, Interval.__sub__, Interval.__mul__, Interval.__truediv__):
        with pytest.raises(Rejected, match="precision"):
            operation(Interval(1, 1, 3), Interval(1, 1, 4))


@pytest.mark.parametrize("value", [1, "true", [True], None, False, 0])
def test_need_takes_nothing_but_true(value):
    with pytest.raises(Rejected, match="why"):
        need(value, "why")
    need(True, "why")


@pytest.mark.parametrize("bits", [1, 2, 10, 64, 200, 1000, 16384])
def test_pi(bits):
    with mp.workprec(bits + 60):
        exact = mp.pi * mp.mpf(2) ** bits
        assert pi(bits).lo <= exact <= pi(bits).hi
    assert pi(bits).width <= 2


def extremes_of_cosine(x):
    """The least and the greatest cosine over an interval, at a high precision, in units 2^-bits."""
    with mp.workprec(8 * x.bits + 200):
        unit = mp.mpf(2) ** -x.bits
        a, b = x.lo * unit, x.hi * unit
        values = [mp.cos(a), mp.cos(b)]
        first, last = int(mp.ceil(a / mp.pi)), int(mp.floor(b / mp.pi))
        values += [mp.mpf(1 - 2 * (n % 2)) for n in range(first, min(last, first + 1) + 1)]
        return min(values) / unit, max(values) / unit


def extremes_of_sine(x):
    with mp.workprec(8 * x.bits + 200):
        unit = mp.mpf(2) ** -x.bits
        a, b = x.lo * unit, x.hi * unit
        values = [mp.sin(a), mp.sin(b)]
        first, last = (int(r(q / mp.pi - mp.mpf(1) / 2)) for q, r in ((a, mp.ceil), (b, mp.floor)))
        values += [mp.mpf(1 - 2 * (n % 2)) for n in range(first, min(last, first + 1) + 1)]
        return min(values) / unit, max(values) / unit


def agrees(result, extremes, slack):
    low, high = extremes
    assert result.lo <= low
    assert high <= result.hi
    assert low - result.lo <= slack
    assert result.hi - high <= slack


@pytest.mark.parametrize("bits", BITS)
def test_cosine_and_sine_of_random_intervals(bits):
    rng = random.Random(bits + 3)  # noqa: S311
    for _ in range(60 * TIMES):
        x = some_interval(rng, bits)
        cos, sin = cos_sin(x)
        agrees(cos, extremes_of_cosine(x), 2)
        agrees(sin, extremes_of_sine(x), 2)


@pytest.mark.parametrize("bits", [53, 200])
@pytest.mark.parametrize("n", [-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 10**6 + 1, 10**30 + 2])
def test_cosine_and_sine_around_the_multiples_of_half_pi(bits, n):
    with mp.workprec(4 * bits + 300):
        middle = int(mp.nint(n * mp.pi / 2 * mp.mpf(2) ** bits))
    for left in (0, 1, 5, 1 << bits // 3, 1 << (bits - 1)):
        for right in (0, 1, 5, 1 << bits // 3, 1 << (bits - 1)):
            for shift in (0, -2 * right, 2 * left):  # around it, before it, after it
                x = Interval(middle - left + shift, middle + right + shift, bits)
                if x.lo > x.hi:
                    continue
                cos, sin = cos_sin(x)
                agrees(cos, extremes_of_cosine(x), 2)
                agrees(sin, extremes_of_sine(x), 2)


@pytest.mark.parametrize("value", [10**30, -(10**30), 10**300 + 1, 3 * 10**1000, 1 << 5000])
def test_cosine_and_sine_of_huge_arguments(value):
    x = Interval.enclosing(Fraction(value), Fraction(value), 128)
    with flint.ctx.workprec(8000):
        unit = flint.arb(2) ** 128
        for result, exact in zip(
            cos_sin(x), (flint.arb(value).cos(), flint.arb(value).sin()), strict=True
        ):
            assert result.lo < exact * unit
            assert exact * unit < result.hi
            assert result.width <= 4


def test_cosine_and_sine_of_a_whole_turn_and_more():
    for x in (Interval.enclosing(0, 7, 64), Interval.enclosing(-(10**40), 10**40, 64)):
        for result in cos_sin(x):
            assert result.lies_in(Fraction(-1) - Fraction(2, 1 << 64), 1 + Fraction(2, 1 << 64))
            assert contains(result, Fraction(1))
            assert contains(result, Fraction(-1))


@pytest.mark.parametrize("bits", [16, 64, 200, 300])
def test_arccosine_of_random_intervals(bits):
    rng = random.Random(bits + 4)  # noqa: S311
    one = 1 << bits
    for k in range(60 * TIMES):
        near = rng.choice((1, 2, 1 << bits // 2, one // 2))
        a = rng.choice(
            (one - rng.randint(1, near), -one + rng.randint(1, near), rng.randint(-near, near))
        )
        a = max(-one + 1, min(one - 1, a))
        b = min(one - 1, a + rng.choice((0, 0, 1, near))) if k else a
        with mp.workprec(4 * bits):
            unit = mp.mpf(2) ** -bits
            extremes = mp.acos(b * unit) / unit, mp.acos(a * unit) / unit
            agrees(arccos(Interval(a, b, bits)), extremes, 2)


@pytest.mark.parametrize("ends", [(-256, 0), (0, 256), (-300, 300), (256, 256), (-256, -256)])
def test_arccosine_at_and_beyond_one_rejects(ends):
    with pytest.raises(Rejected, match="arccosine"):
        arccos(Interval(*ends, 8))


@pytest.mark.parametrize("bits", [64, 250])
def test_cosine_against_balls(bits):
    rng = random.Random(bits)  # noqa: S311
    with flint.ctx.workprec(4 * bits):
        for _ in range(100 * TIMES):
            n = rng.randint(-(1 << bits + 4), 1 << bits + 4)
            t, unit = flint.arb(n) / flint.arb(2) ** bits, flint.arb(2) ** bits
            for result, exact in zip(
                cos_sin(Interval(n, n, bits)), (t.cos(), t.sin()), strict=True
            ):
                assert result.lo <= exact * unit
                assert exact * unit <= result.hi


@pytest.mark.parametrize("ends", [(0, 0), (-1, 0), (5, 6), (-7, -2), (100, 108), (-9, 90)])
def test_the_midpoint_lies_in_the_interval_near_its_middle(ends):
    middle = Interval(*ends, 5).midpoint()
    assert middle.lo == middle.hi
    assert ends[0] <= middle.lo <= ends[1]
    assert abs(2 * middle.lo - sum(ends)) <= 1


@pytest.mark.parametrize("p", [12, 64, 300])
def test_the_error_bounds_of_the_series_before_the_guard_bits_are_cut(p):
    rng = random.Random(p)  # noqa: S311
    half_pi = Interval(pi(p).lo, pi(p).hi, p + 1).with_bits(p)
    with mp.workprec(4 * p + 100):
        unit = mp.mpf(2) ** -p
        for _ in range(100 * TIMES):
            r = rng.randint(0, half_pi.lo // 2)
            value, error = _sine_series(r, p)
            assert abs(value - mp.sin(r * unit) / unit) <= error <= 2 * p
            a = rng.choice((r, -r, r * (1 << 20) + 5, -r * 77))
            for result, f in zip(_cos_sin_at(a, half_pi), (mp.cos, mp.sin), strict=True):
                assert result.lo <= f(a * unit) / unit <= result.hi
        for n in (5, 239):
            value, error = _arctan_of_inverse(n, p)
            assert abs(value - mp.atan(mp.mpf(1) / n) / unit) <= error <= p
