"""How a velocity relaxes, over intervals of doubles, against balls."""

import math
from fractions import Fraction

import pytest
from flint import ctx
from support import rounds, seeded

from cap.flow import relaxation
from cap.sets.decay import relax, relax_double
from cap.sets.doubles import Interval, is_finite
from sets.draw import point
from sets.test_circular import BITS, contains, exact


def drawn(random):
    """Return a viscosity and a duration as intervals."""
    mu = random.choice((0.0, random.uniform(0, 3), 10.0 ** random.uniform(-9, 1)))
    d = random.choice((0.0, random.uniform(0, 13), 10.0 ** random.uniform(-9, 0)))
    wide = random.choice((0.0, 1e-16, 1e-9, 1e-2))
    return Interval(mu, mu * 2.0**-53), Interval(d, wide)


def test_contains():
    """D, h and k of each viscosity and duration."""
    random = seeded(1)
    for _ in range(rounds(3000)):
        mu, d = drawn(random)
        with ctx.workprec(BITS):
            expected = relaxation.relax(exact(point(random, mu)), exact(point(random, d)))
            for found, ball in zip(relax(mu, d), expected, strict=True):
                assert contains(found, ball), (mu, d)


def test_is_tight():
    """For points: a few roundings, relative to the values."""
    random = seeded(2)
    for _ in range(rounds(500)):
        mu, d = drawn(random)
        D, h, k = relax(mu, Interval(d.mid, 0.0))
        growth = 1 + mu.mid * d.mid
        assert h.rad <= 4e-15 * growth * h.mid + 1e-300
        assert k.rad <= 4e-15 * growth * k.mid + 1e-300
        assert D.rad <= 4e-15 * growth


def test_without_viscosity():
    """μ = 0: 1, d and d²/2."""
    D, h, k = relax(Interval(0.0, 0.0), Interval(3.0, 0.0))
    assert (D.mid, h.mid, k.mid) == (1.0, 3.0, 4.5)
    assert max(D.rad, h.rad, k.rad) < 1e-14


@pytest.mark.parametrize("d", [-10.0, 1e9, math.nan])
def test_outside_of_its_range(d):
    """Nothing is said of durations far before 0, or beyond all that matters."""
    assert not any(map(is_finite, relax(Interval(2.0, 0.0), Interval(d, 0.0))))


def test_in_doubles():
    """The same, nearly."""
    random = seeded(3)
    for _ in range(rounds(500)):
        mu, d = drawn(random)
        near = relax_double(mu.mid, d.mid)
        for found, value in zip(relax(mu, Interval(d.mid, 0.0)), near, strict=True):
            assert abs(found.mid - value) <= 1e-13 * (1 + abs(value))


def test_thick_viscosity():
    """A viscosity with a large radius is enclosed, or nothing is said."""
    random = seeded(4)
    for _ in range(rounds(500)):
        mu = Interval(1.0, random.uniform(0, 0.5))
        d = Interval(random.uniform(0, 5), 0.0)
        found = relax(mu, d)
        if is_finite(found[0]):
            with ctx.workprec(BITS):
                ball = relaxation.relax(exact(point(random, mu)), exact(Fraction(d.mid)))
                assert all(contains(x, b) for x, b in zip(found, ball, strict=True))
