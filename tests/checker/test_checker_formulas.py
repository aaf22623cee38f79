"""Maps given by formulas: enclosures, and coverings of which all is known."""

import math
from fractions import Fraction

import numpy as np
import pytest

from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.formulas import Henon, Standard
from cap.checker.kernel.doubles import between
from cap.checker.kernel.rejection import Rejected

A, B, K = Fraction(7, 5), Fraction(3, 10), Fraction(2)


def henon(x, y):
    """Return the Hénon map and its derivative."""
    a, b = float(A), float(B)
    return (1 - a * x * x + y, b * x), ((-2 * a * x, 1.0), (b, 0.0))


def standard(x, y):
    """Return the standard map on the square, and its derivative."""
    v = math.remainder(y + 2 * math.sin(x), 2 * math.pi)
    k = 2 * math.cos(x)
    return (math.remainder(x + v, 2 * math.pi), v), ((1 + k, 1.0), (k, 1.0))


def inside(value, enclosure):
    """Return whether a double lies in an enclosure, up to its own rounding."""
    return enclosure.lower - 1e-14 <= value <= enclosure.upper + 1e-14


@pytest.mark.parametrize(("g", "plain"), [(Henon(A, B), henon), (Standard(K), standard)])
def test_images_contain_those_of_points(g, plain):
    """Of random boxes, values and derivatives at random points."""
    source, tried = np.random.default_rng(3), 0
    for _ in range(400):
        x, y = map(float, source.uniform(-3, 3, 2))
        size = float(source.choice([0.0, 1e-9, 1e-3, 0.1]))
        try:
            image = g.image(between(x, x + size), between(y, y + size))
        except Rejected:
            continue
        tried += 1
        p, q = x + size * float(source.random()), y + size * float(source.random())
        (u, v), rows = plain(p, q)
        assert inside(u, image.x)
        assert inside(v, image.y)
        for row, known in zip(rows, image.derivative, strict=True):
            assert all(map(inside, row, known))
    assert tried > 250


def test_cuts_of_the_square():
    """A box at a cut, or whose image is at one, is refused; b = 0 is no map of this kind."""
    g = Standard(K)
    for x, y in ((3.2, 0.0), (0.0, -3.2), (0.0, math.pi), (1.0, math.pi - 2 * math.sin(1.0))):
        with pytest.raises(Rejected, match="cut"):
            g.image(between(x, x + 1e-6), between(y - 1e-6, y + 1e-6))
    with pytest.raises(Rejected, match="not injective"):
        Henon(A, Fraction(0))


def sets(places):
    """Return the rectangles with x in [low, high] and |y| <= 1/4."""
    zero, rows = Fraction(0), []
    for low, high in places:
        x, half = (low + high) / 2, (high - low) / 2
        rows.append(Parallelogram([x, zero, half, zero, zero, Fraction(1, 4)]))
    return rows


def test_a_full_horseshoe():
    """At a = 6, b = 3/10 two strips cover each other and themselves, as Devaney and Nitecki have
    it; a strip that reaches into the gap does not."""
    g, F = Henon(Fraction(6), B), Fraction
    places = (F(-13, 20), F(-3, 25)), (F(3, 25), F(13, 20)), (F(-1, 5), F(1, 5))
    left, right, gap = sets(places)
    for source in (left, right):
        covers(g, source, [left, right])
    with pytest.raises(Rejected):
        covers(g, gap, [left])
