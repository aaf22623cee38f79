"""The verdicts as they are recorded: ``recorded.json``, which only ``--record`` writes."""

import json
from contextlib import suppress
from dataclasses import asdict
from functools import cache
from pathlib import Path

from cap.audit import ledger
from cap.audit.cache import verdict
from cap.audit.tables import Row
from cap.audit.verdict import Outcome, Strength, Verdict
from cap.files import replacing

PATH = Path(__file__).with_name("recorded.json")


@cache
def recorded() -> dict[str, Verdict]:
    """Return the recorded verdicts by the ids of the claims; one that is none is not recorded."""
    if not PATH.is_file():
        return {}
    found = {}
    for name, fields in json.loads(PATH.read_text(encoding="utf-8")).items():
        with suppress(ValueError, KeyError):
            found[name] = verdict(fields)
    return found


def write(verdicts: dict[str, Verdict]) -> None:
    """Record verdicts."""
    entries = {name: _short(each) for name, each in verdicts.items()}
    text = json.dumps(entries, ensure_ascii=False, indent=1)
    with replacing(PATH) as file:
        file.write(f"{text}\n".encode())
    recorded.cache_clear()


def _short(decided: Verdict) -> dict[str, str]:
    return {key: str(value) for key, value in asdict(decided).items() if value}


def changes(verdicts: dict[str, Verdict], *, whole: bool) -> list[str]:
    """Return in words how verdicts differ from what is recorded; ``whole``: these are all."""
    known = recorded()
    lines = []
    for name, new in verdicts.items():
        if new.outcome is Outcome.UNDECIDED:
            lines.append(f"{name} could not be decided: {new.evidence}")
        elif name not in known:
            lines.append(f"{name} is not recorded: {new.outcome}, {new.strength}")
        else:
            lines += _differences(name, known[name], new)
    if whole:
        lines += [f"{name} is recorded, and no claim any more" for name in known.keys() - verdicts]
    return lines


def _differences(name: str, old: Verdict, new: Verdict) -> list[str]:
    """Numbers found in floats may differ in their last digits: there the verdict decides.

    So for the rows of tables, what is proved there starts from a search in floats.
    """
    lines = []
    for what in ("outcome", "strength"):
        before, now = getattr(old, what), getattr(new, what)
        if before != now:
            lines.append(f"{name}: recorded {before}, now {now}")
    floats = new.strength is Strength.NUMERICAL or isinstance(ledger.claims().get(name), Row)
    if not lines and not floats and old.found != new.found:
        lines.append(f"{name}: recorded '{old.found}', now '{new.found}'")
    return lines
