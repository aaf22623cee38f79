"""The report for a terminal, and as data."""

import json
import textwrap

from cap.audit import labels, recorded
from cap.audit.report.view import INTRODUCTION, Entry, Found, Report, identity, title

WIDTH = 100


def plain(report: Report) -> str:
    """Return the report as plain text."""
    lines = [*wrapped(title()), "", *(line for each in identity() for line in wrapped(each)), ""]
    if report.whole:
        for paragraph in INTRODUCTION:
            lines += [*wrapped(paragraph), ""]
        lines += [*_counts(report), "", *_findings(report), *_statements(report)]
    for section in report.sections():
        heading = f"{'Section ' if section.number != '0' else ''}{section.heading}"
        lines += [heading, "-" * len(heading), ""]
        for entry in section.entries:
            lines += [*_entry(entry), ""]
    return "\n".join(lines)


def wrapped(text: str, first: str = "", rest: str = "") -> list[str]:
    """Return a paragraph as lines of a terminal."""
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=first,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _counts(report: Report) -> list[str]:
    """Return a table with the verdicts as columns, their names above one another."""
    outcomes = [str(each) for each in report.outcomes()]
    lines = ["|   " * k + name for k, name in enumerate(outcomes)]
    for name, row in report.counts():
        cells = "".join(f"{count:<4}" for count in row)
        lines += wrapped(cells + name, rest=" " * len(cells))
    return lines


def _findings(report: Report) -> list[str]:
    lines = [f"The findings, {len(report.findings())}; those that matter most first", ""]
    for count, found in enumerate(report.findings(), 1):
        head = f"{count:>2}. {found.finding.title} [{found.finding.severity}]. {found.words} "
        lines += [*wrapped(head + f"To change: {found.finding.change}", rest="    ")]
        names = ", ".join(entry.claim.id for entry in found.entries)
        lines += [*wrapped(f"{found.where}; {names}", "    ", "    "), ""]
    return lines


def _statements(report: Report) -> list[str]:
    lines = ["What became of the statements, and what may be cited instead", ""]
    for statement, status in report.statements():
        lines += wrapped(f"{statement.name}: {status}. {statement.instead}", rest="    ")
    return [*lines, ""]


def _entry(entry: Entry) -> list[str]:
    claim, verdict = entry.claim, entry.verdict
    lines = wrapped(f"{claim.id}: {verdict.outcome} ({verdict.strength})", rest="    ")
    parts = [(entry.where, claim.says), *entry.parts().items()]
    parts += [("run", command) for command in entry.commands]
    for name, words in parts:
        if name != "certificate":  # a command names it
            lines += wrapped(f"{name}: {words}", "    ", "        ")
    return lines


def data(report: Report) -> str:
    """Return the claims, the findings, and what they are about, as JSON."""
    paper, (day, program) = labels.stored(), recorded.made()
    everything = {
        "paper": {name: getattr(paper, name) for name in ("title", "author", "sha256")},
        "program": program,
        "recorded": day,
        "claims": [_claim(each) for each in report.entries],
        "findings": [_found(each) for each in report.findings()] if report.whole else [],
    }
    return json.dumps(everything, ensure_ascii=False, indent=1)


def _claim(entry: Entry) -> dict[str, object]:
    claim, verdict = entry.claim, entry.verdict
    return {
        "id": claim.id,
        "where": claim.where,
        "claim": claim.says,
        "stated": claim.stated,
        "found": verdict.found,
        "verdict": str(verdict.outcome),
        "strength": str(verdict.strength),
        "evidence": verdict.evidence,
        "command": " && ".join(entry.commands),
        "certificate": verdict.certificate,
        "proof": entry.proof,
        "kind": str(claim.kind),
        "section": entry.section,
        "place": entry.place,
        "line": entry.line,
        "quote": entry.quote,
    }


def _found(found: Found) -> dict[str, object]:
    return {
        "title": found.finding.title,
        "severity": str(found.finding.severity),
        "says": found.words,
        "change": found.finding.change,
        "claims": [entry.claim.id for entry in found.entries],
        "lines": found.lines,
    }
