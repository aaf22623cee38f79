"""What the claims come to: findings, and what became of the statements of the paper.

Their words were written for the verdicts that are recorded.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cap.audit import labels, subject
from cap.audit.labels import Place
from cap.audit.subject import cached
from cap.audit.verdict import Outcome, Verdict

CHANGED = "stands when changed"
_STATUS = {  # others have the name of the verdict
    Outcome.CONFIRMED: "stands",
    Outcome.IMPRECISE: CHANGED,
    Outcome.CORRECTED: CHANGED,
    Outcome.REFUTED: "falls",
}


@dataclass(frozen=True, eq=False)
class Finding:
    """What is wrong, or right after all, and what the author has to change.

    It is about a ``theorem`` (a statement falls, or has to be changed), a ``proof`` (a step, or a
    formula that others use), a ``number`` or figure, or ``wording``: its severity.  ``claims``: the
    core first; a name ending in ``*`` stands for those of a group that no other finding names.
    ``verdict`` is the one on the core for which the words were written.
    """

    title: str
    severity: str
    verdict: str
    claims: Sequence[str]
    says: str
    change: str


@cached
def findings() -> tuple[Finding, ...]:
    """Return all findings, those that matter most first."""
    return tuple(Finding(**each) for each in subject.data("findings.toml").get("finding", []))


def members(verdicts: Mapping[str, Verdict]) -> dict[Finding, list[str]]:
    """Return the claims of each finding: its core, and others that are not confirmed."""
    named = {name for each in findings() for name in each.claims}
    wrong = [name for name, each in verdicts.items() if each.outcome is not Outcome.CONFIRMED]
    keys = {name: name if name in named else f"{name.partition('.')[0]}.*" for name in wrong}
    return {
        each: [core, *(name for name in wrong if keys[name] in each.claims and name != core)]
        for each in findings()
        for core in each.claims[:1]
    }


@dataclass(frozen=True)
class Statement:
    """A statement of the paper, and what may be cited instead of it.

    The first of the claims ``decided_by`` is its core; the others are what it says besides.
    """

    label: str
    decided_by: Sequence[str]
    instead: str

    @property
    def place(self) -> Place:
        """Where it stands."""
        return labels.stored().place(self.label)

    @property
    def name(self) -> str:
        """Its kind, number and title."""
        title = f" ({self.place.title})" if self.place.title else ""
        return f"{self.place.name}{title}"

    def status(self, verdicts: dict[str, Verdict]) -> str:
        """Return what became of it: the first claim decides; what stands may need a change."""
        first, *others = (verdicts[name].outcome for name in self.decided_by)
        if first is Outcome.CONFIRMED and any(each is not Outcome.CONFIRMED for each in others):
            return CHANGED
        return _STATUS.get(first, str(first))


@cached
def statements() -> tuple[Statement, ...]:
    """Return the statements of the paper, in its order."""
    return tuple(Statement(**each) for each in subject.data("statements.toml").get("statement", []))
