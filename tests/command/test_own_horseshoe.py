"""`cap.prove horseshoe --map` and `--model`: what is proved of a file, and refusals in one line."""

import json
from functools import partial

import pytest

from cap.command.prover import main
from cap.floats.coverings import search
from cap.proofs import map_horseshoe
from cap.system.files import planar

HENON = "examples/maps/henon.py"


def prove(*words, given=HENON):
    """Run the command and return its status."""
    return main(["horseshoe", "--map", given, *map(str, words)])


@pytest.mark.slow
def test_from_a_file_to_a_certificate(tmp_path, capsys, monkeypatch):
    """Near a full horseshoe a small sample and short words are enough for most of log 2; no other
    file is replaced."""
    monkeypatch.setattr(search, "cells", partial(search.cells, symbols=search.FEW))
    words = "--set", "a=5", "--effort", "1", "--sets", "disjoint", "--out", tmp_path
    assert prove(*words) == 0
    assert "one-sided subshift" in capsys.readouterr().out.replace("\n  ", " ")
    (path,) = tmp_path.glob("*.json")
    assert path.name == "map_horseshoe-henon-a=5.json"
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert float(claims["entropy"]) > 0.69
    assert claims["together"] == "1"
    path.write_text("{}")
    assert prove(*words) == 2
    assert "there is another file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--effort", "9"], "integer from 1 to 5"),
        (["--sets", "few"], "must be one of"),
        (["--set", "c=1"], "no parameter c"),
        (["--out", "/nowhere/at/all.json"], "cannot write"),
    ],
)
def test_refusals(words, why, capsys):
    """One line each."""
    assert prove(*words) == 2
    assert why in capsys.readouterr().err


MAPS = {
    "one": 'Map("x", {"x": x})',
    "unknown": 'Map("x y", {"x": x + z, "y": y})',
    "missing": 'Map("x y", {"x": x})',
    "turns": 'Map("x y", {"x": x * y, "y": y}, torus=True)',
    "name": 'Map("x cos", {"x": x, "cos": y})',
    "pi": 'Map("x y", {"x": x / pi, "y": y})',
    "system": "1",
}
WHY = {
    "one": "two coordinates",
    "unknown": "the unknown z",
    "missing": "give the images",
    "turns": "depends on turns",
    "name": "not a name",
    "pi": "divided by pi",
    "system": "returns no cap.Map, but int",
}


@pytest.mark.parametrize("name", MAPS)
def test_what_is_no_map(name, tmp_path, capsys):
    """What is wrong with the map is told, with the file."""
    file = tmp_path / "mine.py"
    lines = "from cap import Map, variables", 'x, y, z, pi = variables("x y z pi")'
    file.write_text("\n".join([*lines, "", "", "def mine():", f"    return {MAPS[name]}"]))
    assert prove(given=str(file)) == 2
    said = capsys.readouterr().err
    assert WHY[name] in said
    assert "mine.py" in said
    assert said.count("\n") == 1


def test_other_files(capsys):
    """A system is no map, JSON neither, and another theorem has none."""
    assert prove(given="examples/ball.py") == 2
    assert "returns no cap.Map, but System" in capsys.readouterr().err
    assert prove(given="map.json") == 2
    assert "a map is FILE.py" in capsys.readouterr().err
    assert main(["elliptic", "--map", HENON]) == 2
    assert "of a map `horseshoe` is proved" in capsys.readouterr().err


def test_the_form_of_a_certificate():
    """Polynomials are lists of terms; a torus is told."""
    found = map_horseshoe.as_parameters(planar("examples/maps/standard.py", {"K": "3/2"}))
    assert found["torus"] == "1"
    assert sorted(found["image"]["y"]) == [["1", "y"], ["3/2", "sin"]]


@pytest.mark.slow
def test_a_map_without_a_saddle(tmp_path, capsys):
    """It is said that nothing is proved: a rotation has none."""
    file = tmp_path / "turn.py"
    lines = "from cap import Map, variables", 'x, y = variables("x y")'
    file.write_text("\n".join([*lines, "def turn():", '    return Map("x y", {"x": -y, "y": x})']))
    assert prove("--out", tmp_path, given=str(file)) == 1
    assert "no saddle" in capsys.readouterr().err


# systems

BALL = "examples/ball.py"


def model(*words, given=BALL):
    """Run the command for a system and return its status."""
    return main(["horseshoe", "--model", given, *map(str, words)])


@pytest.mark.slow
def test_from_a_system_to_a_certificate(tmp_path, capsys):
    """A ball on a high table, without overlaps; the file that is there is not replaced."""
    words = "--set", "A=3/4,e=1", "--sets", "disjoint", "--out", tmp_path
    assert model(*words) == 0
    assert "one-sided subshift" in capsys.readouterr().out.replace("\n  ", " ")
    (path,) = tmp_path.glob("*.json")
    assert path.name == "contact_horseshoe-ball-A=3_4-e=1.json"
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert float(claims["entropy"]) > 0.25
    assert float(claims["per_period"]) > 0.1
    path.write_text("{}")
    assert model(*words) == 2
    assert "there is another file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("given", "words", "why"),
    [
        (BALL, ["--effort", "5"], "integer from 1 to 4"),
        (BALL, ["--sets", "few"], "must be one of"),
        (BALL, ["--set", "c=1"], "no parameter c"),
        ("examples/billiard.py", [], "the state has 4 variables"),
        ("examples/clock.py", [], "nothing depends on the clock"),
        ("examples/impact_oscillator.py", [], "not polynomial in time"),
        ("examples/maps/henon.py", [], "returns no cap.System"),
    ],
)
def test_refusals_of_systems(given, words, why, capsys):
    """One line each."""
    assert model(*words, given=given) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
