"""Capture in one's own system: beside closed forms and floats, and refusals."""

import json
from fractions import Fraction
from math import sqrt
from pathlib import Path

import pytest

from cap.command.own import main
from cap.errors import BadInput, NotProved
from cap.floats.models.engine import Engine
from cap.orbits.wall import wall
from cap.proofs import contact_capture
from cap.system.files import read
from cap.system.model import Guard, Mode, System
from cap.system.polynomial import variables

CAPTURE = json.loads(Path("certificates/capture.json").read_text("utf-8"))["claims"]
BOX = ["--box", "0", "10", "-5", "5"]


Y, V = variables("y v")


def bouncing(reset, rest="still", value=None):
    """Return a ball on a fixed table, with another event."""
    y, v = variables("y v")
    table = Guard(y if value is None else value, "fly", reset, rest)
    modes = {"fly": Mode({"y": v, "v": -1}, {"table": table}), "still": Mode({"y": 0, "v": 0})}
    return System("y v", 1, modes)


def proved(file, values, box, time="0", mode=None):
    """Return the claims for a box of an example."""
    return claimed(read(f"examples/{file}.py", values), box, time, mode)


def claimed(system, box, time="0", mode=None):
    """Return the claims for a box of a system."""
    place = wall(system)
    sides = {z: tuple(map(Fraction, ends)) for z, ends in box.items()}
    start = Fraction(time)
    found = contact_capture.prove(place, start, mode or place.falling, sides)
    return found["claims"]


@pytest.mark.parametrize("e", ["1/2", "9/10"])
@pytest.mark.parametrize("height", ["1/8", "2"])
def test_a_ball_that_falls(e, height):
    """On a table at rest the time is sqrt(2h/g) (1 + e)/(1 - e), and more than that of the fall."""
    claims = claimed(bouncing({"v": -Fraction(e) * V}), {"y": (height, height), "v": ("0", "0")})
    low, high = (float(Fraction(q)) for q in claims["accumulation_time"])
    fall, loss = sqrt(2 * float(Fraction(height))), float(Fraction(e))
    exact = fall * (1 + loss) / (1 - loss)
    assert exact < high < 1.05 * exact
    assert 0.9 * fall < low < fall
    assert claims["for_ever"] == "yes"
    assert Fraction(claims["ratio"]) - Fraction(e) < Fraction(1, 100)


@pytest.mark.parametrize(
    "box", [{"y": ("0", "10"), "v": ("-5", "5")}, {"y": ("90", "91"), "v": ("9", "9")}]
)
def test_all_motions_rest_in_floats(box):
    """After the accumulation the engine has all motions of the box at rest."""
    values = {"A": "1/5", "e": "1/2"}
    claims = proved("ball", values, box)
    engine = Engine(read("examples/ball.py", values))
    (a, b), (c, d) = (tuple(map(float, ends)) for ends in box.values())
    starts = [(a + (b - a) * i / 4, c + (d - c) * j / 4) for i in range(1, 5) for j in range(5)]
    periods = int(float(Fraction(claims["accumulation_time"][1])) / 6.28) + 1
    ends = engine.follow(starts, ["fly"] * len(starts), periods=periods)
    assert {engine.modes[mode] for mode in ends.modes} == {"rest"}


@pytest.mark.parametrize("mode", ["right", "left"])
def test_the_same_as_the_other_theorem(mode):
    """The oscillator of `capture`, with a mode for each direction: the same release."""
    p = json.loads(Path("certificates/capture.json").read_text("utf-8"))["parameters"]
    box = {z: tuple(ends) for z, ends in CAPTURE["box"].items()}
    claims = proved("oscillator", p | {"e": p["e"]}, box, mode=mode)
    assert (claims["falling"], claims["guard"], claims["rising"]) == ("right", "wall", "left")
    low, high = (Fraction(q) for q in CAPTURE["release_time"])
    assert Fraction(claims["rests_until"]) <= high
    assert low <= Fraction(claims["released_by"])
    assert Fraction(claims["released_by"]) - Fraction(claims["rests_until"]) == Fraction(1, 10**10)
    assert Fraction(claims["ratio"]) <= Fraction(CAPTURE["ratio"]) * Fraction(101, 100)
    mine, other = (Fraction(q["accumulation_time"][1]) for q in (claims, CAPTURE))
    assert mine < other


@pytest.mark.parametrize(
    ("file", "values", "box", "why"),
    [
        (
            "ball",
            {"e": "1"},
            {"y": ("0", "1"), "v": ("0", "0")},
            "may not decrease: e = 1",
        ),
        ("ball", {"A": "2"}, {"y": ("0", "1"), "v": ("0", "0")}, "may not attract near it"),
        (
            "ball",
            {"A": "1/5"},
            {"y": ("-2", "-1"), "v": ("0", "0")},
            "no state of the box",
        ),
        ("harvester", {}, {"z": ("-1/5", "1/4"), "v": ("0", "0")}, "no hit is found"),
        ("gear_rattle", {}, {"x": ("0", "1/2"), "v": ("-2", "2")}, "no hit is found"),
    ],
)
def test_not_proved(file, values, box, why):
    """The reason, and the sets that show it."""
    with pytest.raises(NotProved, match=why):
        proved(file, values, box)


@pytest.mark.parametrize(
    ("system", "why"),
    [
        (bouncing({"v": V * Fraction(-1, 2)}, None), "no guard names a mode of rest"),
        (bouncing({"v": 0}), "restitution 0"),
        (bouncing({"v": -2 * V}), "restitution 2"),
        (bouncing({"v": V * Fraction(1, 2)}), "restitution -1/2"),
        (bouncing({"v": 1 - V}), "does not make the derivative of its guard to -e times"),
        (bouncing({"v": -V}, value=Y + V * V), "not linear"),
    ],
)
def test_what_is_no_wall(system, why):
    """In one line, with the reason."""
    with pytest.raises(BadInput, match=why) as refusal:
        wall(system)
    assert "\n" not in str(refusal.value)


def prove(*words):
    """Run the command and return its status."""
    return main(["capture", "--model", *map(str, words)])


def test_the_command(capsys, tmp_path):
    """The stored certificate is what its command proves; no other file is replaced."""
    words = ["examples/ball.py", "--set", "A=1/5", *BOX, "--out", tmp_path]
    assert prove(*words) == 0
    (path,) = tmp_path.iterdir()
    assert path.name == "contact_capture-ball-A=1_5.json"
    kept = json.loads(Path("certificates/contact_capture-1.json").read_text("utf-8"))
    assert json.loads(path.read_text("utf-8"))["claims"] == kept["claims"]
    assert "with h = h' = 0, for ever" in capsys.readouterr().out.replace("\n  ", " ")
    path.write_text("{}")
    assert prove(*words) == 2
    assert "there is another file" in capsys.readouterr().err


def test_the_search(capsys, tmp_path):
    """Without a box one is found at the wall, at a time that may be given."""
    words = ["examples/oscillator.py", "--set", "e=4/5", "--start", "6", "--out", tmp_path]
    assert prove(*words) == 0
    (path,) = tmp_path.iterdir()
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert claims["start"] == "6"
    assert claims["rests_until"].startswith("8.2654984")
    assert prove("examples/ball.py", "--set", "e=1") == 1
    assert "NOT PROVED (contact_capture).  capture: the speeds at" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["examples/den_hartog.py"], "no guard names a mode of rest"),
        (["examples/clock.py"], "no guard names a mode of rest"),
        (["examples/coupled_masses.py"], "give --box: the state has 4 variables"),
        (["examples/ball.py", "--box", "0", "1"], "--box is the least and the greatest value"),
        (["examples/ball.py", "--box", "1", "0", "0", "1"], "--box is the least and the greatest"),
        (["examples/ball.py", "--guard", "table"], "--guard is MODE/GUARD"),
        (["examples/ball.py", "--guard", "fly/roof"], "there is no guard roof of a mode fly"),
        (["examples/ball.py", "--mode", "rest"], "--mode is fly or fly"),
    ],
)
def test_the_command_refuses(words, why, capsys, tmp_path):
    """In one line, with the reason."""
    assert prove(*words, "--out", tmp_path) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_no_option_that_does_nothing(capsys):
    """There are no processes to be told of."""
    with pytest.raises(SystemExit) as ended:
        prove("examples/ball.py", "--jobs", "2")
    assert ended.value.code == 2
    assert "--jobs" in capsys.readouterr().err
