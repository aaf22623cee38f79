"""The report as one page of HTML, with its style and its search inside: nothing is fetched."""

from html import escape
from pathlib import Path

from cap.audit.report.view import INTRODUCTION, TITLE, Entry, Report, consequence

STYLE, SCRIPT = (Path(__file__).with_name(name) for name in ("page.css", "page.js"))


def page(report: Report) -> str:
    """Return the report as a page."""
    style, script = (path.read_text(encoding="utf-8") for path in (STYLE, SCRIPT))
    parts = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(TITLE)}</title><style>{style}</style></head><body>",
        f"<h1>{escape(TITLE)}</h1>",
        *(f"<p>{escape(paragraph)}</p>" for paragraph in INTRODUCTION),
    ]
    if report.whole:
        parts += [_counts(report), _findings(report), _statements(report)]
    parts += ["<h2>The claims</h2>", _search(report)]
    for number, title, entries in report.sections():
        heading = title if number == "0" else f"{number}. {title}"
        articles = "".join(map(_entry, entries))
        parts.append(f'<section class="claims"><h2>{escape(heading)}</h2>{articles}</section>')
    return "\n".join([*parts, f"<script>{script}</script></body></html>", ""])


def _search(report: Report) -> str:
    boxes = "".join(
        f'<label><input type="checkbox" value="{each}" checked> {each}</label>'
        for each in report.outcomes()
    )
    field = '<input type="search" placeholder="Search the claims" aria-label="Search the claims">'
    return f'<nav>{field}{boxes}<span id="shown"></span></nav>'


def _counts(report: Report) -> str:
    heads = "".join(f"<th>{each}</th>" for each in report.outcomes())
    rows = "".join(
        f"<tr><td>{escape(name)}</td>{''.join(f'<td>{count}</td>' for count in row)}</tr>"
        for name, row in report.counts()
    )
    return f'<h2>Summary</h2><table class="counts"><tr><th></th>{heads}</tr>{rows}</table>'


def _findings(report: Report) -> str:
    items = "".join(
        f"<li>{_link(entry)} {_badge(entry)} {escape(consequence(finding, entry))}</li>"
        for finding, entry in report.findings()
    )
    return f"<h2>The ten that matter most</h2><ol>{items}</ol>"


def _statements(report: Report) -> str:
    rows = "".join(
        f"<tr><td>{escape(statement.name)}</td><td>{escape(status)}</td>"
        f"<td>{escape(statement.instead)}</td></tr>"
        for statement, status in report.statements()
    )
    heads = (
        "<tr><th>statement of the paper</th><th>status</th><th>what may be cited instead</th></tr>"
    )
    return f"<h2>The statements, and what may be cited instead</h2><table>{heads}{rows}</table>"


def _link(entry: Entry) -> str:
    return f'<a class="id" href="#{entry.claim.id}">{entry.claim.id}</a>'


def _kind(entry: Entry) -> str:
    return str(entry.verdict.outcome).replace(" ", "-")


def _badge(entry: Entry) -> str:
    return f'<span class="badge {_kind(entry)}">{entry.verdict.outcome}</span>'


def _entry(entry: Entry) -> str:
    claim, verdict = entry.claim, entry.verdict
    rows = [
        ("stated", escape(claim.stated)),
        ("found", escape(verdict.found)),
        ("evidence", escape(verdict.evidence)),
        ("proof", verdict.proof and f"<code>proofs/audit/{escape(verdict.proof)}</code>"),
        ("run", "<br>".join(f"<code>{escape(each)}</code>" for each in entry.commands)),
    ]
    listed = "".join(f"<dt>{name}</dt><dd>{words}</dd>" for name, words in rows if words)
    return (
        f'<article id="{claim.id}" class="{_kind(entry)}" data-verdict="{verdict.outcome}">'
        f'<div class="head">{_link(entry)} {_badge(entry)} <span class="place">{verdict.strength}; '
        f"{escape(entry.place)}, {claim.kind}</span></div>"
        f"<p>{escape(claim.says)}</p><dl>{listed}</dl></article>"
    )
