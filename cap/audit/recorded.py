"""The verdicts as they are recorded: ``recorded.json``, which only ``--record`` writes."""

import hashlib
import json
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import asdict
from datetime import UTC, datetime
from typing import Any

from cap import __version__
from cap.audit import ledger, subject
from cap.audit.subject import cached
from cap.audit.verdict import Outcome, Strength, Verdict, verdict
from cap.errors import BadInput


@cached
def _file() -> dict[str, Any]:
    """Return what is in the file."""
    return {"date": "", "program": "", "verdicts": {}} | subject.data("recorded.json")


@cached
def recorded() -> dict[str, Verdict]:
    """Return the recorded verdicts by the ids of the claims; one that is none is not recorded."""
    found = {}
    for name, fields in _file()["verdicts"].items():
        with suppress(ValueError, KeyError):
            found[name] = verdict({k: each for k, each in fields.items() if k != "sentence"})
    return found


def known(names: Iterable[str]) -> dict[str, Verdict]:
    """Return the recorded verdicts on some claims; `BadInput` if one is not recorded."""
    wanted, found = list(names), recorded()
    if missing := [name for name in wanted if name not in found]:
        raise BadInput(f"not recorded yet: {', '.join(missing[:3])}; see --record")
    return {name: found[name] for name in wanted}


def made() -> tuple[str, str]:
    """Return the day of the last record, and the program that made it."""
    return _file()["date"], _file()["program"]


def write(verdicts: dict[str, Verdict]) -> None:
    """Record verdicts; those on other claims stay, those on what is no claim any more go."""
    old, claims = _file()["verdicts"], ledger.claims()
    new = {
        name: {key: str(value) for key, value in asdict(each).items() if value}
        | {"sentence": sentence(name)}
        for name, each in verdicts.items()
    }
    entries = {name: (old | new)[name] for name in claims if name in old | new}
    day, program = datetime.now(UTC).date().isoformat(), f"cap {__version__}"
    everything = {"date": day, "program": program, "verdicts": entries}
    subject.store("recorded.json", f"{json.dumps(everything, ensure_ascii=False, indent=1)}\n")


def sentence(name: str) -> str:
    """Return a digest of what a claim says: place, kind, words, value and quotation."""
    claim = ledger.claims()[name]
    parts = (claim.where, claim.kind, claim.says, claim.stated, claim.quote)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def changes(verdicts: dict[str, Verdict], *, whole: bool) -> list[str]:
    """Return in words how verdicts differ from what is recorded; ``whole``: these are all."""
    known = recorded()
    lines = []
    for name, new in verdicts.items():
        if new.outcome is Outcome.UNDECIDED:
            lines.append(f"{name} could not be decided: {new.evidence}")
        elif name not in known:
            lines.append(f"{name} is not recorded: {new.outcome}, {new.strength}")
        elif _file()["verdicts"][name].get("sentence") != sentence(name):
            lines.append(f"{name}: its place, words, value or quotation are not those recorded")
        else:
            lines += _differences(name, known[name], new)
    if whole:
        lines += [f"{name} is recorded, and no claim any more" for name in known.keys() - verdicts]
    return lines


def _differences(name: str, old: Verdict, new: Verdict) -> list[str]:
    """Numbers found in floats may differ in their last digits: there the verdict decides.

    So for the rows of tables, what is proved there starts from a search in floats.
    """
    before, now = asdict(old), asdict(new)
    kinds = [k for k in ("outcome", "strength") if before[k] != now[k]]
    if kinds:
        return [f"{name}: recorded {before[k]}, now {now[k]}" for k in kinds]
    if new.strength is Strength.NUMERICAL or ledger.claims()[name].table:
        return []
    changed = [k for k in before if before[k] != now[k]]
    return [f"{name}: recorded {k} '{before[k]}', now '{now[k]}'" for k in changed]
