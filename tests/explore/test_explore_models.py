"""The commands of `cap.explore` about a model: what they print, draw and refuse."""

import re
from pathlib import Path

import numpy as np
import pytest

from cap.explore import explorer
from cap.explore.arrays import load

EXAMPLES = Path(__file__).parents[2] / "examples"
PAIR = "--model", str(EXAMPLES / "harvester.py")


def run(capsys, *words):
    """Return the exit status, what is printed, and what is complained of."""
    try:
        status = explorer.main(words)
    except SystemExit as end:
        status = end.code
    out, err = capsys.readouterr()
    return status, out, err


def test_an_orbit(capsys, tmp_path):
    """It is closed, its events are told with what jumps; there is a wall on each side."""
    files = [tmp_path / name for name in ("orbit.svg", "orbit.npz", "orbit.csv")]
    out = [word for file in files for word in ("--out", str(file))]
    status, text, _ = run(capsys, "orbit", *PAIR, "--set", "s=1/2,e=0.5", *out)
    assert status == 0
    assert re.search(r"top +free -> free  z = 0.25, v = 0.930820\d+ -> -0.46541", text)
    assert "it closes after 1 period of the clock; multipliers -0.242" in text
    assert "it attracts" in text
    found = load(files[1])
    assert found["values"] == {"s": "1/2", "e": "1/2", "G": "1/10"}
    assert found["words"].tolist() == ["top", "bottom"]
    assert [found["walls"][k]["place"][0] for k in (0, 1)] == [0.25, -0.25]
    assert np.abs(found["states"][:, 0]).max() == pytest.approx(0.25)
    assert files[2].read_text().startswith("# model = ")
    assert files[0].read_text().count("<path") > 10


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("orbit", "--model", "none.py"), "cannot read none.py"),
        (("orbit", *PAIR, "--set", "E=1"), "no parameter E: there are s = 1/2, e = 1/2, G = 1/10"),
        (("orbit", *PAIR, "--set", "e=x"), "e: not a number: 'x' .*the parameters are s = 1/2"),
        (
            ("orbit", *PAIR, "--set", "e=2"),
            r"harvester.py:\d+: the restitution .* not .* in \[0, 1\]",
        ),
        (("orbit", *PAIR, "--set", "e"), "--set takes NAME=VALUE"),
        (("orbit", *PAIR, "--state", "1"), "--state takes 2 numbers, z, v: 1 given"),
        (("orbit", *PAIR, "--state", "9", "1"), "in no mode"),
        (("orbit", *PAIR, "--state", "0", "1", "--mode", "fly"), "no mode 'fly': there are free"),
        (("orbit", *PAIR, "--plane", "z", "w"), "no variable w: the state is z, v"),
        (("orbit", *PAIR, "--F", "3"), "unrecognized arguments: --F 3"),
        (("sali", *PAIR), "invalid choice: 'sali'"),
    ],
)
def test_refusals(capsys, words, message):
    """One line, exit status 2."""
    status, _, err = run(capsys, *words)
    assert status == 2
    assert re.search(message, err)
    assert err.count("\n") == 1
