"""The picture of a certificate of mixed: only of what the checker proves."""

from itertools import combinations
from pathlib import Path

import pytest
from checker.test_certificates import REASONS
from matplotlib.colors import to_rgb

from cap.explore import mixed as picture
from cap.pictures import proved as painting

pytestmark = pytest.mark.usefixtures("releases_computed_once")

REJECTED = sorted((Path(__file__).parents[1] / "certificates/reject").glob("mixed_*.json"))
SOON = ("box_past_the_wall", "no_sink", "other_interval")


def case(path):
    """Return a case; where all areas are counted, a slow one."""
    marks = () if path.stem.removeprefix("mixed_") in SOON else pytest.mark.slow
    return pytest.param(path, id=path.stem, marks=marks)


@pytest.mark.parametrize("path", [case(path) for path in REJECTED])
def test_what_is_rejected_is_not_drawn(path, tmp_path, monkeypatch, capsys):
    """The verdict has the reason of the checker; there is no file, and the status is 1."""
    monkeypatch.setattr(painting, "draw", None)
    out = tmp_path / "mixed.png"
    assert picture.main([str(path), "--out", str(out)]) == 1
    said, err = capsys.readouterr()
    assert said.startswith("REJECTED: ")
    assert REASONS[path.stem] in said
    assert said.count("\n") == 1
    assert err == ""
    assert list(tmp_path.iterdir()) == []


def test_rejections_are_tried():
    """There are certificates to try it with."""
    assert len(REJECTED) > 10


def test_colours_are_told_apart():
    """In grey, too: their contrast, as defined by the WCAG, is at least 2."""

    def luminance(colour):
        parts = [
            c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)
        ]
        return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), parts, strict=True))

    for pair in combinations(painting.COLOURS, 2):
        dark, light = sorted(map(luminance, pair))
        assert (light + 0.05) / (dark + 0.05) > 2
