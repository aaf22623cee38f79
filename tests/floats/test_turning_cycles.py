"""Attracting cycles that turn and never stick, in floats."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.engine import swarm
from cap.floats.search.turning_cycles import turning_cycles
from cap.parameters import PAPER, Parameters

OTHER = Parameters(*map(Fraction, (3, 2, "3/5", "-1/2", 1)))  # as f = 1/5, in other units


WEAK, WEAKER = (replace(PAPER, f=Fraction(f)) for f in ("1/5", "3/20"))


@pytest.mark.parametrize(("p", "periods"), [(WEAK, {1}), (OTHER, {1}), (WEAKER, {1, 2})])
def test_a_cycle_comes_back(p, periods):
    """To its state, after its period, with the derivative; and attracts."""
    found = turning_cycles(p)
    assert {each.periods for each in found} == periods
    for each in found:
        done = swarm.follow(p, [[each.x, each.v]], each.periods, derivative=True)
        assert done.states[0] == pytest.approx([each.x, each.v], abs=1e-8)
        assert np.array(each.monodromy) == pytest.approx(done.monodromy[0], abs=1e-6)
        assert np.abs(np.linalg.eigvals(np.array(each.monodromy))).max() < 1
        assert done.turned.all()
        assert not done.stuck.any()
    places = np.array([[each.x, each.v] for each in found])
    far = np.abs(places[:, None] - places[None]).max(axis=-1) + np.eye(len(found))
    assert far.min() > 1e-3


def test_there_may_be_none():
    """Chaos that sticks, and periodic orbits that do."""
    assert turning_cycles(PAPER) == []
    assert turning_cycles(replace(PAPER, f=Fraction(3, 10))) == []
