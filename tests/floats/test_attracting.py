"""Attracting cycles of the time-T map, and their least periods."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.floats.diagnostics.attractor import attractors
from cap.floats.diagnostics.gallery import gallery
from cap.floats.search.attracting import attracting, first_alike, growth
from cap.parameters import PAPER

ROOT = Path(__file__).parents[2]
WEAK = replace(PAPER, f=Fraction("1/5"))


def test_before_it_doubles():
    """A cycle of 9 T that nearly doubles is not taken for one of 18 T, to which it never comes."""
    claims = json.loads((ROOT / "certificates/cascade-1.json").read_text("utf-8"))["claims"]
    p = replace(PAPER, f=Fraction("0.38599"))
    assert p.f > Fraction(claims["parameters"][1][1])
    found = attractors(p, points=3, transient=3000).found
    assert {each.period for each in found} == {0, 9}
    assert all(each.kind == "period 9" for each in found if each.period)


def test_the_least_period():
    """A fixed point has the period 1, whatever period it seems to have; and it attracts."""
    (state,) = attractors(WEAK, points=4, transient=400).found[0].states
    cycle = attracting(WEAK, state, 6)
    assert cycle == pytest.approx(state[None], abs=1e-7)
    assert growth(WEAK, cycle) == pytest.approx(-0.0813385, abs=1e-6)
    assert attracting(WEAK, state + 0.1, 6) is None
    assert first_alike(WEAK, [cycle, None, cycle + 1e-9, None, cycle + 0.1]) == [0, 1, 0, 3, 4]


def test_an_island_is_no_attractor():
    """An elliptic point is found by Newton's method, and does not attract."""
    assert attracting(PAPER, np.array([0.10027988984, 0.54194330674]), 1) is None


@pytest.mark.slow
def test_a_gallery_shows_whole_periods():
    """The longest period found is shown, unless one asks for another time."""
    found = gallery(PAPER, values=(1.5,))
    (orbit,), (one,) = found.orbits, found.attractors
    assert one.period > 4
    assert orbit.t[-1] / orbit.period == pytest.approx(one.period)
