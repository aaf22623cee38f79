"""The erratum in Markdown: what the TeX file has, and what it should have, section by section."""

from collections.abc import Iterator

from cap.audit import labels, ledger
from cap.audit.errata import Change, changes
from cap.audit.report.markdown import code, escaped
from cap.audit.report.view import Report, identity

INTRODUCTION = (
    "Every formula and number that the audit corrects or refutes, and wording that goes with them. "
    "A theorem that falls is not repaired by them: what may be cited instead is in the audit. "
    "`python -m cap.audit --patch FILE.tex` prints the same as a patch."
)


def erratum(report: Report) -> str:
    """Return the erratum; its reasons are what the claims found."""
    paper = labels.stored()
    lines = [f"# Erratum to “{escaped(paper.title)}”", ""]
    lines += [*(f"{escaped(each)}\n" for each in identity()), INTRODUCTION, ""]
    for number, name in ledger.sections().items():
        own = [each for each in changes() if _section(each) == number]
        if own:
            lines += [f"## {escaped(name if number == '0' else f'{number}. {name}')}", ""]
        for each in own:
            lines += _change(each, report)
    return "\n".join(lines).rstrip() + "\n"


def _section(change: Change) -> str:
    return ledger.section_of(ledger.claims()[change.claims[0]])


def _change(change: Change, report: Report) -> Iterator[str]:
    by_id = {entry.claim.id: entry for entry in report.entries}
    core = by_id[change.claims[0]]
    times = f", {change.times} times" if change.times > 1 else ""
    yield f"**{escaped(core.place)}**, by {', '.join(f'`{name}`' for name in change.claims)}{times}"
    yield ""
    yield f"- for {code(' '.join(change.old.split()))}"
    yield f"- read {code(' '.join(change.new.split()))}"
    yield f"- because: {escaped(core.verdict.found)}"
    yield ""
