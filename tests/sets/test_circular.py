"""Sine, cosine and arccosine of intervals of doubles, against balls."""

import math
from fractions import Fraction

import pytest
from flint import arb, ctx
from support import rounds, seeded

from cap.sets import circular
from cap.sets import interval as balls
from cap.sets.circular import (
    ERROR,
    LIMIT,
    PI,
    QUARTER_1,
    QUARTER_2,
    QUARTER_3,
    TURN,
    acos,
    shifted,
    sin_cos,
    sin_cos_of_double,
)
from cap.sets.doubles import Interval, is_finite
from sets.draw import interval, point

BITS = 200


def contains(x, ball):
    """Return whether an interval contains a thin ball."""
    mid, rad = arb(x.mid), arb(x.rad)
    return mid - rad <= ball <= mid + rad


def exact(value):
    """Return the ball of a rational."""
    return balls.ball(Fraction(value))


def hard(random, count):
    """Return doubles at which a sine is hard: next to multiples of π/4, tiny, large, subnormal."""
    found = [0.0, 2.0**-1074, 2.0**-1022, 2.0**-30, LIMIT, -LIMIT, math.nextafter(LIMIT, 0)]
    with ctx.workprec(BITS):
        quarter = arb.pi() / 4
        for k in range(1, count):
            n = k if k < count / 2 else random.randint(1, int(LIMIT * 4 / math.pi) - 1)
            near = float((n * quarter).mid())
            found += [near, math.nextafter(near, 0), math.nextafter(near, math.inf), -near]
    return found


def easy(random, count):
    """Return doubles of all sizes up to the limit."""
    sizes = (1.0, 13.0, 1e3, LIMIT)
    return [random.uniform(-1, 1) * random.choice(sizes) for _ in range(count)]


def test_sine_and_cosine_of_doubles():
    """Their errors are below the bound, and not far below: random and hard arguments."""
    random, worst = seeded(1), 0.0
    with ctx.workprec(BITS):
        for x in hard(random, rounds(2000)) + easy(random, rounds(10000)):
            exact_sine, exact_cosine = arb(x).sin_cos()
            sine, cosine = sin_cos_of_double(x)
            worst = max(
                worst, *(float(abs(e).upper()) for e in (sine - exact_sine, cosine - exact_cosine))
            )
    assert ERROR / 3 < worst < ERROR


@pytest.mark.parametrize("x", [math.nextafter(LIMIT, math.inf), -1e300, math.inf, math.nan])
def test_no_sine_beyond_the_limit(x):
    """It is NaN there."""
    assert not any(map(is_finite, sin_cos(Interval(x, 0.0))))


def test_the_reduction():
    """π/2 is the sum of its three parts but for 2^-121; 20 bits more leave the first two exact."""
    with ctx.workprec(BITS):
        rest = arb.pi() / 2 - arb(QUARTER_1) - arb(QUARTER_2) - arb(QUARTER_3)
        assert abs(rest) < arb(2) ** -121
    for part in (QUARTER_1, QUARTER_2):
        numerator = part.as_integer_ratio()[0]
        assert (numerator & -numerator).bit_length() + 32 >= numerator.bit_length()


def test_constants():
    """π and 2π."""
    with ctx.workprec(BITS):
        assert contains(PI, arb.pi())
        assert contains(TURN, 2 * arb.pi())


def test_sine_and_cosine_of_intervals():
    """They contain those of each point, and are about as wide as these vary."""
    random = seeded(2)
    with ctx.workprec(BITS):
        for _ in range(rounds(4000)):
            x = interval(random, 6)
            if abs(x.mid) > LIMIT:
                continue
            sine, cosine = sin_cos(x)
            exact_sine, exact_cosine = exact(point(random, x)).sin_cos()
            assert contains(sine, exact_sine)
            assert contains(cosine, exact_cosine)
            assert sine.rad <= min(1 + 1e-9, abs(math.cos(x.mid)) * x.rad + x.rad**2 / 2 + 3e-16)
            assert abs(sine.mid) + sine.rad <= 1 + x.rad**2 + 1e-15


def test_shifted():
    """Sine and cosine at a time near another one."""
    random = seeded(3)
    with ctx.workprec(BITS):
        for _ in range(rounds(2000)):
            t, d = random.uniform(-20, 20), interval(random, 1)
            sine, cosine = sin_cos(Interval(t, 0.0))
            new = shifted(sine, cosine, d)
            for found, ball in zip(
                new, (exact(t) + exact(point(random, d))).sin_cos(), strict=True
            ):
                assert contains(found, ball)


def test_arccosine():
    """It contains that of each point, is tight, and is given unless it is near 0 or π."""
    random = seeded(4)
    with ctx.workprec(BITS):
        for _ in range(rounds(4000)):
            x = Interval(random.uniform(-1, 1), random.choice((0.0, 1e-17, 1e-9, 1e-3)))
            found = acos(x)
            slope = math.sqrt(1 - x.mid**2)
            if is_finite(found):
                assert contains(found, exact(point(random, x)).acos())
                assert slope < 0.1 or found.rad <= (x.rad + 6e-16) / slope * 1.3
            else:
                assert slope < 0.1
    assert not is_finite(acos(Interval(1.0, 0.0)))
    assert not is_finite(acos(Interval(1.5, 0.0)))


def test_the_guess_of_the_arccosine_is_not_trusted(monkeypatch):
    """A wrong one gives nothing, or a true enclosure."""
    for wrong in (0.01, 0.5, 3.0, math.nan):
        monkeypatch.setattr(circular, "_near_acos", lambda _x, wrong=wrong: 1.2 + wrong)
        found = acos(Interval(0.4, 0.0))
        assert not is_finite(found) or abs(found.mid - math.acos(0.4)) <= found.rad
