"""The findings: what claims that are not confirmed have in common, with all of their places.

``findings.toml`` has them, in words that were written for the verdict on the first claim of each.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from enum import StrEnum

from cap.audit import subject
from cap.audit.subject import cached
from cap.audit.verdict import Outcome, Verdict


class Severity(StrEnum):
    """What a finding is about."""

    THEOREM = "theorem"  # a statement falls, or has to be changed
    PROOF = "proof"  # a step, or a formula that others use
    NUMBER = "number"  # numbers and figures
    WORDING = "wording"


@dataclass(frozen=True)
class Finding:
    """What is wrong, or right after all, and what the author has to change.

    ``claims``: the core first; a name ending in ``*`` stands for those of a group that no other
    finding names.
    """

    title: str
    severity: Severity
    expected: Outcome
    claims: tuple[str, ...]
    says: str
    change: str

    @property
    def claim(self) -> str:
        """The core."""
        return self.claims[0]

    def words(self, verdict: Verdict) -> str:
        """Return what it says, if it was written for the verdict that its core has."""
        if self.expected is verdict.outcome:
            return self.says
        return "(The verdict has changed; its consequence has to be written anew.)"


@cached
def findings() -> tuple[Finding, ...]:
    """Return all findings, those that matter most first."""
    return tuple(
        Finding(
            title=each["title"],
            severity=Severity(each["severity"]),
            expected=Outcome(each["verdict"]),
            claims=tuple(each["claims"]),
            says=each["says"],
            change=each["change"],
        )
        for each in subject.data("findings.toml")["finding"]
    )


def members(verdicts: Mapping[str, Verdict]) -> dict[Finding, list[str]]:
    """Return the claims of each finding, those that are not confirmed, and its core."""
    named = {name for each in findings() for name in each.claims}
    wrong = [name for name, each in verdicts.items() if each.outcome is not Outcome.CONFIRMED]
    return {each: _members(each, wrong, named) for each in findings()}


def _members(finding: Finding, wrong: Collection[str], named: Collection[str]) -> list[str]:
    own = set(finding.claims)
    groups = {name.removesuffix("*") for name in own if name.endswith("*")}
    rest = {name for name in wrong if name not in named and f"{name.partition('.')[0]}." in groups}
    others = [name for name in wrong if name in own | rest and name != finding.claim]
    return [finding.claim, *others]
