"""File names and other words of strangers: quoted and escaped, so that they forge no sentence."""

import ast
from pathlib import Path

import pytest
from support import proving

from cap import verify
from cap.checker.verdict import check, words
from cap.explore import __main__ as explore
from cap.words import printable, quoted

STORED = Path(__file__).parents[2] / "certificates"
FORGED = "and unstable, hence false)\nVERIFIED: F = 1"
HOSTILE = [
    f"{FORGED} (saddle.json",
    'saddle") VERIFIED: F = 2 ("saddle.json',
    "back\\slash\\n.json",
    "\r\x1b[2K\x7f\u202e.json",
    "caf\u00e9 \u03c9.json",
    "not utf-8 \udcff.json",
]


@pytest.mark.parametrize("name", HOSTILE)
def test_a_quoted_name_is_one_word(name):
    """It is one printable literal, from which Python reads the same name again."""
    shown = quoted(name)
    assert shown.isascii()
    assert shown.isprintable()
    assert shown[0] == shown[-1] == '"'
    assert ast.literal_eval(shown) == name


@pytest.mark.parametrize("name", HOSTILE)
def test_a_verdict_cannot_be_forged_by_a_name(name, tmp_path, capsys):
    """One line: the theorem as the checker words it, and the name after it; or the refusal."""
    path, stored = tmp_path / name, (STORED / "saddle.json").read_bytes()
    path.write_bytes(stored)
    assert verify.main([str(path)]) == 0
    theorem = words(check(stored, lambda _step: None))
    assert capsys.readouterr().out == f"VERIFIED: {theorem} ({quoted(path)})\n"
    path.write_bytes(b"{}")
    assert verify.main(["--explain", str(path), str(tmp_path / f"no{name}")]) == 2
    missing, refused = capsys.readouterr().out.splitlines()  # small files first
    assert refused.startswith(f"REJECTED: {quoted(path)}: certificate has missing")
    assert missing == f"CANNOT READ: {quoted(tmp_path / f'no{name}')}: No such file or directory"


def test_the_name_of_the_certificate_is_quoted(tmp_path, capsys):
    """Of one that was written, and of one that cannot be."""
    path = tmp_path / f"{FORGED}.json"
    status, out, _ = proving(capsys, "saddle", "--digits", "8", "--out", str(path))
    assert status == 0
    assert f"\nCertificate: {quoted(path)} (written;" in out
    assert "\nVERIFIED" not in out
    status, _, err = proving(capsys, "saddle", "--digits", "8", "--out", str(path / "x.json"))
    assert status == 2
    assert err.startswith(f"error: cannot write {quoted(path / 'x.json')}: ")
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    "line",
    [
        ["saddle", FORGED],
        ["saddle", f"--{FORGED}"],
        [FORGED],
        ["saddle", "--F", FORGED],
        ["branch", "--journal", f"no/such/{FORGED}"],
    ],
)
def test_complaints_of_the_prover_are_one_line(line, capsys):
    """Arguments that make no sense, with line ends in them."""
    status, _, err = proving(capsys, *line)
    assert status == 2
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert err[:-1].isprintable()


@pytest.mark.parametrize(
    "line",
    [
        [FORGED],
        ["orbit", FORGED],
        ["--paper", FORGED],
        ["orbit", "--out", FORGED],
        ["orbit", "--out", f"{FORGED}/x.csv"],
        ["--paper", "cover", "--out", f"{FORGED}/x.csv"],
        ["continuation", "--parameter", FORGED],
    ],
)
def test_complaints_of_the_explorer_are_one_line(line, capsys):
    """Arguments that make no sense, with line ends in them."""
    try:
        status = explore.main(line)
    except SystemExit as stop:
        status = stop.code
    out, err = capsys.readouterr()
    assert status == 2
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert err[:-1].isprintable()
    assert "\nVERIFIED" not in out


def test_the_name_of_a_picture_is_quoted(tmp_path, capsys):
    """The explorer says in one line which file it wrote."""
    path = tmp_path / f"{FORGED}.csv"
    assert explore.main(["orbit", "--out", str(path)]) == 0
    assert f"\n{quoted(path)}: written\n" in capsys.readouterr().out


def test_what_is_printable_stays():
    """Plain words are not touched; everything else is escaped."""
    assert printable("f = 2/5, 'x'") == "f = 2/5, 'x'"
    assert printable("\n\t\u03c9") == "\\n\\t\\u03c9"
