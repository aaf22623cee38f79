"""The picture of a certificate of homoclinic: drawn if the checker proves it, else not."""

import json
from pathlib import Path

import numpy as np
import pytest
from checker.altered import changed

from cap.explore import homoclinic as picture
from cap.pictures import homoclinic as painting

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

STORED = Path(__file__).parents[2] / "certificates/homoclinic.json"


def test_what_is_rejected_is_not_drawn(tmp_path, monkeypatch, capsys):
    """The verdict has the reason of the checker; there is no file, and the status is 1."""
    monkeypatch.setattr(painting, "draw", None)
    lie = changed(json.loads(STORED.read_text()), "claims", "points", 0, "angle", ["25", "25"])
    file, out = tmp_path / "lie.json", tmp_path / "homoclinic.png"
    file.write_text(json.dumps(lie))
    assert picture.main([str(file), "--out", str(out)]) == 1
    said, err = capsys.readouterr()
    assert said.startswith("REJECTED: ")
    assert "points[0].angle does not contain" in said
    assert err == ""
    assert not out.exists()


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ([str(STORED), "--out", "picture.csv"], "no picture"),
        ([str(STORED.with_name("saddle.json"))], "is about the theorem saddle, not homoclinic"),
        (["nowhere.json"], "cannot read"),
    ],
)
def test_bad_input(words, why, capsys):
    """One line, and status 2."""
    assert picture.main(words) == 2
    assert why in capsys.readouterr().err


def test_orbits_are_those_of_the_checker(tmp_path, monkeypatch):
    """The points drawn begin and end at the saddle, and pass through those claimed."""
    kept = []
    monkeypatch.setattr(painting, "draw", lambda theorem, orbits: kept.append((theorem, orbits)))
    with pytest.raises(AttributeError):  # no figure
        picture.main([str(STORED), "--out", str(tmp_path / "homoclinic.png")])
    ((theorem, orbits),) = kept
    saddle = [float(theorem.claims[z].lower) for z in ("x", "v")]
    for orbit, claim in zip(orbits, theorem.claims["points"], strict=True):
        points = painting.states(orbit)
        assert np.allclose(points[[0, -1]], saddle, atol=1e-6)
        q = [float(claim[z].lower) for z in ("x", "v")]
        assert np.hypot(*(points - q).T).min() < 1e-12
