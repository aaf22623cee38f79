"""An interval of places that the release map takes into itself: what is, and what is not."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import pairwise

import pytest

from cap.checker.attracting import attractor
from cap.checker.attracting.attractor import into_itself, stays
from cap.checker.folded.motion import Direction, Releases
from cap.checker.folded.stops import LATE, backwards, sticks, turns
from cap.checker.folded.units import Units
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import enclosure
from cap.checker.system.walls import Parameters
from checker.mixed_small import STORED, small

PAPER = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)))
Y, UNITS = Releases(PAPER), Units(PAPER)


def distances(low, high):
    """Return the distances to the wall of the places between these."""
    return UNITS.distances(enclosure([low, high], "an interval"))


@pytest.mark.slow
def test_the_interval_of_the_stored_certificate():
    """It is taken into itself; moved by a little, or made a little shorter, it is not."""
    low, high = json.loads(STORED.read_text("utf-8"))["claims"]["attractor"]["interval"]
    into_itself(Y, distances(low, high))
    for lie in ((low, "-0.45"), ("-0.76", high), ("-0.70", "-0.33"), ("-0.9", "0.9")):
        with pytest.raises(Rejected, match="releases may leave their interval"):
            into_itself(Y, distances(*lie))


def test_a_rest_near_a_wall_is_no_proof(monkeypatch):
    """The next place is known then, but not that it depends continuously on the first one."""
    places = distances("-0.6", "-0.59").outer
    assert stays(Y, places, (0.0, 2.0))
    constant = (1.5, *[0.0] * 6), 0.01
    monkeypatch.setattr(attractor, "next_release", lambda *_: constant)
    assert not stays(Y, places, (0.0, 2.0))
    monkeypatch.setattr(attractor, "next_release", lambda *_: 2)
    assert not stays(Y, places, (0.0, 2.0))


def test_no_multiple_of_pi_is_counted_twice():
    """For each region the numbers of those that count increase."""
    theorem, V, y = small()[0], 3.0, Direction(PAPER)
    seen = 0
    for leaf in [*theorem.leaves(y, "late")][::2] + [*theorem.leaves(y, "turns")][::2]:
        start = turns(y, leaf.region) if leaf.parts else sticks(y, LATE, leaf.region)
        numbers = [strobe.number for _, strobe in backwards(y, start.flight, leaf.flights, V)]
        assert all(a < b for a, b in pairwise(numbers))
        seen += len(numbers)
    assert seen > 50
