"""What a report shows, before it is written in any format."""

from collections import Counter
from dataclasses import dataclass
from functools import cached_property

from cap.audit import labels, ledger
from cap.audit.claim import Claim
from cap.audit.matters import FINDINGS, Finding
from cap.audit.tables import Row
from cap.audit.theorems import STATEMENTS, Statement
from cap.audit.verdict import Outcome, Verdict

TITLE = "Audit of the paper on mixed dynamics of the forced vibro-impact oscillator"
INTRODUCTION = (
    "Each checkable claim of the paper, in our words, with a verdict that a program decides, what "
    "is true, and how that was found. It is meant as a referee's report that the author can run: "
    "every entry names the command that decides it again. Where the paper is right, this says so.",
    "Verdicts. Confirmed: true as stated. Corrected: what is meant holds with another value or a "
    "changed hypothesis, which is given. Refuted: false. Imprecise: the words say less, more, or "
    "something else than what holds. Vacuous: about nothing. Open: neither proved nor refuted, in "
    "the paper or here. Not checkable as stated: too little is said.",
    "Evidence. Proved: in ball arithmetic, symbolically, or exhaustively, when the command runs. "
    "Certified: by a stored certificate that an independent checker accepts when the command runs. "
    "By argument: by a written proof, in proofs/audit, of which a machine checked what it can. "
    "Numerical: in floating point. Never-stopping means: the velocity never vanishes.",
)


@dataclass(frozen=True)
class Entry:
    """A claim with its verdict."""

    claim: Claim
    verdict: Verdict

    @property
    def place(self) -> str:
        """The place in words, with its label."""
        place = labels.stored().place(self.claim.where)
        if place.kind == "abstract":
            return "Abstract"
        return f"{place.kind.capitalize()} {place.number} ({place.label})"

    @property
    def section(self) -> str:
        """The number of the section."""
        return ledger.section_of(self.claim)

    @property
    def commands(self) -> list[str]:
        """What to run to decide the claim again."""
        own = [f"python -m cap.audit --only {self.claim.id} --fresh"]
        if isinstance(self.claim, Row):
            own.append(f"python -m cap.explore --paper {self.claim.table}")
        name = self.verdict.certificate
        return [*own, f"python -m cap.verify certificates/{name}"] if name else own

    def data(self) -> dict[str, str]:
        """Return it as one object of the JSON list."""
        return {
            "id": self.claim.id,
            "where": self.claim.where,
            "claim": self.claim.says,
            "stated": self.claim.stated,
            "found": self.verdict.found,
            "verdict": str(self.verdict.outcome),
            "strength": str(self.verdict.strength),
            "evidence": self.verdict.evidence,
            "command": " && ".join(self.commands),
            "certificate": self.verdict.certificate,
            "proof": self.verdict.proof and f"proofs/audit/{self.verdict.proof}",
            "kind": str(self.claim.kind),
            "section": self.section,
        }


@dataclass(frozen=True)
class Report:
    """Claims with verdicts; ``whole``: all of them, with summaries."""

    entries: tuple[Entry, ...]
    whole: bool

    @cached_property
    def verdicts(self) -> dict[str, Verdict]:
        """The verdicts by the ids of the claims."""
        return {entry.claim.id: entry.verdict for entry in self.entries}

    def sections(self) -> list[tuple[str, str, list[Entry]]]:
        """Return number, title and entries of each section that has any."""
        found = []
        for number, title in ledger.sections().items():
            entries = [entry for entry in self.entries if entry.section == number]
            if entries:
                found.append((number, title, entries))
        return found

    def counts(self) -> list[tuple[str, list[int]]]:
        """Return for each section, and for all, how many claims have each of `outcomes`."""
        rows = []
        for number, title, entries in self.sections():
            tally = Counter(entry.verdict.outcome for entry in entries)
            name = title if number == "0" else f"{number} {title}"
            rows.append((name, [tally[each] for each in self.outcomes()]))
        total = [sum(column) for column in zip(*(row for _, row in rows), strict=True)]
        return [*rows, ("All", total)]

    def outcomes(self) -> list[Outcome]:
        """Return the verdicts that occur."""
        found = {entry.verdict.outcome for entry in self.entries}
        return [each for each in Outcome if each in found]

    def findings(self) -> list[tuple[Finding, Entry]]:
        """Return the ten that matter most; if a verdict has changed, without its consequence."""
        by_id = {entry.claim.id: entry for entry in self.entries}
        return [(each, by_id[each.claim]) for each in FINDINGS]

    def statements(self) -> list[tuple[Statement, str]]:
        """Return the statements of the paper with what became of them."""
        return [(each, each.status(self.verdicts)) for each in STATEMENTS]


def consequence(finding: Finding, entry: Entry) -> str:
    """Return the consequence of a finding, if it was written for the verdict that it has."""
    if finding.expected is entry.verdict.outcome:
        return finding.consequence
    return "(The verdict has changed; its consequence has to be written anew.)"


def report(verdicts: dict[str, Verdict]) -> Report:
    """Return the report of some verdicts; of all, with summaries."""
    known = ledger.claims()
    entries = tuple(Entry(known[name], verdict) for name, verdict in verdicts.items())
    return Report(entries, len(entries) == len(known))
