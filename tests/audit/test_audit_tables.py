"""The tables of figures as claims: rows that are listed, computed, and kept."""

import json

import pytest

from cap.audit import coverage, ledger, subject, tables
from cap.audit.comparison import claim, number, proved, roughly, taken_from, unstated
from cap.audit.decide import all_decided, decided
from cap.audit.papers.mixed_dynamics.means.printed import printed, stated
from cap.audit.report.view import report
from cap.audit.verdict import Outcome, Strength
from cap.errors import NotProved

pytest_plugins = ["audit_fixtures"]
LABEL = "fig:sali"
ROWS = (
    number("a value", "1.5", 1.52),
    *taken_from("eq:sali-def", [number("another", "0.25", 0.75, "the sign")]),
    proved("a proved one", "3.14", ["3.1415", "3.1416"]),
    claim("words", "yes", "no (proved)", False, "because"),
    roughly(claim("rough words", "none found", "two", False, "more seeds")),
    unstated(number("a start that is not given", "1.0", 1.0), "it is not given"),
)


@pytest.fixture
def table(own_cache, elsewhere, monkeypatch):
    """Make a figure of some rows the only one; return how often it is computed."""
    calls = []

    def computed(label):
        calls.append(label)
        return ROWS

    elsewhere("tables.json")
    monkeypatch.setattr(tables, "labels", lambda: (LABEL,))
    monkeypatch.setattr(tables, "computed", computed)
    monkeypatch.setattr(tables, "_FOUND", {})
    tables.record(lambda _words: None, [LABEL], fresh=True)
    calls.clear()
    tables._FOUND.clear()
    return calls


def verdicts(fresh=False):
    """Decide the rows of the table."""
    return {each.says: decided(each, fresh=fresh) for each in tables.claims()}


def test_rows_become_claims(table):
    """What agrees is confirmed, values are corrected, words refuted, rough ones imprecise."""
    found = verdicts()
    assert [(each.outcome, each.strength) for each in found.values()] == [
        (Outcome.CONFIRMED, Strength.NUMERICAL),
        (Outcome.CORRECTED, Strength.NUMERICAL),
        (Outcome.CONFIRMED, Strength.PROVED),
        (Outcome.REFUTED, Strength.PROVED),
        (Outcome.IMPRECISE, Strength.NUMERICAL),
        (Outcome.UNCHECKABLE, Strength.NONE),
    ]
    assert [each.found for each in found.values()][3] == "no"
    assert [each.where for each in tables.claims()] == [LABEL, "eq:sali-def", *[LABEL] * 4]
    assert tables.claims()[0].id == "fig-sali.a-value"
    assert tables.claims()[0].module == "cap.paper.sali"


def test_a_table_is_computed_once(table):
    """In a process; later it is on disk; fresh ones are computed again."""
    verdicts()
    tables._FOUND.clear()
    verdicts()
    assert table == []  # it was kept when it was recorded
    tables._FOUND.clear()
    verdicts(fresh=True)
    assert table == [LABEL]


def test_rows_that_are_not_listed_decide_nothing(table):
    """A row more, or another number of the paper: it has to be looked at, and recorded."""
    path = subject.file("tables.json")
    listed = json.loads(path.read_text("utf-8"))
    listed[LABEL][0][1] = "1.6"
    path.write_text(json.dumps(listed))
    subject.forget()
    for each in verdicts().values():
        assert each.outcome is Outcome.UNDECIDED
        assert "other rows than tables.json" in each.evidence


def test_a_table_that_cannot_be_computed(table, monkeypatch):
    """Its rows are undecided, and say why; it is tried once."""

    def fail(label):
        table.append(label)
        raise NotProved("paper", "no reason")

    monkeypatch.setattr(tables, "computed", fail)
    for each in verdicts(fresh=True).values():
        assert each.outcome is Outcome.UNDECIDED
        assert "no reason" in each.evidence
    assert table == [LABEL]


def test_numbers_of_the_paper_are_read_from_the_list(table):
    """As they are printed; there must be such a row, and an interval where one is asked for."""
    assert stated("a value", LABEL) == "1.5"
    with pytest.raises(NotProved, match="no row"):
        stated("a number", LABEL)
    with pytest.raises(NotProved, match="no interval"):
        printed("a value", LABEL)


def test_printed_intervals():
    """Of the stored list: the trace's."""
    low, high = printed("enclosure of the trace")
    assert -1 < low < high < 0


def test_rows_are_in_the_ledger():
    """All that are listed, but those that a claim decides, which exist."""
    rows = {(label, entry[0]) for label, each in tables.listed().items() for entry in each}
    elsewhere = subject.paper()["elsewhere"]
    decided_by = {
        (label, row): name for label, each in elsewhere.items() for row, name in each.items()
    }
    assert decided_by.keys() <= rows
    assert set(decided_by.values()) <= ledger.claims().keys()
    assert len(tables.claims()) == len(rows) - len(decided_by)
    assert {each.id for each in tables.claims()} <= ledger.claims().keys()
    assert coverage.coverage().wrong == ()


def test_a_small_table_is_decided_as_recorded(own_cache):
    """Computed anew, in the way in which all are; its command is shown."""
    rows = [each for each in tables.claims() if each.table == "fig:model-schematic"]
    tables._FOUND.clear()
    found = all_decided(rows, lambda _words: None, fresh=True)
    assert [each.outcome for each in found.values()] == [Outcome.CONFIRMED] * 3
    (entry, *_) = report(found).entries
    assert "python -m cap.explore --paper fig:model-schematic" in entry.commands
