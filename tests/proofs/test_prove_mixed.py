"""The theorem mixed: a coarse proof at another speed, its picture, and refusals."""

import math
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.path import Path
from support import proving

from cap.certificate import report
from cap.certificate.writer import dumps
from cap.checker.folded.ahead import Found
from cap.checker.folded.basins import Basins
from cap.checker.kernel.certificate import read
from cap.checker.theorems.mixed import Mixed
from cap.errors import BadInput, NotProved
from cap.explore import explorer
from cap.floats.candidates import Request
from cap.parameters import PAPER
from cap.pictures.theorems import mixed as painting
from cap.proofs import mixed, places
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted
from cap.runner import Runner


@pytest.fixture(scope="module")
def told():
    """Return what is told of a proof."""
    return []


@pytest.fixture(scope="module")
def coarse(told):
    """Return a certificate for |v| < 2 with few regions."""
    patch = pytest.MonkeyPatch()
    patch.setattr(mixed, "USUAL", mixed.Effort(1e-2, 3e-3, 300, 1500))
    for name, value in {"LEVEL": 15, "WORTHS": (1e-3, 1e-4)}.items():
        patch.setattr(places, name, value)
    theorem = THEOREMS["mixed"]
    start = theorem.search(Request("mixed", PAPER)).candidates[0].start
    runner = Runner(tell=lambda *each: told.append(each))
    found = accepted(
        theorem, Setting(PAPER, start, 8, runner=runner, options={"speed": Fraction(2)})
    )
    patch.undo()
    return found


@pytest.mark.slow
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


@pytest.mark.slow
def test_how_far_it_is(coarse, told):
    """The part that is done grows, from the places to the last turn that is checked."""
    parts = [part for _, part in told if part is not None]
    assert parts == sorted(parts)
    assert parts[0] == 0
    assert 0.98 < parts[-1] <= 1  # the checker's tasks are counted by their text, a little roughly
    assert list(dict.fromkeys(words for words, part in told if part is not None)) == [
        "places are followed to their release",
        "stops are followed",
        "regions are chosen",
        "check: what attracts",
        "check: places are followed to their release",
        "check: late sticks are followed back",
        "check: early sticks are followed back",
        "check: turns are followed back and forwards",
    ]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("drag", "share", "least", "words"),
    [
        ("3/10", "attractor", 0.4, "is attracted to a periodic orbit that sticks"),
        ("1/2", "segment", 0.6, "converges to an orbit of the segment"),
        ("3/5", "stops", 0.5, "stops at least once;"),
        ("1/5", "attractor", 0.2, "is attracted to a periodic orbit through a state"),
    ],
)
def test_other_systems(drag, share, least, words, monkeypatch):
    """A periodic orbit that sticks attracts nearly all; the segment does; nothing is known to."""
    monkeypatch.setattr(mixed, "USUAL", mixed.Effort(1e-2, 3e-3, 300, 1500))
    for name, value in {"LEVEL": 15, "WORTHS": (1e-3, 1e-4)}.items():
        monkeypatch.setattr(places, name, value)
    theorem, p = THEOREMS["mixed"], replace(PAPER, f=Fraction(drag))
    start = theorem.search(Request("mixed", p)).candidates[0].start
    found = accepted(theorem, Setting(p, start, 8, options={"speed": Fraction(2)}))
    shares = {name: float(ends[0]) for name, ends in found["claims"]["shares"].items()}
    assert shares[share] > least
    assert ("attractor" in found["claims"], "cycles" in found["claims"]) == (False, drag == "3/10")
    assert ("segment" in found["claims"]) == (drag != "3/5")
    assert ("sinks" in found["claims"]) == (drag == "1/5")
    assert ("attracted" in report.theorem(found)) == (share == "attractor")
    assert words in " ".join(report.theorem(found).split())


@pytest.mark.slow
def test_many_gaps_are_not_halved(monkeypatch):
    """Where orbits do not come to sticks, the search for places ends."""
    p = replace(PAPER, f=Fraction(1, 5))
    pieces = []
    for most in (10, 2000):
        monkeypatch.setattr(places, "MOST", most)
        search = places.Search(p, Basins(), [], 2.0)
        assert search.run((1e-2, 1e-3, 1e-4, 1e-9)).count("1") == len(search.pieces)
        pieces.append(len(search.pieces) + len(search.gaps))
    assert pieces[0] < pieces[1] < 20_000


def test_friction_is_needed():
    """Without it nothing sticks."""
    with pytest.raises(BadInput, match="f > 0"):
        THEOREMS["mixed"].search(Request("mixed", replace(PAPER, f=Fraction(0))))


PIXELS = 32, 96


@pytest.fixture(scope="module")
def drawn(coarse, tmp_path_factory):
    """Return the file of a certificate, that of its picture, and the outlines in it."""
    folder, outlines, proved = tmp_path_factory.mktemp("mixed"), [], painting.proved
    path, out = folder / "mixed.json", folder / "mixed.png"
    path.write_text(dumps(coarse))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(painting, "PIXELS", PIXELS)
        patch.setattr(
            painting, "proved", lambda *known: outlines.extend(proved(*known)) or outlines
        )
        assert explorer.main(["certificate", str(path), "--out", str(out)]) == 0
    return path, out, outlines


@pytest.mark.slow
def test_what_is_drawn(drawn):
    """As much is drawn as is claimed, of fates less; and floats tell the same."""
    path, out, outlines = drawn
    assert out.stat().st_size > 10_000
    theorem = Mixed(read(path.read_bytes()), lambda _step: None)
    floats = painting.in_floats(theorem, PIXELS[::-1]).ravel()
    sides = []
    for axis, n in zip("xv", PIXELS, strict=True):
        low, high = (float(q) for q in theorem.claims["box"][axis][:2])
        sides.append(low + (high - low) * (np.arange(n) + 0.5) / n)
    middles = np.column_stack([side.ravel() for side in np.meshgrid(*sides)])
    painted = np.zeros(len(middles), dtype=int)
    for fate, points in outlines:
        painted[Path(points).contains_points(middles)] = fate
    claims = {name: float(ends[0]) for name, ends in theorem.claims["shares"].items()}
    assert np.mean(painted > 0) == pytest.approx(claims["stops"], abs=0.02)
    assert np.mean(floats[painted > 0] > 0) > 0.99
    for fate, name in ((painting.ATTRACTED, "attractor"), (painting.SEGMENT, "segment")):
        assert np.mean(painted == fate) > 0.4 * claims[name]
        assert np.mean(floats[painted == fate] == fate) > 0.98


def test_a_fate_that_is_not_shown():
    """At most LOST of the area may be without it; infinitely much is."""
    for missing, fate in (
        ((0.09, 9.0), painting.ATTRACTED),
        ((9.0, 0.0), painting.SEGMENT),
        ((0.11, 0.11), painting.STOPS),
        ((math.inf, math.inf), painting.STOPS),
    ):
        assert painting.shown(Found(2.0, (*missing, 0.0))) == fate


@pytest.mark.slow
def test_no_picture(drawn, tmp_path, capsys):
    """What is no certificate, or no picture, is refused."""
    path, out, _ = drawn
    for words in ([str(tmp_path / "no.json")], [str(out)], [str(path), "--out", "a.csv"]):
        capsys.readouterr()
        assert explorer.main(["certificate", *words]) == 2
        assert capsys.readouterr().err.startswith("error: ")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("mixed", "--e", "9/10"), "elastic walls and dry friction: e = 9/10, mu = 0"),
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

    def search(_p, _V, _releases, plan, _runner):
        tried.append(plan.worth)
        return (), ()

    counts = iter([0.3, 0.6, 0.9])
    monkeypatch.setattr(mixed.stops, "search", search)
    monkeypatch.setattr(mixed, "by_places", lambda *_: (None, "0"))
    monkeypatch.setattr(mixed, "releases_of", lambda *_: None)
    whole = Fraction(12)
    monkeypatch.setattr(
        mixed,
        "counted",
        lambda *_: ((Fraction(0), Fraction(0), whole * Fraction(next(counts)), Fraction(0)), {}),
    )
    theorem = SimpleNamespace(region=lambda: (Fraction(2), Fraction(3)))
    setting = Setting(PAPER, (Fraction(0), Fraction(0)), 8, options={"undecided": Fraction(1, 5)})
    shares = mixed.lemma_shares(setting, theorem, {"places": {}})
    assert float(shares[2]) == 0.9
    assert len(tried) == 3
    counts = iter([0.3] * 9)
    with pytest.raises(NotProved, match="neither fate is shown"):
        mixed.lemma_shares(setting, theorem, {"places": {}})
