"""The cache: verdicts are kept by the content of what decided them."""

from dataclasses import replace

import pytest
from audit_verdicts import said

from cap import tree
from cap.audit import cache, decide
from cap.audit.decide import decided
from cap.audit.means import stored
from cap.audit.verdict import Outcome, Strength

pytest_plugins = ["audit_fixtures"]


def test_a_verdict_is_decided_once(example):
    """The second time it is taken from the cache, unless that is not wanted."""
    one, calls = example
    assert decided(one) == decided(one)
    assert len(calls) == 1
    decided(one, fresh=True)
    assert len(calls) == 2


def test_another_source_decides_anew(example, monkeypatch):
    """The digest of what decides the claim is part of the entry's name."""
    one, calls = example
    decided(one)
    monkeypatch.setattr(cache, "sources", lambda: "another source")
    decided(one)
    assert len(calls) == 2


def test_other_data_decide_anew(example):
    """What the claim is given, and what it says, is part of it too."""
    one, calls = example
    decided(one)
    decided(replace(one, content="other data"))
    assert len(calls) == 2


def test_another_certificate_decides_anew(example, monkeypatch):
    """Certificates that were asked for have to be the same; others may change."""
    one, calls = example
    cache.keep(one, said("confirmed", "kept", ""), {"capture.json": stored.digest("capture.json")})
    assert decided(one).found == "kept"
    monkeypatch.setattr(stored, "digest", lambda name: f"another {name}")
    assert decided(one).found == "yes"
    assert len(calls) == 1


def test_a_proof_that_is_gone_decides_anew(example, monkeypatch):
    """What rests on a written proof holds while this is there."""
    one, calls = example
    cache.keep(one, said("confirmed", "kept", "", proof="lift.md#exactness"), {})
    monkeypatch.setattr(decide, "exists", lambda _: True)
    assert decided(one).found == "kept"
    monkeypatch.setattr(decide, "exists", lambda _: False)
    assert decided(one).found == "yes"
    assert len(calls) == 1


@pytest.mark.parametrize("content", ["", "{", "[]", "{}", '{"verdict": {}, "certificates": {}}'])
def test_entries_that_cannot_be_read(example, own_cache, content):
    """They count for nothing, and are replaced."""
    one, calls = example
    decided(one)
    (entry,) = own_cache.iterdir()
    entry.write_text(content)
    decided(one)
    decided(one)
    assert len(calls) == 2


def test_a_folder_that_cannot_be_written(example, monkeypatch, tmp_path):
    """There is no cache, and no complaint."""
    one, calls = example
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("CAP_CACHE", str(tmp_path / "file" / "below"))
    assert decided(one).outcome is Outcome.CONFIRMED
    assert decided(one).outcome is Outcome.CONFIRMED
    assert len(calls) == 2


def test_what_is_undecided_is_not_kept(example, own_cache):
    """It is tried again the next time."""
    one, _ = example

    def fail():
        raise ZeroDivisionError("no reason")

    verdict = decided(replace(one, decide=fail))
    assert (verdict.outcome, verdict.strength) == (Outcome.UNDECIDED, Strength.NONE)
    assert "ZeroDivisionError: no reason" in verdict.evidence
    assert not own_cache.exists()


def test_the_folder(monkeypatch, tmp_path):
    """Its own variable, else the user's cache folder."""
    monkeypatch.delenv("CAP_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.folder() == tmp_path / "cap" / "audit"


@pytest.mark.parametrize(
    "name", ["cap/b.py", "cap/a/b.json", "cap/a/tables/b.toml", "proofs/b.py", "examples/b.csv"]
)
def test_the_digest_depends_on_every_source(monkeypatch, tmp_path, name):
    """One letter in a module changes it, or in the data beside it; what is recorded does not."""
    monkeypatch.setattr(tree, "ROOT", tmp_path / "cap")
    file = tmp_path / name
    file.parent.mkdir(parents=True)
    digests = []
    for text, recorded in (("x = 1", ""), ("x = 1", "{}"), ("x = 2", "{}")):
        file.write_text(text)
        file.with_name("recorded.json").write_text(recorded)
        digests.append(cache.sources.__wrapped__())
    assert digests[0] == digests[1] != digests[2]


def test_verdicts_survive_the_way_to_the_cache_and_back(example):
    """All fields."""
    one, _ = example
    verdict = said("open", "found", "evidence", strength=Strength.NUMERICAL)
    cache.keep(one, verdict, {})
    assert cache.known(one) == verdict
