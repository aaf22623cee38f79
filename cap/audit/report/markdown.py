"""The report in Markdown, as it is stored in ``docs/audit.md``."""

import re

from cap.audit.report.view import INTRODUCTION, Entry, Report, identity, title

_SPECIAL = re.compile(r"([\\`*_|<>\[\]~])")


def markdown(report: Report) -> str:
    """Return the report in Markdown; its links are relative to ``docs``."""
    lines = [f"# {escaped(title())}", "", *(f"{escaped(each)}\n" for each in identity())]
    if report.whole:
        lines += ["Written by `python -m cap.audit --format markdown`.", ""]
        for paragraph in INTRODUCTION:
            lines += [escaped(paragraph), ""]
        lines += [*_counts(report), *_findings(report), *_statements(report)]
    for section in report.sections():
        lines += [f"## {escaped(section.heading)}", ""]
        for entry in section.entries:
            lines += _entry(entry)
    return "\n".join(lines).rstrip() + "\n"


def escaped(text: str) -> str:
    """Return text that Markdown shows as it is."""
    return _SPECIAL.sub(r"\\\1", text)


def code(text: str) -> str:
    """Return text as code, between as many grave accents as it needs."""
    longest = max((len(each) for each in re.findall("`+", text)), default=0)
    fence = "`" * (longest + 1)
    inner = f" {text} " if longest else text
    return f"{fence}{inner}{fence}"


def _counts(report: Report) -> list[str]:
    heads = [str(each) for each in report.outcomes()]
    lines = ["## Summary", "", f"| section | {' | '.join(heads)} |"]
    lines.append("|---|" + "---|" * len(heads))
    for name, row in report.counts():
        lines.append(f"| {escaped(name)} | {' | '.join(map(str, row))} |")
    return [*lines, ""]


def _findings(report: Report) -> list[str]:
    lines = ["## The findings", "", "The ten first matter most.", ""]
    for count, found in enumerate(report.findings(), 1):
        links = ", ".join(f"[`{e.claim.id}`](#{_anchor(e)})" for e in found.entries)
        finding = found.finding
        lines.append(
            f"{count}. **{escaped(finding.title)}** ({finding.severity}). {escaped(found.words)} "
            f"*To change:* {escaped(finding.change)} {escaped(found.where)}; {links}."
        )
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
    lines = [f"### `{claim.id}`", "", f"*{escaped(entry.where)}.* {escaped(claim.says)}", ""]
    lines.append(f"- **{verdict.outcome}**, {verdict.strength}")
    written = {"text": code, "proof": _file, "certificate": _file}
    lines += [f"- {k}: {written.get(k, escaped)(words)}" for k, words in entry.parts().items()]
    return [*lines, f"- run: {', '.join(f'`{command}`' for command in entry.commands)}", ""]


def _file(path: str) -> str:
    return f"[{escaped(path)}](../{path})"
