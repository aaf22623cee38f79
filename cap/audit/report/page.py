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
    ids = {entry.claim.id for entry in report.entries}
    for number, name, entries in report.sections():
        heading = name if number == "0" else f"{number}. {name}"
        articles = "".join(_entry(entry, ids) for entry in entries)
        parts.append(f'<section class="claims"><h2>{escape(heading)}</h2>{articles}</section>')
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
    finding, lines = found.finding, ", ".join(map(str, found.lines))
    links = " ".join(map(_link, found.entries))
    return (
        f"<li><b>{escape(finding.title)}</b> {_badge(found.core)} "
        f'<span class="place">{finding.severity}</span> {escape(found.words)} '
        f"<i>To change:</i> {escape(finding.change)} "
        f'<span class="place">{escape(found.core.place)}; lines {lines}</span> '
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


def _linked(text: str, ids: set[str]) -> str:
    """Return text in which the names of other claims lead to them."""

    def link(name: re.Match[str]) -> str:
        return f'<a href="#{name[0]}">{name[0]}</a>' if name[0] in ids else name[0]

    return _NAME.sub(link, escape(text))


def _entry(entry: Entry, ids: set[str]) -> str:
    claim, verdict = entry.claim, entry.verdict
    rows = [
        ("text", entry.quote and f"<code>{escape(entry.quote)}</code>"),
        ("stated", escape(claim.stated)),
        ("found", _linked(verdict.found, ids)),
        ("evidence", _linked(verdict.evidence, ids)),
        ("proof", verdict.proof and f"<code>proofs/audit/{escape(verdict.proof)}</code>"),
        ("run", "<br>".join(f"<code>{escape(each)}</code>" for each in entry.commands)),
    ]
    listed = "".join(
        f'<dt class="{name}">{name}</dt><dd class="{name}">{words}</dd>'
        for name, words in rows
        if words
    )
    return (
        f'<article id="{claim.id}" class="{_kind(entry)}" data-verdict="{verdict.outcome}">'
        f'<div class="head">{_link(entry)} {_badge(entry)} <span class="place">{verdict.strength}; '
        f"{escape(entry.place)}, line {entry.line}, {claim.kind}</span></div>"
        f"<p>{escape(claim.says)}</p><dl>{listed}</dl></article>"
    )
