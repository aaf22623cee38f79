"""The report for a terminal."""

import json
import textwrap

from cap.audit.report.view import INTRODUCTION, TITLE, Entry, Report, consequence

WIDTH = 100


def plain(report: Report) -> str:
    """Return the report as plain text."""
    lines: list[str] = []
    if report.whole:
        lines += [TITLE, "=" * len(TITLE), ""]
        for paragraph in INTRODUCTION:
            lines += [*_wrapped(paragraph), ""]
        lines += [*_counts(report), "", *_findings(report), *_statements(report)]
    for number, title, entries in report.sections():
        heading = title if number == "0" else f"Section {number}. {title}"
        lines += [heading, "-" * len(heading), ""]
        for entry in entries:
            lines += [*_entry(entry), ""]
    return "\n".join(lines)


def data(report: Report) -> str:
    """Return the claims as a JSON list of objects."""
    return json.dumps([entry.data() for entry in report.entries], ensure_ascii=False, indent=1)


def _wrapped(text: str, first: str = "", rest: str = "") -> list[str]:
    return textwrap.wrap(
        text, WIDTH, initial_indent=first, subsequent_indent=rest, break_long_words=False
    )


def _counts(report: Report) -> list[str]:
    outcomes = report.outcomes()
    heads = [str(each) for each in outcomes]
    rows = report.counts()
    width = max(len(name) for name, _ in rows)
    lines = [" " * width + "".join(f"  {head}" for head in heads)]
    for name, row in rows:
        cells = (f"  {count:>{len(head)}}" for head, count in zip(heads, row, strict=True))
        lines.append(name.ljust(width) + "".join(cells))
    return lines


def _findings(report: Report) -> list[str]:
    lines = ["The ten that matter most", ""]
    for count, (finding, entry) in enumerate(report.findings(), 1):
        head = f"{count:>2}. {entry.claim.id}: {entry.verdict.outcome}. "
        lines += [*_wrapped(head + consequence(finding, entry), rest="    "), ""]
    return lines


def _statements(report: Report) -> list[str]:
    lines = ["What became of the statements, and what may be cited instead", ""]
    for statement, status in report.statements():
        lines += _wrapped(f"{statement.name}: {status}. {statement.instead}", rest="    ")
    return [*lines, ""]


def _entry(entry: Entry) -> list[str]:
    claim, verdict = entry.claim, entry.verdict
    lines = [f"{claim.id}: {verdict.outcome} ({verdict.strength})"]
    parts = [
        (f"{entry.place}, {claim.kind}", claim.says),
        ("stated", claim.stated),
        ("found", verdict.found),
        ("evidence", verdict.evidence),
        ("proof", verdict.proof and f"proofs/audit/{verdict.proof}"),
        *(("run", command) for command in entry.commands),
    ]
    for name, words in parts:
        if words:
            lines += _wrapped(f"{name}: {words}", "    ", "        ")
    return lines
