"""`cap.prove island --ball`: what is proved, and refusals in one line."""

import json
from pathlib import Path

import pytest

from cap.command.prover import main

SMALL = Path(__file__).parents[1] / "certificates/accept/ball_curve_small.json"


def prove(*words):
    """Run the command and return its status."""
    return main(["island", *map(str, words)])


@pytest.mark.slow
def test_from_parameters_to_a_certificate(tmp_path, capsys):
    """A curve of slow motions; that stored has other units, which scale it; no other file is
    replaced."""
    assert prove("--ball", "A=2/45", "--turns", "1", "--out", tmp_path) == 0
    assert "bounces elastically" in capsys.readouterr().out
    (path,) = tmp_path.glob("*.json")
    assert path.name == "ball_curve-A=2_45-turns=1.json"
    ours, theirs = (
        [float(v) for v in json.loads(file.read_text("utf-8"))["claims"]["speeds"]]
        for file in (path, SMALL)  # A = 1/30, omega = 2, g = 3: the same A omega^2/g
    )
    assert [v * 3 / 2 for v in ours] == pytest.approx(theirs, abs=1e-6)
    path.write_text("{}")
    assert prove("--ball", "A=2/45", "--turns", "1", "--out", tmp_path) == 2
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
