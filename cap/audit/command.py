"""``python -m cap.audit``: a referee's report that can be run."""

import argparse
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from cap.audit import errata, labels, ledger, recorded, revision, subject
from cap.audit.coverage import compared, coverage
from cap.audit.decide import all_decided
from cap.audit.manuscript import Manuscript
from cap.audit.means import stored
from cap.audit.papers import FIRST
from cap.audit.report.formats import FORMATS, written
from cap.audit.report.view import Report
from cap.audit.verdict import Outcome, Verdict
from cap.command.console import Parser, program
from cap.command.entry import INTERRUPTED
from cap.errors import BadInput
from cap.words import printable, say


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
    p.add_argument(
        "--of",
        metavar="NAME",
        default=FIRST,
        help=f"the paper that is audited: {' or '.join(subject.names())} (default: the first)",
    )
    p.add_argument(
        "--only",
        metavar="ID",
        help="a claim, or a group: what is before the point (--format json lists the ids)",
    )
    p.add_argument("--section", metavar="S", help="one section: its number, or any label in it")
    p.add_argument("--verdict", metavar="V", help="claims with this verdict: refuted, open, ...")
    p.add_argument("--format", choices=FORMATS, default="text", help="default: text")
    p.add_argument("--jobs", metavar="N", default="1", help="processes (default 1)")
    p.add_argument("--fresh", action="store_true", help="decide again what the cache knows")
    p.add_argument(
        "--coverage",
        action="store_true",
        help="list the places of the paper with the claims taken from each; status 1 if one is "
        "forgotten",
    )
    p.add_argument(
        "--recorded", action="store_true", help="report the recorded verdicts: decide nothing"
    )
    p.add_argument("--summary", action="store_true", help="the recorded verdicts on one page")
    p.add_argument(
        "--erratum", action="store_true", help="what the text has and should have, by section"
    )
    p.add_argument("--bibtex", action="store_true", help="entries for the paper and the audit")
    p.add_argument(
        "--patch",
        type=Path,
        metavar="FILE.tex",
        help="the erratum as a patch of the paper's TeX file, for git apply",
    )
    p.add_argument(
        "--paper",
        type=Path,
        metavar="FILE.tex",
        help="say which sentences are others in this version of the paper's TeX file, and which "
        "are corrected; with --record, store its places and lines",
    )
    p.add_argument(
        "--record",
        action="store_true",
        help="record the verdicts: later runs are compared with them",
    )
    return p


def main(words: Sequence[str]) -> int:
    """Run the command line; bad input and interrupts become a line and an exit status."""
    options = parser().parse_args(words)
    try:
        subject.choose(options.of)
        if options.paper is not None:
            return _paper(options)
        if options.coverage:
            return _coverage()
        if (text := _text(options)) is not None:
            print(text, end="")
            return 0
        return _audit(options)
    except BadInput as error:
        _progress("")
        say(f"error: {printable(str(error))}", sys.stderr)
        return 2
    except KeyboardInterrupt:
        _progress("")
        say("interrupted; what was decided is in the cache", sys.stderr)
        return INTERRUPTED


def _text(options: argparse.Namespace) -> str | None:
    """Return what is written without deciding anything, if it is asked for."""
    if options.patch is not None:
        return errata.patch(options.patch)
    if options.bibtex:
        return written("citation.bib")
    if options.summary:
        return written("summary.txt", Report(_known(ledger.claims())))
    if options.erratum:
        return written("erratum.md", Report(_known(ledger.claims())))
    return None


def _known(names: Iterable[str]) -> dict[str, Verdict]:
    """Return recorded verdicts."""
    found = recorded.recorded()
    if missing := [name for name in names if name not in found]:
        raise BadInput(f"not recorded yet: {', '.join(missing[:3])}; see --record")
    return {name: found[name] for name in names}


def _paper(options: argparse.Namespace) -> int:
    """Compare the paper with another version of its TeX file, or store the places of this one."""
    lines = compared(options.paper)
    if options.record:
        new = revision.fitted(options.paper)
        subject.store("labels.json", labels.dumps(new))
        print(f"{subject.file('labels.json')}: written ({len(lines)} differences)")
        return 0
    seen = revision.told(Manuscript.read(options.paper))
    print("\n".join([*(lines or ["the stored places are those of this file"]), *seen]))
    return 1 if lines else 0


def _coverage() -> int:
    found = coverage()
    print("\n".join(found.lines()))
    return 1 if found.wrong else 0


def _audit(options: argparse.Namespace) -> int:
    """Decide, report, and compare with what is recorded."""
    wanted = _outcome(options.verdict)
    claims = ledger.chosen(options.only, options.section)
    whole = len(claims) == len(ledger.claims())
    if options.recorded:
        verdicts = _known([each.id for each in claims])
    else:
        verdicts = all_decided(claims, _progress, jobs=_jobs(options.jobs), fresh=options.fresh)
    _progress("")
    if options.record:
        return _record(verdicts)
    shown = {name: each for name, each in verdicts.items() if wanted in (None, each.outcome)}
    if not shown:
        say(f"no claim that was asked for is {wanted}", sys.stderr)
    print(written(FORMATS[options.format], Report(shown)), end="")
    changed = recorded.changes(verdicts, whole=whole)
    for line in changed:
        say(f"changed: {line}", sys.stderr)
    return 1 if changed else 0


def _record(verdicts: dict[str, Verdict]) -> int:
    undecided = [name for name, each in verdicts.items() if each.outcome is Outcome.UNDECIDED]
    for name in undecided:
        say(f"undecided: {name}: {verdicts[name].evidence}", sys.stderr)
    if undecided:
        return 1
    changed = recorded.changes(verdicts, whole=False)
    recorded.write(verdicts)
    stored.accept()
    print(
        "\n".join([*changed, f"{subject.file('recorded.json')}: {len(verdicts)} verdicts written"])
    )
    return 0


def _outcome(text: str | None) -> Outcome | None:
    if text is None:
        return None
    try:
        return Outcome(text)
    except ValueError:
        names = ", ".join(str(each) for each in Outcome)
        raise BadInput(f"there is no verdict {text!r}: one of {names}") from None


def _jobs(text: str) -> int:
    most = 4 * (os.cpu_count() or 1)
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= most):
        raise BadInput(f"--jobs must be an integer from 1 to {most}: {text!r}")
    return int(text)


def _progress(words: str) -> None:
    """Show how far the work is, on one line of a terminal; no words clear it."""
    if sys.stderr is not None and sys.stderr.isatty():
        print(f"\r{words:<90.90}", end="\r", file=sys.stderr, flush=True)
