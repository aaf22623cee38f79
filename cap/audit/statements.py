"""The statements of a paper: what became of each, and what may be cited in its place.

The status follows from the verdicts on the claims that decide it; the words in the last column
were written for these verdicts, and `cap.audit.recorded` holds them.
"""

from collections.abc import Sequence
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
