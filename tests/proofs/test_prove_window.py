"""The theorem window: its cycle against floats, and refusals."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.floats.candidates import Request
from cap.floats.engine.releases import images
from cap.flow.strobe import oscillator
from cap.maps.fixed_point import Start
from cap.parameters import PAPER, Parameters
from cap.proofs import window
from cap.proofs.fixed_point import Setting
from cap.release.cycle import contracted, foreseen_cycle
from cap.sets import interval

ROOT = Path(__file__).parents[2] / "certificates"


@pytest.mark.parametrize("name", ["window-1", "window-2"])
def test_orbits_in_floats(name):
    """The cycle, its multiplier, and that orbits released nearly anywhere in I come to it."""
    stored = json.loads((ROOT / f"{name}.json").read_text("utf-8"))
    p, claims = Parameters(*map(Fraction, stored["parameters"].values())), stored["claims"]
    cycle = [float(Fraction(pair[0])) for pair in claims["cycle"]]
    found = images(p, cycle)
    assert found.value == pytest.approx(cycle[1:] + cycle[:1], abs=1e-9)
    assert np.prod(found.slope) == pytest.approx(float(Fraction(claims["multiplier"][0])), abs=1e-6)
    x = np.linspace(*(float(Fraction(end)) for end in claims["interval"]), 50)
    for _ in range(600):
        x = images(p, x).value
    near = np.abs(x[:, None] - np.array(cycle)).min(axis=1) < 1e-6
    assert near.mean() > 0.9


def test_without_an_attracting_cycle():
    """Where the critical point wanders nothing is proved; nor is J larger than it may be."""
    setting = Setting(PAPER, Start(-0.6003845883, 0.0, ()), 6)
    with pytest.raises(NotProved, match="no cycle is found"):
        window.prove(setting)
    assert foreseen_cycle(PAPER, 5.0) == ()
    ends = Fraction(-65001, 100000), Fraction(-65, 100)
    with interval.workprec(80), pytest.raises(NotProved, match="may not contract"):
        contracted(oscillator(PAPER), PAPER, ends, 1)


def test_what_is_refused():
    """No friction, and a release that is not between the walls, in the name of the theorem."""
    with pytest.raises(BadInput, match="theorem window needs friction"):
        candidates.releasing(Request("window", replace(PAPER, f=Fraction(0))))
    for x in (5.0, 1.0, -1.0):
        with pytest.raises(BadInput, match="not between the walls"):
            candidates.releasing(Request("window", PAPER, (x, 0.0)))
