"""Pi, cosine, sine and arccosine of the checker contain the truth, and hardly more.

Oracles: mpmath's plain numbers and python-flint's balls at a much higher precision.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import flint
import pytest
from mpmath import mp
from support import rounds, seeded

from cap.checker.kernel.arctangent import _arctan, arccos, pi
from cap.checker.kernel.elementary import _cos_sin_at, _sine_series, cos_sin
from cap.checker.kernel.exponential import exp, phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from checker.intervals import BITS, contains, some_interval


@pytest.mark.parametrize("bits", [1, 2, 10, 64, 200, 1000, 8192])
def test_pi(bits):
    """Contains mpmath's pi and is at most two units wide, to twice the bits of a certificate."""
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
    """The same for the sine."""
    with mp.workprec(8 * x.bits + 200):
        unit = mp.mpf(2) ** -x.bits
        a, b = x.lo * unit, x.hi * unit
        values = [mp.sin(a), mp.sin(b)]
        first, last = (int(r(q / mp.pi - mp.mpf(1) / 2)) for q, r in ((a, mp.ceil), (b, mp.floor)))
        values += [mp.mpf(1 - 2 * (n % 2)) for n in range(first, min(last, first + 1) + 1)]
        return min(values) / unit, max(values) / unit


def agrees(result, extremes, slack):
    """Check that an enclosure contains the extremes, and is wider by the slack at most, in ulps."""
    low, high = extremes
    assert result.lo <= low
    assert high <= result.hi
    assert low - result.lo <= slack
    assert result.hi - high <= slack


@pytest.mark.parametrize("bits", BITS)
def test_cosine_and_sine_of_random_intervals(bits):
    """Contain the extremes over intervals of any width, and exceed them by two ulps at most."""
    rng = seeded(bits + 3)
    for _ in range(rounds(60)):
        x = some_interval(rng, bits)
        cos, sin = cos_sin(x)
        agrees(cos, extremes_of_cosine(x), 2)
        agrees(sin, extremes_of_sine(x), 2)


@pytest.mark.parametrize("bits", [53, 200])
@pytest.mark.parametrize("n", [-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 10**6 + 1, 10**30 + 2])
def test_cosine_and_sine_around_the_multiples_of_half_pi(bits, n):
    """Around, before and after an extremum, also touching it: neither missed nor invented."""
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
    """Up to 2^5000 the reduction by pi keeps enough bits."""
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
    """Over a turn or more the result is [-1, 1]."""
    for x in (Interval.enclosing(0, 7, 64), Interval.enclosing(-(10**40), 10**40, 64)):
        for result in cos_sin(x):
            assert result.lies_in(Fraction(-1) - Fraction(2, 1 << 64), 1 + Fraction(2, 1 << 64))
            assert contains(result, Fraction(1))
            assert contains(result, Fraction(-1))


@pytest.mark.parametrize("bits", [16, 64, 200, 300])
def test_arccosine_of_random_intervals(bits):
    """Contains the extremes and exceeds them by two ulps at most, also next to ±1."""
    rng = seeded(bits + 4)
    one = 1 << bits
    for k in range(rounds(60)):
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
    """An interval that contains 1 or -1, or more, rejects."""
    with pytest.raises(Rejected, match="arccosine"):
        arccos(Interval(*ends, 8))


@pytest.mark.parametrize("bits", [64, 250])
def test_cosine_against_balls(bits):
    """At random points the results contain python-flint's cosine and sine."""
    rng = seeded(bits)
    with flint.ctx.workprec(4 * bits):
        for _ in range(rounds(100)):
            n = rng.randint(-(1 << bits + 4), 1 << bits + 4)
            t, unit = flint.arb(n) / flint.arb(2) ** bits, flint.arb(2) ** bits
            for result, exact in zip(
                cos_sin(Interval(n, n, bits)), (t.cos(), t.sin()), strict=True
            ):
                assert result.lo <= exact * unit
                assert exact * unit <= result.hi


@pytest.mark.parametrize("p", [12, 64, 300])
def test_the_error_bounds_of_the_series_before_the_guard_bits_are_cut(p):
    """The stated errors hold for the raw series, where no guard bits could hide a wrong one."""
    rng = seeded(p)
    half_pi = Interval(pi(p).lo, pi(p).hi, p + 1).with_bits(p)
    with mp.workprec(4 * p + 100):
        unit = mp.mpf(2) ** -p
        for _ in range(rounds(100)):
            r = rng.randint(0, half_pi.lo // 2)
            value, error = _sine_series(r, p)
            assert abs(value - mp.sin(r * unit) / unit) <= error <= 2 * p
            a = rng.choice((r, -r, r * (1 << 20) + 5, -r * 77))
            for result, f in zip(_cos_sin_at(a, p), (mp.cos, mp.sin), strict=True):
                assert result.lo <= f(a * unit) / unit <= result.hi
        for n in (2, 5, 239):
            result = _arctan(Interval.enclosing(Fraction(1, n), Fraction(1, n), p))
            assert result.lo <= mp.atan(mp.mpf(1) / n) / unit <= result.hi
            assert result.width <= 3 * p << 9  # after nine halvings


# with few bits, where a unit counts


def holds(few, many):
    """Check that an enclosure of few bits contains one of the same quantity with more of them."""
    assert few.lower <= many.lower
    assert many.upper <= few.upper


def test_pi_at_all_precisions():
    """At each of 400 precisions the enclosure contains that of 500 bits."""
    for bits in range(1, 400):
        holds(pi(bits), pi(500))


def test_all_points_of_few_bits():
    """Cosine and sine at 513 points of 5 bits, exponentials of 6, arccosine of 7 bits."""
    for n in range(-256, 257):
        for few, many in zip(cos_sin(Interval(n, n, 5)), cos_sin(point(n, 5, 90)), strict=True):
            holds(few, many)
        for order in range(3):
            holds(phi(order, Interval(n, n, 6), n % 3), phi(order, point(n, 6, 90), n % 3))
    for n in range(-127, 128):
        holds(arccos(Interval(n, n, 7)), arccos(point(n, 7, 90)))


def point(n, bits, more):
    """Return the point n 2^-bits with more bits."""
    return Interval(n, n, bits).with_bits(more)


@pytest.mark.parametrize("bits", [8, 20, 64])
@pytest.mark.parametrize("n", [-2, -1, 0, 1, 2])
def test_tiny_arguments(bits, n):
    """At a unit from 0, what is left out is far below a unit, but it is there."""
    for order in range(3):
        for k in range(3):
            holds(phi(order, Interval(n, n, bits), k), phi(order, point(n, bits, 400), k))
    for few, many in zip(cos_sin(Interval(n, n, bits)), cos_sin(point(n, bits, 400)), strict=True):
        holds(few, many)


@pytest.mark.parametrize("x", ["-3", "0", "1/1000", "1", "8/3", "63.9"])
def test_the_exponential_of_a_fraction(x):
    """To seventy digits; beyond 200 it is rejected."""
    x = Fraction(x)
    found, known = exp(x), sum(x**n / factorial(n) for n in range(400))
    assert found.lower <= known <= found.upper <= found.lower + known / 10**70
    with pytest.raises(Rejected, match="exponent"):
        exp(x + (x >= 0 or -1) * 201)


def test_the_error_bounds_that_the_text_states():
    """2N + 2 for the sine after N terms."""
    for p in (4, 64):
        assert _sine_series(0, p) == (0, 2)
        assert _sine_series(1, p) == (1, 4)
    assert _sine_series(200, 8)[1] == 6  # the terms are 200 and 20


@pytest.mark.parametrize("x", [-150, -30, 30, 150])
def test_the_exponential_of_large_numbers(x):
    """Terms of its series are as large as e^|x|."""
    found = exp(Fraction(x))
    with mp.workprec(600):
        exact = int(mp.floor(mp.exp(x) * mp.mpf(2) ** found.bits))
    assert found.lo <= exact < found.hi
    assert found.hi - found.lo < 4
