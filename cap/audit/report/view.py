"""What a report shows, before it is written in any format."""

from collections import Counter, defaultdict
from dataclasses import dataclass
from functools import cached_property

from cap.audit import errata, labels, ledger, recorded, subject
from cap.audit.claim import Claim
from cap.audit.errata import Change
from cap.audit.findings import Finding, Statement, members, statements
from cap.audit.labels import Place
from cap.audit.verdict import Outcome, Verdict


@dataclass(frozen=True)
class Entry:
    """A claim with its verdict, the place from which it is taken, and the line of its quotation."""

    claim: Claim
    verdict: Verdict
    at: Place
    line: int

    @property
    def place(self) -> str:
        """The place in words, with its label."""
        if self.at.kind == "abstract":
            return "Abstract"
        label = f", {self.at.label}" if self.at.number.startswith("(") else f" ({self.at.label})"
        return f"{self.at.name}{label}"

    @property
    def where(self) -> str:
        """The place, the line, and what kind of claim it is."""
        return f"{self.place}, line {self.line}, {self.claim.kind}"

    @property
    def commands(self) -> list[str]:
        """What to run to decide the claim again."""
        table, certificate = self.claim.table, self.verdict.certificate
        found = [f"python -m cap.audit --only {self.claim.id} --fresh"]
        found += [f"{subject.paper()['compute']} {table}"] if table else []
        return found + ([f"python -m cap.verify certificates/{certificate}"] if certificate else [])

    def parts(self) -> dict[str, str]:
        """Return what is said of the claim, by what it is, without what there is nothing of."""
        verdict = self.verdict
        parts = {
            "text": " ".join(self.claim.quote.split()),
            "stated": self.claim.stated,
            "found": verdict.found,
            "evidence": verdict.evidence,
            "proof": verdict.proof and f"proofs/audit/{verdict.proof}",
            "certificate": verdict.certificate and f"certificates/{verdict.certificate}",
        }
        return {name: words for name, words in parts.items() if words}

    def data(self) -> dict[str, object]:
        """Return what JSON has of it."""
        claim, verdict, parts = self.claim, self.verdict, self.parts()
        return {
            "id": claim.id,
            "where": claim.where,
            "claim": claim.says,
            "stated": claim.stated,
            "found": verdict.found,
            "verdict": verdict.outcome,
            "strength": verdict.strength,
            "evidence": verdict.evidence,
            "command": " && ".join(self.commands),
            "certificate": verdict.certificate,
            "proof": parts.get("proof", ""),
            "kind": claim.kind,
            "section": self.at.section,
            "place": self.place,
            "line": self.line,
            "quote": parts.get("text", ""),
        }


@dataclass(frozen=True)
class Found:
    """A finding with the entries of its claims, the core first."""

    finding: Finding
    entries: list[Entry]

    @property
    def core(self) -> Entry:
        """The entry of its core."""
        return self.entries[0]

    @property
    def words(self) -> str:
        """What it says, if it was written for the verdict that its core has."""
        if self.finding.verdict == self.core.verdict.outcome:
            return self.finding.says
        return "(The verdict has changed; its consequence has to be written anew.)"

    @property
    def lines(self) -> list[int]:
        """The lines of the TeX file in which its claims are made."""
        return sorted({entry.line for entry in self.entries if entry.line})

    @property
    def where(self) -> str:
        """The place of its core, and its lines."""
        return f"{self.core.place}; lines {', '.join(map(str, self.lines))}"

    def data(self) -> dict[str, object]:
        """Return what JSON has of it."""
        return {
            **{name: getattr(self.finding, name) for name in ("title", "severity")},
            "says": self.words,
            "change": self.finding.change,
            "claims": [entry.claim.id for entry in self.entries],
            "lines": self.lines,
        }


@dataclass(frozen=True)
class Section:
    """The entries of a section."""

    number: str
    title: str
    entries: list[Entry]

    @property
    def heading(self) -> str:
        """Its number and title; the abstract has no number."""
        return self.title if self.number == "0" else f"{self.number}. {self.title}"


@dataclass(frozen=True)
class Report:
    """Claims with verdicts, by their ids; of all claims, with summaries."""

    verdicts: dict[str, Verdict]

    @cached_property
    def by_id(self) -> dict[str, Entry]:
        """The entries by the ids of the claims."""
        paper, claims = labels.stored(), ledger.claims()
        return {  # in the line 0: without quotation
            name: Entry(
                claims[name], each, paper.place(claims[name].where), paper.lines.get(name, 0)
            )
            for name, each in self.verdicts.items()
        }

    @property
    def whole(self) -> bool:
        """Whether these are all claims."""
        return self.verdicts.keys() == ledger.claims().keys()

    @cached_property
    def tally(self) -> Counter[Outcome]:
        """How many claims have each verdict."""
        return Counter(each.outcome for each in self.verdicts.values())

    @property
    def outcomes(self) -> list[Outcome]:
        """The verdicts that occur."""
        return [each for each in Outcome if each in self.tally]

    @cached_property
    def sections(self) -> list[Section]:
        """The sections that have any entries."""
        together = defaultdict[str, list[Entry]](list)
        for each in self.by_id.values():
            together[each.at.section].append(each)
        titles = ledger.sections().items()
        return [Section(k, title, together[k]) for k, title in titles if k in together]

    def counts(self) -> list[tuple[str, list[int]]]:
        """Return for each section, and for all, how many claims have each of `outcomes`."""
        rows = [(each.heading.replace(". ", " ", 1), each.entries) for each in self.sections]
        rows.append(("All", list(self.by_id.values())))
        found = [(name, [each.verdict.outcome for each in entries]) for name, entries in rows]
        return [(name, list(map(each.count, self.outcomes))) for name, each in found]

    @cached_property
    def findings(self) -> list[Found]:
        """The findings, with the entries of their claims."""
        found = members(self.verdicts)
        return [Found(each, [self.by_id[name] for name in names]) for each, names in found.items()]

    @cached_property
    def statements(self) -> list[tuple[Statement, str]]:
        """The statements of the paper with what became of them."""
        return [(each, each.status(self.verdicts)) for each in statements()]

    def changes(self, section: Section) -> list[tuple[Change, Entry]]:
        """Return the changes of the erratum in a section, each with the core of its claims."""
        cores = [(each, self.by_id[each.claims[0]]) for each in errata.changes()]
        return [(change, core) for change, core in cores if core in section.entries]

    def data(self) -> dict[str, object]:
        """Return the claims, the findings, and what they are about, for JSON."""
        paper, (day, program) = labels.stored(), recorded.made()
        return {
            "paper": {name: getattr(paper, name) for name in ("title", "author", "sha256")},
            "program": program,
            "recorded": day,
            "claims": [each.data() for each in self.by_id.values()],
            "findings": [each.data() for each in self.findings] if self.whole else [],
        }
