"""The report on one page, for an editor; and how it is cited."""

from collections import Counter

from cap.audit import labels, recorded
from cap.audit.errata import changes
from cap.audit.findings import Severity
from cap.audit.report.text import wrapped
from cap.audit.report.view import Report, identity, title
from cap.audit.statements import CHANGED, FALLS, NOTHING, STANDS, UNCLEAR, UNKNOWN
from cap.audit.verdict import Outcome

MOST = 10  # of the findings, the first: those that matter most
_KEYS = {
    STANDS: "Stand",
    CHANGED: "Stand when changed",
    FALLS: "Fall",
    NOTHING: "Are about nothing",
    UNKNOWN: "Are open",
    UNCLEAR: "Cannot be checked as stated",
}


def summary(report: Report) -> str:
    """Return what an editor has to know, on a page of a terminal."""
    lines = [*wrapped(title()), ""]
    for each in identity():
        lines += wrapped(each)
    lines += ["", *wrapped(_verdict(report)), "", *_statements(report), "", *_most(report)]
    return "\n".join([*lines, "", *_rest(report)])


def _verdict(report: Report) -> str:
    tally = Counter(entry.verdict.outcome for entry in report.entries)
    wrong = tally[Outcome.REFUTED] + tally[Outcome.CORRECTED]
    counts = ", ".join(f"{tally[each]} {each}" for each in report.outcomes())
    status = Counter(status for _, status in report.statements())
    return (
        f"Of {len(report.entries)} claims {wrong} are wrong as they stand ({counts}). Of "
        f"{len(report.statements())} numbered statements {status[STANDS]} stand, "
        f"{status[CHANGED]} when changed. {_recommended(status)}"
    )


def _recommended(status: Counter[str]) -> str:
    """Return a recommendation that follows from what became of the statements."""
    if status[FALLS] or status[NOTHING]:
        return (
            "Statements that others rest on fall: not acceptable as it is; a revision would have "
            "to withdraw them."
        )
    return "Changes to the text suffice." if status[CHANGED] else "No statement needs a change."


def _statements(report: Report) -> list[str]:
    lines = []
    for status, words in _KEYS.items():
        names = [_short(each.label) for each, own in report.statements() if own == status]
        if names:
            lines += wrapped(f"{words}: {', '.join(names)}.", rest="    ")
    return lines


def _short(label: str) -> str:
    return labels.stored().place(label).name


def _most(report: Report) -> list[str]:
    lines = []
    for count, found in enumerate(report.findings()[:MOST], 1):
        line = f", line {found.core.line}" if found.core.line else ""
        head = f"{count:>2}. {found.finding.title} ({_short(found.core.claim.where)}{line})."
        lines += wrapped(f"{head} {found.finding.change}", rest="    ")
    return lines


def _rest(report: Report) -> list[str]:
    tally = Counter(found.finding.severity for found in report.findings())
    counts = ", ".join(f"{tally[each]} on {_WORDS[each]}" for each in Severity)
    return wrapped(
        f"All findings: {len(report.findings())} ({counts}). What may be cited instead, and all "
        "claims: --format html. The erratum, "
        f"{len(changes())} changes by section: --erratum; as a patch of the TeX file: --patch "
        "FILE.tex. A later version of it: --paper FILE.tex. To cite: --bibtex."
    )


_WORDS = {
    Severity.THEOREM: "statements",
    Severity.PROOF: "proofs and formulas",
    Severity.NUMBER: "numbers and figures",
    Severity.WORDING: "wording",
}


def bibtex() -> str:
    """Return entries for the paper and for its audit."""
    paper, (day, program) = labels.stored(), recorded.made()
    family = paper.author.split()[-1]
    year = day.partition("-")[0]
    return "\n".join(
        [
            f"@unpublished{{{family.lower()}-paper,",
            f"  author = {{{paper.author}}},",
            f"  title  = {{{{{paper.title}}}}},",
            f"  note   = {{TeX file with the SHA-256 digest {paper.sha256}}}",
            "}",
            "",
            f"@misc{{{family.lower()}-audit,",
            f"  title  = {{{{Audit of ``{paper.title}''}}}},",
            f"  year   = {{{year}}},",
            f"  note   = {{Made by {program}, verdicts recorded on {day}; python -m cap.audit}}",
            "}",
        ]
    )
