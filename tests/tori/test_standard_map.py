"""The standard map: its formula, curves against orbits in floats, and where none is proved."""

import math
from fractions import Fraction

import numpy as np
import pytest
from support import seeded

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.sets.interval import Ball, ComplexBall
from cap.tori import standard_map
from cap.tori.invariant_curve import Curve, Rotation, invariant_curve, measured
from cap.tori.newton import levelled

HALF = Fraction(1, 2)
BITS = 128


@pytest.fixture(scope="module")
def proved():
    """The golden curve at K = 1/2."""
    with interval.workprec(BITS):
        return standard_map.spanning_curve(HALF, 64, Fraction(1, 10), steps=2)


@pytest.fixture(autouse=True)
def working():
    """The precision."""
    with interval.workprec(BITS):
        yield


def value(u, theta):
    """Return the value of a polynomial, in floats."""
    n = u.circle.degree
    terms = (complex(c.mid()) * np.exp(1j * k * theta) for k, c in enumerate(u.coefficients, -n))
    return sum(terms).real


def iterated(x, v, K, count):
    """Give the states of an orbit, x not taken mod 2π."""
    for _ in range(count):
        v = v + K * math.sin(x)
        x = x + v
        yield x, v


def test_the_map_and_its_derivative():
    """At points of random curves, against the formula in floats."""
    random, circle = seeded(5), Circle(32, Fraction(1, 20))
    x, v, a, b = (
        circle.real([ComplexBall(random.uniform(-0.1, 0.1)) for _ in range(4)]) for _ in range(4)
    )
    image = standard_map.standard_map(circle, interval.ball(HALF))(x, v)
    tangent = image.tangent((a, b))
    for theta in (0.0, 1.0, 2.5, 4.0):
        x0, v0, a0, b0 = (value(u, theta) for u in (x, v, a, b))
        v1 = v0 + 0.5 * math.sin(theta + x0)
        pushed = b0 + 0.5 * math.cos(theta + x0) * a0
        assert value(image.x, theta) == pytest.approx(x0 + v1, abs=1e-12)
        assert value(image.v, theta) == pytest.approx(v1, abs=1e-12)
        assert value(tangent[0], theta) == pytest.approx(a0 + pushed, abs=1e-12)
        assert value(tangent[1], theta) == pytest.approx(pushed, abs=1e-12)


def test_an_orbit_on_the_curve(proved):
    """It turns by the golden number, its speeds are within the bounds, which are not far."""
    assert proved.found.distance < Ball("1e-12")
    theta, golden = 0.3, (math.sqrt(5) - 1) / 2
    x, v = theta + value(proved.curve.x, theta), value(proved.curve.v, theta)
    states = list(iterated(x, v, 0.5, 20_000))
    turned = (states[-1][0] - x) / (2 * math.pi * len(states))
    assert turned == pytest.approx(golden, abs=1e-5)
    lower, upper = map(float, (q.mid() for q in proved.speeds()))
    speeds = [v for _, v in states]
    assert lower < min(speeds) < lower + 0.05
    assert upper - 0.1 < max(speeds) < upper


def test_orbits_do_not_cross_it(proved):
    """From speeds below the least one of the curve none gets above the largest one."""
    lower, upper = map(float, (q.mid() for q in proved.speeds()))
    random = seeded(6)
    for _ in range(20):
        x, v = random.uniform(0, 7), lower - random.uniform(0, 1)
        assert max(v for _, v in iterated(x, v, 0.5, 2000)) < upper


def test_curves_that_are_not_nearly_invariant():
    """That of K = 0, and one that is moved: they are refused."""
    circle = Circle(64, Fraction(1, 10))
    golden = standard_map.GOLDEN
    turn = Rotation.of(circle, 2 * interval.pi() * golden.value(), Ball("0.38"))
    curve = standard_map.level(circle, turn.omega)
    mapped = standard_map.standard_map(circle, interval.ball(HALF))
    frame = standard_map.normal(curve)
    with pytest.raises(NotProved):  # of K = 0
        invariant_curve(measured(mapped, curve, frame, turn, standard_map.REACH))
    close = standard_map.followed(mapped, curve, turn, 6)
    frame = levelled(mapped, close, standard_map.normal(close), turn)
    found = invariant_curve(measured(mapped, close, frame, turn, standard_map.REACH))
    assert found.distance < Ball("1e-10")
    shifted = Curve(close.x, close.v + Ball("0.001"), close.turns)
    with pytest.raises(NotProved):
        invariant_curve(measured(mapped, shifted, frame, turn, standard_map.REACH))


def test_how_far_orbits_get(proved):
    """Not past a curve that is proved; for K = 3/2 past 2π, so nothing spans in between."""
    lower, upper = proved.speeds()
    start = Fraction(1, 1000), Fraction(0)
    with interval.workprec(2000):
        low = standard_map.reached(HALF, *start, 2000)
        assert Ball("0.9") < low < 2 * interval.pi() - lower < upper
        assert standard_map.reached(Fraction(3, 2), *start, 3000) > 2 * interval.pi()
    short = standard_map.reached(Fraction(3, 2), *start, 3000)  # the precision is used up
    assert short < 2 * interval.pi()


def test_beyond_the_last_curve():
    """For K = 1.2 there is no spanning curve, and none is proved."""
    with pytest.raises(NotProved):
        standard_map.spanning_curve(Fraction(6, 5), 64, Fraction(1, 50), steps=2)


@pytest.mark.slow
def test_the_curve_at_nine_tenths():
    """It is proved within a quarter of a minute."""
    proved = standard_map.spanning_curve(Fraction(9, 10), 512, Fraction(1, 50))
    lower, upper = proved.speeds()
    assert Ball("3.1983") < lower < upper < Ball("4.5681")
