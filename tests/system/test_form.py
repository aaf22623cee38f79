"""A system as JSON: what is written is read, and anything else is refused."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest
from models import ball, parabola, spring

from cap.errors import BadInput
from cap.parameters import PAPER
from cap.system.form import as_json, dumps, from_json, loads
from cap.system.friction import friction, oscillator
from cap.system.masses import masses

SYSTEMS = [
    friction(),
    oscillator(replace(PAPER, mu=Fraction(1, 10), omega=Fraction(7, 3))),
    masses(PAPER, (Fraction(1), Fraction(9, 10), Fraction(2))),
    ball(),
    parabola(),
    spring(),
]


@pytest.mark.parametrize("system", SYSTEMS)
def test_round_trip(system):
    """The system comes back, equal in all parts; so does the text."""
    again = loads(dumps(system))
    assert again.state == system.state
    assert again.omega == system.omega
    assert again.parameters == system.parameters
    assert again.modes.keys() == system.modes.keys()
    for name, mode in system.modes.items():
        assert again.modes[name].field == mode.field
        for guard, g in mode.guards.items():
            other = again.guard(name, guard)
            assert (other.value, other.to, other.rest) == (g.value, g.to, g.rest)
            assert again.reset(name, guard) == system.reset(name, guard)
    assert dumps(again) == dumps(system)


def test_how_it_looks():
    """Numbers are strings; pi is a factor, 1/pi too."""
    text = as_json(spring())
    assert text["modes"]["fly"]["v"] == [["1", "cos"], ["-1/10", "v"], ["-1", "x"]]
    assert text["guards"]["fly"]["stop"] == {
        "value": [["-1", "x"]],
        "to": ["fly"],
        "reset": {"v": [[["-4/5", "v"]], [["1"]]]},
    }
    assert as_json(parabola())["omega"] == [["2", "pi"]]
    assert loads(json.dumps(text | {"omega": [["3", "1/pi", "1/pi"]]})).omega.terms == {
        (("pi", -2),): 3
    }


def changed(*path_and_value):
    """Return the spring as JSON with something else at a place."""
    *path, last, value = path_and_value
    whole = as_json(spring())
    part = whole
    for key in path:
        part = part[key]
    part[last] = value
    return whole


V, STOP = ("modes", "fly", "v"), ("guards", "fly", "stop")
REFUSED = {
    "format": changed("format", "cap-system/2"),
    "no exact number": changed(*V, [[0.5, "x"]]),
    "write a rational as a string": changed(*V, [["0.5", "x"]]),
    "v' in the mode fly has no exact number": changed(*V, [["1/0", "x"]]),
    "has no exact": changed(*V, [["9" * 300, "x"]]),
    "twice": changed(*V, [["1", "x"], ["2", "x"]]),
    "that is 0": changed(*V, [["0", "x"]]),
    "not a list": changed(*V, "x"),
    "exact number": changed(*V, [[]]),
    "pi and 1/pi": changed(*V, [["1", "pi", "1/pi"]]),
    "too many factors": changed(*V, [["1", *["pi"] * 100]]),
    "more than 1000 terms": changed(*V, [[str(k), "x"] for k in range(1, 1002)]),
    "unknown variable: __import__": changed(*V, [["1", "__import__"]]),
    "unknown field 'colour'": changed("colour", "red"),
    "unknown field 'swim'": changed("guards", "swim", {}),
    "unknown mode: swim": changed(*STOP, "to", ["swim"]),
    "not a name": changed(*STOP, "to", [7]),
    "pair": changed(*STOP, "reset", {"v": [[["1"]]]}),
    "denominator": changed(*STOP, "reset", {"v": [[["1"]], []]}),
    "or lacks it": changed(*STOP, {"value": [["1", "x"]], "to": ["fly"]}),
    "object": changed("modes", []),
    "not linear": changed(*V, [["1", "x", "x"]]),
}


@pytest.mark.parametrize("message", REFUSED)
def test_refused(message):
    """By one line that has the words."""
    with pytest.raises(BadInput) as refusal:
        loads(json.dumps(REFUSED[message]))
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "3", '{"a": NaN}', '{"a": 1, "a": 2}', "[" * 100_000, " " * 1_000_001]
)
def test_not_a_system(text):
    """Text that is no JSON, or another one."""
    with pytest.raises(BadInput):
        loads(text)


def test_fields_are_compared():
    """A missing one is refused, whatever it is."""
    whole = as_json(spring())
    for key in whole:
        with pytest.raises(BadInput, match=key):
            from_json({k: value for k, value in whole.items() if k != key})
