"""Maps given by formulas: enclosures, coverings of which all is known, and what is no map."""

import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.formulas import FORMULAS, Map, formulas
from cap.checker.kernel.doubles import between
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.proofs.map_horseshoe import as_parameters
from cap.system.files import planar

MAPS = Path(__file__).parents[2] / "examples/maps"


def given(name, **values):
    """Return the map of an example as the checker reads it."""
    listed = as_parameters(planar(MAPS / f"{name}.py", values))
    return formulas(matched(listed, FORMULAS, "map"))


def henon(x, y):
    """Return the Hénon map and its derivative."""
    return (1 - 1.4 * x * x + y, 0.3 * x), ((-2.8 * x, 1.0), (0.3, 0.0))


def standard(x, y):
    """Return the standard map on the square, and its derivative."""
    v = math.remainder(y + 2 * math.sin(x), 2 * math.pi)
    k = 2 * math.cos(x)
    return (math.remainder(x + v, 2 * math.pi), v), ((1 + k, 1.0), (k, 1.0))


def inside(value, enclosure):
    """Return whether a double lies in an enclosure, up to its own rounding."""
    return enclosure.lower - 1e-14 <= value <= enclosure.upper + 1e-14


@pytest.mark.parametrize(("name", "plain"), [("henon", henon), ("standard", standard)])
def test_images_contain_those_of_points(name, plain):
    """Of random boxes, values and derivatives at random points."""
    g, source, tried = Map(given(name)), np.random.default_rng(3), 0
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


def test_powers_of_both_and_of_the_clock():
    """The derivative of a polynomial of degree 4 is that of differences; pi is the number."""
    image = {"u": [["2", "u", "w", "cos", "sin"]], "w": [["1", "pi"], ["-1", "u", "u", "w"]]}
    g = Map(formulas(matched({"state": ["u", "w"], "image": image}, FORMULAS, "map")))
    u, w, h = 0.7, -0.4, 1e-5
    at = g.image(between(u, u), between(w, w))
    assert inside(2 * u * w * math.cos(u) * math.sin(u), at.x)
    assert inside(math.pi - u * u * w, at.y)
    for k, (du, dw) in enumerate(((h, 0), (0, h))):
        up = g.image(between(u + du, u + du), between(w + dw, w + dw))
        down = g.image(between(u - du, u - du), between(w - dw, w - dw))
        for row, one, other in zip(at.derivative, up[:2], down[:2], strict=True):
            assert abs((one.mid - other.mid) / (2 * h) - row[k].mid) < 1e-8


def test_cuts_of_the_square():
    """A box at a cut, or whose image is at one, is refused."""
    g = Map(given("standard"))
    for x, y in ((3.2, 0.0), (0.0, -3.2), (0.0, math.pi), (1.0, math.pi - 2 * math.sin(1.0))):
        with pytest.raises(Rejected, match="cut"):
            g.image(between(x, x + 1e-6), between(y - 1e-6, y + 1e-6))


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"state": ["x", "x"]}, "one name"),
        ({"state": ["x", "cos"]}, "free name"),
        ({"image": {"x": [["1", "x"]]}}, "not every coordinate"),
        ({"image": {"x": [["1", "z"]], "y": [["1"]]}}, "unknown variable"),
        ({"image": {"x": [["1", "x"], ["2", "x"]], "y": [["1"]]}}, "twice"),
        ({"torus": "1", "image": {"x": [["1/2", "x"]], "y": [["1"]]}}, "multiples of 2 pi"),
        ({"torus": "1", "image": {"x": [["1", "x", "sin"]], "y": [["1"]]}}, "multiples of 2 pi"),
        ({"torus": "yes"}, "none of"),
        ({"more": "1"}, "unknown fields"),
    ],
)
def test_what_is_no_map(change, why):
    """Names, images, a torus on which the map would depend on turns."""
    plane = {"state": ["x", "y"], "image": {"x": [["1", "y"]], "y": [["1", "x"]]}}
    with pytest.raises(Rejected, match=why):
        formulas(matched(plane | change, FORMULAS, "map"))


def test_it_is_printed():
    """As people write it, cos and sin with their angle."""
    assert str(given("henon")) == "(x, y) -> (1 - 7/5 x x + y, 3/10 x) of the plane"
    assert "2 sin(x)" in str(given("standard"))


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
    g, F = Map(given("henon", a=6)), Fraction
    places = (F(-13, 20), F(-3, 25)), (F(3, 25), F(13, 20)), (F(-1, 5), F(1, 5))
    left, right, gap = sets(places)
    for source in (left, right):
        covers(g, source, [left, right])
    with pytest.raises(Rejected):
        covers(g, gap, [left])
