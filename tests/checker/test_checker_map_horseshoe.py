"""The theorem ``map_horseshoe``: what is true, and lies."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.theorems.map_horseshoe import MapHorseshoe
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

HENON = {
    "format": "cap-certificate/1",
    "theorem": "map_horseshoe",
    "digits": "6",
    "parameters": {
        "state": ["x", "y"],
        "image": {"x": [["1"], ["-6", "x", "x"], ["1", "y"]], "y": [["3/10", "x"]]},
    },
    "claims": {"growth": "2", "entropy": "0.69314718", "together": "1"},
    "hints": {
        "sets": [
            ["-0.385", "0", "0.265", "0", "0", "0.25"],
            ["0.385", "0", "0.265", "0", "0", "0.25"],
        ],
        "coverings": [["0", "1"], ["0", "1"]],
        "vector": ["1", "1"],
    },
    "cites": list(MapHorseshoe.CITES),
    "provenance": {},
}
"""A full horseshoe: the map of Hénon at a = 6, b = 3/10, with two strips."""

FILES = sorted((Path(__file__).parents[2] / "certificates").glob("map_horseshoe-*.json"))
STORED = {path.stem: json.loads(path.read_text("utf-8")) for path in FILES}


def test_it_is_verified():
    """The steps are told; the schema describes it; the sentence has its map and numbers."""
    assert len(verify(HENON)) > 4
    fits_the_schema(HENON)
    line = words(read(encode(HENON)))
    for part in ("(1 - 6 x x + y, 3/10 x) of the plane", "0.69314718", "one-sided subshift"):
        assert part in line


def test_sets_that_overlap():
    """Of two copies of a strip with no diamond the sentence claims no semiconjugacy."""
    sets = [*HENON["hints"]["sets"], ["0.386", "0", "0.2645", "0", "0", "0.25"]]
    given = changed(HENON, "hints", "sets", sets)
    given["hints"] |= {"coverings": [["0", "1"], ["0"], ["0"]], "vector": ["1", "1", "0"]}
    given["hints"]["coverings"][0] = ["0", "1"]
    given["claims"] |= {"growth": "1", "entropy": "0", "together": "2"}
    rejected(given, "covered by none")
    given["hints"]["coverings"][0] = ["1", "2"]
    rejected(given, "diamond")
    given["hints"] |= {"coverings": [["0", "1"], ["2"], ["0"]], "vector": ["20", "10", "14"]}
    given["claims"] |= {"growth": "7/5", "entropy": "0.33"}
    line = words(check(encode(given), lambda _: None))
    assert "without diamonds" in line
    assert "of g^n" not in line


def test_a_covering_invented():
    """Of a strip in the gap by others, or by itself."""
    gap = [*HENON["hints"]["sets"], ["0", "0", "0.1", "0", "0", "0.25"]]
    given = changed(HENON, "hints", "sets", gap)
    given["hints"] |= {"vector": ["1", "1", "1"]}
    given["hints"]["coverings"] = [["0", "1", "2"], ["0", "1"], ["0"]]
    rejected(given, "same side|boxes")


@pytest.mark.parametrize("k", range(6))
def test_a_set_moved(k):
    """Each of its numbers."""
    by = Fraction(3, 5) if k < 4 else Fraction(2)
    old = Fraction(HENON["hints"]["sets"][1][k])
    rejected(changed(HENON, "hints", "sets", 1, k, str(old + by)), "side|boxes|together|diamond")


def test_a_set_doubled():
    """With its coverings, which all hold: the matrix grows faster, and there is a diamond."""
    given = changed(HENON, "hints", "sets", [*HENON["hints"]["sets"], HENON["hints"]["sets"][0]])
    given["hints"] |= {"coverings": [["0", "1", "2"]] * 3, "vector": ["1"] * 3}
    given["claims"] |= {"growth": "3", "together": "2"}
    rejected(given, "diamond")


@pytest.mark.parametrize(("name", "value"), [("growth", "2.00000001"), ("entropy", "0.69314719")])
def test_a_unit_more(name, value):
    """Both claims are as large as their last digits allow."""
    rejected(changed(HENON, "claims", name, value), "grow")


@pytest.mark.parametrize("value", ["2", "3"])
def test_other_overlaps(value):
    """With more than there are the sentence would say that some overlap."""
    rejected(changed(HENON, "claims", "together", value), "together")


@pytest.mark.parametrize(
    ("z", "term", "value"), [("x", 1, "-7/5"), ("x", 0, "2/5"), ("x", 1, "6"), ("y", 0, "2")]
)
def test_another_map(z, term, value):
    """Each number of the map counts."""
    given = changed(HENON, "parameters", "image", z, term, 0, value)
    rejected(given, "side|boxes")


def test_a_torus():
    """The square of a coordinate is none on a torus."""
    rejected(changed(HENON, "parameters", "torus", "1"), "multiples of 2 pi")


@pytest.mark.parametrize("name", STORED)
def test_what_is_stored_is_about_its_map(name):
    """With another number in it coverings fail."""
    given = STORED[name]
    z = given["parameters"]["state"][0]
    places = [k for k, term in enumerate(given["parameters"]["image"][z]) if len(term) > 1]
    number = given["parameters"]["image"][z][places[-1]][0]
    more = str(Fraction(number) * Fraction(3, 2))
    lie = changed(given, "parameters", "image", z, places[-1], 0, more)
    rejected(lie, "side|boxes|cut|multiples")


@pytest.mark.parametrize("name", STORED)
def test_a_unit_more_than_stored(name):
    """Both claims are as large as their last digits allow."""
    sets = STORED[name]["hints"]
    claims = STORED[name]["claims"]
    growth = Fraction(claims["growth"]) + Fraction(1, 10**8)
    rows = zip(sets["coverings"], map(int, sets["vector"]), strict=True)
    assert any(sum(int(sets["vector"][int(j)]) for j in to) < growth * v for to, v in rows)
