"""The findings: what claims that are not confirmed have in common, with all of their places."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cap.audit import subject
from cap.audit.subject import cached
from cap.audit.verdict import Outcome, Verdict


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
    return tuple(Finding(**each) for each in subject.data("findings.toml")["finding"])


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
