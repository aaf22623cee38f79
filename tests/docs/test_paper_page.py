"""docs/paper.md against the audit: the same verdicts, and the same numbers."""

import re
from decimal import Decimal
from pathlib import Path

import pytest

from cap.audit import errata, ledger, recorded, subject
from cap.audit.means.stored import FOLDER, accepted

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
    for line in TEXT.splitlines()
    if line.endswith(") |") and "](audit.md#" in line
]
_VERDICT = re.compile(r"([a-z ]+): \[`([\w.-]+)`\]\(audit\.md#([\w-]+)\)")
_NUMBER = re.compile(r"\d+\.\d+…?")
_SHORTEST = 3  # places of a number that is looked for


def verdicts(cell):
    """Return what the last cell of a row says of claims, by their ids."""
    found = {name: outcome.strip() for outcome, name, _ in _VERDICT.findall(cell)}
    assert len(found) == len(cell.split("), "))
    return found


def numbers(text):
    """Return the numbers of a text that have some places."""
    return [
        each
        for each in _NUMBER.findall(text)
        if len(each.partition(".")[2].strip("…")) >= _SHORTEST
    ]


def known(number, texts):
    """Return whether a number is in texts: cut off, if … follows, else rounded."""
    digits = number.rstrip("…")
    ends = {each.rstrip("…") for text in texts for each in _NUMBER.findall(text)}
    if digits != number:
        return any(each.startswith(digits) for each in ends)
    half = Decimal(1).scaleb(-len(digits.partition(".")[2])) / 2
    return any(abs(Decimal(each) - Decimal(digits)) <= half for each in ends)


@pytest.mark.parametrize("row", ROWS, ids=[row[0][:40] for row in ROWS])
def test_a_row_says_what_the_audit_says(row):
    """Its verdicts are those recorded; its numbers are in what was found, or in certificates."""
    paper, proved, audit = row
    every = recorded.recorded()
    told = verdicts(audit)
    assert told == {name: str(every[name].outcome) for name in told}
    files = set(re.findall(r"`([a-z][\w-]+)\.json`", paper + proved))
    found = [(FOLDER / f"{name}.json").read_text(encoding="utf-8") for name in sorted(files)]
    found += [f"{every[name].found} {every[name].evidence}" for name in told]
    stated = [f"{ledger.claims()[name].stated} {ledger.claims()[name].quote}" for name in told]
    for cell, texts in ((paper, [*stated, *found]), (proved, [*found, *stated])):
        for number in numbers(cell):
            assert known(number, texts), number


def test_every_table_names_claims():
    """All rows but those on the nine points of a figure, which have no claims of their own."""
    lines = [each for each in TEXT.splitlines() if each.startswith("| ")]
    heads = [each for each in lines if each.startswith(("| the paper", "| R | f"))]
    assert len(lines) - len(heads) - len(ROWS) == 3


@pytest.mark.parametrize(
    ("number", "texts", "expected"),
    [
        ("0.113477977", ["[0.113477977, 0.113477978]"], True),
        ("0.1135", ["[0.113477977, 0.113477978]"], True),
        ("0.113477978", ["0.1134779785"], True),
        ("0.1134…", ["0.11348"], True),
        ("0.1134", ["0.11348"], False),
        ("0.1135…", ["0.11348"], False),
        ("0.1136", ["0.113477977"], False),
        ("0.420", ["0.113477977"], False),
    ],
)
def test_numbers_are_recognised(number, texts, expected):
    """Digits that are others are not."""
    assert known(number, texts) is expected


def test_counts_are_those_of_the_audit():
    """Of the erratum, of long certificates, of the other paper's claims."""
    compared, of_all = re.search(r"(\d+) of its (\d+) changes", TEXT).groups()
    changes = errata.changes()
    assert int(of_all) == len(changes)
    assert int(compared) == sum(bool(each.formula) for each in changes)
    listed = re.search(r"take the checker longest \(([^:]*):", TEXT)[1]
    assert re.findall(r"`([\w-]+)`", listed) == [name[:-5] for name in sorted(accepted())]
    subject.choose("church_fortin")
    try:
        assert f"`church_fortin`, {len(ledger.claims())} claims" in TEXT
    finally:
        subject.choose(subject.FIRST)
