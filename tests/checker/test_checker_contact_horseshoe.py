"""The theorem ``contact_horseshoe``: what is true, and lies."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.coverings.timed import confirm_timed
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import contact_horseshoe
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.contacts_of_a_ball import CHAOS, system

FILES = sorted((Path(__file__).parents[2] / "certificates").glob("contact_horseshoe-*.json"))
STORED = {path.stem: json.loads(path.read_text("utf-8")) for path in FILES}
TINY = Fraction(1, 10**8)


def told(certificate):
    """Return what is verified."""
    return words(check(encode(certificate), lambda _: None))


def test_it_is_verified():
    """The steps are told; the schema describes it; the sentence has its system and numbers."""
    assert len(verify(CHAOS)) > 5
    fits_the_schema(CHAOS)
    line = told(CHAOS)
    for part in (
        "y' = v, v' = -1, while y - 3/4 sin(omega t) > 0",
        "v becomes 3/2 cos(omega t) - v",
        "'table' of 'fly'",
        "with y given by t",
        "at least 0.28119956",
        "at most 18.221",
        "0.10972385 per period",
        "one-sided subshift",
    ):
        assert part in line


def test_sets_that_overlap():
    """With one set twice, but no diamond, no semiconjugacy is claimed."""
    given = changed(CHAOS, "hints", "sets", [*CHAOS["hints"]["sets"], CHAOS["hints"]["sets"][3]])
    hints = given["hints"]
    hints |= {"coverings": [["1"], ["2", "3"], ["0"], ["1"], ["1"]]}
    for name in ("vector", "times", "timed_vector"):
        hints[name] = [*hints[name], hints[name][3]]
    given["claims"]["together"] = "2"
    rejected(given, "covered by none")
    hints["coverings"][1] = ["2", "3", "4"]
    rejected(given, "diamond")
    hints["coverings"] = [["1"], ["2"], ["0"], ["1"], ["1"]]
    hints["coverings"][1] = ["2"]
    rejected(given, "covered by none")
    kept = [0, 1, 2]
    hints |= {"sets": [hints["sets"][k] for k in kept] * 2, "times": hints["times"][:3] * 2}
    hints |= {"coverings": [["1"], ["2"], ["3"], ["4"], ["5"], ["0"]]}
    hints |= {"vector": ["1"] * 6, "timed_vector": ["1"] * 6}
    given["claims"] |= {"growth": "1", "entropy": "0", "per_period": "0"}
    rejected(given, "more than the growth shows")  # exp(0) is enclosed
    rejected(changed(CHAOS, "claims", "per_period", "0"), "not positive")


# lies about the sets


@pytest.mark.parametrize("i", range(4))
@pytest.mark.parametrize("k", range(6))
def test_a_set_moved(i, k):
    """Each of its numbers."""
    by = Fraction(1, 2)
    old = Fraction(CHAOS["hints"]["sets"][i][k])
    why = "side|boxes|together|diamond|defined|longer|parallel"
    rejected(changed(CHAOS, "hints", "sets", i, k, str(old + by)), why)


@pytest.mark.parametrize(("i", "j"), [(0, 0), (0, 2), (1, 0), (2, 3), (3, 2)])
def test_a_covering_invented(i, j):
    """Of one set by another one, or by itself."""
    targets = [*CHAOS["hints"]["coverings"][i], str(j)]
    rejected(changed(CHAOS, "hints", "coverings", i, targets), "side|boxes|defined")


def test_a_covering_reversed():
    """The set that is covered does not cover."""
    given = changed(CHAOS, "hints", "coverings", [["1"], ["2", "3"], ["0"], ["0"]])
    rejected(given, "side|boxes|defined")


def test_a_set_doubled():
    """With its coverings, which all hold: the matrix grows faster, and there is a diamond."""
    given = changed(CHAOS, "hints", "sets", [*CHAOS["hints"]["sets"], CHAOS["hints"]["sets"][3]])
    hints = given["hints"]
    hints["coverings"] = [["1"], ["2", "3", "4"], ["0"], ["1"], ["1"]]
    for name in ("vector", "times", "timed_vector"):
        hints[name] = [*hints[name], hints[name][3]]
    given["claims"] |= {"growth": "1.6", "together": "2"}
    rejected(given, "diamond")


# lies about numbers


@pytest.mark.parametrize("name", ["growth", "entropy", "per_period"])
def test_a_unit_more(name):
    """All claims are as large as their last digits allow."""
    old = Fraction(CHAOS["claims"][name])
    rejected(changed(CHAOS, "claims", name, f"{float(old + TINY):.8f}"), "grow")


@pytest.mark.parametrize("value", ["2", "3"])
def test_other_overlaps(value):
    """With more than there are the sentence would say that some overlap."""
    rejected(changed(CHAOS, "claims", "together", value), "together")


@pytest.mark.parametrize("i", range(4))
@pytest.mark.parametrize("name", ["vector", "timed_vector"])
def test_another_vector(name, i):
    """An entry that is larger by a tenth, or negative."""
    old = int(CHAOS["hints"][name][i])
    rejected(changed(CHAOS, "hints", name, i, str(old * 11 // 10)), "may not grow")
    rejected(changed(CHAOS, "hints", name, i, str(-old)), "negative somewhere")


@pytest.mark.parametrize("i", range(4))
def test_another_time(i):
    """A flight that lasts longer than claimed, and one that weighs more."""
    old = Fraction(CHAOS["hints"]["times"][i])
    rejected(changed(CHAOS, "hints", "times", i, str(old * 9 / 10)), "defined|longer")
    rejected(changed(CHAOS, "hints", "times", i, str(old + Fraction(1, 1000))), "may not grow")


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("hints", "middle"), "1.571", "defined|cut|side"),
        (("hints", "middle"), "1000001", "the middle is larger"),
        (("hints", "middle"), "1/3", "15 places"),
        (("hints", "times", 0), "0", "not between 0"),
        (("hints", "times", 0), "1000001", "not between 0"),
        (("hints", "times"), ["20"], "not one time for each set"),
        (("hints", "timed_vector", 1), "1/2", "not a vector of integers"),
        (("hints", "timed_vector"), ["1"], "has not one entry"),
        (("hints", "timed_vector"), ["0"] * 4, "or zero"),
        (("claims", "per_period"), "-1", "not positive"),
        (("claims", "per_period"), "1/7", "15 places"),
        (("claims", "mode"), "rest", "there is no guard"),
        (("claims", "guard"), "wall", "there is no guard"),
    ],
)
def test_other_lies(path, value, why):
    """Each is rejected for its reason."""
    rejected(changed(CHAOS, *path, value), why)


# other systems


@pytest.mark.parametrize(("A", "e"), [("1/2", "1"), ("1", "1"), ("3/4", "9/10"), ("3/4", "0.8")])
def test_another_system(A, e):
    """Coverings fail."""
    rejected(changed(CHAOS, "parameters", system(A, e)), "side|boxes|defined|soon|longer")


def test_a_system_that_is_hardly_another_one():
    """What is claimed is coarse: it holds of that one, too, and the sentence says of which."""
    e = 1 - Fraction(1, 10**9)
    line = told(changed(CHAOS, "parameters", system("3/4", e)))
    assert "999999999/1000000000 v" in line


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda fly: fly["guards"]["table"].update(to=[]), "is not a list|table"),
        (lambda fly: fly["guards"]["table"]["value"].append(["1/9", "cos", "v"]), "variable"),
        (lambda fly: fly["guards"]["table"]["value"][0].insert(1, "y"), "degree 1"),
        (lambda fly: fly["field"].update(v=[["-1"], ["-1/10", "y"]]), "polynomial in time"),
        (lambda fly: fly["field"].update(v=[["1"]]), "defined|no contact"),
        (lambda fly: fly["guards"]["table"]["reset"].update(v=[["1", "v"]]), "defined|soon|side"),
    ],
)
def test_hostile_models(change, why):
    """Guards with other factors, springs, gravity upwards, no reset."""
    given = changed(CHAOS, "digits", "6")
    change(given["parameters"]["modes"]["fly"])
    rejected(given, why)


def test_a_low_ceiling():
    """One that motions of the family would hit makes another system, and is seen."""
    for height, holds in (("100", True), ("20", False)):
        given = changed(CHAOS, "digits", "6")
        top = {"value": [[height], ["-1", "y"]], "reset": {"v": [["-1", "v"]]}, "to": ["fly"]}
        given["parameters"]["modes"]["fly"]["guards"]["top"] = top
        if holds:
            assert "while y - 3/4 sin(omega t) > 0" in told(given)
            assert "100 - y > 0" in told(given)
        else:
            rejected(given, "defined")


def test_pieces_of_flights_are_limited(monkeypatch):
    """A hostile certificate cannot ask for any number of them."""
    given = changed(CHAOS, "digits", "6")
    top = {"value": [["100"], ["-1", "y"]], "reset": {"v": [["-1", "v"]]}, "to": ["fly"]}
    given["parameters"]["modes"]["fly"]["guards"]["top"] = top
    monkeypatch.setattr(contact_horseshoe, "WORK", 16)
    rejected(given, "defined|pieces")


def test_growth_in_time():
    """Of a full shift with the times 1 and 2: e^-s + e^-2s = 1 for the golden ratio."""
    edges, rate = [[0, 1], [0, 1]], Fraction(math.log((1 + math.sqrt(5)) / 2))
    times = [Fraction(1), Fraction(2)]
    vector = [int(10**15 * math.exp(-rate * tau)) for tau in times]
    confirm_timed(edges, vector, rate - Fraction(1, 10**12), times)
    with pytest.raises(Rejected, match="grow"):
        confirm_timed(edges, vector, rate + Fraction(1, 10**12), times)


# what is stored


@pytest.mark.parametrize("name", STORED)
def test_what_is_stored_is_about_its_system(name):
    """With another gravity coverings fail."""
    given = STORED[name]
    old = Fraction(given["parameters"]["modes"]["fly"]["field"]["v"][0][0])
    lie = changed(given, "parameters", "modes", "fly", "field", "v", 0, 0, str(old * 5 / 4))
    rejected(lie, "side|boxes|cut|defined|longer")


@pytest.mark.parametrize("name", STORED)
@pytest.mark.parametrize("claim", ["growth", "per_period"])
def test_a_unit_more_than_stored(name, claim):
    """The claims are as large as their last digits allow."""
    given = STORED[name]
    hints, more = given["hints"], Fraction(given["claims"][claim]) + TINY
    edges = [[int(j) for j in targets] for targets in hints["coverings"]]
    if claim == "growth":
        vector = [int(v) for v in hints["vector"]]
        assert any(
            sum(vector[j] for j in to) < more * v for to, v in zip(edges, vector, strict=True)
        )
    else:
        vector = [int(v) for v in hints["timed_vector"]]
        times = [Fraction(tau) for tau in hints["times"]]
        with pytest.raises(Rejected, match="grow"):
            confirm_timed(edges, vector, more / Fraction(2 * math.pi), times)
