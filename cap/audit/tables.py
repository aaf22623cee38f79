"""Tables as claims: files ``tables/NAME.toml`` of a paper, each row a claim that is decided singly.

``docs/own-paper.md`` has the form.  What a row asks for is found by a function, or by steps.
"""

import json
import re
from collections.abc import Callable, Mapping
from functools import cache, partial
from importlib import import_module
from typing import Any

from cap.audit import errata, subject
from cap.audit.claim import Claim, Kind, content
from cap.audit.comparison import Comparison, compared
from cap.audit.filled import filled
from cap.audit.steps import Given, Steps
from cap.audit.subject import cached
from cap.audit.verdict import Verdict
from cap.errors import NotProved
from cap.sets import interval

Found = Mapping[str, Any]
Find = Callable[[Given], Found]  # finds what a row asks for
LONGEST = 60  # end of an id
PLACES = 30  # of a number that steps define
WORDS = "ours", "why", "note"


@cached
def tables() -> dict[str, Given]:
    """Return the tables by their labels, in the order of the paper."""
    found = (subject.data(f"tables/{name}.toml") for name in subject.paper().get("tables", ()))
    return {each["label"]: each for each in found}


def claims() -> tuple[Claim, ...]:
    """Return the claims of all tables; not the rows that another claim decides."""
    elsewhere, quotes = subject.paper().get("elsewhere", {}), subject.data("quotes.toml")
    return tuple(
        _claim(table, row, quotes)
        for label, table in tables().items()
        for row in table["row"]
        if row["what"] not in elsewhere.get(label, {})
    )


def _claim(table: Given, row: Given, quotes: Mapping[str, str]) -> Claim:
    label, what = table["label"], row["what"]
    name = f"{group(label)}.{_slug(what)}"
    return Claim(
        id=name,
        where=row.get("where", label),
        kind=Kind.WORDS if "ours" in row else Kind.NUMBER,
        says=f"{what[0].upper()}{what[1:]}.",
        stated=row["paper"],
        decide=partial(_decided, name, row.get("module", table["module"]), row),
        quote=quotes.get(name, ""),
        content=content(row, errata.formulas(name)),
        table=label,
    )


def group(label: str) -> str:
    """Return what the ids of the rows of a table begin with."""
    return label.replace(":", "-").lower()


def _slug(text: str) -> str:
    """Return whole words of a text, as the end of an id."""
    words = re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")
    return words if len(words) <= LONGEST else words[: LONGEST + 1].rpartition("-")[0]


def comparisons(label: str, find: Find) -> tuple[Comparison, ...]:
    """Compare all rows of a table."""
    rows = tables()[label]["row"]
    return tuple(_by_steps(row) if "steps" in row else compared(row, find(row)) for row in rows)


def _by_steps(row: Given) -> Comparison:
    """Compare what the steps of a row define: words, or a number, which is enclosed."""
    done, found = Steps(row), {}
    if name := row.get("value"):
        found = {name: interval.outward(done.enclosed(done.names[name]), PLACES)}
    words = {key: filled(row[key], done.names, done.balls) for key in WORDS if key in row}
    return compared({**row, **words}, found)


def stated(what: str, label: str) -> str:
    """Return what the paper states in a row of a table, or raise `NotProved` if there is none."""
    found = [row["paper"] for row in tables().get(label, {"row": ()})["row"] if row["what"] == what]
    if len(found) != 1:
        raise NotProved("audit", f"the table of {label} has no row {what!r}")
    return str(found[0])


def _decided(name: str, module: str, row: Given) -> Verdict:
    Steps().as_in_the_erratum(name)
    if "steps" in row:
        return _by_steps(row).verdict
    found = _found(module, row["by"], json.dumps(row.get("with", {})))
    if isinstance(found, str):
        raise NotProved("audit", found)
    return compared(row, found).verdict


@cache
def _found(module: str, function: str, options: str) -> Found | str:
    """Find what a row asks for, once in a process; if that fails, return why."""
    try:
        finds = import_module(subject.paper()["finds"]).finds
        found: Found = finds(module, function, json.loads(options))
    except Exception as failure:  # noqa: BLE001 (what cannot be computed is no crash)
        return f"{module}.{function}: {type(failure).__name__}: {failure}"
    return found
