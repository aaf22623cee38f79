"""Cycles of releases that attract: what is contracted is accepted, nothing else."""

from __future__ import annotations

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.mixed import Mixed
from checker.altered import encode
from checker.mixed_small import certificate

WEAK = {"f": "3/10"}, [[["-0.2323", "-0.2072"]]]  # at about -0.2198, with G' = -0.42
TWO = {"F": "3/2"}, [[["-0.7672", "-0.7655"], ["-0.4928", "-0.4902"]]]  # G' = -0.71, 0.44
STEEP = {"F": "2"}, [[["-0.89415", "-0.88955"], ["-0.70756", "-0.67092"]]]  # G' = 7.66, -0.04


def theorem(more, cycles, *, attractor=False):
    """Return the theorem with these cycles, and no segment."""
    lie = certificate()
    lie["parameters"] |= more
    lie["claims"]["cycles"] = cycles
    del lie["claims"]["segment"]
    if not attractor:
        del lie["claims"]["attractor"], lie["hints"]["attractor"]
        lie["cites"] = []
    return Mixed(read(encode(lie)), lambda _step: None)


def prove(found):
    """Prove that the cycles are contracted."""
    found.attract["cycles"].prove(found.basins())


@pytest.mark.parametrize("known", [WEAK, TWO])
def test_cycles_that_attract(known):
    """Each with its step; places in them are kept."""
    found = theorem(*known)
    steps = []
    found.step = steps.append
    prove(found)
    assert len(steps) == 1
    for (low, high), (a, b) in zip(found.kept(), known[1][0], strict=True):
        F = float(found.p.F)
        assert (low * F, high * F) == pytest.approx((1 - float(b), 1 - float(a)), abs=1e-12)


@pytest.mark.parametrize(
    ("parameters", "cycles", "complaint"),
    [
        (WEAK[0], [[["-0.2300", "-0.2290"]]], "leave their cycle"),
        (WEAK[0], [[["-0.5", "0.5"]]], "certain|stop|turn|contract|leave"),
        (WEAK[0], [[["-1", "-0.2"]]], "between the walls"),
        (WEAK[0], [[["-0.2", "-0.2"]]], "between the walls"),
        (WEAK[0], [*WEAK[1], [["-0.9", "-0.899"]]], "leave their cycle"),
        (TWO[0], [TWO[1][0][:1]], "leave their cycle"),
        (TWO[0], [[TWO[1][0][0], ["-0.4900", "-0.4880"]]], "leave their cycle"),
        (TWO[0], [[["-0.78", "-0.7655"], TWO[1][0][1]]], "leave their cycle"),
        (*STEEP, "may not contract"),
    ],
)
def test_what_is_no_cycle(parameters, cycles, complaint):
    """Beside it, too long, past a wall, of one point; one of several is none; too steep."""
    with pytest.raises(Rejected, match=complaint):
        prove(theorem(parameters, cycles))


def test_intervals_are_apart():
    """No place is in two intervals, nor in one and in I."""
    inner = [["-0.2250", "-0.2150"]]
    prove(theorem(WEAK[0], [inner]))
    with pytest.raises(Rejected, match="not apart"):
        theorem(WEAK[0], [*WEAK[1], inner]).kept()
    with pytest.raises(Rejected, match="too short"):
        theorem(WEAK[0], [[["-0.22", f"-0.21{'9' * 20}"]]]).kept()
    with pytest.raises(Rejected, match="not apart"):
        theorem({}, [[["-0.5", "-0.49"]]], attractor=True).kept()


def test_an_attractor_has_its_hints():
    """Claims without hints are refused, and hints without claims."""
    for part in ("claims", "hints"):
        lie = certificate()
        del lie[part]["attractor"]
        if part == "claims":
            lie["cites"] = []
        with pytest.raises(Rejected, match="without its hints"):
            read(encode(lie))


def test_what_is_cited_is_cited_for_an_attractor():
    """Without one nothing is cited; with one all that its entropy needs."""
    lie = certificate()
    assert lie["cites"] == Mixed.cited(lie["claims"])
    assert Mixed.cited({"cycles", "sinks", "segment"}) == []
    lie["cites"] = []
    with pytest.raises(Rejected, match="cites"):
        read(encode(lie))
