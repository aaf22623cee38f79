"""The report as one page of HTML, with its style and its search inside: nothing is fetched."""

import re
from html import escape
from pathlib import Path

from cap.audit.report.view import INTRODUCTION, Entry, Found, Report, identity, title

STYLE, SCRIPT = (Path(__file__).with_name(name) for name in ("page.css", "page.js"))
_NAME = re.compile(r"\b[a-z]+(?:-[a-z0-9]+)*\.[a-z0-9]+(?:-[a-z0-9]+)*\b")


def page(report: Report) -> str:
    """Return the report as a page."""
    style, script = (path.read_text(encoding="utf-8") for path in (STYLE, SCRIPT))
    parts = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(title())}</title><style>{style}</style></head><body>",
        f"<h1>{escape(title())}</h1>",
        *(f'<p class="identity">{escape(line)}</p>' for line in identity()),
    ]
    if report.whole:
        parts += [f"<p>{escape(paragraph)}</p>" for paragraph in INTRODUCTION]
        parts += [_counts(report), _findings(report), _statements(report)]
    parts += ["<h2>The claims</h2>", _search(report)]
    parts.append(
        '<p class="printed">Each is decided again by <code>python -m cap.audit --only ID '
        "--fresh</code>.</p>"
    )
    for section in report.sections():
        articles = "".join(_entry(entry, report) for entry in section.entries)
        head = f"<h2>{escape(section.heading)}</h2>"
        parts.append(f'<section class="claims">{head}{articles}</section>')
    return "\n".join([*parts, f"<script>{script}</script></body></html>", ""])


def _search(report: Report) -> str:
    boxes = "".join(
        f'<label><input type="checkbox" value="{each}" checked> {each}</label>'
        for each in report.outcomes()
    )
    field = '<input type="search" placeholder="Search the claims" aria-label="Search the claims">'
    return f'<nav>{field}{boxes}<span id="shown"></span></nav>'


def _table(head: str, rows: str, kind: str = "") -> str:
    """Return a table that scrolls by itself where the page is narrow."""
    return f'<div class="wide"><table class="{kind}">{head}{rows}</table></div>'


def _counts(report: Report) -> str:
    heads = "".join(f"<th>{each}</th>" for each in report.outcomes())
    rows = "".join(
        f"<tr><td>{escape(name)}</td>{''.join(f'<td>{count}</td>' for count in row)}</tr>"
        for name, row in report.counts()
    )
    return f"<h2>Summary</h2>{_table(f'<tr><th></th>{heads}</tr>', rows, 'counts')}"


def _findings(report: Report) -> str:
    items = "".join(map(_finding, report.findings()))
    return f"<h2>The findings</h2><p>The ten first matter most.</p><ol>{items}</ol>"


def _finding(found: Found) -> str:
    finding = found.finding
    links = " ".join(map(_link, found.entries))
    return (
        f"<li><b>{escape(finding.title)}</b> {_badge(found.core)} "
        f'<span class="place">{finding.severity}</span> {escape(found.words)} '
        f"<i>To change:</i> {escape(finding.change)} "
        f'<span class="place">{escape(found.where)}</span> '
        f"<details><summary>{len(found.entries)} claims</summary>{links}</details></li>"
    )


def _statements(report: Report) -> str:
    rows = "".join(
        f"<tr><td>{escape(statement.name)}</td><td>{escape(status)}</td>"
        f"<td>{escape(statement.instead)}</td></tr>"
        for statement, status in report.statements()
    )
    heads = (
        "<tr><th>statement of the paper</th><th>status</th><th>what may be cited instead</th></tr>"
    )
    return f"<h2>The statements, and what may be cited instead</h2>{_table(heads, rows)}"


def _link(entry: Entry) -> str:
    return f'<a class="id" href="#{entry.claim.id}">{entry.claim.id}</a>'


def _kind(entry: Entry) -> str:
    return str(entry.verdict.outcome).replace(" ", "-")


def _badge(entry: Entry) -> str:
    return f'<span class="badge {_kind(entry)}">{entry.verdict.outcome}</span>'


def _linked(text: str, report: Report) -> str:
    """Return text in which the names of other claims lead to them."""

    def link(name: re.Match[str]) -> str:
        return f'<a href="#{name[0]}">{name[0]}</a>' if name[0] in report.by_id else name[0]

    return _NAME.sub(link, escape(text))


def _entry(entry: Entry, report: Report) -> str:
    claim, verdict = entry.claim, entry.verdict
    parts = entry.parts()
    parts.pop("certificate", None)  # a command names it
    for name, words in parts.items():
        linked = name in {"found", "evidence"}
        parts[name] = _linked(words, report) if linked else escape(words)
        if name in {"text", "proof"}:
            parts[name] = f"<code>{parts[name]}</code>"
    parts["run"] = "<br>".join(f"<code>{escape(each)}</code>" for each in entry.commands)
    listed = "".join(
        f'<dt class="{name}">{name}</dt><dd class="{name}">{words}</dd>'
        for name, words in parts.items()
    )
    return (
        f'<article id="{claim.id}" class="{_kind(entry)}" data-verdict="{verdict.outcome}">'
        f'<div class="head">{_link(entry)} {_badge(entry)} <span class="place">{verdict.strength}; '
        f"{escape(entry.where)}</span></div>"
        f"<p>{escape(claim.says)}</p><dl>{listed}</dl></article>"
    )
