"""The release map as a study: its branches, its interval, its orbits over a parameter."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.errors import BadInput
from cap.explore.commands import COMMANDS
from cap.floats.return_map import ReleaseMap, ReleaseOrbits, release
from cap.parameters import PAPER


def test_the_graph():
    """One branch fills the interval, the orbit is one of G, and late iterates lie in the interval."""
    study = release(PAPER, points=1000)
    assert isinstance(study, ReleaseMap)
    low, high = study.interval
    inside = (study.x > low) & (study.x < high)
    assert len(set(study.branch[inside].tolist())) == 1
    assert ((study.value[inside] > low) & (study.value[inside] < high)).all()
    assert set(study.half_periods[inside].tolist()) == {3}
    assert ((study.late > low) & (study.late < high)).mean() > 0.5
    assert len(study.lines()) == 3
    assert COMMANDS["release"].picture(study, dpi=40).axes


def test_over_a_parameter():
    """In the window of period 3 the exponent is negative, at the paper's f it is positive."""
    study = release(PAPER, parameter="f", range=(0.39, 0.41), points=5, iterates=60)
    assert isinstance(study, ReleaseOrbits)
    assert study.exponent[0] < 0 < study.exponent[2]
    settled = study.late[0].reshape(60, 4)[-3:]
    assert len(set(np.round(settled[:, 1], 4))) == 3
    assert len(study.lines()) == 2
    assert COMMANDS["release"].picture(study, dpi=40).axes


def test_without_an_interval():
    """Where several branches are used no interval is shown."""
    study = release(replace(PAPER, f=Fraction(9, 20)), points=200)
    assert np.isnan(study.critical)
    assert "no interval" in study.lines()[-1]
    assert COMMANDS["release"].picture(study, dpi=40).axes


def test_bad_requests():
    """No friction, a range of no parameter, or one that is not increasing, a place in a wall."""
    with pytest.raises(BadInput, match="f > 0"):
        release(replace(PAPER, f=Fraction(0)))
    with pytest.raises(BadInput, match="of a --parameter"):
        release(PAPER, range=(0.1, 0.2))
    with pytest.raises(BadInput, match="increasing"):
        release(PAPER, parameter="f", range=(0.2, 0.1))
    with pytest.raises(BadInput, match="between the walls"):
        release(PAPER, start=(2.0,), points=10)
