"""Deciding: nothing that goes wrong is a verdict, and processes decide the same."""

import json
from dataclasses import replace

import audit_verdicts
import pytest
from audit_verdicts import said

from cap.audit import decide, given, ledger, recorded, subject
from cap.audit.decide import all_decided, decided
from cap.audit.means import stored as certificates
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Outcome, Strength
from cap.checker import verdict
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


@pytest.fixture
def accepted(tmp_path, monkeypatch):
    """Give a file of accepted certificates, one of which is another now."""
    path = tmp_path / "accepted.json"
    path.write_text(json.dumps({"impulse-1.json": "another", "none.json": ""}))
    monkeypatch.setattr(certificates, "ACCEPTED", path)
    certificates.accepted.cache_clear()
    yield path
    certificates.accepted.cache_clear()


@pytest.fixture
def checks(monkeypatch):
    """Return a list that grows when the checker is asked."""
    calls = []

    def check(data, tell):
        calls.append(1)
        return usual(data, tell)

    usual = verdict.check
    monkeypatch.setattr(verdict, "check", check)
    certificates._accepted.cache_clear()
    yield calls
    certificates._accepted.cache_clear()


def test_long_certificates_are_those_that_were_accepted(accepted, checks):
    """Another file is checked, and accepted when verdicts are recorded; then it is not checked."""
    certificates.accept()
    assert len(checks) == 1
    digest = certificates.digest("impulse-1.json")
    assert certificates.accepted() == {"impulse-1.json": digest, "none.json": ""}
    certificates._accepted.cache_clear()
    certificates.stored("impulse-1.json")
    assert len(checks) == 1
    certificates.stored("capture.json")
    assert len(checks) == 2


def test_the_stored_long_certificates_are_accepted():
    """Else claims that ask for them take minutes; see `cap.audit.means.stored`."""
    for name, digest in certificates.accepted().items():
        assert digest == certificates.digest(name), "run cap.audit --record"


@pytest.mark.slow
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
    monkeypatch.setattr(decide, "_part", audit_verdicts.killed)
    with pytest.raises(BadInput, match="was killed"):
        all_decided([ledger.claims()[FEW[0]]], print, jobs=2, fresh=True)
