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
What needs more names a function, ``decide``, of the module ``claims/GROUP.py``, with what it is
given, ``with``, after its steps, if it has some.  It raises `NotProved`, or returns a verdict, or
the words that ``found`` and ``evidence`` ask for.  What has neither is decided by reading.
"""

import hashlib
import json
import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from pathlib import Path

from cap.audit import errata, steps
from cap.audit.claim import Claim, Kind
from cap.audit.filled import filled
from cap.audit.steps import Given
from cap.audit.verdict import UNDECIDABLE, Outcome, Strength, Verdict

WORDS = "found", "evidence", "proof", "certificate"


def claims(path: Path, module: str) -> tuple[Claim, ...]:
    """Return the claims of a file; functions of a module decide them, if it exists."""
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    common = data.get("common", {})
    own = path.with_suffix(".py").is_file()
    return tuple(_claim(each, common, module if own else steps.__name__) for each in data["claim"])


def _claim(entry: Given, common: Given, module: str) -> Claim:
    decide: Callable[[], Verdict]
    if "decide" in entry:
        function = getattr(import_module(module), entry["decide"])
        decide = partial(_decided, entry, common, partial(function, **entry.get("with", {})))
    else:
        decide = partial(_derived, entry, common)
    formulas = [each.formula for each in errata.of(entry["id"])]
    content = json.dumps([entry, common, formulas], sort_keys=True)
    return Claim(
        id=entry["id"],
        where=entry["where"],
        kind=Kind(entry["kind"]),
        says=entry["says"],
        stated=entry["stated"],
        decide=decide,
        quote=entry["quote"],
        module=module,
        content=hashlib.sha256(content.encode()).hexdigest(),
    )


def _decided(
    entry: Given, common: Given, function: Callable[[], Verdict | Mapping[str, object] | None]
) -> Verdict:
    """Return what a function decides; its words are put where ``found`` and ``evidence`` ask."""
    made = steps.made(common, entry) if "steps" in entry else steps.Steps()
    done = function()
    as_in_the_erratum(entry["id"], made)
    return done if isinstance(done, Verdict) else _verdict(entry, {**made.names, **(done or {})})


def _derived(entry: Given, common: Given) -> Verdict:
    """Return the verdict that follows when all steps hold, or from the rule that it names."""
    done = steps.made(common, entry)
    as_in_the_erratum(entry["id"], done)
    rule = steps.RULES.get(entry["verdict"])
    verdict = rule(done, entry["stated"]) if rule else entry["verdict"]
    return _verdict({**entry, "verdict": verdict}, done.names)


def as_in_the_erratum(name: str, done: steps.Steps) -> None:
    """Compare the formulas of the changes that a claim asks for with what was derived."""
    for each in errata.of(name):
        for formula in each.formula if each.claims[0] == name else ():
            done.agrees(formula, each.new)


def _verdict(entry: Given, words: Mapping[str, object]) -> Verdict:
    outcome = Outcome(entry["verdict"])
    strength = Strength.NONE if outcome in UNDECIDABLE else Strength.PROVED
    texts = {name: filled(entry.get(name, ""), words) for name in WORDS}
    return Verdict(outcome=outcome, strength=Strength(entry.get("strength", strength)), **texts)
