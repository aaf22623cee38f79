"""The ball on a table: impacts in floats by their definition, functions against them."""

import math
from fractions import Fraction

import numpy as np
import pytest
from support import seeded

from cap.checker.kernel import fourier
from cap.checker.kernel.interval import Interval
from cap.checker.tori import bouncing as checker
from cap.checker.tori.written import function
from cap.floats.search import spanning
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.tori.approximate import model
from cap.tori.bouncing import Bouncing
from cap.tori.invariant_curve import Curve

A = 0.2
FIFTH = Interval.enclosing(Fraction(1, 5), Fraction(1, 5), 160)
GOLDEN = (math.sqrt(5) - 1) / 2


def height(t, v, s, a=A):
    """Return the height over the table."""
    return a * math.sin(t) + (v + a * math.cos(t)) * s - s * s / 2 - a * math.sin(t + s)


def bounced(t, v, a=A):
    """Return the next impact, by small steps and bisection."""
    s = 1e-3
    while height(t, v, s, a) > 0:
        s += 1e-3
    low, high = s - 1e-3, s
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if height(t, v, middle, a) > 0 else (low, middle)
    s = low
    return t + s, -(v + a * math.cos(t) - s - a * math.cos(t + s))


def test_flights_in_floats():
    """The first impact after random ones; the derivative has determinant 1, and is right."""
    random, ball = seeded(7), spanning.Ball(A)
    for _ in range(30):
        t, v = random.uniform(0, 7), random.uniform(0.3, 4)
        step = ball.image(np.array([t]), np.array([v * v / 2]))
        later, u = bounced(t, v)
        assert u > 0
        assert step.move[0] == pytest.approx(later - t, abs=1e-9)
        assert step.y[0] == pytest.approx(u * u / 2, abs=1e-9)
        a, b, c, d = (float(entry[0]) for entry in step.derivative)
        assert a * d - b * c == pytest.approx(1)
        h = 1e-6
        for dt, dw, row in ((h, 0, (a, c)), (0, h, (b, d))):
            other = ball.image(np.array([t + dt]), np.array([v * v / 2 + dw]))
            assert (dt + other.move[0] - step.move[0]) / h == pytest.approx(row[0], abs=1e-3)
            assert (other.y[0] - step.y[0]) / h == pytest.approx(row[1], abs=1e-3)


def test_the_integral_is_kept():
    """∮ w dt of curves around the cylinder that are not invariant, and of their images."""
    ball = spanning.Ball(A)
    theta = 2 * math.pi * np.arange(4096) / 4096
    for k, size in ((1, 0.3), (3, 0.1)):
        w = 2 + size * np.cos(k * theta) + 0.1 * np.sin(theta)
        step = ball.image(theta, w)
        later = np.append(step.move + theta, step.move[0] + theta[0] + 2 * math.pi)
        heights = np.append(step.y, step.y[0])
        image = np.sum((heights[1:] + heights[:-1]) / 2 * np.diff(later))
        assert image == pytest.approx(2 * math.pi * w.mean(), abs=1e-5)


@pytest.fixture(scope="module")
def curve():
    """A curve in floats."""
    return spanning.found(spanning.Ball(A), 2 * math.pi * GOLDEN)[0]


def value(u, theta):
    """Return the value of a polynomial, in floats."""
    n = u.circle.degree
    terms = (complex(c.mid()) * np.exp(1j * k * theta) for k, c in enumerate(u.coefficients, -n))
    return sum(terms).real


def value_there(u, theta):
    """Return the value of the checker's function."""
    unit = u.circle.unit
    modes = [complex(a / unit, b / unit) for a, b in u.coefficients]
    turned = sum((c * np.exp(1j * k * theta)).real for k, c in enumerate(modes) if k)
    return modes[0].real + 2 * turned


def rows_of(columns):
    """Return the entries of a matrix, row by row."""
    (a, c), (b, d) = columns
    return a, b, c, d


@pytest.fixture(scope="module")
def written(curve):
    """Both implementations: of the prover what is near the curve; hints and curve as written."""
    degree, rho = curve.modes, Fraction(1, 50)
    rows = [row.tolist() for row in spanning.Ball(A).hints(curve)]
    with interval.workprec(160):
        circle = Circle(degree, rho)
        x, w = (model(circle, row.tolist()) for row in curve)
        near = Bouncing.of(circle, interval.ball(Fraction(1, 5)), rows).along(Curve(x, w, 1))
        words, near = near.written(30)
    other = fourier.Circle(degree, rho, 30)
    units = {"speed": 1, "inverse": 10**10, "time": 1, "later": 10**10}
    flight = checker.Flight(**{k: function(other, words["flight"][k], units[k]) for k in units})
    rows = (
        [(round(c.real * 10**15) * 10**15, round(c.imag * 10**15) * 10**15) for c in row]
        for row in curve
    )
    return (near, x, w), (flight, *(fourier.Function(other, row, 0) for row in rows))


@pytest.fixture(scope="module")
def flown(written):
    """The image of the curve by the checker, and the slopes with which roots were enclosed."""
    slopes, root = [], checker.root
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checker, "root", lambda *given: slopes.append(given[2]) or root(*given))
        return checker.over(FIFTH, *written[1]), slopes


def test_functions(written, flown):
    """Both implementations, at places of a curve; tangents against differences."""
    near, x, w = written[0]
    with interval.workprec(160):
        image = near(x, w)
        one, nothing = x.circle.constant(1), x.circle.constant(0)
        columns = [image.tangent(z) for z in ((one, nothing), (nothing, one))]
    there, constant = flown[0], written[1][1].circle.constant
    others = [there.tangent((constant(p), constant(q))) for p, q in ((1, 0), (0, 1))]
    for theta in (0.0, 1.0, 2.5, 4.0):
        t, v = theta + value(x, theta), math.sqrt(2 * value(w, theta))
        later, u = bounced(t, v)
        step = spanning.Ball(A).image(np.array([t]), np.array([v * v / 2]))
        expected = [later - theta, u * u / 2, *(float(entry[0]) for entry in step.derivative)]
        for f, functions in (
            (value, [image.x, image.v, columns[0][0], columns[1][0], columns[0][1], columns[1][1]]),
            (
                value_there,
                [there.x, there.y, others[0][0], others[1][0], others[0][1], others[1][1]],
            ),
        ):
            found = [f(g, theta) for g in functions]
            assert found == pytest.approx(expected, abs=1e-7)
    assert image.x.error < 1e-8
    assert there.x.error < 10**22


def test_slopes(written, flown):
    """Of v^2 and of the height, for all v and s not farther from the hints than e."""
    flight, x, _ = written[1]
    for e in (0.0, 0.1):
        of_speed, of_height = (slope(round(e * x.circle.unit)) for slope in flown[1])
        for theta in (0.0, 1.0, 2.5, 4.0):
            t, v, s = theta + value_there(x, theta), *(value_there(f, theta) for f in flight[::2])
            for moved in (-e, e):
                rate = v + A * math.cos(t) - (s + moved) - A * math.cos(t + s + moved)
                for slope, expected in ((of_speed, 2 * (v + moved)), (of_height, rate)):
                    far = abs(value_there(slope, theta) - expected)
                    assert far <= slope.error / x.circle.unit + 1e-9
        assert max(of_speed.error, of_height.error) < 3 * e * x.circle.unit + 10**22


def test_no_orbit_passes(curve):
    """In floats: from below none gets above."""
    v = np.sqrt(2 * curve.values()[1])
    random = seeded(8)
    for _ in range(5):
        t, u = random.uniform(0, 7), float(v.min()) - random.uniform(0.01, 0.5)
        for _ in range(60):
            t, u = bounced(t, u)
            assert u < float(v.max()) + 1e-3
