"""The theorem ``contact_capture``: what is true is verified; each lie is noticed."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

STORED = Path(__file__).parents[2] / "certificates"
EVER, RELEASED, MASSES = (
    json.loads((STORED / f"contact_capture-{n}.json").read_text("utf-8")) for n in (1, 2, 3)
)
FLY, REST = ("parameters", "modes", "fly"), ("parameters", "modes", "rest")
TABLE = (*FLY, "guards", "table")


def without(given, *path):
    """Return a copy without a field."""
    *path, last = path
    result = json.loads(encode(given))
    part = result
    for key in path:
        part = part[key]
    del part[last]
    return result


@pytest.mark.parametrize(("given", "steps"), [(EVER, 5), (RELEASED, 6), (MASSES, 5)])
def test_it_is_verified(given, steps):
    """Its steps are told; the schema describes it."""
    assert len(verify(given)) == steps
    fits_the_schema(given)


def test_what_is_told():
    """The rule of the model, the box, when hits accumulate, how long it rests."""
    line = words(check(encode(EVER), lambda _: None))
    for part in (
        "mode 'fly', and 'rest' after infinitely many in finite time)",
        "at t = 0 is in the mode 'fly', all guards of which are positive, with (y, v) in [0, 10] x",
        "infinitely often, at times that accumulate at one in [0, 41.25], and until then nothing",
        "is at most 0.613 times that just before the hit before it",
        "in the mode 'rest', with h = h' = 0, for ever",
    ):
        assert part in line
    line = words(check(encode(RELEASED), lambda _: None))
    assert (
        "at least until t = 7.2682960905, and it leaves this mode before t = 7.2682960906" in line
    )


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("start",), "1", "hits accumulate before they begin"),
        (("start",), "2000000", "a time is larger"),
        (("mode",), "rest", "begin in another mode"),
        (("mode",), "nowhere", "begin in another mode"),
        (("box", "y"), ["0", "11"], "may leave the states that were looked at"),
        (("box", "v"), ["-7", "5"], "may leave the states that were looked at"),
        (("falling",), "rest", "there is no such guard, or mode"),
        (("guard",), "leave", "there is no such guard, or mode"),
        (("rising",), "rest", "h' is not the same in rest"),
        (("restitution",), "500000001/1000000000", "is not -e times that before it"),
        (("restitution",), "499999999/1000000000", "is not -e times that before it"),
        (("restitution",), "0", "0 < e <= 1 does not hold"),
        (("ratio",), "612/1000", "the ratio may be larger than claimed"),
        (("ratio",), "1", "the ratio is not below 1"),
        (("accumulation_time",), ["0", "40"], "may accumulate later than claimed"),
        (("accumulation_time",), ["1/1000", "41.25"], "may accumulate earlier than claimed"),
        (("rests_until",), "100", "not one of claims.rests_until and claims.for_ever"),
        (("released_by",), "100", "claims.released_by without claims.rests_until"),
        (("for_ever",), "no", "is none of: yes"),
    ],
)
def test_each_claim(path, value, why):
    """None may be another one, of a ball that rests for ever."""
    rejected(changed(EVER, "claims", *path, value), why)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("start",), "3.664", "may accumulate earlier than claimed"),
        (("start",), "2", "may not be positive at hints.state"),
        (("accumulation_time",), ["3.665", "5.4"], "may accumulate later than claimed"),
        (("accumulation_time",), ["3.665", "7.3"], "what chatters may be held off"),
        (("rests_until",), "7.2682960907", "it is released before its rest is over"),
        (("rests_until",), "5", "it rests before hits accumulate"),
        (("released_by",), "7.26829609051", "it may rest longer than claimed"),
        (("released_by",), "7.2682960905", "it may rest longer than claimed"),
        (("released_by",), "7", "it is released before its rest is over"),
        (("ratio",), "58/100", "the ratio may be larger than claimed"),
    ],
)
def test_each_claim_of_a_release(path, value, why):
    """Nor of one that is thrown again."""
    rejected(changed(RELEASED, "claims", *path, value), why)


def test_a_rest_that_ends():
    """It is not one for ever, nor longer than it is."""
    claims = {
        k: v for k, v in RELEASED["claims"].items() if k not in ("rests_until", "released_by")
    }
    rejected(RELEASED | {"claims": claims | {"for_ever": "yes"}}, "leave of rest may come to 0")
    rejected(RELEASED | {"claims": claims}, "not one of claims.rests_until and claims.for_ever")
    late = changed(RELEASED, "claims", "rests_until", "7.26829609055")
    rejected(without(late, "claims", "released_by"), "leave of rest may come to 0")


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("height",), "40", "may leave the states that were looked at"),
        (("speed",), "8", "may leave the states that were looked at"),
        (("others",), {"y": ["0", "1"]}, "hints.others are not the other variables"),
        (("state", "y"), "11", "hints.state is not in the box"),
        (("state", "y"), "0", "may not be positive at hints.state"),
        (("state",), {"y": "1"}, "hints.state is not a state"),
        (("cuts",), ["0"], "cuts are not in order"),
        (("cuts",), ["100"], "cuts are not in order"),
        (("bits",), "2000", "more than 1024 bits"),
    ],
)
def test_hints(path, value, why):
    """A hint that is wrong proves nothing."""
    rejected(changed(EVER, "hints", *path, value), why)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        ((*TABLE, "rest"), "nowhere", "rests in an unknown mode"),
        ((*TABLE, "rest"), "fly", "h or h' does not stay 0 in fly"),
        ((*TABLE, "reset"), {}, "h' after a hit is not -e times"),
        ((*TABLE, "reset", "v"), [["-1/2", "v"]], "h' after a hit is not -e times"),
        ((*TABLE, "reset", "y"), [["2", "y"]], "h is not 0 after a hit"),
        ((*TABLE, "value"), [["-1/4", "sin"], ["1", "y"]], "h' after a hit is not -e times"),
        ((*TABLE, "value"), [["1", "y", "y"]], "are not linear|not linear in two"),
        ((*TABLE, "to"), ["fly", "rest"], "the mode rest may be open after a hit"),
        ((*TABLE, "to"), ["rest"], "a hit does not lead to fly|may be open"),
        ((*FLY, "field", "v"), [["1"]], "what chatters may be held off"),
        ((*FLY, "field", "v"), [["-1"], ["1/2", "cos"]], "may not decrease"),
        ((*REST, "field", "y"), [["1/4", "cos"]], "h or h' does not stay 0 in rest"),
        ((*REST, "field", "v"), [["1/5", "sin"]], "h or h' does not stay 0 in rest"),
        ((*REST, "guards", "leave", "value"), [["1/6"], ["-1/5", "sin"]], "leave of rest may come"),
        ((*REST, "guards", "leave", "value"), [["1", "y"]], "leave of rest may come to 0"),
    ],
)
def test_other_systems(path, value, why):
    """The system in the certificate is the one that is proved to rest."""
    rejected(changed(EVER, *path, value), why)


def test_no_mode_of_rest():
    """Where the model does not say what follows infinitely many hits, nothing is proved."""
    rejected(without(EVER, *TABLE, "rest"), "the guard table of fly names no mode of rest")


@pytest.mark.parametrize(
    ("value", "why"),
    [
        ([["10"], ["-1", "y"]], "ceiling of fly may come to 0"),
        ([["42"], ["-1", "y"]], None),
        ([["2", "y"], ["-2/5", "sin"]], "ceiling of fly may come to 0"),
    ],
)
def test_another_guard(value, why):
    """One that is met, and one that is not: h ≤ 41; and the table twice."""
    ceiling = {"value": value, "reset": {}, "to": ["fly"]}
    given = changed(EVER, *FLY, "guards", "ceiling", ceiling)
    if why:
        rejected(given, why)
    else:
        verify(given)


@pytest.mark.parametrize(
    ("part", "path", "value", "why"),
    [
        ("hints", ("others", "p"), ["0.48", "0.52"], "p may leave its box"),
        ("hints", ("others", "u"), ["-0.01", "0.01"], "u may leave its box"),
        ("hints", ("others",), {}, "hints.others are not the other variables"),
        ("claims", ("box", "p"), ["0.4", "0.501"], "p may leave its box"),
        ("claims", ("box", "q"), ["0.09", "0.1"], "may leave the states"),
        ("claims", ("box", "v"), ["-0.01", "0.01"], "may leave the states"),
        ("claims", ("rests_until",), "1", "may leave its box"),
        ("claims", ("for_ever",), "yes", "not one of"),
    ],
)
def test_other_variables(part, path, value, why):
    """They stay in a box, which is proved."""
    rejected(changed(MASSES, part, *path, value), why)


def test_a_hit_that_moves_another_variable():
    """It is none of this theorem."""
    reset = ("parameters", "modes", "free", "guards", "wall", "reset", "u")
    rejected(changed(MASSES, *reset, [["-1", "u"]]), "a hit changes another variable")


def test_for_ever_among_others():
    """What depends on other variables is not claimed for all times."""
    given = changed(without(MASSES, "claims", "rests_until"), "claims", "for_ever", "yes")
    rejected(given, "a guard of the mode of rest depends on other variables")


def test_times_are_exact():
    """The least time of accumulation is that of a fall, for a box that is above the table."""
    box = {"y": ["1", "2"], "v": ["0", "0"]}
    given = changed(changed(EVER, "claims", "box", box), "hints", "state", {"y": "1", "v": "0"})
    verify(changed(given, "claims", "accumulation_time", ["1", "41.25"]))
    rejected(changed(given, "claims", "accumulation_time", ["2", "41.25"]), "earlier than claimed")
    assert Fraction(given["claims"]["ratio"]) < 1
