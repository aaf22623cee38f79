"""`cap.prove attractor --model`: what is proved of a file, and refusals in one line."""

import json

import pytest

from cap.command.prover import main
from cap.errors import NotProved
from cap.proofs import contact_attractor
from cap.runner import Runner
from cap.system.files import read

TOSS = """
from cap import Guard, Mode, System, variables
y, v, cos, pi = variables("y v cos pi")
def toss(a=2):
    hand = Guard(y, "fly", {"y": 0, "v": pi + a * cos})
    return System("y v", 1, {"fly": Mode({"y": v, "v": -1}, {"hand": hand})})
"""


def prove(model, *words):
    """Run the command and return its status."""
    return main(["attractor", "--model", str(model), *map(str, words)])


@pytest.mark.slow
def test_the_belt_as_stored(tmp_path, capsys):
    """One orbit of two periods attracts what is released in more than a third of a period."""
    assert prove("examples/belt.py", "--out", tmp_path) == 0
    assert "exactly one fixed point" in capsys.readouterr().out.replace("\n", " ")
    (path,) = tmp_path.glob("*.json")
    assert path.name == "contact_attractor-belt.json"
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert float(claims["rate"]) < 0.7
    assert claims["periods"] == "2"


@pytest.mark.slow
def test_entropy_of_a_ball_that_is_tossed(tmp_path):
    """The map t + 4 cos t; its entropy is between bounds, and the Lyapunov exponent in floats."""
    file = tmp_path / "toss.py"
    file.write_text(TOSS)
    assert prove(file, "--out", tmp_path / "toss.json") == 0
    claims = json.loads((tmp_path / "toss.json").read_text("utf-8"))["claims"]
    low, high = map(float, claims["entropy"])
    assert 0.77 < low < high < 0.78
    assert claims["entropy_per_period"] == claims["entropy"]
    assert claims["period"] == "5"
    assert [int(n) > 0 for n in claims["orbits"][:5]] == [True, True, False, True, True]


def test_entropy_over_two_periods(tmp_path, capsys):
    """The same map, with flights that are a period longer: half the entropy for each."""
    file = tmp_path / "toss.py"
    file.write_text(TOSS.replace("pi + a", "2 * pi + a"))
    assert prove(file, "--set", "a=43/20", "--out", tmp_path / "toss.json") == 0
    claims = json.loads((tmp_path / "toss.json").read_text("utf-8"))["claims"]
    assert claims["periods"] == "2"
    pairs = zip(claims["entropy"], claims["entropy_per_period"], strict=True)
    assert all(abs(float(one) - 2 * float(each)) < 3e-8 for one, each in pairs)
    told = " ".join(capsys.readouterr().out.split())
    assert "+ 2 pi j/omega, j = 0, .., 1; G has at least" in told
    assert "repeat after m x 2 x 2 pi/omega" in told


def test_two_releases_in_a_round(tmp_path, capsys):
    """Of the map t + 2 a cos t the fixed point is unstable at a = 11/10, and a cycle attracts.

    So the release that closes the round is not the next one, but the one after it.
    """
    file = tmp_path / "toss.py"
    file.write_text(TOSS)
    assert prove(file, "--set", "a=11/10", "--out", tmp_path / "two.json") == 0
    claims = json.loads((tmp_path / "two.json").read_text("utf-8"))["claims"]
    assert len(claims["contacts"]) == 2
    assert float(claims["rate"]) < 1
    told = " ".join(capsys.readouterr().out.split())
    assert "if after it the next release but 1 follows with the contacts 'hand' of 'fly'" in told


@pytest.mark.parametrize(
    ("model", "words", "why"),
    [
        ("examples/ball.py", (), "after table of fly v is not given by y and the clock"),
        ("examples/clock.py", (), "nothing depends on the clock"),
        ("examples/billiard.py", (), "not of degree 1 in one variable"),
        ("examples/impact_oscillator.py", (), "the clock alone decides when"),
        ("examples/belt.py", ("--set", "c=1"), "no parameter c"),
        ("examples/belt.py", ("--out", "/nowhere/at/all.json"), "cannot write"),
    ],
)
def test_refusals(model, words, why, capsys):
    """One line each."""
    assert prove(model, *words) == 2
    err = capsys.readouterr().err
    assert why in err
    assert err.count("\n") == 1


def test_what_is_not_proved():
    """A fixed point that is neutral: all of its neighbours, too."""
    with pytest.raises(NotProved, match="no interval"):
        contact_attractor.prove_any(read("examples/den_hartog.py", {}), Runner(1, lambda *_: None))
