"""Malformed certificates are rejected, quickly, in one line, whatever they contain."""

from __future__ import annotations

import copy
import json
import os
import subprocess
import sys
import time
from fractions import Fraction

import pytest
from checker.forge import forge

from cap import verify
from cap.checker.certificate import MAX_BYTES, bounded, enclosure, number, parsed, read
from cap.checker.rejection import Rejected


@pytest.fixture(scope="module")
def good():
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
    with pytest.raises(Rejected):
        number(literal, "n")


@pytest.mark.parametrize("value", [1, 1.5, None, True, ["1"], {"a": "1"}])
def test_what_is_no_string_is_no_number(value):
    with pytest.raises(Rejected, match="string"):
        number(value, "n")


def test_the_longest_numbers():
    for literal in ("9" * 4000, "0." + "1" * 3998, "1/" + "9" * 3998):
        assert number(literal, "n") > 0


@pytest.mark.parametrize(
    "value", [["1"], ["1", "2", "3"], "1", ["2", "1"], [["1", "2"]], {}, ["1", 2], None]
)
def test_what_is_no_enclosure(value):
    with pytest.raises(Rejected):
        enclosure(value, "e")


def test_an_enclosure_may_be_a_point():
    assert enclosure(["1", "1.0"], "e").lower == 1


@pytest.mark.parametrize("literal", ["5", "1001", "-6", "6.0", "06", "", "1e2", "9" * 4000, "12/2"])
def test_small_integers_out_of_bounds_reject(literal):
    with pytest.raises(Rejected):
        bounded(literal, 6, 1000, "digits")
    assert bounded("6", 6, 1000, "digits") == 6
    assert bounded("1000", 6, 1000, "digits") == 1000


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "not JSON"),
        (b"\x00\x01\x02\xff\xfe", "UTF-8"),
        (b"\xff" * 100, "UTF-8"),
        (b"\xef\xbb\xbf{}", "not JSON"),
        (b"{", "not JSON"),
        (b"{} {}", "not JSON"),
        (b"[" * MAX_BYTES, "nested"),
        (b'{"a":' * 100000, "nested"),
        (b" " * (MAX_BYTES + 1), "larger"),
        (b'{"a":"1","a":"1"}', "repeats"),
        (b'{"a":{"b":"1","b":"2"}}', "repeats"),
        (b"1", "JSON number"),
        (b"[1.5]", "JSON number"),
        (b"[NaN]", "JSON number"),
        (b"[-Infinity]", "JSON number"),
        (b"[1e400]", "JSON number"),
        (b"[" + b"9" * 5000 + b"]", "JSON number"),
        (b"[true]", "not a string"),
        (b'{"a":[{"b":null}]}', "not a string"),
        (b"{'a': 'b'}", "not JSON"),
        (b'["\x01"]', "not JSON"),
    ],
)
def test_files_that_are_no_certificates(data, why):
    with pytest.raises(Rejected, match=why):
        parsed(data)


@pytest.mark.parametrize("data", [b"[]", b'"text"', b"{}", b'[{"a": "b"}]'])
def test_json_of_another_form(data):
    with pytest.raises(Rejected):
        read(data)


def encode(certificate):
    return json.dumps(certificate).encode()


def test_the_good_certificate_can_be_read(good):
    assert read(encode(good)).theorem == "elliptic"


def paths(value, path=()):
    yield path
    if isinstance(value, dict | list):
        for key in value if isinstance(value, dict) else range(len(value)):
            yield from paths(value[key], (*path, key))


def at(value, path):
    for key in path:
        value = value[key]
    return value


def test_every_field_is_needed_and_no_other_is_allowed(good):
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
                    read(encode(bad))
        if path and isinstance(path[-1], str):
            bad = copy.deepcopy(good)
            del at(bad, path[:-1])[path[-1]]
            with pytest.raises(Rejected):
                read(encode(bad))


@pytest.mark.parametrize("junk", [1, 1.5, True, None, [], {}, "", "x", "NaN", ["1", "2"], "1e3"])
def test_every_leaf_is_checked(good, junk):
    for path in list(paths(good)):
        if path[:1] in {("provenance",), ()} or isinstance(at(good, path), dict | list):
            continue
        bad = copy.deepcopy(good)
        at(bad, path[:-1])[path[-1]] = junk
        with pytest.raises(Rejected):
            read(encode(bad))


BROKEN = {
    "format": (("format",), "cap-certificate/2", "format"),
    "theorem": (("theorem",), "hyperbolic", "theorem"),
    "theorem unhashable": (("theorem",), ["elliptic"], "string"),
    "digits small": (("digits",), "5", "digits"),
    "digits large": (("digits",), "1001", "digits"),
    "bits small": (("hints", "bits"), "63", "bits"),
    "bits large": (("hints", "bits"), "16385", "bits"),
    "order even": (("hints", "order"), "4", "odd"),
    "order small": (("hints", "order"), "1", "order"),
    "order large": (("hints", "order"), "11", "order"),
    "no hits": (("hints", "hit_times"), [], "1 to 64"),
    "many hits": (("hints", "hit_times"), [["1", "2"]] * 65, "1 to 64"),
    "hits are no list": (("hints", "hit_times"), {}, "1 to 64"),
    "hints are no object": (("hints",), [], "hints"),
    "radius zero": (("hints", "radius"), "0", "radius"),
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
    path, value, why = BROKEN[name]
    bad = copy.deepcopy(good)
    at(bad, path[:-1])[path[-1]] = value
    with pytest.raises(Rejected, match=why):
        read(encode(bad))


@pytest.fixture
def files(tmp_path, good):
    (tmp_path / "good.json").write_bytes(encode(good))
    with (tmp_path / "huge.json").open("wb") as huge:
        huge.truncate(1 << 30)
    (tmp_path / "deep.json").write_bytes(b"[" * 500000)
    (tmp_path / "empty.json").write_bytes(b"")
    (tmp_path / "bad\nname\x1b.json").write_bytes(b"\x1b[31m")
    hostile = {**good, "theorem": "\x1b[31m\n" * 1000, "\r\nVERIFIED: ": "1"}
    (tmp_path / "hostile.json").write_bytes(encode(hostile))
    os.mkfifo(tmp_path / "fifo.json")
    return tmp_path


@pytest.mark.parametrize(
    "name",
    [
        "huge.json",
        "deep.json",
        "empty.json",
        "bad\nname\x1b.json",
        "hostile.json",
        "fifo.json",
        ".",
        "none",
    ],
)
def test_bad_files_are_rejected_in_one_line_and_soon(files, capsys, name):
    start = time.monotonic()
    assert verify.main([str(files / name)]) == 1
    assert time.monotonic() - start < 2
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith("REJECTED: ")
    assert out.count("\n") == 1
    assert out[:-1].isprintable()
    assert len(out) < 800


def test_the_exit_status(files, capsys):
    good, bad = str(files / "good.json"), str(files / "empty.json")
    assert verify.main([good]) == 0
    assert verify.main([good, bad]) == 1
    assert verify.main([bad, good]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0] for line in lines] == [
        "VERIFIED",
        "VERIFIED",
        "REJECTED",
        "REJECTED",
        "VERIFIED",
    ]
    with pytest.raises(SystemExit) as usage:
        verify.main([])
    assert usage.value.code == 2


def test_any_exception_is_a_rejection(files, capsys, monkeypatch):
    def fail(*_):
        raise ZeroDivisionError("x" * 10000 + "\n")

    monkeypatch.setattr(verify, "check", fail)
    assert verify.main([str(files / "good.json")]) == 1
    assert capsys.readouterr().out.endswith("ZeroDivisionError while checking\n")


def test_an_interrupt_exits_130(files, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(verify, "check", interrupt)
    assert verify.main([str(files / "good.json")]) == 130


def test_the_command_under_python_o(files):
    command = [sys.executable, "-O", "-m", "cap.verify", "--explain"]
    for name, status in (("good.json", 0), ("hostile.json", 1)):
        done = subprocess.run(
            [*command, str(files / name)], capture_output=True, text=True, check=False
        )
        assert done.returncode == status
        assert done.stderr == ""
        verdict = done.stdout.splitlines()[-1]
        assert verdict.startswith("VERIFIED: " if status == 0 else "REJECTED: ")


def test_explain_prints_the_steps_before_the_verdict(files, capsys):
    assert verify.main(["--explain", str(files / "good.json")]) == 0
    *steps, verdict = capsys.readouterr().out.splitlines()
    assert verdict.startswith("VERIFIED: ")
    assert len(steps) >= 8
    assert all(step.startswith("  ") for step in steps)


def test_latex(files, capsys, good):
    arguments = ["--latex", "--latex-digits", "5", str(files / "good.json")]
    assert verify.main(arguments) == 0
    out, err = capsys.readouterr()
    assert err.startswith("VERIFIED: ")
    macros = dict(
        line.removeprefix("\\newcommand{\\cap").split("}{", 1) for line in out.splitlines()
    )
    assert macros["GoodTrace"] == "[-0.46029, -0.46028]}"
    lower, upper = json.loads(
        macros["GoodBoxX"][:-1].replace("[", '["').replace("]", '"]').replace(", ", '", "')
    )
    claim = good["claims"]["box"]["x"]
    assert Fraction(lower) <= Fraction(claim[0])
    assert Fraction(claim[1]) <= Fraction(upper)
    assert "\\cdot 10^{" in macros["GoodRemainderX"]
    assert all(name.isalpha() for name in macros)
    assert verify.main(["--latex", str(files / "empty.json")]) == 1
    assert capsys.readouterr().out == ""
