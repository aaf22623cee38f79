"""``python -m cap.audit``: a referee's report that can be run."""

import argparse
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from cap.audit import coverage, errata, labels, ledger, recorded, revision, subject
from cap.audit.decide import all_decided
from cap.audit.manuscript import Manuscript
from cap.audit.means import stored
from cap.audit.papers import FIRST
from cap.audit.report.formats import FORMATS, written
from cap.audit.report.view import Report
from cap.audit.verdict import Outcome, Verdict
from cap.command.console import Parser, add_jobs, program
from cap.command.entry import INTERRUPTED
from cap.errors import BadInput
from cap.words import printable, say

DOCUMENTS = {"summary": "summary.txt", "erratum": "erratum.md", "bibtex": "citation.bib"}
WHOLE = {"coverage", "patch", "paper", *DOCUMENTS}  # what is said of the whole paper
_APART = {"recorded": {"record", "fresh"}, "paper": set[str]()}
_APART |= {each: {"record"} for each in WHOLE - {"paper"}}
_APART |= {each: _APART[each] | WHOLE - {each} | {"only", "section", "verdict"} for each in WHOLE}


def parser() -> argparse.ArgumentParser:
    """Return the command line."""
    p = Parser(
        prog=program("cap.audit"),
        description="Decide the claims of the paper, and report. Exit status 0: every claim was "
        "decided as recorded; 1: something changed; 2: the request makes no sense.",
        epilog="Examples: python -m cap.audit --summary; python -m cap.audit --only "
        "saltation.wall-entry; python -m cap.audit --verdict refuted --section 4; python -m "
        "cap.audit --recorded --format html > audit.html; python -m cap.audit --patch paper.tex",
    )
    add, flag = p.add_argument, partial(p.add_argument, action="store_true")
    file = partial(p.add_argument, type=Path, metavar="FILE.tex")
    papers = " or ".join(subject.names())
    words = f"the paper that is audited: {papers} (default: the first)"
    add("--of", metavar="NAME", default=FIRST, help=words)
    words = "a claim, or a group: what is before the point (--format json lists the ids)"
    add("--only", metavar="ID", help=words)
    words = "one section or subsection: its number or label, or any label in a section"
    add("--section", metavar="S", help=words)
    outcomes, words = list(map(str, Outcome)), "claims with this verdict: refuted, open, ..."
    add("--verdict", metavar="V", choices=outcomes, help=words)
    add("--format", choices=FORMATS, default="text", help="default: text")
    add_jobs(p)
    flag("--fresh", help="decide again what the cache knows")
    words = "list the places of the paper with the claims taken from each; status 1 if one is "
    flag("--coverage", help=f"{words}forgotten")
    flag("--recorded", help="report the recorded verdicts: decide nothing")
    flag("--summary", help="the recorded verdicts on one page")
    flag("--erratum", help="what the text has and should have, by section")
    flag("--bibtex", help="entries for the paper and the audit")
    file(
        "--patch",
        help="the erratum as a patch of the paper's TeX file, for git apply; what the file has "
        "already is said; status 1 if a change does not fit",
    )
    file(
        "--paper",
        help="say which sentences are others in this version of the paper's TeX file, and which "
        "are corrected; with --record, store its places and lines",
    )
    flag("--record", help="record the verdicts: later runs are compared with them")
    return p


def main(words: Sequence[str]) -> int:
    """Run the command line; bad input and interrupts become a line and an exit status."""
    options = parser().parse_args(words)
    try:
        subject.choose(options.of)
        _together(options)
        return _done(options)
    except BadInput as error:
        _progress("")
        say(f"error: {printable(str(error))}", sys.stderr)
        return 2
    except KeyboardInterrupt:
        _progress("")
        say("interrupted; what was decided is in the cache", sys.stderr)
        return INTERRUPTED


def _together(options: argparse.Namespace) -> None:
    """Raise `BadInput` if one option would be ignored for another."""
    asked = {name for name, value in vars(options).items() if value not in (None, False)}
    for name in sorted(asked & _APART.keys()):
        if others := sorted(asked & _APART[name]):
            raise BadInput(f"--{name} does not go with --{others[0]}")


def _done(options: argparse.Namespace) -> int:
    """Do what is asked for."""
    if options.paper is not None:
        return _paper(options.paper, options.record)
    if not labels.stored().places:
        raise BadInput("the places of the paper are not stored yet: --paper FILE.tex --record")
    if options.patch is not None:
        return _patch(options.patch)
    if options.coverage:
        print("\n".join(coverage.lines()))
        return 1 if any(coverage.wrong()) else 0
    return _audit(options)


def _paper(path: Path, record: bool) -> int:
    """Compare the paper with another version of its TeX file, or store the places of this one."""
    lines = revision.compared(path)
    if record:
        subject.store("labels.json", labels.dumps(revision.fitted(path)))
        print(f"{subject.file('labels.json')}: written ({len(lines)} differences)")
        return 0
    seen = revision.told(Manuscript.read(path))
    print("\n".join([*(lines or ["the stored places are those of this file"]), *seen]))
    return 1 if lines else 0


def _patch(path: Path) -> int:
    """Print the erratum as a patch; say what the file has already, and what does not fit."""
    text, done, others = errata.patch(path)
    print(text, end="")
    if done:
        say(f"corrected already: {', '.join(done)}", sys.stderr)
    for each in others:
        say(each, sys.stderr)
    return 1 if others else 0


def _audit(options: argparse.Namespace) -> int:
    """Decide, report, and compare with what is recorded."""
    claims = ledger.chosen(options.only, options.section)
    places = {place.label for place in labels.stored().places}
    if lost := [each for each in claims if each.where not in places]:
        raise BadInput(f"claim {lost[0].id} is taken from {lost[0].where!r}, which is no place")
    asked = [template for name, template in DOCUMENTS.items() if vars(options)[name]]
    if options.recorded or asked:
        verdicts = recorded.known(each.id for each in claims)
    else:
        verdicts = all_decided(claims, _progress, jobs=options.jobs, fresh=options.fresh)
    _progress("")
    if options.record:
        return _record(verdicts)
    shown = {k: each for k, each in verdicts.items() if options.verdict in (None, each.outcome)}
    if not shown:
        say(f"no claim that was asked for is {options.verdict}", sys.stderr)
    (template,) = asked or [FORMATS[options.format]]
    print(written(template, Report(shown)), end="")
    changed = recorded.changes(verdicts, whole=len(claims) == len(ledger.claims()))
    for line in changed:
        say(f"changed: {line}", sys.stderr)
    return 1 if changed else 0


def _record(verdicts: dict[str, Verdict]) -> int:
    """Record verdicts, if all are decided."""
    undecided = [k for k, each in verdicts.items() if each.outcome is Outcome.UNDECIDED]
    for name in undecided:
        say(f"undecided: {name}: {verdicts[name].evidence}", sys.stderr)
    if undecided:
        return 1
    changed = recorded.changes(verdicts, whole=False)
    recorded.write(verdicts)
    stored.accept()
    print(*changed, f"{subject.file('recorded.json')}: {len(verdicts)} verdicts written", sep="\n")
    return 0


def _progress(words: str) -> None:
    """Show how far the work is, on one line of a terminal; no words clear it."""
    if sys.stderr is not None and sys.stderr.isatty():
        print(f"\r{words:<90.90}", end="\r", file=sys.stderr, flush=True)
