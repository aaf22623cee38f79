"""The tables of figures as claims: each row is decided singly."""

import re
import sys
import types
from importlib import import_module

import pytest

from cap.audit import coverage, ledger, subject, tables
from cap.audit.comparison import compared, value
from cap.audit.decide import all_decided, decided
from cap.audit.papers.mixed_dynamics.means.printed import printed
from cap.audit.report.view import Report
from cap.audit.steps import SYMBOLS
from cap.audit.verdict import Outcome, Strength
from cap.errors import NotProved

pytest_plugins = ["audit_fixtures"]
LABEL = "fig:sali"
TABLE = """
label = "fig:sali"
module = "own_finders"

[[row]]
what = "a value"
paper = "1.5"
by = "numbers"
value = "near"

[[row]]
what = "another"
paper = "0.25"
by = "numbers"
value = "far"
why = "the sign"
where = "eq:sali-def"

[[row]]
what = "a proved one"
paper = "3.14"
by = "numbers"
value = "pi"

[[row]]
what = "words"
paper = "yes"
by = "words"
ours = "{said} (proved)"
holds = 'said == "yes"'
why = "for {said}"

[[row]]
what = "rough words"
paper = "none found"
by = "words"
ours = "two"
rough = true

[[row]]
what = "a start that is not given"
paper = "1.0"
by = "given"
with = { x = "1.0" }
value = "x"
unstated = true
why = "it is not given"
"""


class Finders(types.ModuleType):
    """Functions that find what the rows ask for; they note that they are called."""

    def __init__(self):
        super().__init__("own_finders")
        self.calls = []

    def numbers(self):
        """Return numbers."""
        return {"near": 1.52, "far": 0.75, "pi": ["3.1415", "3.1416"]}

    def words(self):
        """Return words."""
        return {"said": "no", "so": False}

    def given(self, x):
        """Return what is given."""
        return {"x": float(x)}

    def finds(self, module, function, options):
        """Call a function."""
        self.calls.append(function)
        assert module == self.__name__
        return getattr(self, function)(**options)


@pytest.fixture
def table(own_cache, elsewhere, monkeypatch):
    """Make a figure of some rows the only one; return what finds them."""
    finders = Finders()
    monkeypatch.setitem(sys.modules, "own_finders", finders)
    path = elsewhere("tables/own.toml")
    path.parent.mkdir()
    path.write_text(TABLE, encoding="utf-8")
    own = subject.paper() | {"tables": ["own"], "finds": "own_finders"}
    monkeypatch.setattr(subject, "paper", lambda: own)
    tables._found.cache_clear()
    yield finders
    tables._found.cache_clear()


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
    words = found["Words."]
    assert (words.found, words.evidence) == ("no", "for no.")
    assert [each.where for each in tables.claims()] == [LABEL, "eq:sali-def", *[LABEL] * 4]
    assert tables.claims()[0].id == "fig-sali.a-value"


def test_a_row_is_decided_singly(table):
    """No function but its own is called for it, and that once in a process."""
    rows = tables.claims()
    decided(rows[3])
    assert table.calls == ["words"]
    decided(rows[4])
    assert table.calls == ["words"]
    verdicts()
    assert table.calls == ["words", "numbers", "given"]


def test_rows_are_kept(table):
    """Later they are on disk; fresh ones are computed again."""
    known = verdicts()
    tables._found.cache_clear()
    table.calls.clear()
    assert verdicts() == known
    assert table.calls == []
    assert verdicts(fresh=True) == known
    assert sorted(table.calls) == ["given", "numbers", "words"]


def test_another_row_is_decided_anew(table, elsewhere):
    """What is kept is about the row as it was."""
    assert verdicts()["A value."].outcome is Outcome.CONFIRMED
    path = subject.file("tables/own.toml")
    path.write_text(path.read_text("utf-8").replace('"1.5"', '"1.7"'), encoding="utf-8")
    subject.forget()
    assert verdicts()["A value."].outcome is Outcome.CORRECTED


def test_a_row_that_cannot_be_computed(table, monkeypatch):
    """It is undecided, and says why; that is tried once, and other rows are decided."""

    def fail():
        raise NotProved("paper", "no reason")

    monkeypatch.setattr(table, "numbers", fail)
    found = verdicts(fresh=True)
    failed = [each for each in found.values() if each.outcome is Outcome.UNDECIDED]
    assert len(failed) == 3
    assert all("no reason" in each.evidence for each in failed)
    assert table.calls.count("numbers") == 1


def test_a_row_of_which_nothing_is_found(table, monkeypatch):
    """It is undecided."""
    monkeypatch.setattr(table, "words", dict)
    assert verdicts()["Words."].outcome is Outcome.UNDECIDED


def test_numbers_of_the_paper_are_read_from_the_rows(table):
    """As they are printed; there must be such a row, and an interval where one is asked for."""
    assert tables.stated("a value", LABEL) == "1.5"
    with pytest.raises(NotProved, match="no row"):
        tables.stated("a number", LABEL)
    with pytest.raises(NotProved, match="no interval"):
        printed("a value", LABEL)


def test_printed_intervals():
    """Of the stored rows: the trace's."""
    low, high = printed("enclosure of the trace")
    assert -1 < low < high < 0


def test_rows_are_in_the_ledger():
    """All that there are, but those that a claim decides, which exist; names are of one row."""
    rows = [(label, row["what"]) for label, each in tables.tables().items() for row in each["row"]]
    assert len(set(rows)) == len(rows)
    elsewhere = subject.paper()["elsewhere"]
    decided_by = {
        (label, row): name for label, each in elsewhere.items() for row, name in each.items()
    }
    assert decided_by.keys() <= set(rows)
    assert set(decided_by.values()) <= ledger.claims().keys()
    assert len(tables.claims()) == len(rows) - len(decided_by)
    assert {each.id for each in tables.claims()} <= ledger.claims().keys()
    assert list(coverage.wrong()) == []


ENTRIES = {
    "what",
    "paper",
    "by",
    "module",
    "steps",
    "with",
    "value",
    "ours",
    "holds",
    "why",
    "note",
    "where",
}
FLAGS = {"rough", "unstated", "cut"}


@pytest.mark.parametrize("label", tables.tables())
def test_rows_have_known_entries(label):
    """A number, or words; flags are set or not there; and who finds them exists."""
    module = tables.tables()[label]["module"]
    for row in tables.tables()[label]["row"]:
        assert row.keys() <= ENTRIES | FLAGS | SYMBOLS.keys(), row["what"]
        assert {"what", "paper"} <= row.keys()
        assert ("steps" in row) is not ("by" in row), row["what"]
        if "by" in row:
            assert callable(getattr(import_module(row.get("module", module)), row["by"]))
        assert ("value" in row) is not ("ours" in row), row["what"]
        assert "ours" in row or "holds" not in row
        assert all(row[flag] is True for flag in FLAGS & row.keys())


@pytest.mark.parametrize(
    ("row", "ours", "outcome"),
    [
        ({"steps": "x = 2/pi", "value": "x"}, "0.636620", Outcome.CONFIRMED),
        ({"steps": "x = 3/pi", "value": "x"}, "0.954930", Outcome.CORRECTED),
        (
            {"steps": "x = 2/pi\nx > 0", "ours": "{x:2} (proved)", "holds": True},
            "[0.63, 0.64]",
            Outcome.CONFIRMED,
        ),
        (
            {"steps": "x = 2/pi\nx != 0", "ours": "{x:1} (proved)", "why": "{paper.f:1}"},
            "[0.6, 0.7]",
            Outcome.REFUTED,
        ),
    ],
)
def test_rows_that_steps_decide(row, ours, outcome):
    """A number is enclosed, words are filled; what they find is proved."""
    found = tables._by_steps({"what": "x", "paper": "0.637", **row}).verdict
    assert (found.found, found.outcome, found.strength) == (ours, outcome, Strength.PROVED)
    assert found.evidence == ("0.4." if "why" in row else "")


@pytest.mark.parametrize(
    ("paper", "ours", "right"),
    [
        ("0.123", ["0.1239", "0.12399"], True),
        ("0.124", ["0.1239", "0.12399"], False),  # rounded
        ("0.123", ["0.1229", "0.1229"], False),
        ("-0.123", ["-0.1239", "-0.1238"], True),
        ("-0.123", ["-0.1229", "-0.1228"], False),
    ],
)
def test_a_number_that_is_cut(paper, ours, right):
    """What follows are further digits; a rounded one, or a smaller one, is another."""
    row = {"what": "x", "paper": paper, "value": "x", "cut": True}
    outcome = compared(row, {"x": ours}).outcome
    assert outcome is (Outcome.CONFIRMED if right else Outcome.CORRECTED)


def test_of_several_runs_the_range_agrees():
    """To half a unit of the last digit; of integers no farther."""
    for paper, right in (("0.42", False), ("0.43", True), ("0.45", True), ("0.46", False)):
        assert (value(paper, [0.434, 0.447])[1] is Outcome.CONFIRMED) is right
    assert value("4", [5.0, 7.0])[1] is Outcome.CORRECTED


CALCULATED = {  # from a formula of the text
    "fig-model-schematic.period-t-2-pi-omega-the-paper-2-pi",
    "fig-bifurcation.exponent-of-rotation-number-over-distance-from-the-end",
    "fig-continuation.exponent-of-mu-in-the-positive-lyapunov-exponent",
}


def test_numbers_are_those_of_the_quotations():
    """A decimal that a claim states is in the piece of the text that it is taken from."""
    decimals = {
        name: each
        for name, each in ledger.claims().items()
        if re.fullmatch(r"[-+]?\d+\.\d+", each.stated) and name not in CALCULATED
    }
    assert len(decimals) > 70
    for name, each in decimals.items():
        assert re.search(rf"(?<![\d.]){re.escape(each.stated.strip('+-'))}(?!\d)", each.quote), name
        minus = f"-{each.stated[1:]}" in each.quote
        assert minus is each.stated.startswith("-"), name


def test_a_row_with_a_step_that_fails():
    """It is not decided."""
    with pytest.raises(NotProved):
        tables._by_steps({"what": "x", "paper": "1", "steps": "x = 1\nx > 2", "value": "x"})


def test_a_small_table_is_decided_as_recorded(own_cache):
    """Computed anew, in the way in which all are; its command is shown."""
    rows = [each for each in tables.claims() if each.table == "fig:model-schematic"]
    tables._found.cache_clear()
    found = all_decided(rows, lambda _words: None, fresh=True)
    assert [each.outcome for each in found.values()] == [Outcome.CONFIRMED] * 3
    (entry, *_) = Report(found).by_id.values()
    assert "python -m cap.explore --paper fig:model-schematic" in entry.commands
