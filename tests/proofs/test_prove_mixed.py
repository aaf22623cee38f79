"""The theorem mixed: a coarse proof at another speed, its picture, and refusals."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from support import proving

from cap.certificate import report
from cap.certificate.writer import dumps
from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.explore import mixed as picture
from cap.floats.candidates import Request
from cap.parameters import PAPER
from cap.pictures import proved as painting
from cap.proofs import mixed
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted

STORED = Path(__file__).parents[2] / "certificates/mixed.json"


@pytest.fixture(scope="module")
def coarse():
    """Return a certificate for |v| < 2 with few leaves, cut once on average."""
    patch = pytest.MonkeyPatch()
    small = {"parts": "128", "cuts": "4", "depth": "8"}
    for name, value in {"COLUMNS": 10, "ROWS": 20, "CUTS": 3, "PLACES": small}.items():
        patch.setattr(mixed, name, value)
    theorem = THEOREMS["mixed"]
    start = theorem.search(Request("mixed", PAPER)).candidates[0].start
    found = accepted(theorem, replace(Setting(PAPER, start, 8), speed=Fraction(2)))
    patch.undo()
    return found


def test_a_coarse_proof(coarse):
    """The shares leave room for what floats say; leaves that gain are cut more often."""
    shares = {k: [float(q) for q in ends] for k, ends in coarse["claims"]["shares"].items()}
    assert 0.1 < shares["attractor"][0] < 0.95 < shares["attractor"][1]
    assert 0.005 < shares["segment"][0] < 0.06 < shares["segment"][1]
    assert shares["stops"][0] > 0.5
    assert shares["stops"][0] == pytest.approx(1 - shares["undecided"][1], abs=1e-5)
    area = float(coarse["claims"]["never_stopping_area"][1])
    assert area == pytest.approx(8 * shares["undecided"][1], abs=1e-4)
    cuts = [int(letter) for letter in coarse["hints"]["leaves"]]
    assert min(cuts) < max(cuts)
    assert sum(1 << n for n in cuts) <= len(cuts) << 3
    assert "of the states (x, v) between the walls with |v| < 2" in " ".join(
        report.theorem(coarse).split()
    )


def test_its_picture(coarse, tmp_path, capsys, monkeypatch):
    """Coloured pixels have the fate that floats tell, but for orbits next to a border."""
    path, out = tmp_path / "mixed.json", tmp_path / "mixed.png"
    path.write_text(dumps(coarse))
    theorem = picture._theorem(path)
    pixels = painting.image(theorem, lambda f, tasks: [f(task) for task in tasks])
    floats = painting.in_floats(theorem, pixels.shape)
    for fate in (painting.ATTRACTED, painting.SEGMENT):
        told = floats[pixels == fate]
        assert len(told) > 10
        assert np.mean(told == fate) > 0.995
    monkeypatch.setattr(painting, "image", lambda *_: pixels)
    assert picture.main([str(path), "--out", str(out)]) == 0
    assert out.stat().st_size > 10_000
    for words in ([str(tmp_path / "no.json")], [str(out)], [str(path), "--out", "a.csv"]):
        capsys.readouterr()
        assert picture.main(words) == 2
        assert capsys.readouterr().err.startswith("error: ")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("mixed", "--e", "9/10"), "e = 1, mu = 0"),
        (("mixed", "--cuts", "0"), "--cuts must be"),
        (("mixed", "--speed", "0"), "--speed must be positive"),
    ],
    ids=lambda words: " ".join(words) if isinstance(words, tuple) else "",
)
def test_refusals(capsys, tmp_path, monkeypatch, words, complaint):
    """One line, and status 2."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, *words, "--out", "mixed.json")
    assert status == 2
    assert complaint in err


@pytest.mark.parametrize("cuts", [1, 2, 4, 6])
def test_what_may_be_asked_for_is_not_too_much(cuts):
    """With as many cuts as the command line allows the checker does the work, not with more."""
    stored = {**json.loads(STORED.read_text()), "provenance": {}}
    setting = replace(Setting(PAPER, (Fraction(0), Fraction(0)), 8), cuts=cuts)
    stored["hints"]["leaves"] = str(cuts) * (mixed.COLUMNS * mixed.ROWS)
    stored["hints"]["depth"] = str(mixed.halvings(setting))
    read(json.dumps(stored).encode())
    stored["hints"]["leaves"] = "9" * (mixed.COLUMNS * mixed.ROWS)
    with pytest.raises(Rejected, match="too many pieces"):
        read(json.dumps(stored).encode())
