"""`cap.prove island --map`: what is proved of a file, and refusals in one line."""

import json

import pytest

from cap.command.prover import main

STANDARD = "examples/maps/standard.py"


def prove(*words, given=STANDARD):
    """Run the command and return its status."""
    return main(["island", "--map", given, *map(str, words)])


def test_from_a_file_to_a_certificate(tmp_path, capsys):
    """A curve well inside; no other file is replaced."""
    words = "--set", "K=1/5", "--rotation", "[0;2,(1)]", "--out", tmp_path
    assert prove(*words) == 0
    said = capsys.readouterr().out.replace("\n  ", " ")
    assert "alpha = [0;2,(1)]" in said
    assert "or back" in said
    (path,) = tmp_path.glob("*.json")
    assert path.name == "map_curve-standard-K=1_5.json"
    low, high = map(float, json.loads(path.read_text("utf-8"))["claims"]["bounds"])
    assert 2.2 < low < 2.4 < high < 2.7
    path.write_text("{}")
    assert prove(*words) == 2
    assert "there is another file" in capsys.readouterr().err


@pytest.mark.slow
def test_beyond_the_last_curve(capsys, tmp_path):
    """Not proved."""
    assert prove("--set", "K=6/5", "--out", tmp_path) == 1
    assert "NOT PROVED (map_curve)" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--rotation", "0.6"], "continued fraction"),
        (["--rotation", "[0;0,(1)]"], "quotient 0"),
        (["--set", "c=1"], "no parameter c"),
        (["--out", "/nowhere/at/all.json"], "cannot write"),
    ],
)
def test_refusals(words, why, capsys):
    """One line each."""
    assert prove(*words) == 2
    assert why in capsys.readouterr().err


def test_a_map_of_another_kind(capsys):
    """That of Hénon is none of a cylinder."""
    assert prove(given="examples/maps/henon.py") == 2
    assert "the map is not" in capsys.readouterr().err
