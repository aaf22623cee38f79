"""Fixtures of the tests of the audit: a cache of their own, and a claim to decide."""

import pytest

from cap.audit.claim import Claim, Kind
from cap.audit.verdict import confirmed


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    """Keep verdicts in a folder of the test."""
    monkeypatch.setenv("CAP_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def example():
    """Return a claim that counts how often it is decided."""
    calls = []

    def decide():
        calls.append(1)
        return confirmed("yes", f"decided {len(calls)} times")

    decide.__module__ = "cap.audit.claims.strobe"
    return Claim("strobe.example", "def:Phi", Kind.THEOREM, "An example.", "", decide), calls
