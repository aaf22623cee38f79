"""Claims that are data, files ``claims/GROUP.toml`` of a paper: ``docs/own-paper.md`` has the form.

A claim is decided by its steps, by a function that is called after them, or by reading.
"""

from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path

from cap.audit import errata, subject
from cap.audit.claim import Claim, Kind, content
from cap.audit.filled import filled
from cap.audit.steps import RULES, Given, Steps, Words
from cap.audit.verdict import UNDECIDABLE, Outcome, Strength, Verdict
from cap.errors import BadInput

FIELDS = "id", "where", "says", "stated", "quote", "kind"
WORDS = "verdict", "found", "evidence", "proof", "certificate"


def claims(path: Path, module: str) -> tuple[Claim, ...]:
    """Return the claims of a file; functions of a module decide those that need some."""
    data = subject.read(path)
    entries = data.get("claim", [])
    for n, entry in enumerate(entries, 1):
        if missing := [name for name in FIELDS if name not in entry]:
            raise BadInput(f"{path}: claim {entry.get('id', n)} has no {' and no '.join(missing)}")
        if entry["kind"] not in list(Kind):
            kinds = ", ".join(Kind)
            raise BadInput(f"{path}: claim {entry['id']}: the kind is none of {kinds}")
    return tuple(_claim(each, data.get("common", {}), module) for each in entries)


def _claim(entry: Given, common: Given, module: str) -> Claim:
    function = None
    if "decide" in entry:
        group, _, name = entry["decide"].rpartition(".")
        own = import_module(subject.module(f"claims.{group}") if group else module)
        function = partial(getattr(own, name), **entry.get("with", {}))
    return Claim(
        **{name: entry[name] for name in FIELDS if name != "kind"},
        kind=Kind(entry["kind"]),
        decide=partial(decided, entry, common, function),
        content=content(entry, common, errata.formulas(entry["id"])),
    )


def decided(
    entry: Given, common: Given, function: Callable[[], Words | None] | None = None
) -> Verdict:
    """Return the verdict that follows when all steps hold, and what a function asks for.

    It is what a rule says, or the words of the function, or the one that is named.
    """
    used = [subject.module(f"means.{each}") for each in entry.get("uses", "").split()]
    data = [common, entry] if function is None or "steps" in entry else []
    made = Steps(*data, used=used)
    words = {**made.names, **((function and function()) or {})}
    made.as_in_the_erratum(entry["id"])
    texts = {name: {**common, **entry}.get(name, "") for name in WORDS}
    if rule := RULES.get(texts["verdict"]):
        texts["verdict"] = rule(made, entry["stated"])
    filled_in = {name: filled(text, words, made.balls) for name, text in texts.items()}
    outcome = Outcome(filled_in.pop("verdict"))
    strength = Strength.NONE if outcome in UNDECIDABLE else Strength.PROVED
    strength = Strength(entry.get("strength", strength))
    return Verdict(outcome=outcome, strength=strength, **filled_in)
