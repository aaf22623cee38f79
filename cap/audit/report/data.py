"""The report as data."""

from cap.audit import labels, recorded
from cap.audit.report.view import Entry, Found, Report


def data(report: Report) -> dict[str, object]:
    """Return the claims, the findings, and what they are about, for JSON."""
    paper, (day, program) = labels.stored(), recorded.made()
    return {
        "paper": {name: getattr(paper, name) for name in ("title", "author", "sha256")},
        "program": program,
        "recorded": day,
        "claims": [_claim(each) for each in report.by_id.values()],
        "findings": [_found(each) for each in report.findings] if report.whole else [],
    }


def _claim(entry: Entry) -> dict[str, object]:
    claim, verdict, parts = entry.claim, entry.verdict, entry.parts()
    return {
        "id": claim.id,
        "where": claim.where,
        "claim": claim.says,
        "stated": claim.stated,
        "found": verdict.found,
        "verdict": verdict.outcome,
        "strength": verdict.strength,
        "evidence": verdict.evidence,
        "command": " && ".join(entry.commands),
        "certificate": verdict.certificate,
        "proof": parts.get("proof", ""),
        "kind": claim.kind,
        "section": entry.at.section,
        "place": entry.place,
        "line": entry.line,
        "quote": parts.get("text", ""),
    }


def _found(found: Found) -> dict[str, object]:
    return {
        "title": found.finding.title,
        "severity": found.finding.severity,
        "says": found.words,
        "change": found.finding.change,
        "claims": [entry.claim.id for entry in found.entries],
        "lines": found.lines,
    }
