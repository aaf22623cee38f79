"""The theorem ``islands``: proved from the command line, and refused."""

import json
from fractions import Fraction

import pytest
from support import proving

from cap.proofs import island, islands, rotation_choice


@pytest.fixture
def small(monkeypatch):
    """Only curves near P*, with few modes."""
    scale = island.Scale(40, Fraction(1, 5), 34)
    monkeypatch.setattr(island.Scale, "of", classmethod(lambda *_, **__: scale))
    monkeypatch.setattr(rotation_choice.within, "__defaults__", (((12, 25),),))


@pytest.mark.slow
@pytest.mark.usefixtures("small")
def test_a_range(capsys, tmp_path):
    """Two islands, and an f beyond the last one; interrupted and gone on with."""
    path, journal = tmp_path / "islands.json", tmp_path / "done.journal"
    words = ("--from", "2/5", "--to", "7/10", "--count", "3", "--digits", "8")
    for _ in range(2):
        told = ("--out", str(path), "--journal", str(journal))
        status, out, err = proving(capsys, "islands", *words, *told)
        assert status == 0, out + err
        found = json.loads(path.read_text("utf-8"))
        claims, unclaimed = found["claims"]["islands"], found["hints"]["open"]
        assert [(each["f"], each["map"]) for each in claims] == [("2/5", "Phi"), ("11/20", "sigma")]
        assert unclaimed == [{"f": "7/10", "reason": "no elliptic orbit"}]
        assert "f = 11/20" in out


def test_nothing_is_proved(capsys):
    """Where no orbit is elliptic; all reasons are told."""
    words = ("--from", "7/10", "--to", "8/10", "--count", "2")
    status, out, err = proving(capsys, "islands", *words)
    assert status == 1
    assert "7/10" in out + err
    assert "no elliptic orbit" in out + err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ((), "--from Q --to Q"),
        (("--from", "1/2"), "--from Q --to Q"),
        (("--from", "1/2", "--to", "2/5"), "0 < from < to"),
        (("--from", "1/2", "--to", "1"), "below F"),
        (("--from", "1/2", "--to", "3/5", "--count", "1"), "from 2 to 64"),
        (("--from", "1/2", "--to", "3/5", "--f", "1/2"), "more than one f"),
        (("--from", "1/2", "--to", "3/5", "--mu", "1/10"), "mu = 0|elastic|viscous"),
    ],
)
def test_what_is_refused(capsys, words, why):
    """In a line, with a status."""
    status, out, err = proving(capsys, "islands", *words)
    assert status != 0
    assert any(part in out + err for part in why.split("|")), out + err


def test_reasons():
    """Near a resonance, or not."""
    assert islands.reason(0.332) == "resonance of order 3"
    assert islands.reason(0.255) == "resonance of order 4"
    assert islands.reason(0.4) == islands.NO_CURVE
