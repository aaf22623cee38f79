"""Fixtures of the tests of the audit: a cache of their own, and a claim to decide."""

from pathlib import Path

import pytest
from audit_verdicts import said

from cap.audit import subject
from cap.audit.claim import Claim, Kind


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    """Keep verdicts in a folder of the test."""
    monkeypatch.setenv("CAP_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """Return a function after which the paper's file of some name is in a folder of the test."""
    known = dict[str, Path]()
    usual = subject.file

    def move(name):
        known[name] = tmp_path / name
        subject.forget()
        return known[name]

    monkeypatch.setattr(subject, "file", lambda name: known.get(name) or usual(name))
    yield move
    known.clear()
    subject.forget()


@pytest.fixture
def example():
    """Return a claim that counts how often it is decided."""
    calls = []

    def decide():
        calls.append(1)
        return said("confirmed", "yes", f"decided {len(calls)} times")

    return Claim("strobe.example", "def:Phi", Kind.THEOREM, "An example.", "", decide), calls
