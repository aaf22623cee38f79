"""Certificates that are not exactly of the format are rejected, whatever they contain."""

from __future__ import annotations

import copy
from fractions import Fraction

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.reading import MAX_BYTES, number, parsed
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Whole, enclosure
from checker.altered import encode, rejected, verify
from checker.forge import forge

pytestmark = pytest.mark.usefixtures("orbits_computed_once")


@pytest.fixture(scope="module")
def good():
    """Return a valid certificate of few digits."""
    return forge(digits=8)


@pytest.mark.parametrize(
    ("literal", "value"),
    [
        ("0", 0),
        ("-3", -3),
        ("0.25", "1/4"),
        ("-0.50", "-1/2"),
        ("2/5", "2/5"),
        ("-4/6", "-2/3"),
        ("10", 10),
    ],
)
def test_numbers(literal, value):
    """Integers, decimals and fractions are read exactly."""
    assert number(literal, "n") == Fraction(value)


@pytest.mark.parametrize(
    "literal",
    [
        *("", " ", "1 ", " 1", "+1", "01", "-01", "00", ".5", "5.", "1e3", "1E3", "1_000", "--1"),
        *("1/0", "1/-2", "1/02", "1/2/3", "0.5/2", "1/0.5", "nan", "inf", "Infinity", "0x10"),
        *("1\n", "\n1", "1,5", "1/", "-", "/", ".", "1\x00", "\uff11", "\u0663", "\u22121"),
        *("9" * 4001, "0." + "1" * 4000, "1/" + "9" * 4000),
    ],
)
def test_other_numbers_reject(literal):
    """Exponents, signs, spaces, leading zeros, other digits, zero denominators, too long ones."""
    with pytest.raises(Rejected):
        number(literal, "n")


@pytest.mark.parametrize("value", [1, 1.5, None, True, ["1"], {"a": "1"}])
def test_what_is_no_string_is_no_number(value):
    """JSON's own numbers, null, true and containers are not numbers of the format."""
    with pytest.raises(Rejected, match="string"):
        number(value, "n")


def test_the_longest_numbers():
    """4000 characters are allowed in each of the three notations."""
    for literal in ("9" * 4000, "0." + "1" * 3998, "1/" + "9" * 3998):
        assert number(literal, "n") > 0


@pytest.mark.parametrize(
    "value", [["1"], ["1", "2", "3"], "1", ["2", "1"], [["1", "2"]], {}, ["1", 2], None]
)
def test_what_is_no_enclosure(value):
    """Wrong lengths, inverted ends, nesting and leaves that are no strings reject."""
    with pytest.raises(Rejected):
        enclosure(value, "e")


def test_an_enclosure_may_be_a_point():
    """Equal ends, in different notation, are allowed."""
    assert enclosure(["1", "1.0"], "e").lower == 1


@pytest.mark.parametrize("literal", ["5", "1001", "-6", "6.0", "06", "", "1e2", "9" * 4000, "12/2"])
def test_small_integers_out_of_bounds_reject(literal):
    """Only plain integers in the bounds; both bounds are allowed."""
    with pytest.raises(Rejected):
        Whole(6, 1000)(literal, "digits")
    assert Whole(6, 1000)("6", "digits") == 6
    assert Whole(6, 1000)("1000", "digits") == 1000


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "not JSON in UTF-8"),
        (b"\x00\x01\x02\xff\xfe", "can't decode"),
        (b"\xff" * 100, "can't decode"),
        (b"\xef\xbb\xbf{}", "not JSON"),
        (b"{", "not JSON"),
        (b"{} {}", "not JSON"),
        (b"[" * MAX_BYTES, "recursion"),
        (b'{"a":' * 100000, "recursion"),
        (b" " * (MAX_BYTES + 1), "larger"),
        (b'{"a":"1","a":"1"}', "repeats"),
        (b'{"a":{"b":"1","b":"2"}}', "repeats"),
        (b"{'a': 'b'}", "not JSON"),
        (b'["\x01"]', "not JSON"),
    ],
)
def test_files_that_are_no_certificates(data, why):
    """Binary, truncated, repeated and deep JSON, each with its reason."""
    with pytest.raises(Rejected, match=why):
        parsed(data)


@pytest.mark.parametrize(("before", "after"), [("[", "]"), ('{"a": ', "}")])
def test_what_is_nested_where_a_string_is_expected(good, before, after):
    """Rejected at any depth, in claims and in what else is not read, as far as JSON goes."""
    for path in (("claims", "trace"), ("cites",), ("provenance", "cap")):
        bad = copy.deepcopy(good)
        at(bad, path[:-1])[path[-1]] = "HERE"
        for depth in (1, 17, 500, 100000):
            deep = before * depth + '"x"' + after * depth
            with pytest.raises(Rejected):
                read(encode(bad).replace(b'"HERE"', deep.encode()))


@pytest.mark.parametrize(
    "junk", ["1", "-1.5", "NaN", "-Infinity", "1e400", "9" * 5000, "true", "false", "null", "[]"]
)
def test_no_leaf_is_anything_but_a_string(good, junk):
    """JSON's own numbers of any size, true, false and null, anywhere, also in the provenance."""
    leaves = [p for p in paths(good) if isinstance(at(good, p), str)]
    for path in leaves:
        bad = copy.deepcopy(good)
        at(bad, path[:-1])[path[-1]] = "HERE"
        with pytest.raises(Rejected, match=r"not a string|is none of|own list"):
            read(encode(bad).replace(b'"HERE"', junk.encode()))


@pytest.mark.parametrize("data", [b"[]", b'"text"', b"{}", b'[{"a": "b"}]'])
def test_json_of_another_form(data):
    """Valid JSON that is no object of the format rejects."""
    with pytest.raises(Rejected):
        read(data)


def test_the_good_certificate_can_be_read(good):
    """The one that the tests below break is accepted as it stands."""
    assert read(encode(good)).theorem == "elliptic"


def paths(value, path=()):
    """Give the path of every part of a JSON value."""
    yield path
    if isinstance(value, dict | list):
        for key in value if isinstance(value, dict) else range(len(value)):
            yield from paths(value[key], (*path, key))


def at(value, path):
    """Return the part at a path."""
    for key in path:
        value = value[key]
    return value


def test_every_field_is_needed_and_no_other_is_allowed(good):
    """Each key removed or added, each list shortened or lengthened, anywhere: rejected."""
    for path in list(paths(good)):
        if path[:1] == ("provenance",) and len(path) > 1:
            continue
        part = at(good, path)
        changes = []
        if isinstance(part, dict) and path != ("provenance",):
            changes.append(lambda p: p.update(surplus="1"))
        if isinstance(part, list):
            changes += [
                lambda p: p.append(copy.deepcopy(p[0]) if p else ["1", "2"]),
                lambda p: p and p.pop(),
            ]
        for change in changes:
            bad = copy.deepcopy(good)
            change(at(bad, path))
            if bad != good:
                with pytest.raises(Rejected):
                    verify(bad)
        if path and isinstance(path[-1], str):
            bad = copy.deepcopy(good)
            del at(bad, path[:-1])[path[-1]]
            with pytest.raises(Rejected):
                verify(bad)


@pytest.mark.parametrize("junk", [1, 1.5, True, None, [], {}, "", "x", "NaN", ["1", "2"], "1e3"])
def test_every_leaf_is_checked(good, junk):
    """No leaf outside the provenance may be replaced by junk."""
    for path in list(paths(good)):
        if path[:1] in {("provenance",), ()} or isinstance(at(good, path), dict | list):
            continue
        bad = copy.deepcopy(good)
        at(bad, path[:-1])[path[-1]] = junk
        with pytest.raises(Rejected):
            verify(bad)


BROKEN = {
    "format": (("format",), "cap-certificate/2", "format"),
    "theorem": (("theorem",), "hyperbolic", "theorem"),
    "theorem unhashable": (("theorem",), ["elliptic"], "theorem is none of"),
    "digits small": (("digits",), "5", "digits"),
    "digits large": (("digits",), "1001", "digits"),
    "bits small": (("hints", "bits"), "63", "bits is not between"),
    "bits large": (("hints", "bits"), "8193", "bits is not between"),
    "order even": (("hints", "order"), "4", "order"),
    "order small": (("hints", "order"), "1", "order"),
    "order large": (("hints", "order"), "11", "order"),
    "no hits": (("hints", "hit_times"), [], "1 to 64"),
    "many hits": (("hints", "hit_times"), [["1", "2"]] * 65, "1 to 64"),
    "hits are no list": (("hints", "hit_times"), {}, "1 to 64"),
    "hints are no object": (("hints",), [], "hints"),
    "radius zero": (("hints", "radius"), "0", "interior of its box"),
    "radius negative": (("hints", "radius"), "-1/1000", "ends of an interval are not in order"),
    "omega zero": (("parameters", "omega"), "0", "omega"),
    "omega negative": (("parameters", "omega"), "-1", "omega"),
    "friction negative": (("parameters", "f"), "-1/5", "f < F"),
    "friction too large": (("parameters", "f"), "1", "f < F"),
    "walls": (("parameters", "l"), "1", "l < r"),
    "cites": (("cites", 0, "theorem"), "Newton", "cites"),
    "cites statement": (("cites", 1, "hypotheses", 0, "statement"), "anything", "cites"),
    "cites by": (("cites", 1, "hypotheses", 0, "by"), [], "cites"),
    "cites empty": (("cites",), [], "cites"),
    "provenance": (("provenance",), "text", "provenance"),
    "provenance list": (("provenance",), [], "provenance"),
    "taylor key": (("claims", "taylor", "x"), {}, "missing or unknown"),
    "inverted": (("claims", "trace"), ["0.5", "0.25"], "lower > upper"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_each_rule_of_the_format(good, name):
    """Each rule broken alone is rejected, and for that reason."""
    path, value, why = BROKEN[name]
    bad = copy.deepcopy(good)
    at(bad, path[:-1])[path[-1]] = value
    rejected(bad, why)


def test_decimals_for_people():
    """Exact: a decimal if that is short, else the fraction."""
    for text in ("0.25", "-0.000043441281", "12", "-3", "1/3", "-22/7", "4.81839722", "0"):
        assert decimal(Fraction(text)) == text
    assert decimal(Fraction(1, 2**200)) == f"1/{2**200}"
