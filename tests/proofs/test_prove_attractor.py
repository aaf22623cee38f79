"""The theorem attractor: at other parameters, against laps counted in floats, and refusals."""

import json
import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.errors import BadInput, NotProved
from cap.floats.engine import swarm
from cap.floats.engine.releases import images
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import attractor
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted
from cap.release.cell import Cell
from cap.release.trap import critical_points, trap
from cap.release.unimodal import turning
from cap.sets.interval import Ball

STORED = json.loads((Path(__file__).parents[2] / "certificates/attractor.json").read_text("utf-8"))[
    "claims"
]


def number(pair):
    """Return the middle of an enclosure."""
    return float(sum(map(Fraction, pair)) / 2)


@pytest.mark.slow
def test_the_entropy_against_laps():
    """The number of monotone pieces of Gⁿ on I grows like exp(n h)."""
    low, high = map(float, STORED["interval"])
    x = np.linspace(low, high, 60_001)
    counts = []
    for _ in range(12):
        x = images(PAPER, x).value
        rising = np.diff(x) > 0
        counts.append(1 + int((rising[1:] != rising[:-1]).sum()))
    growth = math.log(counts[-1] / counts[-7]) / 6
    assert growth == pytest.approx(number(STORED["entropy"]), rel=0.04)
    assert number(STORED["entropy_per_period"]) == pytest.approx(2 / 3 * number(STORED["entropy"]))


def test_the_critical_point_and_its_images():
    """In floats: where G' vanishes, and the first symbols."""
    c = number(STORED["critical_point"])
    found = images(PAPER, [c - 1e-5, c, c + 1e-5])
    assert found.slope[0] < 0 < found.slope[2]
    assert found.value[1] == pytest.approx(number(STORED["critical_value"]), abs=1e-9)
    x, symbols = found.value[1], ""
    for _ in range(20):
        symbols += "R" if x < c else "L"
        x = images(PAPER, [x]).value[0]
    assert STORED["kneading"].startswith(symbols)


def test_the_basin():
    """States of the box rest in I, or its mirror image, before a release."""
    sides = [list(map(float, STORED["basin"][z])) for z in "xv"]
    states = np.random.default_rng(2).uniform(*zip(*sides, strict=True), (200, 2))
    time = 2 * math.pi - math.acos(0.4) + 2 * math.pi - math.pi - 1e-9  # of a release to the left
    found = swarm.follow(PAPER, states, time / (2 * math.pi))
    assert (found.states[:, 1] == 0).all()
    low, high = map(float, STORED["interval"])
    assert ((-found.states[:, 0] > low) & (-found.states[:, 0] < high)).all()


def proved(p, digits=6):
    """Return the claims of the theorem at other parameters, which the checker accepts."""
    start = Start(critical_points(p)[0], 0.0, ())
    return accepted(THEOREMS["attractor"], Setting(p, start, digits))["claims"]


@pytest.mark.slow
def test_other_parameters():
    """With losses, in other units and with other walls: the entropy agrees where it must."""
    scaled = replace(PAPER, F=Fraction(3), omega=Fraction(2), f=Fraction(6, 5),
                     l=Fraction(1), r=Fraction(5, 2))  # fmt: skip
    claims = proved(scaled)
    low, high = map(Fraction, claims["entropy"])
    assert low <= Fraction(STORED["entropy"][1])
    assert Fraction(STORED["entropy"][0]) <= high
    assert claims["kneading"].startswith(STORED["kneading"][:20])


def test_several_itineraries():
    """Where orbits use several branches there is no such interval: that is said."""
    with pytest.raises(BadInput, match=r"mapped into itself with one itinerary.* --from Q --to Q"):
        trap(replace(PAPER, f=Fraction(42, 100)), -0.474959)
    with pytest.raises(BadInput, match="no next one"):
        trap(replace(PAPER, f=Fraction(1, 1000)), 0.3)


def test_no_critical_point():
    """Signs of the derivative that are not those of a unimodal map prove nothing."""

    def cells(*slopes):
        curves = {"0": Ball(1), "?": Ball(-1)}
        return [
            Cell(Fraction(n), Fraction(n + 1), (), Ball(0),
                 {"-": Ball(-1), "+": Ball(1)}.get(s, Ball(0, 1)), curves.get(s), 3)
            for n, s in enumerate(slopes)
        ]  # fmt: skip

    assert turning(cells(*"--00++")) == 1
    for signs in ("--++", "----", "-0-", "-0+0+", "-?+", "+0-", "-+0+", "-0?+", "0-0+"):
        with pytest.raises(NotProved, match="critical point"):
            turning(cells(*signs))


def test_not_long_enough(monkeypatch):
    """If the symbols cannot tell the entropy, that is not proved."""
    monkeypatch.setattr(attractor, "MOST_SYMBOLS", 30)
    monkeypatch.setattr(attractor, "ROUNDS", 2)
    setting = Setting(PAPER, Start(number(STORED["critical_point"]), 0.0, ()), 20)
    known = trap(PAPER, setting.start.x)
    with pytest.raises(NotProved, match="30 symbols do not decide so many digits"):
        attractor.lemma_3_entropy(setting, known, 1, 3)
    with monkeypatch.context() as patch:
        patch.setattr(attractor, "kneading_sequence", lambda *_: iter("RLRL"))
        with pytest.raises(NotProved, match="not certain for long enough"):
            attractor.lemma_3_entropy(setting, known, 1, 3)
    with pytest.raises(NotProved, match="where G' vanishes"):
        attractor.lemma_3_entropy(setting, known, -1, 3)
