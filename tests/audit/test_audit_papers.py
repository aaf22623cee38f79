"""Other papers: claims that are data, and what the general part does with them."""

import pytest

from cap.audit import command, coverage, findings, given, ledger, recorded, subject
from cap.audit.decide import decided
from cap.audit.means import stored as certificates
from cap.audit.papers import FIRST
from cap.audit.papers.church_fortin.claims import tables as deciding
from cap.audit.report.formats import FORMATS, written
from cap.audit.report.view import Report
from cap.audit.verdict import Outcome
from cap.errors import BadInput, NotProved

pytest_plugins = ["audit_fixtures"]
FEW = ("labels.a2-0-e0-89-e1-0", "labels.a1-8-e0-75-e1-5", "row.a2-0-e0-8-e1-0-1")


@pytest.fixture
def tables(own_cache):
    """Choose Church and Fortin's tables."""
    subject.choose("church_fortin")
    yield
    subject.choose(FIRST)


def test_papers_are_chosen():
    """By their names; another name is refused."""
    assert {"church_fortin", FIRST} <= set(subject.names())
    with pytest.raises(BadInput, match="no paper 'church' is audited"):
        subject.choose("church")
    assert subject.chosen() == FIRST


def test_the_ledger_of_the_tables(tables):
    """Each claim has a row as its quotation, a place, a verdict; what is wrong is in a finding."""
    claims = ledger.claims()
    assert ledger.quotes().keys() == claims.keys() == recorded.recorded().keys()
    assert list(coverage.wrong()) == []
    shared = findings.members(recorded.recorded())
    wrong = {n for n, each in recorded.recorded().items() if each.outcome is not Outcome.CONFIRMED}
    assert wrong == {name for names in shared.values() for name in names}
    for name, each in claims.items():
        text = (deciding.DATA / f"{each.where}.csv").read_text("utf-8")
        assert text.count(f"\n{ledger.quotes()[name]}\n") == 1


@pytest.mark.slow
@pytest.mark.parametrize("name", FEW)
def test_claims_that_are_data_are_decided(tables, name):
    """As recorded: a wrong label, a right one, a row that crosses the table."""
    claim = ledger.claims()[name]
    assert recorded.changes({name: decided(claim, fresh=True)}, whole=False) == []


def test_recording_lists_no_figures(tables, elsewhere, capsys, monkeypatch):
    """Rows of figures belong to the paper that has them."""
    monkeypatch.setattr(certificates, "accept", lambda: None)  # it would write into the tree
    stored = elsewhere("recorded.json")
    assert command.main(["--of", "church_fortin", "--only", FEW[1], "--record"]) == 0
    assert FEW[1] in stored.read_text("utf-8")
    assert not subject.file("tables").exists()


def test_reports_of_the_tables(tables):
    """In every format, with their title."""
    whole = Report(recorded.recorded())
    texts = [written(each, whole) for each in (*FORMATS.values(), "citation.bib", "summary.txt")]
    assert all("vibrating gravitational billiards" in each for each in texts)
    assert "Five rows are no orbits" in texts[-1]


def test_a_claim_of_a_kind_that_is_not_there(tmp_path):
    """A function that nobody wrote decides nothing."""
    path = tmp_path / "claims.toml"
    path.write_text(
        '[[claim]]\nid = "a.b"\nwhere = "c"\nkind = "number"\nsays = "D."\nstated = "1"\n'
        'quote = "E"\ndecide = "nothing"\n'
    )
    path.with_suffix(".py").touch()
    with pytest.raises(AttributeError, match="nothing"):
        given.claims(path, deciding.__name__)


def test_a_function_decides_after_the_steps(tmp_path, monkeypatch):
    """Its words and theirs are in what is found; a step that fails leaves nothing to decide."""
    path = tmp_path / "claims.toml"
    text = (
        '[[claim]]\nid = "a.b"\nwhere = "c"\nkind = "number"\nsays = "D."\nstated = "1"\n'
        'quote = "E"\ndecide = "shown"\nverdict = "confirmed"\nfound = "{half}, {words}"\n'
        "steps = '''\nhalf = Rational(1, 2)\nhalf < 1\n'''\n"
    )
    path.with_suffix(".py").touch()
    path.write_text(text)
    calls = []
    monkeypatch.setattr(
        deciding, "shown", lambda: calls.append(1) or {"words": "so"}, raising=False
    )
    (claim,) = given.claims(path, deciding.__name__)
    assert claim.decide().found == "1/2, so"
    path.write_text(text.replace("half < 1", "half > 1"))
    (claim,) = given.claims(path, deciding.__name__)
    with pytest.raises(NotProved, match="half > 1"):
        claim.decide()
    assert calls == [1]
