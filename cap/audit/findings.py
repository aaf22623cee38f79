"""The findings: what claims that are not confirmed have in common, with all of their places."""

from collections.abc import Mapping
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
    finding names.  ``verdict`` is the one on the core for which the words were written.
    """

    title: str
    severity: Severity
    verdict: Outcome
    claims: tuple[str, ...]
    says: str
    change: str

    def words(self, verdict: Verdict) -> str:
        """Return what it says, if it was written for the verdict that its core has."""
        if self.verdict is verdict.outcome:
            return self.says
        return "(The verdict has changed; its consequence has to be written anew.)"


_READ = {"severity": Severity, "verdict": Outcome, "claims": tuple}


@cached
def findings() -> tuple[Finding, ...]:
    """Return all findings, those that matter most first."""
    entries = subject.data("findings.toml")["finding"]
    return tuple(
        Finding(**{**each, **{k: read(each[k]) for k, read in _READ.items()}}) for each in entries
    )


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
