"""The erratum in Markdown: what the TeX file has, and what it should have, section by section."""

from collections.abc import Iterator

from cap.audit import labels
from cap.audit.errata import Change, changes
from cap.audit.report.markdown import code, escaped
from cap.audit.report.view import Entry, Report, identity

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
    cores = [report.by_id[each.claims[0]] for each in changes()]
    for section in report.sections():
        own = [each for each in zip(changes(), cores, strict=True) if each[1] in section.entries]
        lines += [f"## {escaped(section.heading)}", ""] if own else []
        for each in own:
            lines += _change(*each)
    return "\n".join(lines).rstrip() + "\n"


def _change(change: Change, core: Entry) -> Iterator[str]:
    times = f", {change.times} times" if change.times > 1 else ""
    yield f"**{escaped(core.place)}**, by {', '.join(f'`{name}`' for name in change.claims)}{times}"
    yield ""
    yield f"- for {code(' '.join(change.old.split()))}"
    yield f"- read {code(' '.join(change.new.split()))}"
    yield f"- because: {escaped(core.verdict.found)}"
    yield ""
