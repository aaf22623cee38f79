"""The command line: what it prints, and its exit status."""

import json
from dataclasses import replace

import pytest

from cap.audit import command, labels, ledger, recorded, subject
from cap.audit.verdict import Outcome

pytest_plugins = ["audit_fixtures"]
ONE = "roots.value-of-f-sc"
KEYS = ["id", "where", "claim", "stated", "found", "verdict", "strength", "evidence", "command"]


@pytest.fixture
def run(capsys):
    """Return (status, standard output, standard error) of the command."""

    def command_line(*words):
        try:
            status = command.main(words)
        except SystemExit as stop:
            status = stop.code
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return command_line


@pytest.mark.slow
def test_one_claim(run):
    """Decided as recorded: status 0; text says how to decide it again."""
    status, out, err = run("--only", ONE)
    assert (status, err) == (0, "")
    assert f"{ONE}: confirmed (proved)" in out
    assert f"run: python -m cap.audit --only {ONE} --fresh" in out
    assert "The findings" not in out
    assert labels.stored().sha256 in out


def test_data(run):
    """The paper, the program, and a list of objects with the keys that were asked for."""
    status, out, _ = run("--section", "def:Phi", "--format", "json", "--recorded")
    everything = json.loads(out)
    objects = everything["claims"]
    assert status == 0
    assert everything["paper"]["sha256"] == labels.stored().sha256
    assert everything["program"].startswith("cap ")
    assert {each["section"] for each in objects} == {"2"}
    for each in objects:
        assert list(each)[: len(KEYS)] == KEYS
        assert "certificate" in each
        assert each["verdict"] in [str(outcome) for outcome in Outcome]


def test_one_verdict(run):
    """Only claims with it are shown; the others are decided all the same."""
    status, out, _ = run("--only", "inclusion", "--verdict", "vacuous", "--format", "json")
    assert status == 0
    found = json.loads(out)["claims"]
    assert [each["id"] for each in found] == ["inclusion.sticking-to-a-wall"]


def test_a_verdict_that_changed(run, monkeypatch):
    """Status 1, and what changed, on standard error."""
    known = recorded.recorded()
    changed = known | {ONE: replace(known[ONE], outcome=Outcome.REFUTED)}
    monkeypatch.setattr(recorded, "recorded", lambda: changed)
    status, _, err = run("--only", ONE)
    assert status == 1
    assert err == f"changed: {ONE}: recorded refuted, now confirmed\n"


def test_a_claim_that_cannot_be_decided(run, monkeypatch):
    """Status 1; the report shows it as undecided."""
    claim = ledger.claims()[ONE]

    def fail():
        raise ArithmeticError("broken")

    monkeypatch.setitem(ledger.claims(), ONE, replace(claim, decide=fail))
    status, out, err = run("--only", ONE, "--fresh")
    assert status == 1
    assert f"{ONE}: undecided" in out
    assert "could not be decided: ArithmeticError: broken" in err


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("--only", "roots.value-of-f"), "no claim 'roots.value-of-f': did you mean "),
        (("--section", "0.5"), "no section '0.5'"),
        (("--verdict", "wrong"), "invalid choice: 'wrong' (choose from "),
        (("--patch", "none.tex"), "cannot read none.tex: No such file or directory\n"),
        (("--paper", "none.tex"), "cannot read none.tex: No such file or directory\n"),
        (("--format", "word"), "invalid choice"),
        (
            ("--of", "church_fortins"),
            "no paper 'church_fortins' is audited: did you mean ",
        ),
        (("else",), "unrecognized arguments"),
        (("--recorded", "--record"), "--recorded does not go with --record"),
        (("--recorded", "--fresh"), "--recorded does not go with --fresh"),
        (("--summary", "--record"), "--summary does not go with --record"),
        (("--erratum", "--section", "4"), "--erratum does not go with --section"),
        (("--patch", "a.tex", "--paper", "b.tex"), "--paper does not go with --patch"),
        (("--paper", "a.tex", "--only", "roots"), "--paper does not go with --only"),
    ],
)
def test_requests_that_make_no_sense(run, words, complaint):
    """One line on standard error, and status 2."""
    status, out, err = run(*words)
    assert (status, out) == (2, "")
    assert complaint in err
    assert err.count("\n") == 1


def test_coverage(run):
    """All places, one to a line; status 0 as none is forgotten."""
    status, out, _ = run("--coverage")
    assert status == 0
    assert len(out.splitlines()) == len(labels.stored().places) + 2
    assert "none: definition of the system" in out


def test_coverage_fails(run, monkeypatch):
    """Status 1 if a place is forgotten."""
    monkeypatch.setattr("cap.audit.coverage.reasons", dict)
    status, out, _ = run("--coverage")
    assert status == 1
    assert "WRONG: eq:model is forgotten" in out


@pytest.mark.slow
def test_the_paper(run, tmp_path, monkeypatch, elsewhere):
    """Another file has other places: status 1; with --record they are stored."""
    path, claim = tmp_path / "paper.tex", replace(ledger.claims()[ONE], where="sec:intro")
    path.write_text(r"\section{One}\label{sec:intro}")
    assert run("--paper", str(path)) == (
        *(2, "", "error: this is another text: no sentence of the paper is in it\n"),
    )
    usual = subject.file("labels.json").read_text("utf-8")
    elsewhere("labels.json").write_text(usual)
    monkeypatch.setattr("cap.audit.ledger.claims", lambda: {ONE: claim})
    status, _, err = run("--paper", str(path), "--record")
    assert (status, err.startswith("error: not once in ")) == (2, True)
    path.write_text(f"\\section{{One}}\\label{{sec:intro}} {claim.quote}")
    assert run("--paper", str(path))[0] == 1
    monkeypatch.setattr("cap.audit.errata.changes", tuple)
    assert run("--paper", str(path), "--record")[0] == 0
    labels.stored.cache_clear()
    status, out, _ = run("--paper", str(path))
    assert status == 0
    assert out.startswith("the stored places are those of this file\n")


@pytest.mark.parametrize("word", ["--summary", "--erratum", "--bibtex"])
def test_what_is_written_without_deciding(run, monkeypatch, word):
    """Of the recorded verdicts, with the digest of the paper."""
    monkeypatch.setattr(command, "all_decided", None)
    status, out, err = run(word)
    assert (status, err) == (0, "")
    assert labels.stored().sha256 in out


def test_recorded_verdicts_are_shown(run, monkeypatch):
    """Without deciding; a whole page in a second."""
    monkeypatch.setattr(command, "all_decided", None)
    status, out, _ = run("--recorded", "--format", "json")
    assert status == 0
    assert len(json.loads(out)["findings"]) > 50


def test_the_summary_is_one_page(run):
    """Lines of a terminal on a sheet of paper: what stands, what falls, the ten, where to go on."""
    _, out, _ = run("--summary")
    lines = out.splitlines()
    assert len(lines) <= 60
    assert max(map(len, lines)) <= 100
    for words in ("Stand when changed: ", "Fall: ", "10. ", "--erratum"):
        assert words in out


def test_an_interrupt(run, monkeypatch):
    """Status 130, and a line."""

    def interrupted(*_words, **_options):
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "all_decided", interrupted)
    status, out, err = run("--only", ONE)
    assert (status, out) == (130, "")
    assert err.startswith("interrupted")
