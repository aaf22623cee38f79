"""The theorem ``converse``: proved by coarse grids, and refused."""

import json
from fractions import Fraction

import numpy as np
import pytest
from support import proving

from cap.areas.rings import search
from cap.areas.rings.half_periods import flown
from cap.areas.rings.path import JUMP, ring
from cap.areas.rings.search import Ring
from cap.proofs import converse


@pytest.fixture
def coarse(monkeypatch):
    """Few rays, few points, few half periods."""
    for module in (search, converse):
        monkeypatch.setattr(module, "COLUMNS", 64)
    for name, value in {"ROWS": 60, "FIRST": 12, "LATER": 20, "BLOCK": 16}.items():
        monkeypatch.setattr(search, name, value)


@pytest.mark.slow
@pytest.mark.usefixtures("coarse")
def test_a_coarse_ring(capsys, tmp_path):
    """Where the island ends near states that stop at once, few points suffice; in other units."""
    areas = []
    for k, words in enumerate(
        (
            ("--f", "44/125"),
            ("--F", "3", "--omega", "2", "--f", "132/125", "--l=-1/4", "--r", "5/4"),
        )
    ):
        path = tmp_path / f"{k}.json"
        status, out, err = proving(capsys, "converse", *words, "--digits", "12", "--out", str(path))
        assert status == 0, out + err
        areas.append(Fraction(json.loads(path.read_text("utf-8"))["claims"]["area"]))
    assert Fraction(1, 1000) < areas[0] < Fraction(17, 10_000)
    assert areas[1] * 8 / 9 == pytest.approx(float(areas[0]), rel=1e-2)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--e", "9/10"), "e = 1|elastic"),
        (("--f", "0"), "friction"),
        (("--f", "13/20"), "elliptic"),
    ],
)
def test_what_is_refused(capsys, words, why):
    """In a line, with a status."""
    status, out, err = proving(capsys, "converse", *words)
    assert status != 0
    assert any(each in out + err for each in why.split("|")), out + err


def test_the_least_ring():
    """Around through the least rows that are linked; none where a column has no links."""
    area = np.arange(6.0)[None, :] * np.ones((10, 1))
    links = np.zeros((10, 6, 2 * JUMP + 1), np.bool_)
    links[:, 2:, JUMP] = True
    assert (ring(area, links, 0.01) == 2).all()
    links[4] = False
    assert ring(area, links, 0.01) is None


def test_a_ring_in_words():
    """Its area is exact."""
    square = Ring([(10, 10), (-10, 10), (-10, -10), (10, -10)], [(1, 1)] * 4)
    assert square.area == 400 * search.UNIT**2
    assert square.words == "10 10,-10 10,-10 -10,10 -10"
    assert square.flights == "1 1,1 1,1 1,1 1"


def test_half_periods_go_back():
    """Backward from an image, mirrored, the state comes back."""
    z = flown(0.11, 0.53, 0.4, 1.0, 1.0)
    back = flown(-z.y, z.v, 0.4, 1.0, -1.0)
    assert (-back.y, back.v) == pytest.approx((0.11, 0.53), abs=1e-12)
