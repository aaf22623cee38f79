"""A tool on dry friction that is struck whenever it has stopped: the model of the gallery."""

import json
from fractions import Fraction
from math import asin, cos, pi, sin
from pathlib import Path

import numpy as np
import pytest

from cap.command.own import main

T = 2 * pi


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """Return the file of the model, as the gallery has it."""
    text = Path("docs/gallery.md").read_text("utf-8")
    start = text.index("    from fractions import Fraction\n    from cap import Guard")
    end = text.index("    $ python -m cap.prove attractor --model percussion.py")
    lines = [line.removeprefix("    ") for line in text[start:end].splitlines()]
    file = tmp_path_factory.mktemp("model") / "percussion.py"
    file.write_text("\n".join(lines), encoding="utf-8")
    return file


def claims(model, tmp_path, *words):
    """Return what is proved of the model."""
    out = tmp_path / "percussion.json"
    assert main(["attractor", "--model", str(model), *words, "--out", str(out)]) == 0
    return json.loads(out.read_text("utf-8"))["claims"]


def after(t, a, b=6.5, cosine=cos):
    """Return the time of the next blow, less a period."""
    return t + b + a * cosine(t) - T


def test_chaos(model, tmp_path):
    """The numbers of the gallery; the map takes the interval into itself, and is not monotone."""
    found = claims(model, tmp_path)
    assert f"[{', '.join(found['entropy'])}]" in Path("docs/gallery.md").read_text("utf-8")
    low, high = (float(Fraction(q)) for q in found["interval"])
    places = [low + (high - low) * k / 1000 for k in range(1001)]
    images = [after(t, 4.1) - (int(found["periods"]) - 1) * T for t in places]
    assert low < min(images)
    assert max(images) < high
    turns = {1 - 4.1 * sin(t) > 0 for t in places}
    assert turns == {True, False}
    assert 1 < float(found["growth"]) <= float(found["laps"]) < 3  # the laps of the map
    assert found["entropy_per_period"] == found["entropy"]
    assert found["period"] == "3"


@pytest.mark.slow
def test_periodic_orbits_are_seen_in_floats(model, tmp_path):
    """The iterates of the map cross the diagonal at least as often as is claimed."""
    found = claims(model, tmp_path)
    low, high = (float(Fraction(q)) for q in found["interval"])
    t = np.linspace(low, high, 400_001)
    image = t
    for m in range(1, 8):
        image = after(image, 4.1, cosine=np.cos)
        crossings = np.count_nonzero(np.diff(np.sign(image - t)))
        counted = sum(d * int(n) for d, n in enumerate(found["orbits"], 1) if m % d == 0)
        assert counted <= crossings
        assert counted >= crossings // 3


def test_one_motion_attracts(model, tmp_path):
    """At a = 1 the blow comes where b + cos t is a period."""
    found = claims(model, tmp_path, "--set", "a=1")
    low, high = (float(Fraction(q)) for q in found["fixed"])
    t = pi / 2 + asin(6.5 - T)
    assert any(low <= t + k * T <= high for k in (-1, 0, 1))
    assert found["rate"].startswith("0.")
