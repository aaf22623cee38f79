"""The constants of the folded flow, and rests near a wall."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from cap.checker.folded.motion import Releases
from cap.checker.folded.rests import height
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters

PAPER = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)))


def test_constants():
    """Doubles next to them, with errors."""
    p = Parameters(*map(Fraction, (3, 2, "4/3", "-1/2", "3/4")))
    y = Releases(p)
    a, theta = 4 / 9, math.acos(4 / 9)
    for (value, error), truth in (
        ((-y.a, y.a_error), a),
        (y.width, 5 / 3),
        (y.rest, theta),
        (y.theta, math.pi - theta),
        (y.pi, math.pi),
        (y.sine, math.sqrt(65) / 9),
    ):
        assert value == pytest.approx(truth, abs=1e-15)
        assert 0 < error < 1e-15


def test_rests_after_slow_hits():
    """A capture at the wall, a rest near it, neither for a fast hit or a late one."""
    y = Releases(PAPER)
    assert height(y, (0.1, 0.11), 0.01) == 0
    assert 0 < height(y, (1.1595, 1.1596), 0.01) < 1e-3
    assert height(y, (0.1, 0.11), 0.5) is None
    assert height(y, (2.0, 2.01), 0.01) is None
    assert height(y, (1.28, 1.29), 0.028) is None  # it may not stop before the force pulls it off
    assert height(y, (1.28, 1.29), 0.01) is not None


def test_without_friction_there_is_no_folded_flow():
    """And none with losses."""
    for other in (
        PAPER._replace(f=Fraction(0)),
        PAPER._replace(mu=Fraction(1)),
        PAPER._replace(e=Fraction(1, 2)),
    ):
        with pytest.raises(Rejected, match="needs f > 0"):
            Releases(other)
