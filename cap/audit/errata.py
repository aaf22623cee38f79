"""The erratum: ``errata.toml``, what stands in the TeX file and what should stand there.

Every formula and number that a claim corrects or refutes has a change.  A theorem that falls is
not repaired by them: what may be cited instead of it is in ``statements.toml``.
"""

import difflib
import tomllib
from dataclasses import dataclass
from pathlib import Path

from cap.audit import subject
from cap.audit.manuscript import Manuscript
from cap.audit.subject import cached
from cap.errors import BadInput


@dataclass(frozen=True)
class Change:
    """What is in the text so many times, what takes its place, and the claims that say why."""

    claims: tuple[str, ...]
    old: str
    new: str
    times: int = 1


@cached
def changes() -> tuple[Change, ...]:
    """Return all changes, in the order of the paper."""
    found = tomllib.loads(subject.file("errata.toml").read_text(encoding="utf-8"))["change"]
    return tuple(Change(**each | {"claims": tuple(each["claims"])}) for each in found)


def of(claim: str) -> list[Change]:
    """Return the changes that a claim asks for."""
    return [each for each in changes() if claim in each.claims]


def corrected(manuscript: Manuscript) -> Manuscript:
    """Return the text with every change; `BadInput` if one does not fit."""
    for each in changes():
        count = manuscript.count(each.old)
        if count != each.times:
            raise BadInput(
                f"this is in the file {count} times, not {each.times}: {' '.join(each.old.split())}"
            )
        manuscript = manuscript.replaced(each.old, each.new)
    return manuscript


def patch(path: Path) -> str:
    """Return the changes of a TeX file as ``git apply`` and ``patch -p1`` take them."""
    old = Manuscript.read(path)
    before, after = (each.text.splitlines(keepends=True) for each in (old, corrected(old)))
    return "".join(difflib.unified_diff(before, after, f"a/{path.name}", f"b/{path.name}"))
