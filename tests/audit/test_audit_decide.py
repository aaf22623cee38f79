"""Deciding: nothing that goes wrong is a verdict, and processes decide the same."""

import os
from dataclasses import replace

import pytest
from audit_verdicts import said

from cap.audit import given, ledger, recorded, subject
from cap.audit.decide import all_decided, decided
from cap.audit.means import accepted
from cap.audit.means.need import need
from cap.audit.means.stored import FOLDER, stored
from cap.audit.verdict import Outcome, Strength
from cap.errors import BadInput, NotProved

pytest_plugins = ["audit_fixtures"]
FEW = ("stops.tangency-times", "roots.value-of-f-sc", "cover.triangular-wave")


def with_function(one, decide):
    """Return the claim, decided by another function."""
    return replace(one, decide=decide)


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
        with_function(example[0], lambda: said("confirmed", "yes", "", proof="setup.md#nothing"))
    )
    assert verdict.outcome is Outcome.UNDECIDED
    assert "setup.md#nothing is missing" in verdict.evidence


def rests(example, *, proof="", checks=0, certificate="", asks=False):
    """Return the verdict of a function that makes checks, and may ask for a certificate."""

    def decide():
        for _ in range(checks):
            need(True, "no")
        if asks:
            stored("impulse-1.json")
        return said("confirmed", "yes", "", proof=proof, certificate=certificate)

    return decided(with_function(example[0], decide), fresh=True)


def test_the_strength_follows_from_what_was_done(example):
    """Not from what a verdict names: nothing, checks, a certificate, a written proof."""
    assert rests(example).strength is Strength.READ
    assert rests(example, checks=1).strength is Strength.PROVED
    assert rests(example, checks=1, asks=True).strength is Strength.CERTIFIED
    by = rests(example, checks=1, asks=True, proof="setup.md#the-contact-law")
    assert by.strength is Strength.BY_ARGUMENT
    entry = {"id": "strobe.example", "verdict": "open", "stated": ""}
    assert given.decided(entry, {}).strength is Strength.NONE
    assert given.decided({**entry, "strength": "numerical"}, {}).strength is Strength.NUMERICAL


def test_a_certificate_that_is_named_must_be_checked(example):
    """Its name alone decides nothing."""
    verdict = rests(example, checks=1, certificate="impulse-1.json")
    assert verdict.outcome is Outcome.UNDECIDED
    assert "impulse-1.json is named, and was not checked" in verdict.evidence


def test_long_certificates_are_those_that_were_accepted(tmp_path, monkeypatch):
    """Another file is checked; so is one that does not take long."""
    name, data = accepted.LONG[0], b"{}"
    monkeypatch.setattr(accepted, "STORED", tmp_path / "accepted.json")
    accepted._stored.cache_clear()
    try:
        accepted.note("impulse-1.json", data)
        accepted.note(name, data)
        accepted.record()
        assert accepted.known(name, data)
        assert not accepted.known(name, data + b" ")
        assert not accepted.known("impulse-1.json", data)
    finally:
        accepted._stored.cache_clear()
        accepted._NEW.clear()


def test_the_stored_long_certificates_are_accepted():
    """Else claims that ask for them take minutes; see `accepted`."""
    for name in accepted.LONG:
        assert accepted.known(name, (FOLDER / name).read_bytes()), "run cap.audit --record"


def test_processes_decide_the_same(own_cache):
    """In the order of the claims, with progress."""
    claims = [ledger.claims()[name] for name in FEW]
    heard = []
    alone = all_decided(claims, heard.append, fresh=True)
    together = all_decided(claims, heard.append, jobs=2, fresh=True)
    assert alone == together
    assert list(together) == list(FEW)
    assert len(heard) == 2 * len(FEW)


@pytest.mark.parametrize("jobs", [1, 2])
def test_certificates_accepted_by_processes_are_recorded(tmp_path, monkeypatch, jobs):
    """What a process notes while it decides reaches the one that records."""
    claim = ledger.claims()[FEW[0]]

    def decide():
        accepted.note(accepted.LONG[0], b"{}")
        return said("confirmed", "yes", "")

    monkeypatch.setitem(ledger.claims(), claim.id, with_function(claim, decide))
    monkeypatch.setattr(accepted, "STORED", tmp_path / "accepted.json")
    accepted._stored.cache_clear()
    try:
        all_decided([ledger.claims()[claim.id]], print, jobs=jobs, fresh=True)
        accepted.record()
        assert accepted.known(accepted.LONG[0], b"{}")
    finally:
        accepted._stored.cache_clear()
        accepted._NEW.clear()


def test_changes_are_noticed():
    """Another verdict, strength or finding; what is new, undecided, or gone."""
    name = FEW[0]
    old = recorded.recorded()[name]
    assert recorded.changes({name: old}, whole=False) == []
    assert len(recorded.changes({name: old}, whole=True)) == len(ledger.claims()) - 1
    for new, words in (
        (said("refuted", old.found, ""), "recorded corrected, now refuted"),
        (replace(old, found="else"), "now 'else'"),
        (replace(old, evidence="else"), "recorded evidence"),
        (replace(old, proof="else"), "recorded proof"),
        (type(old)(outcome=Outcome.UNDECIDED, found="", evidence="why"), "not be decided: why"),
    ):
        (line,) = recorded.changes({name: new}, whole=False)
        assert words in line
    (line,) = recorded.changes({"new.claim": old}, whole=False)
    assert "new.claim is not recorded" in line


def test_floats_may_differ_in_their_digits():
    """What is found in floats is not compared, its verdict is."""
    name = "gallery.scaling-of-the-hits"
    old = recorded.recorded()[name]
    assert old.strength is Strength.NUMERICAL
    assert recorded.changes({name: replace(old, found="else")}, whole=False) == []
    assert recorded.changes({name: replace(old, strength=Strength.READ)}, whole=False)


@pytest.mark.parametrize("what", ["says", "stated", "where"])
def test_a_changed_sentence_is_noticed(monkeypatch, what):
    """Its words, the value stated, its place: the record knows what the verdict was about."""
    name = FEW[1]
    claim = ledger.claims()[name]
    monkeypatch.setitem(ledger.claims(), name, replace(claim, **{what: "another"}))
    (line,) = recorded.changes({name: recorded.recorded()[name]}, whole=False)
    assert "are not those recorded" in line


def test_a_changed_quotation_is_noticed(monkeypatch):
    """One digit of it is enough."""
    name = FEW[1]
    claim = ledger.claims()[name]
    other = replace(claim, quote=claim.quote.replace("0.34790", "0.34791"))
    monkeypatch.setitem(ledger.claims(), name, other)
    (line,) = recorded.changes({name: recorded.recorded()[name]}, whole=False)
    assert "are not those recorded" in line


def test_recording(elsewhere):
    """What is written is read back, other entries stay; what is no verdict is not recorded."""
    first, second = FEW[:2]
    one, two = said("open", "found", "evidence"), said("refuted", "x", "y", certificate="z")
    elsewhere("recorded.json")
    assert recorded.recorded() == {}
    recorded.write({first: one})
    recorded.write({second: two})
    assert recorded.recorded() == {first: one, second: two}
    day, program = recorded.made()
    assert len(day) == len("2026-01-01")
    assert program.startswith("cap ")
    path = subject.file("recorded.json")
    path.write_text(path.read_text("utf-8").replace("refuted", "disputed"))
    subject.forget()
    assert recorded.recorded().keys() == {first}


def test_a_process_that_is_killed(own_cache, monkeypatch):
    """One line, no traceback."""
    claim = ledger.claims()[FEW[0]]
    monkeypatch.setitem(ledger.claims(), claim.id, with_function(claim, lambda: os._exit(1)))
    with pytest.raises(BadInput, match="was killed"):
        all_decided([ledger.claims()[claim.id]], print, jobs=2, fresh=True)
