"""The theorem cascade: its numbers against floats, and refusals."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from support import over

from cap.errors import BadInput, NotProved
from cap.floats.engine.releases import images
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import cascade
from cap.proofs.cascade import Guess
from cap.proofs.fixed_point import Setting
from cap.release import doubling
from cap.sets import interval
from cap.sets.interval import Ball

CLAIMS = json.loads((Path(__file__).parents[2] / "certificates/cascade-1.json").read_text("utf-8"))[
    "claims"
]


def setting(low, high, digits=6):
    """Return what the proof starts from."""
    f_range = Fraction(low), Fraction(high)
    return Setting(PAPER, Start(0.0, 0.0, ()), digits, options=over(*f_range))


@pytest.mark.parametrize("k", range(5))
def test_in_floats(k):
    """The cycle of f_k closes, with slopes whose product is -1."""
    p = replace(PAPER, f=Fraction(CLAIMS["parameters"][k][0]))
    x, slope = float(Fraction(CLAIMS["places"][k][0])), 1.0
    start = x
    for _ in range(3 << k):
        here = images(p, np.array([x]))
        x, slope = float(here.value[0]), slope * float(here.slope[0])
    assert x == pytest.approx(start, abs=1e-9)
    assert slope == pytest.approx(-1, abs=1e-3)


def test_one_doubling_is_proved():
    """From a guess; it is the stored one."""
    guess = Guess(0.3875, -0.6652, 3)
    with interval.workprec(120):
        found = cascade.lemma_1_doubling(setting("0.38", "0.39"), guess)
        f = found.box[1].cos()
        low, high = map(Fraction, CLAIMS["parameters"][0])
        assert f.overlaps(interval.hull(interval.ball(low), interval.ball(high)))
    assert len(found.orbit.events) == 3


def test_refusals(monkeypatch):
    """Without a range, without a cycle in it, and from a guess that leads nowhere."""
    with pytest.raises(BadInput, match="--from Q --to Q"):
        cascade.prove(Setting(PAPER, Start(0.0, 0.0, ()), 6))
    monkeypatch.setattr(cascade, "LOOKS", 1)
    with pytest.raises(
        NotProved, match=r"no cycle of a period up to 12 .*between 0\.399 and 0\.401"
    ):
        cascade.prove(setting("0.399", "0.401"))
    with interval.workprec(120), pytest.raises(NotProved, match="into itself"):
        doubling.proved(PAPER, Ball(-0.66), Ball(1.17), 3, Fraction(1, 10**8))
