"""Maps of the cylinder: which are ones, curves against orbits in floats, what orbits reach."""

import math
from fractions import Fraction

import numpy as np
import pytest
from support import seeded

from cap import Map, variables
from cap.checker.coverings.formulas import FORMULAS, formulas
from cap.checker.kernel import fourier
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.checker.tori import kicked as checker
from cap.errors import BadInput, NotProved
from cap.floats.search import spanning
from cap.proofs.map_horseshoe import as_parameters
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.sets.interval import Ball, ComplexBall
from cap.tori.kicked import Kicked, mean, reached

x, y, cos, sin, pi = variables("x y cos sin pi")
HALF = Fraction(1, 2)
KICK = HALF * sin - 2 * cos * sin + cos**2 - HALF
AFTER = y + KICK


def mapped(first, second):
    """Return a map by its images."""
    return Map("x y", {"x": first, "y": second})


GENERAL = mapped(x - 2 * AFTER + Fraction(1, 3), AFTER)
STANDARD = mapped(x + y + HALF * sin, y + HALF * sin)


def kick(t):
    """Return q in floats."""
    return 0.5 * math.sin(t) - 2 * math.cos(t) * math.sin(t) + math.cos(t) ** 2 - 0.5


def slope(t):
    """Return q' in floats."""
    return 0.5 * math.cos(t) - 2 * math.cos(2 * t) - math.sin(2 * t)


def value(u, theta):
    """Return the value of a polynomial, in floats."""
    n = u.circle.degree
    terms = (complex(c.mid()) * np.exp(1j * k * theta) for k, c in enumerate(u.coefficients, -n))
    return sum(terms).real


def test_the_map_and_its_derivative():
    """At points of random curves, against the formula in floats; in the checker, too."""
    random, circle = seeded(5), Circle(32, Fraction(1, 20))
    given = Kicked.of(GENERAL)
    assert (given.b, given.c) == (-2, Fraction(1, 3))
    rows = [[random.uniform(-0.1, 0.1) for _ in range(4)] for _ in range(4)]
    with interval.workprec(128):
        u, v, a, b = (circle.real([ComplexBall(c) for c in row]) for row in rows)
        image = given.over(circle)(u, v)
        tangent = image.tangent((a, b))
    other = fourier.Circle(32, Fraction(1, 20), 30)
    U, V, A, B = (
        fourier.Function(other, [(round(c * 10**6) * 10**24, 0) for c in row], 0) for row in rows
    )
    g = checker.Kicked.of(formulas(matched(as_parameters(GENERAL), FORMULAS, "")))
    there = g.over(U, V)
    moved = there.tangent((A, B))
    for theta in (0.0, 1.0, 2.5, 4.0):
        x0, y0, a0, b0 = (value(w, theta) for w in (u, v, a, b))
        y1 = y0 + kick(theta + x0)
        pushed = b0 + slope(theta + x0) * a0
        for found, expected in (
            (image.x, x0 - 2 * y1 + 1 / 3),
            (image.v, y1),
            (tangent[0], a0 - 2 * pushed),
            (tangent[1], pushed),
        ):
            assert value(found, theta) == pytest.approx(expected, abs=1e-12)
        for function, expected in zip(
            (there.x, there.y, *moved), (x0 - 2 * y1 + 1 / 3, y1, a0 - 2 * pushed, pushed),
            strict=True,
        ):  # fmt: skip
            modes = [complex(p / 10**30, q / 10**30) for p, q in function.coefficients]
            turned = sum((c * np.exp(1j * k * theta)).real for k, c in enumerate(modes) if k)
            assert modes[0].real + 2 * turned == pytest.approx(expected, abs=1e-4)
            assert function.error < 10**20


@pytest.mark.parametrize(
    ("given", "why", "said"),
    [
        (mapped(x + y, y + sin * x), "is not", "kicked"),
        (mapped(x + y + sin, y + 2 * sin), "is not", "b y"),
        (mapped(2 * x + y, y), "is not", "b y"),
        (mapped(x + y * y, y), "is not", "b y"),
        (mapped(x + 1, y + sin), "does not twist|is not", "twist|b y"),
        (mapped(x, y + sin), "does not twist", "twist"),
        (mapped(x + y + sin + 1, y + sin + 1), "mean", "mean"),
        (mapped(x + y + cos**2, y + cos**2), "mean", "mean"),
        (mapped(x + y + pi * sin, y + pi * sin), "rational", "kicked"),
        (mapped(x + y + pi + sin, y + sin), "rational", "b y"),
    ],
)
def test_what_is_no_such_map(given, why, said):
    """Refused, by the prover and by the checker."""
    with pytest.raises(BadInput, match=why):
        Kicked.of(given)
    with pytest.raises(Rejected, match=said):
        checker.Kicked.of(formulas(matched(as_parameters(given), FORMULAS, "")))


@pytest.mark.parametrize(
    "q", [cos**2, cos**4 * sin**2, sin**6, cos**3 * sin**2, cos * sin**3, KICK, KICK + 7]
)
def test_means(q):
    """Against a sum over a grid, which is exact for so low a degree."""
    given = as_parameters(mapped(x + y, y + q))
    read = formulas(matched(given, FORMULAS, "")).image[1]
    t = 2 * np.pi * np.arange(16) / 16
    total = sum(
        float(c) * np.cos(t) ** dict(m).get("cos", 0) * np.sin(t) ** dict(m).get("sin", 0)
        for m, c in Map("x y", {"x": x, "y": q + 0 * y}).image["y"].terms.items()
    )
    expected = float(np.mean(total))
    assert float(mean(Map("x y", {"x": x, "y": q + 0 * y}).image["y"])) == pytest.approx(expected)
    without = type(read)({m: c for m, c in read.terms.items() if "y" not in m})
    assert float(checker.mean(without)) == pytest.approx(expected)


@pytest.mark.slow
def test_curves_in_floats():
    """They are invariant, also where the map has no symmetry; beyond the last one none is found."""
    golden = (math.sqrt(5) - 1) / 2
    for at in (
        spanning.Kicked(1.0, 0.0, [(0.9, 0, 1)]),
        spanning.Kicked(-2.0, 0.3, [(0.1, 0, 1), (0.05, 1, 1), (-0.02, 1, 0)]),
    ):
        curve, rate = spanning.found(at, 2 * math.pi * golden)
        _, error = spanning.improved(at, curve, 2 * math.pi * golden)
        assert error < 1e-12
        assert 0.05 < rate <= 0.8
        theta = 2 * math.pi * np.arange(4 * curve.modes) / (4 * curve.modes)
        u, v = curve.values()
        a, b = theta[5] + u[5], v[5]
        turned = 0.0
        for _ in range(3000):
            b = b + float(at.kick(np.array(a))[0])
            a, turned = a + at.b * b + at.c, turned + at.b * b + at.c
            assert v.min() - 1e-5 < b < v.max() + 1e-5
        off = (turned / (2 * math.pi * 3000) - golden + 0.5) % 1 - 0.5
        assert abs(off) < 1e-3
    with pytest.raises(NotProved, match="no curve"):
        spanning.found(spanning.Kicked(1.0, 0.0, [(1.2, 0, 1)]), 2 * math.pi * golden)


def test_how_far_orbits_get():
    """For K = 3/2 past 2π, so no curve is in between; not where the precision is used up."""
    start = Fraction(1, 1000), Fraction(0)
    wild = Kicked.of(mapped(x + y + 3 * HALF * sin, y + 3 * HALF * sin))
    with interval.workprec(2000):
        low = reached(Kicked.of(STANDARD), *start, 2000)
        assert Ball("0.9") < low < 2 * interval.pi() - Ball("3.577")
        assert reached(wild, *start, 3000) > 2 * interval.pi()
    with interval.workprec(128):
        assert reached(wild, *start, 3000) < 2 * interval.pi()
