"""The ledger: all claims are well formed, and no place of the paper is forgotten."""

from dataclasses import replace

import pytest

from cap.audit import coverage, errata, findings, labels, ledger, recorded, revision
from cap.audit.claim import Kind
from cap.audit.findings import statements
from cap.audit.verdict import Outcome
from cap.errors import BadInput

pytest_plugins = ["audit_fixtures"]


def test_claims_are_many_and_well_formed():
    """Each has an id of its own, a place, words that end, and a value stated."""
    claims = ledger.claims()
    assert len(claims) >= 550
    for name, each in claims.items():
        assert name == each.id
        assert each.says[-1] in ".?", name
        assert each.stated, name
        assert labels.stored().place(each.where)


def test_claims_are_in_the_order_of_the_sections():
    """The abstract first, then section by section."""
    order, paper = list(ledger.sections()), labels.stored()
    found = [paper.place(each.where).section for each in ledger.claims().values()]
    numbers = [order.index(section) for section in found]
    assert numbers == sorted(numbers)


def test_recorded_verdicts_are_those_of_the_claims():
    """All claims, and no others; none is undecided."""
    assert recorded.recorded().keys() == ledger.claims().keys()
    assert all(each.outcome is not Outcome.UNDECIDED for each in recorded.recorded().values())


def test_no_place_is_forgotten():
    """Each place has claims or a reason, not both."""
    assert list(coverage.wrong()) == []
    assert len(coverage.taken()) == len(labels.stored().places)


@pytest.mark.parametrize(
    ("reasons", "complaint"),
    [
        ({}, "eq:model is forgotten"),
        ({"thm:wellposed": "?"}, "thm:wellposed has claims, and a reason"),
        ({"thm:nothing": "?"}, "'thm:nothing', which is no place"),
    ],
)
def test_coverage_complains(monkeypatch, reasons, complaint):
    """A forgotten place, a needless reason, a reason for nothing."""
    given = coverage.reasons() | reasons if reasons else {}
    monkeypatch.setattr(coverage, "reasons", lambda: given)
    assert any(complaint in each for each in coverage.wrong())


def test_coverage_complains_of_claims_without_a_place(monkeypatch, example):
    """A claim that is taken from nowhere."""
    one = example[0]
    lost = replace(one, where="eq:lost")
    monkeypatch.setattr(ledger, "claims", lambda: {lost.id: lost})
    assert any("'eq:lost', which is no place" in each for each in coverage.wrong())


def test_findings_share_out_what_is_not_confirmed():
    """Each such claim is in one of about sixty findings; the claims that they name exist."""
    ids = ledger.claims().keys()
    known = {name: recorded.recorded()[name] for name in ids}
    shared = findings.members(known)
    assert 50 <= len(shared) <= 70
    everywhere = [name for names in shared.values() for name in names]
    assert len(everywhere) == len(set(everywhere))
    wrong = {name for name, each in known.items() if each.outcome is not Outcome.CONFIRMED}
    assert wrong <= set(everywhere) <= ids
    named = {name for each in shared for name in each.claims}
    assert {name for name in named if not name.endswith("*")} <= ids


def test_quotations_and_changes_name_claims():
    """Each claim has a quotation; both were found to fit the paper as they are stored now."""
    assert ledger.quotes().keys() == ledger.claims().keys() == labels.stored().lines.keys()
    assert labels.stored().bound == revision.bound()
    assert {name for each in errata.changes() for name in each.claims} <= ledger.claims().keys()


def test_each_wrong_formula_and_number_has_a_change():
    """And no change is asked for by a claim that is confirmed."""
    known = recorded.recorded()
    wanted = {name for each in errata.changes() for name in each.claims}
    for name, each in ledger.claims().items():
        wrong = known[name].outcome in (Outcome.CORRECTED, Outcome.REFUTED)
        if wrong and each.kind in (Kind.FORMULA, Kind.NUMBER, Kind.INEQUALITY):
            assert name in wanted
    assert all(known[name].outcome is not Outcome.CONFIRMED for name in wanted)


def test_summaries_name_claims():
    """The table of statements; every theorem of the paper is in it."""
    ids = ledger.claims().keys()
    assert {name for each in statements() for name in each.decided_by} <= ids
    kinds = ("theorem", "lemma", "proposition", "corollary", "conjecture")
    assert [each.label for each in statements()] == [
        place.label for place in labels.stored().places if place.kind in kinds
    ]


def test_findings_were_written_for_the_recorded_verdicts():
    """Their consequences belong to the verdicts that they have."""
    known = recorded.recorded()
    all_ = findings.findings()
    assert [known[each.claims[0]].outcome for each in all_] == [each.verdict for each in all_]
    assert {each.severity for each in all_} == {"theorem", "proof", "number", "wording"}


def test_claims_are_chosen():
    """By id, by group, and by section: its number or any of its labels."""
    assert {each.id.partition(".")[0] for each in ledger.chosen("fig-sali", None)} == {"fig-sali"}
    assert [each.id for each in ledger.chosen("stops.tangency-times", None)] == [
        "stops.tangency-times"
    ]
    third = ledger.chosen(None, "3")
    assert third == ledger.chosen(None, "thm:symplectic")
    assert {labels.stored().place(each.where).section for each in third} == {"3"}


def test_claims_of_a_subsection_are_chosen():
    """By its number or its label, up to the next one; the next section is none of it."""
    places = [place.label for place in labels.stored().places]
    part = ledger.chosen(None, "2.4")
    assert part == ledger.chosen(None, "ssec:setup-strob")
    found = [places.index(each.where) for each in part]
    assert {"def:Phi", "def:trajectory-types"} <= {each.where for each in part}
    assert places.index("ssec:setup-strob") <= min(found)
    assert max(found) < places.index("sec:lift")
    parts = [claim for k in range(1, 5) for claim in ledger.chosen(None, f"2.{k}")]
    head = [claim for claim in ledger.chosen(None, "2") if claim.where == "sec:setup"]
    assert head + parts == ledger.chosen(None, "2")


@pytest.mark.parametrize(
    ("only", "section", "words"),
    [
        ("stops.tangency-time", None, "did you mean stops.tangency-times"),
        (None, "42", "no section"),
        (None, "sec:nothing", "no section"),
    ],
)
def test_choices_that_make_no_sense(only, section, words):
    """One line, with a guess of what was meant."""
    with pytest.raises(BadInput, match=words):
        ledger.chosen(only, section)
