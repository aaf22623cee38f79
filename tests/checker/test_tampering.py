"""Every number of the stored certificates on non-sticking orbits, tampered with, is noticed."""

import copy
import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

CERTIFICATES = [
    path
    for theorem in ("elliptic", "saddle")
    for path in sorted((Path(__file__).parents[2] / "certificates").glob(f"{theorem}*.json"))
]
WHOLE = ("elliptic", "saddle")  # the others get the two cheapest attacks only
by_name = pytest.mark.parametrize("path", CERTIFICATES, ids=lambda path: path.stem)


def leaves(value, trail=()):
    """Give the path to every string in a JSON value."""
    if isinstance(value, str):
        yield trail
    else:
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(inner, (*trail, key))


def get(value, trail):
    """Return what lies at a path."""
    for key in trail:
        value = value[key]
    return value


def changed(certificate, trail, text):
    """Return a copy with another value at a path."""
    result = json.loads(json.dumps(certificate))
    get(result, trail[:-1])[trail[-1]] = text
    return result


def text(value):
    """Return a fraction as the format writes it."""
    return str(Fraction(value))


def rejected(certificate):
    """Return whether the checker rejects, and for a reason of its own, not by accident."""
    try:
        check(json.dumps(certificate).encode(), lambda _step: None)
    except Rejected:
        return True
    return False


def attacks(pair, other, whole):
    """Give values for one end of an enclosure, ``other`` its other end."""
    yield "its other end", other
    width = abs(Fraction(other) - Fraction(pair))
    away = 1 if Fraction(pair) > Fraction(other) else -1
    if whole:
        yield (
            "a thousand widths out",
            text(Fraction(pair) + away * 1000 * max(width, Fraction(1, 10**60))),
        )


def enclosures(certificate):
    """Give the path to every end of an enclosure in the claims, but for the box."""
    for trail in leaves(certificate["claims"]):
        if trail[0] not in ("box", "remainder"):
            yield ("claims", *trail)


@by_name
def test_every_end_of_every_claim(path):
    """An end moved onto the other, or far out, is rejected."""
    good = json.loads(path.read_text("utf-8"))
    survivors = []
    for trail in enclosures(good):
        here, there = get(good, trail), get(good, (*trail[:-1], 1 - trail[-1]))
        for name, value in attacks(here, there, path.stem in WHOLE):
            if not rejected(changed(good, trail, value)):
                survivors.append((trail, name))
    assert survivors == []


@by_name
def test_the_box(path):
    """A box without P*, too large, inverted, or touching a wall or v = 0 is rejected."""
    good = json.loads(path.read_text("utf-8"))
    for axis, walls in (("x", ("l", "r")), ("v", (None, None))):
        lower, upper = (Fraction(end) for end in good["claims"]["box"][axis])
        bounds = [Fraction(good["parameters"][w]) if w else Fraction(0) for w in walls]
        width = upper - lower
        cases = [
            (upper, lower),
            (lower - 10 * width, upper),
            (lower, upper + 10 * width),
            (lower - 2 * width, lower - width),
            (upper + width / 2, upper + width),
            (Fraction(good["claims"][axis][1]), upper),
            (lower, Fraction(good["claims"][axis][0])),
            (min(bounds[0], lower), upper)
            if axis == "x"
            else (min(lower, bounds[0]), max(upper, bounds[0])),
        ]
        for case in cases:
            bad = changed(good, ("claims", "box", axis), [text(end) for end in case])
            assert rejected(bad), (axis, case)


@by_name
def test_the_remainder(path):
    """A smaller bound, a larger or empty disk, another degree are rejected."""
    good = json.loads(path.read_text("utf-8"))
    if "remainder" not in good["claims"]:
        return
    claim = good["claims"]["remainder"]
    for key, value in (
        ("x", Fraction(claim["x"]) / 100),
        ("v", Fraction(claim["v"]) / 100),
        ("x", 0),
        ("v", -1),
        ("radius", 2 * Fraction(claim["radius"])),
        ("radius", 100 * Fraction(claim["radius"])),
        ("radius", 0),
        ("radius", -Fraction(claim["radius"])),
        ("degree", int(claim["degree"]) + 2),
        ("degree", 3 if claim["degree"] == "5" else 1),
    ):
        assert rejected(changed(good, ("claims", "remainder", key), text(value))), (key, value)


@by_name
def test_the_parameters(path):
    """The claims hold at no other parameters, however near."""
    good = json.loads(path.read_text("utf-8"))
    for name, value in good["parameters"].items():
        for change in (
            Fraction(1, 100),
            -Fraction(1, 100),
            Fraction(1, 10**20),
            -Fraction(1, 10**20),
        ):
            bad = changed(good, ("parameters", name), text(Fraction(value) + change))
            assert rejected(bad), (name, change)


@by_name
def test_the_hints(path):
    """Hints far off prove nothing.  (A window a little wider is as good: hints are not claims.)"""
    good = json.loads(path.read_text("utf-8"))
    hints = good["hints"]
    for trail in leaves(hints):
        value = Fraction(get(hints, trail))
        for bad in (value * 1000 + 1000, -value - 1):
            assert rejected(changed(good, ("hints", *trail), text(bad))), (trail, bad)
    assert rejected(changed(good, ("hints", "bits"), "64"))
    assert rejected(changed(good, ("hints", "radius"), "0"))


@by_name
def test_what_is_cited(path):
    """No word of what is cited can be changed, no hypothesis dropped, no discharge moved."""
    good = json.loads(path.read_text("utf-8"))
    for trail in leaves(good["cites"]):
        assert rejected(changed(good, ("cites", *trail), "x")), trail
    for cited, theorem in enumerate(good["cites"]):
        for k in range(len(theorem["hypotheses"])):
            bad = copy.deepcopy(good)
            del bad["cites"][cited]["hypotheses"][k]
            assert rejected(bad)


@by_name
def test_fields_removed_added_or_of_another_type(path):
    """Unknown and missing fields, numbers that are not strings, and other types are errors."""
    good = json.loads(path.read_text("utf-8"))
    for trail in [(key,) for key in good] + [
        (part, key) for part in ("claims", "hints", "parameters") for key in good[part]
    ]:
        bad = copy.deepcopy(good)
        del get(bad, trail[:-1])[trail[-1]]
        assert rejected(bad), trail
        for value in (1, 0.5, True, None, [], {}, "", "nan", "1e3", " 1", "+1", "1_0", "٣", "0x1"):
            if trail != ("provenance",) or not isinstance(value, dict):
                assert rejected(changed(good, trail, value)), (trail, value)
    for part in ("claims", "hints", "parameters"):
        assert rejected(changed(good, (part, "extra"), "1"))
    assert rejected({**good, "extra": "1"})


def test_one_theorem_is_not_the_other():
    """A saddle is not elliptic by name, nor the converse; a certificate states its own theorem."""
    stored = {path.stem: json.loads(path.read_text("utf-8")) for path in CERTIFICATES}
    assert rejected({**stored["saddle"], "theorem": "elliptic"})
    assert rejected({**stored["elliptic"], "theorem": "saddle"})
    mixed = {**stored["elliptic"], "claims": stored["elliptic-2"]["claims"]}
    assert rejected(mixed)


@by_name
def test_provenance_is_ignored(path):
    """Who made a certificate, when and how long it took does not matter."""
    good = json.loads(path.read_text("utf-8"))
    assert not rejected({**good, "provenance": {"made by": "somebody", "seconds": "0"}})
