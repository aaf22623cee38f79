"""The release map as a findings: its branches, its interval, its orbits over a parameter."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.errors import BadInput
from cap.explore.commands import COMMANDS
from cap.floats.diagnostics.return_map import SAME, ReleaseMap, ReleaseOrbits, late, release
from cap.floats.engine.releases import period_of
from cap.floats.search.release_cycles import attracting, settled
from cap.parameters import PAPER

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
def test_the_graph():
    """One branch fills the interval, which G takes into itself; there most iterates end."""
    findings = release(PAPER, points=1000)
    assert isinstance(findings, ReleaseMap)
    low, high = findings.interval
    inside = (findings.x > low) & (findings.x < high)
    assert len(set(findings.branch[inside].tolist())) == 1
    assert ((findings.value[inside] > low) & (findings.value[inside] < high)).all()
    assert set(findings.half_periods[inside].tolist()) == {3}
    assert ((findings.late > low) & (findings.late < high)).mean() > 0.5
    assert len(findings.lines()) == 3
    assert COMMANDS["release"].picture(findings, dpi=40).axes


def test_over_a_parameter():
    """In the window of period 3 the exponent is negative, at the paper's f it is positive."""
    findings = release(PAPER, parameter="f", range=(0.39, 0.41), points=5, iterates=60)
    assert isinstance(findings, ReleaseOrbits)
    assert findings.exponent[0] < 0 < findings.exponent[2]
    settled = findings.late[0].reshape(60, 4)[-3:]
    assert len(set(np.round(settled[:, 1], 4))) == 3
    assert len(findings.lines()) == 2
    assert COMMANDS["release"].picture(findings, dpi=40).axes


def test_windows():
    """A cycle of period 3 attracts at three values next to each other; the least period counts."""
    findings = release(PAPER, parameter="f", range=(0.3895, 0.3905), points=3, iterates=30)
    assert findings.windows() == [(0.3895, 0.3905, 3)]
    assert findings.lines()[-1] == "  window of period 3 seen: 0.3895 .. 0.3905"
    assert COMMANDS["release"].picture(findings, dpi=40).axes
    cycle = np.tile([[0.1], [0.2], [0.1], [0.3]], (3, 2))
    assert period_of(cycle, 1e-3) == 4
    assert period_of(cycle[:7], 1e-3) == 0
    cycle[5, 1] = np.nan
    assert period_of(cycle, 1e-3) == 4
    cycle[5, 0] += 0.01
    assert period_of(cycle, 1e-3) == 0


@pytest.mark.slow
def test_the_least_period_counts():
    """On both sides of where period 3 doubles to 6, which the stored cascade proves."""
    stored = json.loads((ROOT / "certificates/cascade-1.json").read_text("utf-8"))
    doubling = float(stored["claims"]["parameters"][0][0])
    for f, period in (("0.3866", 6), ("0.3874", 6), ("0.38745", 3), ("0.3876", 3)):
        assert (float(f) < doubling) == (period == 6)
        p = replace(PAPER, f=Fraction(f))
        assert settled(p, late(p, 40)[0].reshape(40, -1), SAME) == period
    found = release(PAPER, parameter="f", range=(0.38775, 0.38805), points=4)
    assert found.lines()[0].endswith("omega = 1, f = 0.38775 .. 0.38805, R = 2: 4 values")
    assert found.lines()[-1] == "  window of period 3 seen: 0.38775 .. 0.38805"


def test_what_stands_still_is_no_cycle():
    """Places that are the same are no attracting cycle, if Newton's method finds none there."""
    assert settled(PAPER, np.full((4, 2), 0.1), 1e-4) == 0
    assert attracting(PAPER, 0.1, 6) == []


@pytest.mark.slow
def test_without_an_interval():
    """Where several branches are used no interval is shown."""
    findings = release(replace(PAPER, f=Fraction(9, 20)), points=200)
    assert np.isnan(findings.critical)
    assert "no interval" in findings.lines()[-1]
    assert COMMANDS["release"].picture(findings, dpi=40).axes


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
