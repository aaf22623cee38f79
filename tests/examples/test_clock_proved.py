"""A clock: nothing depends on the time, and the period is unknown."""

import json
import math
from copy import deepcopy
from fractions import Fraction
from functools import cache

import pytest

from cap.certificate.writer import dumps
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check, words
from cap.command.prover import main
from cap.explore import explorer
from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs.contacts import prove
from cap.system.files import read

D = 0.1
W = math.sqrt(1 - D * D)
FACTOR = math.exp(-2 * math.pi * D / W)  # of a turn
SPEED = FACTOR / (1 - FACTOR)
PERIOD = 2 * math.pi / W
MODEL = read("examples/clock.py", {"f": 0, "d": "1/10", "k": 1})
NAMES = ("coming", "kick"), ("going", "stop"), ("back", "turn")
CONTACTS = [
    Contact(*names, to) for names, to in zip(NAMES, ("going", "back", "coming"), strict=True)
]


@cache
def certificate():
    """Return the certificate of the orbit, from a guess that is wrong by some per cent."""
    guess = [PERIOD + 0.1, 0.01, SPEED + 0.05, 1.5, 1.8, 0, 4.6, -1.3, 0]
    return prove(Itinerary(MODEL, CONTACTS), guess)


def inside(value, pair):
    """Return whether a double lies in a claim."""
    low, high = map(Fraction, pair)
    return low <= Fraction(value) <= high


def test_the_closed_form():
    """The period, the speed before the kick, and the multiplier; the other one is 0."""
    claims = certificate()["claims"]
    assert inside(PERIOD, claims["times"][0])
    assert inside(math.atan2(W, D) / W, claims["times"][1])  # where v = 0 after the kick
    assert inside(SPEED, claims["states"][0][1])
    assert inside(FACTOR, claims["symmetric"][0])
    assert inside(0, claims["symmetric"][1])
    assert claims["unstable"] == "0"


def test_the_sentence():
    """It says that the period is known in an interval, and uniqueness but for shifts."""
    said = words(check(dumps(certificate()).encode(), lambda _: None))
    assert "has an orbit of period in [6.3148388" in said
    assert "but for shifts in time it is the only one" in said
    assert "; it attracts: with z = (x, v) just before" in said


def test_lies():
    """Two periods, a period moved, a clock that matters after all."""
    given = deepcopy(certificate())
    given["claims"]["periods"] = "2"
    rejected(given, "claims.periods is not 1, but the system has no clock")
    given = deepcopy(certificate())
    low, high = map(Fraction, given["claims"]["times"][0])
    given["claims"]["times"][0] = [str(high), str(2 * high - low)]
    rejected(given, "times.0. does not contain the enclosure computed")
    given = deepcopy(certificate())
    given["parameters"]["modes"]["coming"]["field"]["v"].append(["1/1000000000", "cos"])
    rejected(given, "does not lie in the interior")
    given = deepcopy(certificate())
    kick = given["parameters"]["modes"]["coming"]["guards"]["kick"]["reset"]["v"]
    kick[kick.index(["1"])] = ["1000000001/1000000000"]
    rejected(given, "does not lie in the interior")


def rejected(given, reason):
    """Check that a certificate is rejected for this reason."""
    with pytest.raises(Rejected, match=reason):
        check(dumps(given).encode(), lambda _: None)


def test_the_command(tmp_path, capsys):
    """The search follows orbits until they come back to a contact; a period is not asked for."""
    out = tmp_path / "clock.json"
    words_ = ["periodic", "--model", "examples/clock.py", "--set", "f=0", "--out", str(out)]
    assert main(words_) == 0
    said = capsys.readouterr().out
    assert "Found 1 orbit" in said
    assert "at the period 6.29105" in said
    assert len(json.loads(out.read_bytes())["claims"]["contacts"]) == 3
    assert main([*words_, "--orbit", "1.0", "0.5", "--mode", "going"]) == 0
    assert main([*words_, "--period", "2"]) == 2
    assert "nothing depends on the clock" in capsys.readouterr().err


@pytest.mark.slow
def test_a_curve(tmp_path, capsys):
    """Over the friction the swing stays one that attracts."""
    out = tmp_path / "curve.json"
    range_ = ["--parameter", "f", "--range", "1/100", "3/100"]
    assert main(["branch", "--model", "examples/clock.py", *range_, "--out", str(out)]) == 0
    assert "there is a connected curve of orbits of an unknown period" in capsys.readouterr().out
    claims = json.loads(out.read_bytes())["claims"]
    assert [*map(Fraction, claims["range"])] == [Fraction(1, 100), Fraction(3, 100)]
    assert {cell["outside"] for cell in claims["cells"]} == {"0"}
    assert not claims["points"]


def test_floats_that_need_a_clock(capsys):
    """They are refused in a line that says what does it."""
    clock = "--model", "examples/clock.py"
    assert explorer.main(["search", *clock]) == 2
    assert "the period is unknown: `attractor` and `orbit` find it" in capsys.readouterr().err
    range_ = "--parameter", "f", "--range", "1/100", "3/100"
    assert explorer.main(["continuation", *clock, *range_]) == 2
    assert "`cap.prove branch --model` proves the curve" in capsys.readouterr().err
