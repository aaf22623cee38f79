"""The formats of the report: one template for each, in ``templates/``.

In a template ``{{ words | e }}`` are words that the format shows as they are, and between
``{% filter wrapped %}`` and ``{% endfilter %}`` stands a paragraph of a terminal.  Those of LaTeX
have ``<<`` and ``<%`` in the place of these braces.  The paragraphs of ``front.txt`` are in each:
the title, two lines that say what this is, and an introduction.
"""

import html
import json
import re
import textwrap
from collections.abc import Callable, Container
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from cap.audit import errata, labels, recorded
from cap.audit.report import latex
from cap.audit.report.view import Report

FORMATS = {
    "text": "audit.txt",
    "markdown": "audit.md",
    "html": "audit.html",
    "json": "audit.json",
    "latex": "audit.tex",
}
WIDTH = 100  # of a terminal
_TEX: dict[str, Any] = {
    "block_start_string": "<%",
    "block_end_string": "%>",
    "variable_start_string": "<<",
    "variable_end_string": ">>",
    "comment_start_string": "<#",
    "comment_end_string": "#>",
}
_MARKDOWN = re.compile(r"([\\`*_|<>\[\]~])")
_ID = re.compile(r"\b[a-z]+(?:-[a-z0-9]+)*\.[a-z0-9]+(?:-[a-z0-9]+)*\b")


def written(template: str, report: Report) -> str:
    """Return what a template makes of a report: an ``audit``, an ``erratum``, a ``summary``."""
    kind = template.rpartition(".")[2]
    plain = Environment(
        loader=PackageLoader(__package__),
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
        autoescape=False,  # noqa: S701 (each format escapes in its own way)
    )
    plain.filters |= {
        "json": lambda each: json.dumps(each.data(), ensure_ascii=False, indent=1),
        "e": _ESCAPED.get(kind, str),
        "wrapped": wrapped,
        "code": code,
        "joined": joined,
        "linked": linked,
        "typed": latex.typed,
        "breakable": latex.breakable,
    }
    day, program = recorded.made()
    about = {"paper": labels.stored(), "day": day, "program": program}
    title, paper, audit, *introduction = (
        plain.get_template("front.txt").render(about).strip().split("\n\n")
    )
    own = plain.overlay(**_TEX) if kind in ("tex", "bib") else plain
    return own.get_template(template).render(
        **about,
        title=title,
        identity=[paper, audit],
        introduction=introduction,
        report=report,
        changes=errata.changes(),
    )


def wrapped(text: str, first: str = "", rest: str = "") -> str:
    """Return a paragraph as lines of a terminal."""
    lines = textwrap.TextWrapper(
        WIDTH, first, rest, break_long_words=False, break_on_hyphens=False
    ).wrap(text)
    return "".join(f"{line}\n" for line in lines)


def escaped(text: str) -> str:
    """Return text that Markdown shows as it is."""
    return _MARKDOWN.sub(r"\\\1", text)


def code(text: str) -> str:
    """Return text as code of Markdown, on one line, between as many grave accents as it needs."""
    line = " ".join(text.split())
    longest = max((len(each) for each in re.findall("`+", line)), default=0)
    fence = "`" * (longest + 1)
    return f"{fence} {line} {fence}" if longest else f"{fence}{line}{fence}"


def joined(text: str) -> str:
    """Return a piece of HTML without its breaks of lines beside tags."""
    return re.sub(r"(?<=>)\n|\n(?= ?<)", "", text) + "\n"


def linked(text: str, known: Container[str]) -> str:
    """Return HTML in which the ids of claims that are known lead to them."""

    def link(name: re.Match[str]) -> str:
        return f'<a href="#{name[0]}">{name[0]}</a>' if name[0] in known else name[0]

    return _ID.sub(link, text)


_ESCAPED: dict[str, Callable[[Any], str]] = {
    "md": escaped,
    "html": html.escape,
    "tex": latex.escaped,
}
