"""What a report shows, before it is written in any format."""

from collections import Counter, defaultdict
from dataclasses import dataclass
from functools import cached_property

from cap.audit import errata, labels, ledger, recorded, subject
from cap.audit.claim import Claim
from cap.audit.errata import Change
from cap.audit.findings import Finding, members
from cap.audit.labels import Place
from cap.audit.statements import Statement, statements
from cap.audit.verdict import Outcome, Verdict

INTRODUCTION = (
    "Claims of the paper, at least one from each of its labels that makes any: each with the words "
    "of the TeX file from which it is taken and their line, a verdict that a program decides, what "
    "is true, and how that was found. It is meant as a referee's report that the author can run: "
    "every entry names the command that decides it again. Where the paper is right, this says so.",
    "Verdicts. Confirmed: true as stated. Corrected: what is meant holds with another value or a "
    "changed hypothesis, which is given. Refuted: false. Imprecise: the words say less, more, or "
    "something else than what holds. Vacuous: about nothing. Open: neither proved nor refuted, in "
    "the paper or here. Not checkable as stated: too little is said.",
    "Evidence. Proved: in ball arithmetic, symbolically, or exhaustively, when the command runs. "
    "Certified: by a stored certificate that an independent checker accepts, when the command "
    "runs or, if it is one of the few that take long, when the verdicts were recorded. By "
    "argument: by a written proof, in proofs/audit, of which a machine checked what it can. By "
    "reading: the text alone shows it. Numerical: in doubles, by closed forms from event to "
    "event, located up to rounding; what depends on chance, seeds or rounding says so. A printed "
    "number is confirmed if it is what is found, rounded to its last digit. Never-stopping means: "
    "the velocity never vanishes.",
)


def title() -> str:
    """Return the title of the report."""
    return f"Audit of “{labels.stored().title}”"


def identity() -> list[str]:
    """Return which paper this is about, and which program says so, in a line each."""
    paper, (day, program) = labels.stored(), recorded.made()
    return [
        f"The paper: {paper.author}, “{paper.title}”. The TeX file with the SHA-256 digest "
        f"{paper.sha256}; lines and quotations are of this file.",
        f"The audit: {program}; verdicts last recorded on {day}.",
    ]


@dataclass(frozen=True)
class Entry:
    """A claim with its verdict."""

    claim: Claim
    verdict: Verdict

    @property
    def at(self) -> Place:
        """The place from which the claim is taken."""
        return labels.stored().place(self.claim.where)

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
    def line(self) -> int:
        """The line of the TeX file in which its quotation begins; 0 if there is none."""
        return labels.stored().lines.get(self.claim.id, 0)

    @property
    def quote(self) -> str:
        """The words of the TeX file from which it is taken, on one line."""
        return " ".join(self.claim.quote.split())

    @property
    def commands(self) -> list[str]:
        """What to run to decide the claim again."""
        own = [f"python -m cap.audit --only {self.claim.id} --fresh"]
        if self.claim.table:
            own.append(f"{subject.paper()['compute']} {self.claim.table}")
        name = self.verdict.certificate
        return [*own, f"python -m cap.verify certificates/{name}"] if name else own

    @property
    def proof(self) -> str:
        """The section of a written proof, from the root of the repository."""
        return self.verdict.proof and f"proofs/audit/{self.verdict.proof}"

    def parts(self) -> dict[str, str]:
        """Return what is said of the claim, by what it is, without what there is nothing of."""
        parts = {
            "text": self.quote,
            "stated": self.claim.stated,
            "found": self.verdict.found,
            "evidence": self.verdict.evidence,
            "proof": self.proof,
            "certificate": self.verdict.certificate and f"certificates/{self.verdict.certificate}",
        }
        return {name: words for name, words in parts.items() if words}


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
        """What it says; if the verdict on its core has changed, that it has to be written anew."""
        return self.finding.words(self.core.verdict)

    @property
    def lines(self) -> list[int]:
        """The lines of the TeX file in which its claims are made."""
        return sorted({entry.line for entry in self.entries if entry.line})

    @property
    def where(self) -> str:
        """The place of its core, and its lines."""
        return f"{self.core.place}; lines {', '.join(map(str, self.lines))}"


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
        known = ledger.claims()
        return {name: Entry(known[name], verdict) for name, verdict in self.verdicts.items()}

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
        rows = []
        for each in self.sections:
            tally = Counter(entry.verdict.outcome for entry in each.entries)
            name = each.heading.replace(". ", " ", 1)
            rows.append((name, [tally[outcome] for outcome in self.outcomes]))
        return [*rows, ("All", [self.tally[outcome] for outcome in self.outcomes])]

    @cached_property
    def findings(self) -> list[Found]:
        """The findings, with the entries of their claims."""
        return [
            Found(each, [self.by_id[name] for name in names])
            for each, names in members(self.verdicts).items()
        ]

    @cached_property
    def statements(self) -> list[tuple[Statement, str]]:
        """The statements of the paper with what became of them."""
        return [(each, each.status(self.verdicts)) for each in statements()]

    def changes(self, section: Section) -> list[tuple[Change, Entry]]:
        """Return the changes of the erratum in a section, each with the core of its claims."""
        cores = [(each, self.by_id[each.claims[0]]) for each in errata.changes()]
        return [(change, core) for change, core in cores if core in section.entries]
