"""Claims are data: files ``claims/GROUP.toml`` of a paper.

[[claim]]
id = "energy.of-a-mass"
where = "eq:energy-of-a-mass"      # a label of the paper
kind = "formula"                   # see `cap.audit.claim.Kind`
says = "A mass m of the speed v has this energy."
stated = "m v²/2"
quote = '''a piece of the TeX file'''
verdict = "confirmed"              # if all steps hold; or a rule: "formula", "number"
found = "what is true, with {words}"
evidence = "how that was found"
proof = "FILE.md#section"          # of a written proof, if it rests on one
certificate = "NAME.json"          # stored, if it rests on one

What is decided by algebra, or by what certificates claim, has ``steps``: see `cap.audit.steps`.
They may call functions of modules of the folder ``means/``, whose names are in ``uses``.
What needs more names a function, ``decide``, of the module ``claims/GROUP.py``, or of another's,
``GROUP.function``, with what it is given, ``with``.  It is called after the steps, if there are
some, raises `NotProved`, or returns the words that ``verdict``, ``found`` and ``evidence`` ask for.
What has neither is decided by reading.  Symbols, steps and words that several claims share are
under ``[common]``.
"""

import tomllib
from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from pathlib import Path

from cap.audit import errata, steps, subject
from cap.audit.claim import Claim, Kind, content
from cap.audit.filled import filled
from cap.audit.steps import Given, Words
from cap.audit.verdict import UNDECIDABLE, Outcome, Strength, Verdict

WORDS = "verdict", "found", "evidence", "proof", "certificate"


def claims(path: Path, module: str) -> tuple[Claim, ...]:
    """Return the claims of a file; functions of a module decide those that need some."""
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    common = data.get("common", {})
    return tuple(_claim(each, common, module) for each in data["claim"])


def _claim(entry: Given, common: Given, module: str) -> Claim:
    function = None
    used = [subject.module(f"means.{each}") for each in entry.get("uses", "").split()]
    if "decide" in entry:
        group, _, name = entry["decide"].rpartition(".")
        own = import_module(subject.module(f"claims.{group}") if group else module)
        function = partial(getattr(own, name), **entry.get("with", {}))
    formulas = [each.formula for each in errata.of(entry["id"])]
    return Claim(
        id=entry["id"],
        where=entry["where"],
        kind=Kind(entry["kind"]),
        says=entry["says"],
        stated=entry["stated"],
        decide=partial(decided, entry, common, function, used),
        quote=entry["quote"],
        content=content(entry, common, formulas),
    )


def decided(
    entry: Given,
    common: Given,
    function: Callable[[], Words | None] | None = None,
    used: Sequence[str] = (),
) -> Verdict:
    """Return the verdict that follows when all steps hold, and what a function asks for.

    It is what a rule says, or the words of the function, or the one that is named.  The steps may
    call functions of the modules that are ``used``.
    """
    every = function is None or "steps" in entry
    made = steps.made(common, entry, used=used) if every else steps.Steps()
    words = {**made.names, **((function and function()) or {})}
    as_in_the_erratum(entry["id"], made)
    texts = {name: {**common, **entry}.get(name, "") for name in WORDS}
    if rule := steps.RULES.get(texts["verdict"]):
        texts["verdict"] = rule(made, entry["stated"])
    filled_in = {name: filled(text, words, made.balls) for name, text in texts.items()}
    outcome = Outcome(filled_in.pop("verdict"))
    strength = Strength.NONE if outcome in UNDECIDABLE else Strength.PROVED
    strength = Strength(entry.get("strength", strength))
    return Verdict(outcome=outcome, strength=strength, **filled_in)


def as_in_the_erratum(name: str, done: steps.Steps) -> None:
    """Compare the formulas of the changes that a claim asks for with what was derived."""
    for each in errata.of(name):
        for formula in each.formula if each.claims[0] == name else ():
            done.agrees(formula, each.new)
