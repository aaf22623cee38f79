"""Families of periodic orbits: beside their closed form, and what is no family."""

import json
from contextlib import suppress
from fractions import Fraction

import numpy as np
import pytest

from cap.command.own import main
from cap.errors import NotProved
from cap.floats.models.periodic import followed
from cap.orbits.family import Family, family, quarters
from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs import contacts_family
from cap.proofs.contacts_family import Parts
from cap.system.files import read

MODEL = "examples/den_hartog.py"
TURNS = (Contact("right", "stop", "left"), Contact("left", "stop", "right"))


def den_hartog(**values):
    """Return the family of the oscillator with its turns at t = 0 and half a period later."""
    return family(Itinerary(read(MODEL, values), TURNS), [0, 2])


def closed(omega, f, excess=0):
    """Return from where to where c goes, and where it stands in the middle."""
    w, f, excess = map(Fraction, (omega, f, excess))
    K, P = w * w / (1 - w * w), 1 / (1 - w * w)
    return P + f - K + excess, P - f + K - excess


@pytest.mark.parametrize(("omega", "f", "excess"), [("1/2", "1/10", "0"), ("1/4", "1/50", "1/100")])
def test_the_interval_is_that_of_the_closed_form(omega, f, excess):
    """It is inside, and comes near to both ends; the product is that of the formula."""
    found = den_hartog(omega=omega, f=f, excess=excess)
    low, high = closed(omega, f, excess)
    proof = contacts_family.prove(found.itinerary, flat(found, (low + high) / 2))
    a, b = map(Fraction, proof["claims"]["range"])
    assert low < a < b < high
    assert a - low < 1e-5
    assert high - b < 1e-5
    least, most = map(Fraction, proof["claims"]["product"])
    K, force = closed(omega, 0)[1] - 1 / (1 - Fraction(omega) ** 2), Fraction(f)
    for c in (a, (a + b) / 2, b):
        C = c - 1 / (1 - Fraction(omega) ** 2) - force
        product = (K + C) * (K - 2 * force - C) / ((K + C + 2 * force) * (K - C))
        assert least < product < most


def flat(found, c):
    """Return times and states of an orbit."""
    period = 2 * np.pi / float(found.itinerary.system.omega.terms[()])
    return [x for j, q in zip(found.quarters, found.at(c), strict=True)
            for x in (j * period / 4, *map(float, q))]  # fmt: skip


def test_the_orbits_are_exact():
    """They turn at c and c - 2/(1 - omega^2), whatever the friction is."""
    found = den_hartog(omega="1/2", f="1/10")
    assert found.states == [[(0, 1), (0, 0)], [(Fraction(-8, 3), 1), (0, 0)]]
    assert found.frequencies == [Fraction(1, 2), 1]
    assert found.at(Fraction(6, 5))[1] == [Fraction(6, 5) - Fraction(8, 3), 0]


def test_what_is_followed_is_the_family():
    """Most states that have settled turn at quarters of a period, up to rounding."""
    found = 0
    for itinerary, guess in followed(read(MODEL, {"omega": "1/2", "f": "1/10"}), 1):
        with suppress(NotProved):
            assert isinstance(family(itinerary, quarters(itinerary, guess[::3])), Family)
            found += 1
    assert found > 50


@pytest.mark.parametrize(
    ("c", "reason"), [(Fraction(1), "guard|open|crossed"), (Fraction(8, 5), "guard|open|crossed")]
)
def test_outside_there_are_none(c, reason):
    """The equations of the contacts have a solution there, too."""
    found = den_hartog(omega="1/2", f="1/10")
    with pytest.raises(NotProved, match=reason):
        Parts(found, lambda *_: None).part((c, c + Fraction(1, 10**6)))


def test_a_command(tmp_path, capsys):
    """It finds the family, proves it, and names the file."""
    out = tmp_path / "family.json"
    words = ["family", "--model", MODEL, "--set", "omega=1/2,f=1/5", "--out", str(out)]
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "different c have different states at the first of these times" in said
    claims = json.loads(out.read_text("utf-8"))["claims"]
    low, high = closed("1/2", "1/5")
    a, b = map(Fraction, claims["range"])
    assert Fraction(9, 10) * (high - low) < b - a < high - low


def test_no_family(tmp_path, capsys):
    """Where contacts are elsewhere, the command says so; so if none is asked for."""
    words = ["family", "--model", MODEL, "--out", str(tmp_path / "family.json")]
    assert main(words) == 1
    assert "contacts are not at quarters of a period" in capsys.readouterr().err
    assert main(["contacts_family", *words[1:], "--period", "0"]) == 2


NONE = "no orbit has contacts at these times"
REFUSED = {
    "another frequency": (MODEL, {"omega": "3/7"}, TURNS, [0, 2], "whole number of quarters"),
    "no orbit": (MODEL, {"omega": "1/3"}, TURNS, [0, 2], NONE),
    "three quarters": (
        MODEL,
        {"omega": "1/2"},
        TURNS,
        [0, 3],
        "no orbit has contacts at these times",
    ),
    "damping": (
        "examples/impact_oscillator.py",
        {},
        [Contact("free", "wall", "free")],
        [0],
        "not sums of cos and sin",
    ),
    "pi": (
        "examples/harvester.py",
        {},
        [Contact("free", end, "free") for end in ("top", "bottom")],
        [0, 2],
        "the clock has no rational frequency|have pi in their equations",
    ),
    "free fall": (
        "examples/ball.py",
        {},
        [Contact("fly", "table", "fly")],
        [0],
        "not sums of cos and sin",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_no_family(what):
    """Each is refused for its own reason."""
    file, values, contacts, times, reason = REFUSED[what]
    with pytest.raises(NotProved, match=reason):
        family(Itinerary(read(file, values), contacts), times)


def test_contacts_elsewhere():
    """Times that are no quarters are refused; so is a system without a clock."""
    itinerary = Itinerary(read(MODEL, {"omega": "1/2"}), TURNS)
    assert quarters(itinerary, [0, 2 * np.pi]) == [0, 2]
    with pytest.raises(NotProved, match="not at quarters"):
        quarters(itinerary, [0, 6])
    turn = [("back", "turn", "coming"), ("coming", "kick", "going"), ("going", "stop", "back")]
    clock = Itinerary(read("examples/clock.py", {}), [Contact(*names) for names in turn])
    with pytest.raises(NotProved, match="no clock"):
        contacts_family.prove(clock, [0.0] * 9)
