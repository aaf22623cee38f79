"""The report in Markdown, as it is stored in ``docs/audit.md``."""

import re

from cap.audit.report.view import INTRODUCTION, TITLE, Entry, Report, consequence

_SPECIAL = re.compile(r"([\\`*_|<>\[\]~])")


def markdown(report: Report) -> str:
    """Return the report in Markdown; its links are relative to ``docs``."""
    lines: list[str] = []
    if report.whole:
        lines += [f"# {TITLE}", "", "Written by `python -m cap.audit --format markdown`.", ""]
        for paragraph in INTRODUCTION:
            lines += [escaped(paragraph), ""]
        lines += [*_counts(report), *_findings(report), *_statements(report)]
    for number, title, entries in report.sections():
        lines += [f"## {escaped(title if number == '0' else f'{number}. {title}')}", ""]
        for entry in entries:
            lines += _entry(entry)
    return "\n".join(lines).rstrip() + "\n"


def escaped(text: str) -> str:
    """Return text that Markdown shows as it is."""
    return _SPECIAL.sub(r"\\\1", text)


def _counts(report: Report) -> list[str]:
    heads = [str(each) for each in report.outcomes()]
    lines = ["## Summary", "", f"| section | {' | '.join(heads)} |"]
    lines.append("|---|" + "---|" * len(heads))
    for name, row in report.counts():
        lines.append(f"| {escaped(name)} | {' | '.join(map(str, row))} |")
    return [*lines, ""]


def _findings(report: Report) -> list[str]:
    lines = ["## The ten that matter most", ""]
    for count, (finding, entry) in enumerate(report.findings(), 1):
        link = f"[`{entry.claim.id}`](#{_anchor(entry)})"
        words = escaped(consequence(finding, entry))
        lines.append(f"{count}. {link}, **{entry.verdict.outcome}**. {words}")
    return [*lines, ""]


def _statements(report: Report) -> list[str]:
    lines = ["## The statements, and what may be cited instead", ""]
    lines += ["| statement of the paper | status | what may be cited instead |", "|---|---|---|"]
    for statement, status in report.statements():
        lines.append(f"| {escaped(statement.name)} | {status} | {escaped(statement.instead)} |")
    return [*lines, ""]


def _anchor(entry: Entry) -> str:
    return entry.claim.id.replace(".", "")


def _entry(entry: Entry) -> list[str]:
    claim, verdict = entry.claim, entry.verdict
    place = f"*{escaped(entry.place)}, {claim.kind}.*"
    lines = [f"### `{claim.id}`", "", f"{place} {escaped(claim.says)}", ""]
    lines.append(f"- **{verdict.outcome}**, {verdict.strength}")
    if claim.stated:
        lines.append(f"- stated: {escaped(claim.stated)}")
    lines += [f"- found: {escaped(verdict.found)}", f"- evidence: {escaped(verdict.evidence)}"]
    if verdict.proof:
        path = f"proofs/audit/{verdict.proof}"
        lines.append(f"- proof: [{escaped(path)}](../{path})")
    if verdict.certificate:
        path = f"certificates/{verdict.certificate}"
        lines.append(f"- certificate: [{escaped(path)}](../{path})")
    return [*lines, f"- run: {', '.join(f'`{command}`' for command in entry.commands)}", ""]
