"""The command ``cap.prove basin --model FILE``: from a file to a certificate, and refusals."""

import json
from fractions import Fraction

import numpy as np
import pytest

from cap.areas.resting.asked import Rectangle, driven
from cap.checker.verdict import check
from cap.command.own import main
from cap.errors import BadInput, NotProved
from cap.floats.models.engine import Engine
from cap.orbits.wall import wall
from cap.proofs import certified, contact_basin
from cap.system.files import read
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import variables

BALL = "examples/ball.py"
BOX = ["--box", "0", "2", "-2", "2", "--until", "6"]


def run(*words, model=BALL):
    """Run the command and return its status."""
    return main(["basin", "--model", model, *words])


@pytest.mark.slow  # compiled anew in a fresh clone
def test_from_a_file_to_a_certificate(tmp_path, capsys):
    """The shares grow with the number of cells; the name tells what is asked."""
    shares = []
    for cells in ("300", "3000"):
        words = "--set", "A=3/10", "--cells", cells, "--out", str(tmp_path)
        assert run(*BOX, *words) == 0
        assert "comes to rest before t = 6" in capsys.readouterr().out.replace("\n  ", " ")
        (path,) = tmp_path.glob("*.json")
        assert path.name == "contact_basin-ball-A=3_10-until=6.json"
        claims = json.loads(path.read_text("utf-8"))["claims"]
        shares.append([float(claims[key]) for key in ("resting", "flying")])
    assert shares[0][0] < shares[1][0] < 0.75
    assert shares[0][1] <= shares[1][1] < 0.25


@pytest.mark.slow
def test_processes_of_the_checker(tmp_path, capsys, monkeypatch):
    """The certificate is the same, and as many are asked for as the checker has."""
    made, asked = [], []

    def noted(data, hear, jobs, tell):
        asked.append(jobs)
        return check(data, hear, jobs, tell)

    monkeypatch.setattr(certified, "check", noted)
    for jobs in ("1", "2"):
        path = tmp_path / f"{jobs}.json"
        assert run(*BOX, "--cells", "3000", "--jobs", jobs, "--out", str(path)) == 0
        made.append(path.read_bytes())
    capsys.readouterr()
    assert made[0] == made[1]
    assert asked == [1, 2]


@pytest.mark.slow
def test_a_table_nearly_at_rest():
    """At rest all from below 1/8 rest before sqrt(2 H/g) (1 + e)/(1 - e) = 3/2; none flies."""
    box = {"y": (0, Fraction(1, 8)), "v": (-Fraction(1, 100), 0)}
    asked = Rectangle(Fraction(0), Fraction(8, 5), box)
    found = contact_basin.prove(wall(read(BALL, {"A": Fraction(1, 1000)})), asked, 2000)
    assert float(found["claims"]["resting"]) > 0.95
    assert found["claims"]["flying"] == "0"


@pytest.mark.slow
def test_too_few_cells():
    """Of one large cell nothing is certain."""
    box = {"y": (0, Fraction(2)), "v": (-Fraction(3), 3)}
    asked = Rectangle(Fraction(0), Fraction(6), box)
    with pytest.raises(NotProved, match="of no cell it is certain"):
        contact_basin.prove(wall(read(BALL, {})), asked, 1)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["--box", "0", "2", "-2", "2", "--until", "0"], "--until is not after --start"),
        (["--box", "0", "2", "-2", "2", "--until", "501"], "at most 500/omega after --start"),
        (["--box", "0", "0", "-2", "2", "--until", "6"], "--box has no area"),
        (["--box", "0", "2", "--until", "6"], "--box is the least and the greatest"),
        ([*BOX, "--cells", "0"], "integer from 1"),
        ([*BOX, "--guard", "table"], "--guard is MODE/GUARD"),
        ([*BOX, "--out", "/nowhere/at/all.json"], "cannot write"),
    ],
)
def test_refusals(words, why, capsys):
    """One line each."""
    assert run(*words) == 2
    assert why in capsys.readouterr().err


@pytest.mark.parametrize(
    ("model", "why"),
    [
        ("coupled_masses", "the state has 4 variables, not two"),
        ("harvester", "free has other guards than top"),
        ("gear_rattle", "free has other guards than front"),
        ("impact_oscillator", "no share of a rectangle|no guard names a mode of rest"),
        ("oscillator", "no share of a rectangle"),
        ("billiard", "no guard names a mode of rest"),
    ],
)
def test_models_that_are_refused(model, why):
    """What is not of this kind says why."""
    with pytest.raises(BadInput, match=why):
        driven(wall(read(f"examples/{model}.py", {})))


z, v, cos, pi = variables("z v cos pi")


def ceiling():
    """Return a ball that a force 1 + cos(2 pi t)/3 presses to a ceiling; h falls as z rises."""
    force = 1 + cos * Fraction(1, 3)
    top = Guard(1 - 2 * z, "free", Bounce(Fraction(2, 5)), rest="held")
    leave = Guard(force, "free", {"v": 0})
    free, held = Mode({"z": v, "v": force}, {"top": top}), Mode({"z": 0, "v": 0}, {"leave": leave})
    return System("v z", 2 * pi, {"free": free, "held": held})


@pytest.mark.slow
def test_shares_beside_floats():
    """A part rests, and a part flies, not larger than in floats, from t = 1/4."""
    system, start, until = ceiling(), Fraction(1, 4), Fraction(5, 2)
    box = {"v": (Fraction(-1), Fraction(1)), "z": (Fraction(-1), Fraction(1, 2))}
    found = contact_basin.prove(wall(system), Rectangle(start, until, box), 3000)
    proved = [float(found["claims"][key]) for key in ("resting", "flying")]
    engine, count = Engine(system), 2000
    states = np.random.default_rng(1).uniform((-1, -1), (1, 0.5), (count, 2))
    phase = 2 * np.pi * float(start)
    ends = engine.follow(states, ["free"] * count, phase=phase, periods=3, log=120 * count)
    orbits, when = ends.log[:, 0], ends.log[:, 1]
    captured = (ends.log[:, 2] == engine.words.index("capture")) & (when < float(until - start))
    rest = len(np.unique(orbits[captured])) / count
    assert 0.05 < proved[0] < rest + 0.02
    assert 0.6 < proved[1] < 1 - rest + 0.02
