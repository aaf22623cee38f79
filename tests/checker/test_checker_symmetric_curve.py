"""Curves of symmetric orbits of one's own system: a pitchfork, and lies about symmetries."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from branches import certificate
from own_systems import rejected

from cap.certificate.writer import dumps
from cap.checker.verdict import check, words

PITCHFORK = Path(__file__).parents[2] / "certificates/pitchfork.json"


def test_the_multiplier_is_minus_one_at_the_pitchfork():
    """The closed form of theorem `pitchfork` and the zero here are in common intervals."""
    (point,) = certificate("pitchfork")["claims"]["points"]
    low, high = map(Fraction, point["at"])
    a, b = map(Fraction, json.loads(PITCHFORK.read_text("utf-8"))["claims"]["f"])
    assert low < a < b < high
    assert high - low < Fraction(1, 10**20)
    assert point["kind"] == "flip"


def test_the_sentence():
    """It says what is symmetric, and what the multipliers are."""
    said = words(check(dumps(certificate("pitchfork")).encode(), lambda _: None))
    assert "a connected curve of symmetric orbits of period 1 x 2 pi/omega" in said
    assert "each with these contacts in half a round" in said
    assert "1/2 x 2 pi/omega later the state is (-x, -v, f) of what it was" in said
    assert "those of the orbit are their squares" in said
    assert "a multiplier is -1, of the orbit 1" in said
    alone = words(check(dumps(certificate("fold")).encode(), lambda _: None))
    assert "squares" not in alone
    assert "half" not in alone


def symmetry(**changes):
    """Return what changes the symmetry."""
    return lambda given: given["claims"]["symmetry"].update(changes)


def modes(**changes):
    """Return what changes images of modes."""
    return lambda given: given["claims"]["symmetry"]["modes"].update(changes)


def at(*path, value):
    """Return what changes the system."""

    def change(given):
        part = given["parameters"]["modes"]
        for key in path[:-1]:
            part = part[key]
        part[path[-1]] = value

    return change


SWAPPED = {"right": "left", "left": "right", "rest": "rest"}
LIES = {
    "none": (lambda given: given["claims"].pop("symmetry"), "the next contact is in another mode"),
    "one sign": (symmetry(signs=["1", "-1", "1"]), "the field of 'left' is not the image of that"),
    "a sign too few": (symmetry(signs=["-1", "1"]), "has not a sign for each variable"),
    "no sign": (symmetry(signs=["-1", "0", "1"]), "a sign of the symmetry is none"),
    "the parameter": (symmetry(signs=["-1", "-1", "-1"]), "the symmetry changes the parameter"),
    "a mode left out": (symmetry(modes={"right": "left", "left": "right"}), "exchange the modes"),
    "a mode invented": (symmetry(modes={**SWAPPED, "up": "up"}), "does not exchange the modes"),
    "no exchange": (modes(left="left"), "does not exchange the modes"),
    "all modes as they are": (modes(left="left", right="right"), "the field of"),
    "two periods": (lambda given: given["claims"].update(periods="2"), "an even number of periods"),
    "three periods": (lambda given: given["claims"].update(periods="3"), "interior of the box"),
    "a wall moved": (
        at("left", "guards", "wall", "value", value=[["1.000000001"], ["1", "x"]]),
        "the guards of 'left' are not the images of those of 'right'",
    ),
    "another restitution at one wall": (
        at("left", "guards", "wall", "reset", "v", value=[["-0.999999999", "v"]]),
        "the guards of 'left' are not the images",
    ),
    "another mode after one stop": (
        at("left", "guards", "stop", "to", value=["right"]),
        "the guards of 'left' are not the images",
    ),
    "one more guard": (
        at(
            "left",
            "guards",
            "more",
            value={"value": [["9"], ["1", "x"]], "reset": {}, "to": ["right"]},
        ),
        "the guards of",
    ),
    "friction on one side": (
        at("left", "field", "v", value=[["1", "cos"], ["1", "f"], ["1/1000000000", "v"]]),
        "the field of",
    ),
    "another mode after the contact": (
        lambda given: given["claims"]["contacts"][0].update(to="rest"),
        "wall does not lead to the mode rest|a contact leads to a mode that is none",
    ),
    "no mode after the contact": (
        lambda given: given["claims"]["contacts"][0].update(to="up"),
        "a contact leads to a mode that is none",
    ),
    "a pair without counts": (
        lambda given: given["claims"]["points"][0].update(kind="pair"),
        "nothing is counted at its ends",
    ),
    "counts where both are on the circle": (
        lambda given: given["claims"]["points"][0].update(outside=["1", "0"]),
        "not so many multipliers are certain to be outside",
    ),
}


@pytest.mark.parametrize("name", LIES)
def test_lies(name):
    """Each is rejected, with the reason."""
    lie, why = LIES[name]
    given = certificate("pitchfork")
    lie(given)
    rejected(given, why)


def test_without_a_clock_there_is_no_half_period():
    """The symmetry is one of half a period."""
    given = certificate("clock")
    kept = {mode: mode for mode in given["parameters"]["modes"]}
    signs = ["1"] * len(given["parameters"]["state"])
    given["claims"]["symmetry"] = {"signs": signs, "modes": kept}
    rejected(given, "there is no clock")
