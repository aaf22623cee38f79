"""Numbers that are far too large or too small: a verdict or a reason, and no other exception."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from cap.areas.listing import written
from cap.checker.kernel.reading import NUMBER
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.rounding import in_doubles
from cap.checker.verdict import check
from checker.altered import changed, encode, rejected

ROOT = Path(__file__).parents[2]
ZEROS = "0" * 400
SIZES = f"1{ZEROS}", f"-1{ZEROS}", f"1/1{ZEROS}"
SMALL = ["capture", "impulse-1", "segment", "sliding", "pitchfork", "symmetric"]
ALL = ["0", "1"]
MIXED = {
    "format": "cap-certificate/1",
    "theorem": "mixed",
    "digits": "6",
    "parameters": {"F": "1", "omega": "1", "f": "1/5", "l": "-1", "r": "1"},
    "claims": {
        "box": {"x": ["-1", "1"], "v": ["-3", "3"]},
        "shares": dict.fromkeys(("attractor", "segment", "either", "stops", "undecided"), ALL),
        "never_stopping_area": ["0", "12"],
        "sinks": [
            {
                "x": "0.0538",
                "v": "0.7002",
                "matrix": [["-11.9", "-45.1"], ["-0.62", "-46.7"]],
                "halves": "4",
            }
        ],
        "cycles": [[["-0.2323", "-0.2072"]]],
    },
    "hints": {
        "bits": "64",
        "places": {"level": "6", "tree": "0"},
        "stops": dict.fromkeys(("late", "early", "turns"), written([0])),
    },
    "provenance": {},
}


def stored(path):
    """Return a certificate."""
    return json.loads((ROOT / path).read_text("utf-8"))


def mixed():
    """Return a certificate of a sink, of which no share is claimed."""
    lie = {**MIXED, "cites": []}
    return changed(lie, "claims", {k: v for k, v in lie["claims"].items() if k != "cycles"})


def numbers(value, path=()):
    """Give the paths of all numbers."""
    if isinstance(value, dict | list):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        for key, part in pairs:
            yield from numbers(part, (*path, key))
    elif re.fullmatch(NUMBER, value):
        yield path


def tried(certificate, *parts):
    """Put each size in the place of each number; return how many certificates are rejected."""
    reasons = []
    for part in parts:
        start = certificate
        for key in part:
            start = start[key]
        for path in numbers(start, part):
            for size in SIZES:
                try:
                    check(encode(changed(certificate, *path, size)), lambda _: None)
                except Rejected as reason:
                    reasons.append(str(reason))
    assert all(" " in reason for reason in reasons)
    return len(reasons)


@pytest.mark.parametrize("name", SMALL)
def test_each_number_of_small_certificates(name):
    """In integers: nothing overflows."""
    certificate = stored(f"certificates/{name}.json")
    assert tried(certificate, ("parameters",), ("claims",), ("hints",)) > 10


@pytest.mark.slow
def test_each_number_of_a_ceiling():
    """They become doubles."""
    certificate = stored("tests/certificates/accept/conservative_by_three_flights.json")
    assert tried(certificate, ("parameters",), ("hints", "ceiling")) == 24
    large = changed(certificate, "hints", "ceiling", "phase", SIZES[0])
    rejected(large, r"a number of the ceiling is larger than 10\^30")


def test_each_number_of_a_box_and_a_sink():
    """And these: a box, shares and an ellipse."""
    certificate = mixed()
    check(encode(certificate), lambda _: None)
    assert tried(certificate, ("parameters",), ("claims", "box"), ("claims", "sinks")) > 40
    for n in (0, 1):
        large = changed(certificate, "claims", "sinks", 0, "matrix", n, 0, SIZES[n])
        rejected(large, r"a number of a sink is larger than 10\^90")
    for size in SIZES:
        rejected(changed(certificate, "claims", "box", "v", 1, size), "V is not|lower > upper")


def test_each_number_of_a_cycle():
    """Places are between the walls."""
    certificate = changed(mixed(), "parameters", "f", "3/10")
    claims = {k: v for k, v in certificate["claims"].items() if k != "sinks"}
    certificate = changed(certificate, "claims", claims | {"cycles": MIXED["claims"]["cycles"]})
    check(encode(certificate), lambda _: None)
    assert tried(certificate, ("claims", "cycles")) == 6


@pytest.mark.parametrize("wrong", [lambda: 1e300**2, lambda: 1.0 / 0.0, lambda: round(1e999)])
def test_what_is_no_finite_double_is_rejected(wrong):
    """Where Python raises an exception instead of an infinity."""
    with pytest.raises(Rejected, match="not a finite double"), in_doubles():
        wrong()
