"""Periodic orbits along paths of coverings: linear maps, those stored, and lies."""

import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from cap.checker.coverings import orbits
from cap.checker.coverings.entropy import ORBITS
from cap.checker.coverings.formulas import Map
from cap.checker.coverings.orbits import Round, confirm_orbit, confirm_orbits, images, nearness
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Enclosure, matched
from checker.altered import changed, decimal, rejected, verify
from checker.linear import Linear
from checker.test_checker_formulas import given

STORED = Path(__file__).parents[2] / "certificates"
CERTIFICATE = json.loads((STORED / "horseshoe-2.json").read_text("utf-8"))
FOUND = CERTIFICATE["claims"]["orbits"]
SQUARE = [Fraction(n) for n in (0, 0, 1, 0, 0, 1)]
SMALL = [Fraction(n, 1000) for n in (0, 0, 1, 0, 0, 1)]


def read(*listed):
    """Return orbits as the checker reads them: paths, and the ends of a square box."""
    boxes = [
        {"path": list(map(str, path)), "box": [[str(low), str(high)]] * 2}
        for path, low, high in listed
    ]
    return matched(boxes, ORBITS.shape.shape, "orbits")


def test_the_saddle_of_a_linear_map():
    """Its box is small or large, and around 0 somewhere."""
    for low, high in (("-1e-9", "1e-9"), ("-0.99", "0.99"), ("-0.9", "0.01")):
        ends = decimal(Fraction(low)), decimal(Fraction(high))
        confirm_orbits(Linear(), [SQUARE], [[0]], read(([0], *ends)))


@pytest.mark.parametrize(
    ("g", "sets", "found", "why"),
    [
        (Linear(), [SQUARE], ([1], "-0.1", "0.1"), "to no set"),
        (Linear(), [SQUARE, SQUARE], ([0, 1], "-0.1", "0.1"), "no covering"),
        (Linear(), [SMALL], ([0], "-0.1", "0.1"), "leave its sets"),
        (Linear(), [SQUARE], ([0, 0], "-0.1", "0.1"), "its least"),
        (Linear(3.0, 0.0, 0.0, 2.0), [SQUARE], ([0], "-0.1", "0.1"), "a saddle"),
        (Linear(0.5, 0.0, 0.0, 0.2), [SQUARE], ([0], "-0.1", "0.1"), "a saddle"),
        (Linear(1.0, 0.0, 0.0, 0.2), [SQUARE], ([0], "-0.1", "0.1"), "a saddle"),
        (Linear(0.8, -0.6, 0.6, 0.8), [SQUARE], ([0], "-0.1", "0.1"), "a saddle"),
        (Linear(), [SQUARE], ([0], "0.1", "0.2"), "one fixed point"),
        (Linear(), [SQUARE], ([0], "0", "0.2"), "one fixed point"),
    ],
)
def test_what_is_none(g, sets, found, why):
    """No path, no point, no saddle, a point on the side of its box."""
    with pytest.raises(Rejected, match=why):
        confirm_orbits(g, sets, [[0]], read(found))


def test_one_orbit_twice():
    """With the same box, and with another one."""
    for other in (("-0.1", "0.1"), ("-0.2", "0.1")):
        with pytest.raises(Rejected, match="the same"):
            confirm_orbits(Linear(), [SQUARE], [[0]], read(([0], "-0.1", "0.1"), ([0], *other)))


def test_one_orbit_begun_elsewhere():
    """An orbit of period 3 of the Hénon map, and its second point."""
    g, n = Map(given("henon", a="5")), 3
    stored = json.loads((STORED / "map_horseshoe-3.json").read_text("utf-8"))
    one = next(o for o in stored["claims"]["orbits"] if len(o["path"]) == n)
    path = one["path"][1:] + one["path"][:1]
    (orbit,) = matched([one], ORBITS.shape.shape, "orbits")
    sets = [[Fraction(q) for q in numbers] for numbers in stored["hints"]["sets"]]
    edges = [[int(j) for j in to] for to in stored["hints"]["coverings"]]
    x, y = confirm_orbit(g, sets, edges, orbit["path"], orbit["box"]).boxes[1]
    box = [[decimal(Fraction(q.mid) + s * Fraction(1, 10**7)) for s in (-1, 1)] for q in (x, y)]
    again = {"path": path, "box": box}
    confirm_orbits(g, sets, edges, matched([again], ORBITS.shape.shape, "orbits"))
    with pytest.raises(Rejected, match="the same"):
        confirm_orbits(g, sets, edges, matched([one, again], ORBITS.shape.shape, "orbits"))


def test_a_degenerate_point():
    """Dg^n - 1 is singular: there is nothing to divide by."""
    zero, one = Double(0.0), Double(1.0)
    box = Double(0.0, 0.1), Double(0.0, 0.1)
    with pytest.raises(Rejected, match="degenerate"):
        nearness(box, Round([box, box], (zero, zero), ((one, zero), (zero, one))))


def test_how_far_a_fixed_point_is():
    """Dg^n is about diag(3, 1/2), so C = diag(1/2, -2): not less than in fractions."""
    source, zero = np.random.default_rng(11), Double(0.0)
    for _ in range(20):
        far, r, wide = (source.uniform(1e-6, 1e-3, 2).tolist() for _ in range(3))
        box = Double(0.0, r[0]), Double(0.0, r[1])
        D = (Double(3.0, wide[0]), zero), (zero, Double(0.5, wide[1]))
        found = nearness(box, Round([box, box], (Double(far[0]), Double(far[1])), D))
        for k, c in enumerate((Fraction(1, 2), Fraction(2))):
            exact = c * (Fraction(far[k]) + Fraction(wide[k]) * Fraction(r[k]))
            assert 0 <= Fraction(found[k]) - exact < Fraction(1, 10**12)


def test_images_contain_those_of_points():
    """Eight times, of random boxes of the Hénon map: points, the midpoint, and the derivative."""
    g, source = Map(given("henon")), np.random.default_rng(5)
    for _ in range(60):
        x, y, size = *source.uniform(-0.5, 0.5, 2), 10.0 ** source.uniform(-9, -3)
        found = images(g, [0] * 8, (Double(float(x), float(size)), Double(float(y), float(size))))
        u, v = x + size * source.uniform(-1, 1), y + size * source.uniform(-1, 1)
        D = np.eye(2)
        for box in found.boxes[1:]:
            D = np.array([[-2.8 * u, 1.0], [0.3, 0.0]]) @ D
            u, v = 1 - 1.4 * u * u + v, 0.3 * u
            for value, side in zip((u, v), box, strict=True):
                assert side.lower - 1e-13 <= value <= side.upper + 1e-13
        for value, entry in zip(D.ravel(), sum(found.derivative, ()), strict=True):
            assert entry.lower - 1e-9 <= value <= entry.upper + 1e-9
        assert found.boxes[-1][0].lower <= found.middle[0].mid <= found.boxes[-1][0].upper


def test_those_stored():
    """They are told, with their periods; the paths are closed paths of coverings."""
    assert any("periodic orbits" in step for step in verify(CERTIFICATE))
    edges = CERTIFICATE["hints"]["coverings"]
    for orbit in FOUND:
        path = orbit["path"]
        assert all(j in edges[int(i)] for i, j in pairwise([*path, path[0]]))


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("k", [0, len(FOUND) - 1])
def test_a_box_moved(k, side, monkeypatch):
    """By its width; the other conditions are not looked at again."""
    monkeypatch.setattr("cap.checker.coverings.entropy.confirm_coverings", lambda *_: 0)
    low, high = map(Fraction, FOUND[k]["box"][side])
    for by in (high - low, low - high):
        moved = [decimal(low + by), decimal(high + by)]
        rejected(changed(CERTIFICATE, "claims", "orbits", k, "box", side, moved), "orbit|fixed")
    wide = [decimal(low - Fraction(1, 2)), decimal(high + Fraction(1, 2))]
    rejected(changed(CERTIFICATE, "claims", "orbits", k, "box", side, wide), ".")


def test_other_paths(monkeypatch):
    """A path turned around, one of another orbit, one orbit twice, a number too large."""
    monkeypatch.setattr("cap.checker.coverings.entropy.confirm_coverings", lambda *_: 0)
    lie = lambda *path_and_value: changed(CERTIFICATE, "claims", "orbits", *path_and_value)  # noqa: E731
    k = next(k for k, orbit in enumerate(FOUND) if len(orbit["path"]) > 2)
    rejected(lie(k, "path", FOUND[k]["path"][::-1]), "no covering")
    rejected(lie(k, "path", FOUND[0]["path"]), "leave|fixed|saddle")
    rejected(lie(0, "path", ["99999"]), "between 0|to no set")
    twice = changed(CERTIFICATE, "claims", "orbits", [FOUND[k], FOUND[k]])
    rejected(twice, "the same")
    rejected(lie(0, "box", 0, ["-1" + "0" * 31, "1"]), "larger")
    rejected(changed(CERTIFICATE, "claims", "orbits", []), "list of 1")


def test_numbers_that_are_none():
    """A box that may be the same is one, whatever its numbers are."""
    assert orbits._meet(Double(float("nan")), Double(0.0))
    assert not orbits._meet(Double(2.0), Double(0.0, 1.0))


@pytest.mark.parametrize("name", ["map_horseshoe-1", "map_horseshoe-2", "map_horseshoe-3"])
def test_those_of_maps_by_newtons_method(name):
    """Without the checker's map, in floats: a fixed point of the iterate in each box, a saddle."""
    stored = json.loads((STORED / f"{name}.json").read_text("utf-8"))
    a = 5.0 if name == "map_horseshoe-3" else 1.4

    def step(x, y):
        if name == "map_horseshoe-2":
            kick = y + 2 * np.sin(x)
            images = (np.angle(np.exp(1j * (x + kick))), np.angle(np.exp(1j * kick)))
            return images, np.array([[1 + 2 * np.cos(x), 1], [2 * np.cos(x), 1]])
        return (1 - a * x * x + y, 0.3 * x), np.array([[-2 * a * x, 1], [0.3, 0]])

    for orbit in stored["claims"]["orbits"]:
        box = np.array([[float(q) for q in side] for side in orbit["box"]])
        z = box.mean(axis=1)
        for _ in range(8):
            (x, y), D = z, np.eye(2)
            for _ in orbit["path"]:
                (x, y), J = step(x, y)
                D = J @ D
            z = z - np.linalg.solve(D - np.eye(2), np.array([x, y]) - z)
        assert np.abs(np.array([x, y]) - z).max() < 1e-8
        assert (box[:, 0] < z).all()
        assert (z < box[:, 1]).all()
        assert (1 + np.linalg.det(D)) ** 2 < np.trace(D) ** 2


def test_intervals_that_touch_meet():
    """One common point is enough, and a few roundings are allowed for."""
    for p, q in ((Double(0.0, 1.0), Double(2.0, 1.0)), (Double(-0.3, 0.1), Double(0.1, 0.3))):
        assert orbits._meet(p, q)
        assert orbits._meet(q, p)
        assert not orbits._meet(p, Double(q.mid + 1e-9, q.rad))


@pytest.mark.parametrize("q", [Fraction(1, 3), Fraction(1, 10)])
def test_a_side_that_is_no_double(q):
    """Its double is below a third, and above a tenth; the interval contains both."""
    found = orbits._interval(Enclosure(q, q, ("", "")))
    assert abs(q - Fraction(found.mid)) <= Fraction(found.rad)
    assert found.rad < 1e-16
