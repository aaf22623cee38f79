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
from cap.audit.manuscript import Manuscript, faults
from cap.audit.subject import cached
from cap.errors import BadInput

_LINE = r"^line \d+: "  # of a fault, which a change may move


@dataclass(frozen=True)
class Change:
    """What is in the text so many times, what takes its place, and the claims that say why.

    The first claim is decided only if each ``formula`` agrees with its steps.
    """

    claims: Sequence[str]
    old: str
    new: str
    times: int = 1
    formula: list[dict[str, str]] = field(default_factory=list)

    def made(self, manuscript: Manuscript) -> bool:
        """Return whether a text has it already."""
        return manuscript.count(self.new) > 0 and not manuscript.count(self.old)


@cached
def changes() -> tuple[Change, ...]:
    """Return all changes, in the order of the paper."""
    return tuple(Change(**each) for each in subject.data("errata.toml").get("change", []))


def of(claim: str) -> list[Change]:
    """Return the changes that a claim asks for."""
    return [each for each in changes() if claim in each.claims]


def formulas(claim: str) -> list[tuple[dict[str, str], str]]:
    """Return the formulas of changes of which a claim is the first, each with the new text."""
    own = [each for each in changes() if each.claims[0] == claim]
    return [(formula, each.new) for each in own for formula in each.formula]


def corrected(manuscript: Manuscript) -> tuple[Manuscript, list[Change]]:
    """Return the text with every change that it does not have already, and those that do not fit.

    A change fits if what it is about is in the text as often as it says, in the old words or in
    the new ones.
    """
    others = []
    for each in changes():
        left, done = manuscript.count(each.old), manuscript.count(each.new)
        if left == each.times or left < each.times <= left + done:
            manuscript = manuscript.replaced(each.old, each.new)
        else:
            others.append(each)
    return manuscript, others


def undone(manuscript: Manuscript) -> Manuscript:
    """Return the text as it was before the changes that it has."""
    for each in [each for each in changes() if each.made(manuscript)]:
        manuscript = manuscript.replaced(each.new, each.old)
    return manuscript


def patch(path: Path) -> tuple[str, list[str], list[str]]:
    """Return the changes of a TeX file as ``git apply`` and ``patch -p1`` take them.

    With the claims whose changes it has already, and in words what changes do not fit.  Raises
    `BadInput` if no change fits, or the new text has a fault that the old one has not.
    """
    old = Manuscript.read(path)
    new, others = corrected(old)
    if others and len(others) == len(changes()):
        raise BadInput(f"{path} is another text: no change fits")
    known = {re.sub(_LINE, "", each) for each in faults(old.text)}
    if wrong := [each for each in faults(new.text) if re.sub(_LINE, "", each) not in known]:
        raise BadInput(f"the corrected text would be no TeX: {'; '.join(wrong)}")
    before, after = (each.text.splitlines(keepends=True) for each in (old, new))
    difference = difflib.unified_diff(before, after, f"a/{path.name}", f"b/{path.name}")
    done = dict.fromkeys(each.claims[0] for each in changes() if each.made(old))
    return "".join(difference), list(done), list(map(misfit, others))


def misfit(change: Change) -> str:
    """Return in words that a change does not fit a version of the paper."""
    return (
        f"the change for {change.claims[0]} does not fit this version (--paper FILE.tex says what "
        f"became of each sentence): not {change.times} times in the file: "
        f"{' '.join(change.old.split())}"
    )
