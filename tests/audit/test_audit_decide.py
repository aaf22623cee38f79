"""Deciding: nothing that goes wrong is a verdict, and processes decide the same."""

import os

import pytest

from cap.audit import ledger, recorded
from cap.audit.decide import all_decided, decided
from cap.audit.verdict import Outcome, Strength, confirmed, refuted, still_open
from cap.errors import BadInput, NotProved

pytest_plugins = ["audit_fixtures"]
FEW = ("stops.tangency-times", "roots.value-of-f-sc", "cover.triangular-wave")


def with_function(one, decide):
    """Return the claim, decided by another function."""
    decide.__module__ = one.module
    return type(one)(one.id, one.where, one.kind, one.says, one.stated, decide)


def test_a_step_that_fails_decides_nothing(example):
    """`NotProved` says why."""

    def fail():
        raise NotProved("audit", "no reason", {"x": 1})

    verdict = decided(with_function(example[0], fail))
    assert verdict.outcome is Outcome.UNDECIDED
    assert "no reason  [x = 1]" in verdict.evidence


def test_a_written_proof_must_be_there(example):
    """An argument without its text decides nothing."""
    verdict = decided(
        with_function(example[0], lambda: confirmed("yes", "", proof="setup.md#nothing"))
    )
    assert verdict.outcome is Outcome.UNDECIDED
    assert "setup.md#nothing is missing" in verdict.evidence


def test_the_strength_follows_from_what_a_verdict_rests_on():
    """A written proof makes it an argument, a certificate makes it certified, else it is proved."""
    assert confirmed("", "").strength is Strength.PROVED
    assert refuted("", "", certificate="capture.json").strength is Strength.CERTIFIED
    both = confirmed("", "", certificate="capture.json", proof="setup.md#the-contact-law")
    assert both.strength is Strength.BY_ARGUMENT
    assert still_open("", "").strength is Strength.NONE
    assert still_open("", "", numerical=True).strength is Strength.NUMERICAL


def test_processes_decide_the_same(own_cache):
    """In the order of the claims, with progress."""
    claims = [ledger.claims()[name] for name in FEW]
    heard = []
    alone = all_decided(claims, heard.append, fresh=True)
    together = all_decided(claims, heard.append, jobs=2, fresh=True)
    assert alone == together
    assert list(together) == list(FEW)
    assert len(heard) == 2 * len(FEW)


def test_changes_are_noticed():
    """Another verdict, strength or finding; what is new, undecided, or gone."""
    name = FEW[0]
    old = recorded.recorded()[name]
    assert recorded.changes({name: old}, whole=False) == []
    assert len(recorded.changes({name: old}, whole=True)) == len(ledger.claims()) - 1
    for new, words in (
        (refuted(old.found, ""), "recorded corrected, now refuted"),
        (type(old)(outcome=old.outcome, found="else", evidence=""), "now 'else'"),
        (type(old)(outcome=Outcome.UNDECIDED, found="", evidence="why"), "not be decided: why"),
    ):
        (line,) = recorded.changes({name: new}, whole=False)
        assert words in line
    (line,) = recorded.changes({"new.claim": old}, whole=False)
    assert "new.claim is not recorded" in line


def test_floats_may_differ_in_their_digits():
    """What is found in floats is not compared, its verdict is."""
    name = "homoclinic.horseshoe"
    old = recorded.recorded()[name]
    assert old.strength is Strength.NUMERICAL
    assert recorded.changes({name: still_open("else", "", numerical=True)}, whole=False) == []
    assert recorded.changes({name: still_open("else", "")}, whole=False)


def test_recording(tmp_path, monkeypatch):
    """What is written is read back; an entry that is no verdict is not recorded."""
    verdicts = {"a.b": still_open("found", "evidence"), "c.d": refuted("x", "y", certificate="z")}
    monkeypatch.setattr(recorded, "PATH", tmp_path / "recorded.json")
    recorded.recorded.cache_clear()
    try:
        assert recorded.recorded() == {}
        recorded.write(verdicts)
        assert recorded.recorded() == verdicts
        text = recorded.PATH.read_text().replace("refuted", "disputed")
        recorded.PATH.write_text(text)
        recorded.recorded.cache_clear()
        assert recorded.recorded().keys() == {"a.b"}
    finally:
        recorded.recorded.cache_clear()


def test_a_process_that_is_killed(own_cache, monkeypatch):
    """One line, no traceback."""
    claim = ledger.claims()[FEW[0]]
    monkeypatch.setitem(ledger.claims(), claim.id, with_function(claim, lambda: os._exit(1)))
    with pytest.raises(BadInput, match="was killed"):
        all_decided([ledger.claims()[claim.id]], print, jobs=2, fresh=True)
