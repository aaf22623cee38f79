"""Pictures of certificates: drawn if the checker proves the theorem, else not."""

import json
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from checker.altered import changed
from checker.test_certificates import REASONS
from matplotlib.colors import to_rgb
from matplotlib.text import Text

from cap.checker.theorems import NAMES
from cap.explore import explorer
from cap.explore.certificate import opened
from cap.floats.diagnostics.manifold import manifolds
from cap.parameters import PAPER
from cap.pictures import theorems
from cap.pictures.theorems import homoclinic, mixed

pytestmark = pytest.mark.usefixtures("orbits_computed_once", "releases_computed_once")

ROOT = Path(__file__).parents[2]
STORED, ACCEPTED = ROOT / "certificates", ROOT / "tests/certificates/accept"
REJECTED = sorted((Path(__file__).parents[1] / "certificates/reject").glob("mixed_*.json"))
SOON = ("box_past_the_wall", "other_interval")


def case(path):
    """Return a case; where all areas are counted, a slow one."""
    marks = () if path.stem.removeprefix("mixed_") in SOON else pytest.mark.slow
    return pytest.param(path, id=path.stem, marks=marks)


def refused(path, out, capsys):
    """Return the verdict on a certificate that is not drawn."""
    assert explorer.main(["certificate", str(path), "--out", str(out)]) == 1
    said, err = capsys.readouterr()
    assert said.startswith("REJECTED: ")
    assert said.count("\n") == 1
    assert all(line.endswith(("%", " left")) for line in err.splitlines())  # after half a minute
    return said


def test_every_theorem_has_a_picture():
    """Each has a function that draws it, and, where that is named, a proof."""
    assert sorted(theorems.DRAWINGS) == NAMES
    for name in theorems.DRAWINGS:
        assert callable(theorems.function(name))
        assert theorems.proof(name).prove


def test_a_picture(tmp_path, monkeypatch, capsys):
    """A stored certificate is drawn, by its name."""
    name = "impulse-1"
    monkeypatch.chdir(tmp_path)
    assert explorer.main(["certificate", name]) == 0
    assert capsys.readouterr().out.startswith(f'VERIFIED: "{name}"')
    assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")


def drawn(path):
    """Return what is written on the picture of a certificate, which is not verified again."""
    certificate = opened(str(path))
    theorem = theorems.proof(certificate.theorem)(certificate, lambda _step: None)
    if certificate.theorem == "homoclinic":  # its picture needs what the proof finds
        theorem.prove()
    figure = theorems.drawn(theorem)
    texts = [text.get_text() for text in figure.findobj(Text)]
    figure.canvas.draw()
    return " ".join(texts)


@pytest.mark.slow
def test_what_a_picture_of_a_map_says():
    """No more digits of the entropy than are proved, and the map."""
    words = drawn(STORED / "map_horseshoe-1.json")
    assert "852 parallelograms, 1294 coverings: entropy at least 0.44858 " in words
    assert "(x, y) -> (1 - 7/5 x x + y, 3/10 x) of the plane" in words
    assert "sets (proved)" in words
    assert "saddle (floats)" in words


def test_what_a_picture_of_a_curve_says():
    """The range rounded inwards, and where the points are."""
    words = drawn(STORED / "contacts_branch-1.json")
    assert "A takes all values in [1.0472, 2]\n(the certificate is VERIFIED)" in words
    assert r"fold at A = $1.047197551[19\ldots 20]$" in words
    assert "multipliers: nothing is claimed" in words


@pytest.mark.parametrize("name", ["segment", "sliding", "pitchfork"])
def test_what_a_picture_says(name):
    """It says what is proved, at which parameters, and what is floats."""
    words = drawn(STORED / f"{name}.json")
    assert "(the certificate is VERIFIED)" in words
    assert "F = 1" in words
    assert "(proved)" in words
    assert "(floats)" in words


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in theorems.DRAWINGS if name != "mixed"])
def test_a_certificate_of_each_theorem(name):
    """The smallest one is drawn."""
    found = [*STORED.glob(f"{name}*.json"), *ACCEPTED.glob(f"{name}*.json")]
    of_it = [path for path in found if json.loads(path.read_text("utf-8"))["theorem"] == name]
    assert "VERIFIED" in drawn(min(of_it, key=lambda path: path.stat().st_size))


@pytest.mark.slow
def test_what_is_rejected_is_not_drawn(tmp_path, monkeypatch, capsys):
    """The verdict has the reason of the checker; there is no file, and the status is 1."""
    monkeypatch.setattr(theorems, "drawn", None)
    lie = changed(
        json.loads((STORED / "homoclinic.json").read_text("utf-8")),
        "claims",
        "points",
        0,
        "angle",
        ["25", "25"],
    )
    file, out = tmp_path / "lie.json", tmp_path / "homoclinic.png"
    file.write_text(json.dumps(lie))
    assert "points[0].angle does not contain" in refused(file, out, capsys)
    assert not out.exists()


@pytest.mark.parametrize("path", [case(path) for path in REJECTED])
def test_basins_that_are_rejected_are_not_drawn(path, tmp_path, monkeypatch, capsys):
    """Likewise, whatever is wrong with them."""
    monkeypatch.setattr(theorems, "drawn", None)
    assert REASONS[path.stem] in refused(path, tmp_path / "mixed.png", capsys)
    assert list(tmp_path.iterdir()) == []


def test_rejections_are_tried():
    """There are certificates to try it with."""
    assert len(REJECTED) > 10


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ([str(STORED / "saddle.json"), "--out", "picture.csv"], "no picture"),
        ([str(ROOT / "CITATION.cff")], "is no certificate"),
        (["nowhere.json"], "error: cannot read"),
    ],
)
def test_bad_input(words, why, capsys):
    """One line, and status 2."""
    assert explorer.main(["certificate", *words]) == 2
    assert why in capsys.readouterr().err


def test_homoclinic_orbits_are_those_of_the_checker():
    """The points drawn begin and end at the saddle, and pass through those claimed."""
    theorem = homoclinic.Proof(opened("homoclinic"), lambda _step: None)
    theorem.prove()
    saddle = [float(theorem.claims[z].lower) for z in ("x", "v")]
    for orbit, claim in zip(theorem.orbits, theorem.claims["points"], strict=True):
        points = homoclinic.states(orbit)
        assert np.allclose(points[[0, -1]], saddle, atol=1e-6)
        q = [float(claim[z].lower) for z in ("x", "v")]
        assert np.hypot(*(points - q).T).min() < 1e-12


@pytest.mark.slow
def test_curves_near_the_saddle_are_those_of_floats():
    """Both are proved; where one is left out, the curves of floats lie on what is drawn."""
    theorem = homoclinic.Proof(opened("homoclinic"), lambda _step: None)
    saddle = [float(theorem.claims[z].lower) for z in ("x", "v")]
    floats = manifolds(PAPER, orbit=saddle, length=0.1, spacing=1e-4)
    proved = homoclinic.near(theorem, PAPER)
    assert len(proved) == 2
    for points, curve in zip(proved, (floats.unstable, floats.stable), strict=True):
        assert np.hypot(*(points[[0, -1]] - saddle).T).min() > 0.04
        for point in points:
            assert np.nanmin(np.hypot(*(curve - point).T)) < 1e-4


def test_colours_of_basins_are_told_apart():
    """In grey, too: their contrast, as defined by the WCAG, is at least 2."""

    def luminance(colour):
        parts = [
            c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)
        ]
        return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), parts, strict=True))

    for pair in combinations(mixed.COLOURS, 2):
        dark, light = sorted(map(luminance, pair))
        assert (light + 0.05) / (dark + 0.05) > 2
