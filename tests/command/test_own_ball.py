"""`cap.prove island --ball`: what is proved, and refusals in one line."""

import json

import pytest

from cap.command.prover import main


def prove(*words):
    """Run the command and return its status."""
    return main(["island", *map(str, words)])


@pytest.mark.slow
def test_from_parameters_to_a_certificate(tmp_path, capsys):
    """A curve of slow motions; other units scale it; no other file is replaced."""
    assert prove("--ball", "A=1/20", "--out", tmp_path) == 0
    assert "bounces elastically" in capsys.readouterr().out
    (path,) = tmp_path.glob("*.json")
    assert path.name == "ball_curve-A=1_20.json"
    low, high = map(float, json.loads(path.read_text("utf-8"))["claims"]["speeds"])
    assert 1.88 < low < 1.9
    assert 1.98 < high < 2
    other = tmp_path / "other.json"
    assert prove("--ball", "A=1/40,omega=2,g=2", "--out", other) == 0
    speeds = map(float, json.loads(other.read_text("utf-8"))["claims"]["speeds"])
    assert list(speeds) == pytest.approx([low, high], abs=1e-6)
    path.write_text("{}")
    assert prove("--ball", "A=1/20", "--out", tmp_path) == 2
    assert "there is another file" in capsys.readouterr().err


@pytest.mark.slow
def test_beyond_the_last_curve(capsys, tmp_path):
    """Not proved."""
    assert prove("--ball", "A=9/10", "--turns", "1", "--out", tmp_path) == 1
    assert "NOT PROVED (ball_curve)" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--ball", "A=1"], "A omega^2 < g"),
        (["--ball", "A=0"], "must be positive"),
        (["--ball", "e=1/2"], "no parameter e"),
        (["--ball", "A"], "NAME=VALUE"),
        (["--ball", "A=1/5", "--rotation", "0.6"], "continued fraction"),
        (["--ball", "A=1/5", "--turns", "-1"], "integer from 0"),
        (["--ball", "A=1/5", "--out", "/nowhere/at/all.json"], "cannot write"),
    ],
)
def test_refusals(words, why, capsys):
    """One line each."""
    assert prove(*words) == 2
    assert why in capsys.readouterr().err
