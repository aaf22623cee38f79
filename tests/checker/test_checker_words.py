"""The sentence printed for a certificate has every number that it is about, as it was claimed."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cap.checker.verdict import words
from checker.altered import encode, leaves
from checker.forge import forge
from checker.forge_capture import forge_capture
from checker.forge_hybrid import forge_persistence, valid
from checker.forge_impact import WALLS, forge_branch, forge_pitchfork, forge_symmetric
from checker.parts import read

COMMON = ("box", "x", "v", "trace", "multipliers")
CERTIFICATES = {
    "elliptic": (forge, {}, (*COMMON, "least_speed", "twist")),
    "saddle": (forge, {"theorem": "saddle"}, (*COMMON, "least_speed")),
    "focus": (valid, {"name": "focus"}, (*COMMON, "determinant")),
    "saddle with turns": (valid, {"name": "saddle"}, (*COMMON, "determinant")),
    "persistence": (
        forge_persistence,
        {"epsilon": ("0", "1/1000"), "mu": ("0", "1/1000")},
        (*COMMON, "determinant"),
    ),
    "capture": (forge_capture, {}, ("box", "accumulation_time", "forcing", "release_time")),
    "symmetric": (
        forge_symmetric,
        {},
        ("branches", "saddle_center", "pitchfork", "minus_identity", "paper_roots"),
    ),
    "not genuine": (
        forge_symmetric,
        {"parameters": WALLS | {"f": "3/5", "l": "-3/8", "r": "3/8"}},
        ("branches", "saddle_center", "pitchfork", "minus_identity"),
    ),
    "pitchfork": (
        forge_pitchfork,
        {},
        ("f", "x", "v", "least_speed", "hit_speed", "curvature", "trace_curvature"),
    ),
    "branch": (
        forge_branch,
        {"first": "0.34", "width": "0.03"},
        ("f_range", "f_start", "f_end", "trace_end", "resonances", "twist_zeros", "exceptions"),
    ),
}


@pytest.mark.parametrize("name", CERTIFICATES)
def test_every_number_is_stated(name):
    """Each enclosure, and what else the claims say in words."""
    forger, options, stated = CERTIFICATES[name]
    certificate = forger(**options)
    line, claims = words(read(encode(certificate))), certificate["claims"]
    for path, (lower, upper) in leaves({k: claims[k] for k in stated if k in claims}):
        if path[-1] != "half_trace" and path[0] != "basin":
            assert f"[{lower}, {upper}]" in line, path
    for value in certificate["parameters"].values():
        assert value in line
    for key in ("itinerary", "type", "wall", "period"):
        if key in claims:
            said = claims[key]
            assert (", ".join(said) if isinstance(said, list) else said) in line
    for row in claims.get("basin", {"matrix": []})["matrix"]:
        assert f"({Fraction(row[0])}, {Fraction(row[1])})" in line
    assert str(Fraction(claims.get("ratio", "0"))) in line
    for side in ("epsilon", "mu"):
        if "range" in claims:
            assert f"{side} <= {claims['range'][side][-1]}" in line
    for resonance in claims.get("resonances", []):
        assert f"{resonance['ratio']} at f in " in line
