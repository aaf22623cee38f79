"""The erratum: ``errata.toml``, what stands in the TeX file and what should stand there.

Every formula and number that a claim corrects or refutes has a change.  A theorem that falls is
not repaired by them: what may be cited instead of it is in ``statements.toml``.
"""

import difflib
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cap.audit import subject
from cap.audit.manuscript import Manuscript
from cap.audit.subject import cached
from cap.audit.syntax import faults
from cap.errors import BadInput


@dataclass(frozen=True)
class Change:
    """What is in the text so many times, what takes its place, and the claims that say why.

    ``formula``: pieces ``tex`` of what is new, each with what it ``is``, or ``steps`` that hold for
    it, in the names of the steps of the first claim: see `cap.audit.steps`.  The claim is decided
    only if they agree.
    """

    claims: Sequence[str]
    old: str
    new: str
    times: int = 1
    formula: list[dict[str, str]] = field(default_factory=list)


@cached
def changes() -> tuple[Change, ...]:
    """Return all changes, in the order of the paper."""
    return tuple(Change(**each) for each in subject.data("errata.toml")["change"])


def of(claim: str) -> list[Change]:
    """Return the changes that a claim asks for."""
    return [each for each in changes() if claim in each.claims]


def corrected(manuscript: Manuscript) -> Manuscript:
    """Return the text with every change; `BadInput` if one does not fit."""
    for each in changes():
        count = manuscript.count(each.old)
        if count != each.times:
            raise BadInput(
                f"the change for {each.claims[0]} does not fit this version (--paper FILE.tex says "
                f"what became of each sentence): this is in the file {count} times, not "
                f"{each.times}: {' '.join(each.old.split())}"
            )
        manuscript = manuscript.replaced(each.old, each.new)
    return manuscript


def patch(path: Path) -> str:
    """Return the changes of a TeX file as ``git apply`` and ``patch -p1`` take them.

    Raises `BadInput` if one does not fit, or if the new text has a fault that the old one has not.
    """
    old = Manuscript.read(path)
    new = corrected(old)
    known = {_unplaced(each) for each in faults(old.text)}
    if wrong := [each for each in faults(new.text) if _unplaced(each) not in known]:
        raise BadInput(f"the corrected text would be no TeX: {'; '.join(wrong)}")
    before, after = (each.text.splitlines(keepends=True) for each in (old, new))
    return "".join(difflib.unified_diff(before, after, f"a/{path.name}", f"b/{path.name}"))


def _unplaced(fault: str) -> str:
    """Return a fault without its line, which a change may move."""
    return re.sub(r"^line \d+: ", "", fault)
