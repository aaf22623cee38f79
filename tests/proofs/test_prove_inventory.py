"""The theorem inventory: against the search in floats, and where it is not proved."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from conftest import STARTS

from cap.checker.theorems.inventory import Inventory
from cap.errors import BadInput, NotProved
from cap.floats.candidates import Request
from cap.floats.engine.swarm import follow
from cap.floats.search.orbits import from_hit_times
from cap.maps.inventory import Effort, TooMany, Tree, tree
from cap.maps.launch_set import Constants
from cap.parameters import PAPER
from cap.proofs import inventory
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted
from cap.sets import interval

SYSTEMS = {
    "paper": PAPER,
    "after the pitchfork": replace(PAPER, f=Fraction(1, 2)),
    "no orbit": replace(PAPER, f=Fraction(7, 10)),
    "one hit at most": replace(PAPER, f=Fraction(9, 10)),
    "other units": replace(
        PAPER, F=Fraction(2), omega=Fraction(3), f=Fraction(9, 10), l=Fraction(1), r=Fraction(3)
    ),
    "wide": replace(PAPER, l=Fraction(-5, 2), r=Fraction(5, 2)),
}


LONG = ("paper", "after the pitchfork")
TURNING = ("paper", "after the pitchfork", "other units", "wide")  # the segment exists


def setting(p):
    """Return the setting at some parameters."""
    return Setting(p, STARTS["elliptic"], 20)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name in LONG)) for name in SYSTEMS],
)
def test_the_search_finds_the_same(name):
    """The checker agrees, nothing is left open, and floats find these orbits and no other."""
    p = SYSTEMS[name]
    claims = accepted(THEOREMS["inventory"], setting(p))["claims"]
    assert claims["undecided"] == {"boxes": "0", "size": "0"}
    orbits = [orbit for orbits in from_hit_times(p) for orbit in orbits]
    found = sorted((orbit.x, orbit.v, orbit.trace) for orbit in orbits)
    proved = [
        [float(sum(map(Fraction, point[key])) / 2) for key in ("x", "v", "trace")]
        for point in claims["fixed_points"]
    ]
    assert len(found) == len(proved)
    for one, other in zip(found, sorted(proved), strict=True):
        assert one == pytest.approx(other, rel=1e-6, abs=1e-9)
    assert claims["families"] == ["segment"] * (name in TURNING)
    assert all(len(orbit.hit_times) == 2 for orbit in orbits)


def test_on_the_way_back_at_the_start(monkeypatch):
    """With little friction one of the pair moves to the left at t = 0; launches are left out."""
    p = replace(PAPER, f=Fraction(1, 10), l=Fraction(0), r=Fraction(249, 100))
    monkeypatch.setattr(inventory.inventory, "tree", lambda *_: Tree(["?"], [], []))
    monkeypatch.setattr(Inventory, "launches", lambda _: None)
    points = accepted(THEOREMS["inventory"], setting(p))["claims"]["fixed_points"]
    states = [[float(Fraction(point[key][0])) for key in "xv"] for point in points]
    assert sorted(v > 0 for _, v in states) == [False, True, True, True]
    after = follow(p, states, 1, derivative=True)
    np.testing.assert_allclose(after.states, states, atol=1e-9)
    traces = [float(Fraction(point["trace"][0])) for point in points]
    np.testing.assert_allclose(np.trace(after.monodromy, axis1=1, axis2=2), traces, rtol=1e-6)


def test_too_many_boxes(monkeypatch):
    """Where a certificate would have more boxes than it may, that is said before all are there."""
    monkeypatch.setattr(inventory, "MAX_BOXES", 300)
    with pytest.raises(NotProved, match="than a certificate may have: f or R is too small"):
        inventory.prove(setting(PAPER))


@pytest.mark.parametrize(("depth", "most"), [(4, 16), (4, 15)])
def test_the_number_of_leaves_is_bounded(depth, most):
    """A tree of this depth has as many leaves as boxes of this size, as none is empty."""
    with interval.workprec(64):
        system = Constants.of(interval.ball(Fraction(2, 5)), interval.ball(2))
        sides, effort = (interval.ball(100), interval.ball(100)), Effort(depth, most)
        if most == 16:
            assert len(tree(system, sides, effort, lambda *_: None).open) == 16
        else:
            with pytest.raises(TooMany):
                tree(system, sides, effort, lambda *_: None)


def test_what_is_left_open_is_told(monkeypatch):
    """With few halvings boxes are left; their number and size are claimed and checked."""
    monkeypatch.setattr(inventory, "DEPTH", 12)
    claims = accepted(THEOREMS["inventory"], setting(PAPER))["claims"]
    assert int(claims["undecided"]["boxes"]) > 100
    assert Fraction(claims["undecided"]["size"]) > Fraction(1, 2)
    assert len(claims["fixed_points"]) == 4


@pytest.mark.slow
def test_progress():
    """It tells how many boxes are done."""
    told = []
    inventory.prove(replace(setting(PAPER), progress=told.append))
    assert told
    assert all("boxes of launches examined" in line for line in told)


def test_refusals():
    """No friction; losses; parameters at which an orbit is born."""
    for p, why in (
        (replace(PAPER, f=Fraction(0)), "f > 0"),
        (replace(PAPER, e=Fraction(1, 2)), "e = 1/2"),
        (replace(PAPER, mu=Fraction(1, 2)), "mu = 1/2"),
    ):
        with pytest.raises(BadInput, match=why):
            inventory.SEARCH(Request("inventory", p))
    barely = Fraction(2 / math.sqrt(4 + math.pi**2))  # orbits that touch no wall begin to stick
    asked = setting(replace(PAPER, f=barely))
    with interval.workprec(53), pytest.raises(NotProved, match="is open"):
        inventory.lemma_3_families(asked)
