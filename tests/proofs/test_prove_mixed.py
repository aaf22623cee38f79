"""The theorem mixed: a coarse proof at another speed, its picture, and refusals."""

from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from support import proving

from cap.certificate import report
from cap.certificate.writer import dumps
from cap.errors import NotProved
from cap.explore import mixed as picture
from cap.floats.candidates import Request
from cap.parameters import PAPER
from cap.pictures import proved as painting
from cap.proofs import mixed, places, strip
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted


@pytest.fixture(scope="module")
def coarse():
    """Return a certificate for |v| < 2 with few regions."""
    patch = pytest.MonkeyPatch()
    patch.setattr(mixed, "USUAL", (1e-2, 300))
    patch.setattr(strip, "WORTH", 1e-3)
    for name, value in {"LEVEL": 15, "WORTHS": (1e-3, 1e-4)}.items():
        patch.setattr(places, name, value)
    theorem = THEOREMS["mixed"]
    start = theorem.search(Request("mixed", PAPER)).candidates[0].start
    found = accepted(theorem, replace(Setting(PAPER, start, 8), speed=Fraction(2)))
    patch.undo()
    return found


def test_a_coarse_proof(coarse):
    """The shares leave room for what floats say."""
    shares = {k: [float(q) for q in ends] for k, ends in coarse["claims"]["shares"].items()}
    assert 0.3 < shares["attractor"][0] < 0.95 < shares["attractor"][1]
    assert 0.003 < shares["segment"][0] < 0.06 < shares["segment"][1]
    assert shares["stops"][0] > shares["either"][0]
    assert shares["either"][0] > shares["attractor"][0] + shares["segment"][0] - 1e-3
    assert shares["stops"][0] == pytest.approx(1 - shares["undecided"][1], abs=1e-5)
    area = float(coarse["claims"]["never_stopping_area"][1])
    assert area == pytest.approx(8 * shares["undecided"][1], abs=1e-4)
    assert "of the states (x, v) between the walls with |v| < 2" in " ".join(
        report.theorem(coarse).split()
    )


def test_its_picture(coarse, tmp_path, capsys, monkeypatch):
    """Points inside of what is drawn have the fate that floats tell, but next to a border."""
    path, out = tmp_path / "mixed.json", tmp_path / "mixed.png"
    path.write_text(dumps(coarse))
    theorem = picture._theorem(path)
    outlines = painting.proved(theorem, lambda f, tasks: [f(task) for task in tasks])
    shape = painting.PIXELS[::-1]
    floats = painting.in_floats(theorem, shape)
    box = theorem.claims["box"]
    low, size = (
        np.array([float(box[axis][0]) for axis in "xv"]),
        np.array([float(box[axis][1] - box[axis][0]) for axis in "xv"]),
    )
    for fate, least in ((painting.ATTRACTED, 10), (painting.SEGMENT, 3)):
        middles = [points.mean(axis=0) for found, points in outlines if found == fate]
        pixels = ((np.array(middles) - low) / size * shape[::-1]).astype(int)
        inside = ((pixels >= 0) & (pixels < shape[::-1])).all(axis=1)
        told = floats[pixels[inside, 1], pixels[inside, 0]]
        assert len(told) > least
        assert np.mean(told == fate) > 0.7
    monkeypatch.setattr(painting, "proved", lambda *_: outlines)
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
        (("mixed", "--undecided", "0"), "--undecided must be positive"),
        (("mixed", "--undecided", "2"), "--undecided must be less than 1"),
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


def test_no_more_is_undecided_than_asked_for(monkeypatch):
    """Regions are made smaller until it is so, or it is said what was reached."""
    tried = []

    def search(_p, _V, plan, _runner):
        tried.append(plan.worth)
        return ()

    counts = iter([0.3, 0.6, 0.9])
    monkeypatch.setattr(mixed.sticks, "search", search)
    monkeypatch.setattr(mixed, "by_places", lambda *_: (None, "0"))
    monkeypatch.setattr(mixed, "by_strip", lambda *_: (Fraction(0), {}))
    whole = Fraction(12)
    monkeypatch.setattr(
        mixed,
        "counted",
        lambda *_: ((Fraction(0), Fraction(0), whole * Fraction(next(counts)), Fraction(0)), {}),
    )
    theorem = SimpleNamespace(region=lambda: (Fraction(2), Fraction(3)))
    setting = replace(Setting(PAPER, (Fraction(0), Fraction(0)), 8), undecided=Fraction(1, 5))
    shares = mixed.lemma_shares(setting, theorem, {"places": {}})
    assert float(shares[2]) == 0.9
    assert len(tried) == 3
    counts = iter([0.3] * 9)
    with pytest.raises(NotProved, match="neither fate is shown"):
        mixed.lemma_shares(setting, theorem, {"places": {}})
