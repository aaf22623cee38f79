"""Cones along coverings: linear maps, strips with all their points, the one stored, and lies."""

import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from cap.checker.coverings import cones, entropy
from cap.checker.coverings.cones import carried, cone, rates, strip
from cap.checker.coverings.covering import Box, Parallelogram
from cap.checker.coverings.entropy import cone_rates
from cap.checker.coverings.formulas import Map
from cap.checker.coverings.planar import Planar
from cap.checker.kernel.certificate import read
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import words
from checker.altered import changed, decimal, encode, rejected, verify
from checker.linear import Linear
from checker.test_checker_formulas import given

STORED = Path(__file__).parents[2] / "certificates"
CERTIFICATE = json.loads((STORED / "map_horseshoe-3.json").read_text("utf-8"))
WITH_UNITS = json.loads((STORED / "horseshoe-3.json").read_text("utf-8"))
SETS = [[Fraction(q) for q in numbers] for numbers in CERTIFICATE["hints"]["sets"]]
EDGES = [[int(j) for j in to] for to in CERTIFICATE["hints"]["coverings"]]
ALONG = Fraction(0), Fraction(0)
ONE = Fraction(1)


def square(x=0, y=0, a=1):
    """Return a parallelogram with axes along the coordinates."""
    return Parallelogram([Fraction(n) for n in (x, y, a, 0, 0, a)])


def of(g, here=(ONE, ONE, ONE), there=(ONE, ONE, ONE)):
    """Return the rates of the covering of a square by itself, in units before and after."""
    (A,) = carried(g, square(), [square()])
    return rates(A, cone(ALONG, ONE, here), cone(ALONG, ONE, there))


def test_rates_of_linear_maps():
    """Those of the axes; less if the axes are turned against each other."""
    for g in (Linear(), Linear(-3.0, 0.0, 0.0, -0.25)):
        stretch, shrink = of(g)
        assert 3 - 1e-12 < stretch <= 3
        assert 0.25 <= shrink < 0.25 + 1e-12
    stretch, shrink = of(Linear(3.0, 0.5, 0.25, 0.25))
    assert 2.5 - 1e-12 < stretch <= 2.5
    assert 0.5 <= shrink < 0.5 + 1e-12


@pytest.mark.parametrize(
    ("g", "why"),
    [
        (Linear(3.0, 0.0, 5.0, 0.25), "mapped into a cone"),
        (Linear(0.9, 0.0, 0.0, 0.25), "stretched"),
        (Linear(3.0, 0.0, 0.0, 1.5), "shrunk"),
        (Linear(3.0, 0.0, 0.0, 0.0), "regular"),
    ],
)
def test_no_cones(g, why):
    """Each inequality refuses something."""
    with pytest.raises(Rejected, match=why):
        of(g)


def test_rates_in_units():
    """Numbers are divided by units; the slopes of cones are those of the set they begin in."""
    g, units = Linear(3.0, 0.5, 0.25, 0.25), [Fraction(n) for n in (1, 2, 4)]
    assert 2 - 1e-12 < of(g, units, [Fraction(1), Fraction(5, 2), Fraction(4)]).stretch <= 2
    assert 0.5 <= of(g, units, units).shrink < 0.5 + 1e-12
    with pytest.raises(Rejected, match="shrunk"):
        of(g, units)
    flat = [Fraction(1, 2), Fraction(1), Fraction(1)]
    stretch, shrink = of(g, flat)
    assert 2.75 - 1e-12 < stretch <= 2.75
    assert 0.75 <= shrink < 0.75 + 1e-12
    with pytest.raises(Rejected, match="mapped into a cone"):
        of(g, (ONE, ONE, ONE), [Fraction(1, 10), ONE, ONE])


class Nowhere(Planar):
    """A map that is not defined."""

    def image(self, x, y):  # noqa: ARG002
        """Reject."""
        raise Rejected("nowhere")


def test_no_strip(monkeypatch):
    """What is mapped elsewhere, what is not defined, what needs too many pieces."""
    with pytest.raises(Rejected, match="no point"):
        strip(Linear(), square(), square(5))
    with pytest.raises(Rejected, match="defined, or has a fold"):
        strip(Nowhere(), square(), square())
    with pytest.raises(Rejected, match="fold"):
        strip(Linear(0.0, 1.0, 1.0, 0.0), square(), square())
    monkeypatch.setattr(cones, "MOST", 2)
    with pytest.raises(Rejected, match="more than"):
        strip(Linear(), square(), square())


def test_parts_cover_a_strip():
    """They follow each other along both sides, from end to end."""
    S = Box(-0.5, 0.3, 0.5, 0.6)
    parts = list(cones._cut(S))
    for first, last, a, b in (("p0", "p1", S.p0, S.p1), ("q0", "q1", S.q0, S.q1)):
        sides = sorted({(getattr(part, first), getattr(part, last)) for part in parts})
        assert sides[0][0] == a
        assert sides[-1][1] == b
        assert all(low < high for low, high in sides)
        assert all(one[1] == two[0] for one, two in pairwise(sides))
        assert len(sides) == cones.PARTS
    assert len({*parts}) == cones.PARTS**2


def test_a_strip_has_all_points():
    """Random points of sets with images in another set; the matrices at these and between them."""
    g, source, seen = Map(given("henon", a="5")), np.random.default_rng(11), 0
    for i in (0, 7, 100, 279):
        P, targets = Parallelogram(SETS[i]), [Parallelogram(SETS[j]) for j in EDGES[i]]
        here = np.array([float(q) for q in SETS[i]])
        A = np.array([[here[2], here[4]], [here[3], here[5]]])
        for j, target, b in zip(EDGES[i], targets, carried(g, P, targets), strict=True):
            there = np.array([float(q) for q in SETS[j]])
            back = np.linalg.inv(np.array([[there[2], there[4]], [there[3], there[5]]]))
            S, kept = strip(g, P, target), []
            place = source.uniform(-1, 1, (40_000, 2))
            x, y = here[:2, None] + A @ place.T
            inside = np.abs(back @ (np.array([1 - 5 * x * x + y, 0.3 * x]) - there[:2, None])) <= 1
            kept = place[inside.all(axis=0)]
            assert S.p0 <= kept[:, 0].min() <= kept[:, 0].max() <= S.p1
            assert S.q0 <= kept[:, 1].min() <= kept[:, 1].max() <= S.q1
            for p in (*kept[:20], *((kept[:20] + kept[-20:]) / 2)):
                x = here[0] + A[0] @ p
                found = back @ np.array([[-10 * x, 1.0], [0.3, 0.0]]) @ A
                for value, entry in zip(found.ravel(), sum(b, ()), strict=True):
                    assert entry.lower - 1e-9 <= value <= entry.upper + 1e-9
                seen += 1
    assert seen > 100


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stored", "where"),
    [(CERTIFICATE, "directions of each set exp"), (WITH_UNITS, "each set, in units of each, exp")],
)
def test_those_stored(stored, where):
    """Conjugate, hyperbolic: said with the rates."""
    assert any("one orbit only" in step for step in verify(stored))
    line = words(read(encode(stored)))
    assert "conjugate to the two-sided subshift" in line
    assert "hyperbolic" in line
    assert where in line
    assert stored["claims"]["cones"]["stretch"] in line


MATRICES_OF, MATRICES = entropy.matrices_of, {}
"""Those of the coverings by a set, computed once: cones change none."""


def matrices_once(g, sets, edges, i):
    """Return what the checker does, for the systems of this file."""
    key = type(g), *map(tuple, (sets[i], *(sets[j] for j in edges[i])))
    if key not in MATRICES:
        MATRICES[key] = MATRICES_OF(g, sets, edges, i)
    return MATRICES[key]


@pytest.fixture
def only_cones(monkeypatch):
    """Let the checker look at cones only: not at the coverings, nor at periodic orbits again."""
    monkeypatch.setattr("cap.checker.coverings.entropy.confirm_coverings", lambda *_: 0)
    monkeypatch.setattr("cap.checker.coverings.entropy.confirm_orbits", lambda *_: None)
    monkeypatch.setattr("cap.checker.coverings.entropy.matrices_of", matrices_once)


@pytest.mark.parametrize(("name", "by"), [("stretch", 1), ("shrink", -1)])
def test_a_unit_more(name, by, only_cones):
    """Both rates are as good as their last digits allow."""
    value = CERTIFICATE["claims"]["cones"][name]
    other = decimal(Fraction(value) + Fraction(by, 10**4), 4)
    rejected(changed(CERTIFICATE, "claims", "cones", name, other), "as claimed")


@pytest.mark.parametrize(("name", "value"), [("stretch", "1"), ("shrink", "1")])
def test_rates_of_nothing(name, value, only_cones):
    """Nothing is stretched by 1."""
    rejected(changed(CERTIFICATE, "claims", "cones", name, value), "as claimed")


def test_other_directions(only_cones):
    """Of one set."""
    for other in (["2", "0"], ["0", "2"], ["0", "1"]):
        lie = changed(CERTIFICATE, "hints", "cones", "leaning", 0, other)
        rejected(lie, "cone|as claimed|zero")


@pytest.mark.parametrize("which", [0, 1, 2])
def test_other_units(which, only_cones):
    """A set with another slope, or another unit of one of its coordinates."""
    k = next(k for k, to in enumerate(WITH_UNITS["hints"]["coverings"]) if len(to) > 1)
    row = WITH_UNITS["hints"]["cones"]["units"][k]
    for factor in (1000, Fraction(1, 1000)):
        other = [str(q) for q in row]
        other[which] = decimal(Fraction(row[which]) * factor, 12)
        lie = changed(WITH_UNITS, "hints", "cones", "units", k, other)
        rejected(lie, "cone|as claimed|stretched|shrunk")


def test_no_units(only_cones):
    """None at all."""
    without = changed(WITH_UNITS, "hints", "cones", "slope", "1")
    del without["hints"]["cones"]["units"]
    rejected(without, "cone|stretched|shrunk")


def test_units_that_are_none():
    """Not positive, too large, too few."""
    given_ = WITH_UNITS["hints"]["cones"]["units"]
    for value in ("0", "-1", "1000001"):
        lie = changed(WITH_UNITS, "hints", "cones", "units", 0, ["1", value, "1"])
        rejected(lie, "a unit of a set")
    rejected(changed(WITH_UNITS, "hints", "cones", "units", given_[:-1]), "units for each")


def test_what_is_not_of_the_form():
    """Claimed or given alone; too flat, too steep, too few."""
    for part in ("claims", "hints"):
        lie = changed(CERTIFICATE, part, "cones", None)
        del lie[part]["cones"]
        rejected(lie, "not both")
    given_ = CERTIFICATE["hints"]["cones"]["leaning"]
    for slope in ("0", "1001"):
        rejected(changed(CERTIFICATE, "hints", "cones", "slope", slope), "slope of the cones")
    rejected(changed(CERTIFICATE, "hints", "cones", "leaning", given_[:-1]), "one pair")
    rejected(changed(CERTIFICATE, "hints", "cones", "leaning", 0, ["1001", "0"]), "steeper")


def test_sets_that_overlap(only_cones):
    """Cones say nothing of conjugacy there."""
    lie = json.loads((STORED / "horseshoe-2.json").read_text("utf-8"))
    lie["claims"]["cones"] = {"stretch": "1.1", "shrink": "0.9"}
    leaning = [["0", "0"]] * len(lie["hints"]["sets"])
    lie["hints"]["cones"] = {"slope": "1", "leaning": leaning}
    rejected(lie, "not disjoint")


def test_the_worst_covering_decides():
    """The rates of a family are those of its worst covering."""
    good, bad = ((Double(4.0), Double(0.0)), (Double(0.0), Double(0.1))), (
        (Double(2.0), Double(0.0)), (Double(0.0), Double(0.5)))  # fmt: skip
    found = cone_rates([[good], [bad]], [[1], [0]], [cone(ALONG, ONE)] * 2)
    assert 1.99 < found.stretch <= 2
    assert 0.5 <= found.shrink < 0.51
