"""The report: the stored page is true to the code, and every format holds together."""

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import pytest
from audit_verdicts import said

from cap.audit import ledger, recorded
from cap.audit.claim import Claim, Kind
from cap.audit.findings import Statement
from cap.audit.means.written import anchor, sections
from cap.audit.report import latex
from cap.audit.report.formats import FORMATS, WIDTH, escaped, written
from cap.audit.report.view import Report
from cap.audit.verdict import Outcome

ROOT = Path(__file__).resolve().parents[2]
NASTY = '<b> & "quotes" | `code` *stars* _under_ \\command{x} $5 #1 100% ~ ^ -- μ^(1/2) θ̃ ö'


@pytest.fixture(scope="module")
def whole():
    """Return the report of the recorded verdicts."""
    return Report({name: recorded.recorded()[name] for name in ledger.claims()})


@pytest.fixture
def nasty():
    """Return a report of one claim whose words have every special sign."""
    one = Claim("stops.nasty", "eq:model", Kind.WORDS, NASTY, NASTY, lambda: said("confirmed"))
    known = ledger.claims()
    known[one.id] = one
    try:
        yield Report({one.id: said("confirmed", NASTY, NASTY)})
    finally:
        del known[one.id]


def test_the_stored_report_is_true_to_the_code(whole):
    """And so is the stored erratum: both are written of the recorded verdicts."""
    stored = (ROOT / "docs/audit.md").read_text(encoding="utf-8")
    assert stored == written(FORMATS["markdown"], whole)
    changes = (ROOT / "docs/erratum.md").read_text(encoding="utf-8")
    assert changes == written("erratum.md", whole)


def test_summary(whole):
    """Counts by section add up."""
    rows = whole.counts()
    assert rows[0][0] == "Abstract"
    assert sum(rows[-1][1]) == len(ledger.claims())
    assert rows[-1][1] == [sum(c) for c in zip(*(row for _, row in rows[:-1]), strict=True)]


@pytest.mark.slow
def test_every_claim_is_in_every_format(whole):
    """With its id, and in text with what was found."""
    unbroken = written(FORMATS["latex"], whole).replace(r"\allowbreak{}", "")
    texts = [
        written(FORMATS["text"], whole),
        written(FORMATS["markdown"], whole),
        written(FORMATS["html"], whole),
        unbroken,
    ]
    for name in ledger.claims():
        assert all(name in text for text in texts), name


def test_text_is_not_wider_than_a_terminal(whole):
    """Words are wrapped, but for one that is longer than a line."""
    lines = written(FORMATS["text"], whole).splitlines()
    assert all(len(line) <= WIDTH for line in lines if " " in line.strip())


class Tags(HTMLParser):
    """Whether tags are closed in their order; what is fetched; the ids."""

    def __init__(self):
        super().__init__()
        self.open, self.fetched, self.ids = [], [], []

    def handle_starttag(self, tag, attrs):
        """Note a tag."""
        given = dict(attrs)
        self.fetched += [given[name] for name in ("src", "href") if name in given]
        self.ids += [given["id"]] if "id" in given else []
        if tag not in ("meta", "br", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        """Close a tag."""
        assert self.open.pop() == tag


def test_the_page_is_one_file(whole):
    """Tags are balanced, ids unique, links stay on the page, nothing is fetched."""
    tags = Tags()
    text = written(FORMATS["html"], whole)
    tags.feed(text)
    assert tags.open == []
    assert len(set(tags.ids)) == len(tags.ids)
    assert {each[1:] for each in tags.fetched} <= set(tags.ids)
    assert all(each.startswith("#") for each in tags.fetched)
    assert "http" not in text.replace("http-equiv", "")


def test_words_stay_words(nasty):
    """Special signs of no format do anything."""
    tags = Tags()
    tags.feed(written(FORMATS["html"], nasty))
    assert "b" not in tags.open
    assert "&lt;b&gt; &amp;" in written(FORMATS["html"], nasty)
    assert r"\<b\>" in written(FORMATS["markdown"], nasty)
    assert written(FORMATS["latex"], nasty).count("{") == written(FORMATS["latex"], nasty).count(
        "}"
    )
    assert "<b>" in written(FORMATS["text"], nasty)


def test_markdown_is_escaped():
    """Signs that Markdown would take for its own."""
    assert escaped("a*b_c|d<e`f[g]") == r"a\*b\_c\|d\<e\`f\[g\]"


def test_latex_needs_no_unicode(whole):
    """Only ASCII is left, no ligature is made of two hyphens; an unknown sign is an error."""
    text = written(FORMATS["latex"], whole)
    assert text.isascii()
    assert "--" not in text
    assert latex.escaped("θ̃ ö ⁻¹ ₀ a_b") == (
        r"\ensuremath{\tilde{\ensuremath{\theta}}} \"{o} "
        r"\textsuperscript{$-$}\textsuperscript{1} \textsubscript{0} a\_b"
    )
    with pytest.raises(ValueError, match="no way to write"):
        latex.escaped("∃")


def test_links_of_the_stored_report():
    """Files and sections of written proofs that it links are there."""
    stored = (ROOT / "docs/audit.md").read_text(encoding="utf-8")
    links = set(re.findall(r"\]\(\.\./([^)]+)\)", stored))
    assert any("certificates/" in each for each in links)
    for link in links:
        path, _, section = link.partition("#")
        assert (ROOT / path).is_file(), link
        assert not section or section in sections(Path(path).name), link


def test_links_within_the_stored_report():
    """The findings lead to their claims."""
    stored = (ROOT / "docs/audit.md").read_text(encoding="utf-8")
    headings = {anchor(each) for each in re.findall(r"^### (.+)$", stored, re.MULTILINE)}
    targets = re.findall(r"\]\(#([^)]+)\)", stored)
    assert len(targets) > 300
    assert set(targets) <= headings


@pytest.mark.parametrize(
    ("verdicts", "status"),
    [
        ([said("confirmed")], "stands"),
        ([said("confirmed"), said("refuted")], "stands when changed"),
        ([said("corrected")], "stands when changed"),
        ([said("refuted"), said("confirmed")], "falls"),
        ([said("vacuous"), said("confirmed")], "vacuous"),
    ],
)
def test_what_becomes_of_a_statement(verdicts, status):
    """The first claim decides; what stands may need a change."""
    names = tuple("abc"[: len(verdicts)])
    one = Statement("thm:wellposed", names, "")
    assert one.status(dict(zip(names, verdicts, strict=True))) == status
    assert one.name == "Theorem 2.5 (Well-posedness)"


def test_a_consequence_belongs_to_its_verdict(whole):
    """If the verdict is another, the report says so, and not what would follow from the old one."""
    found = whole.findings[0]
    finding, entry = found.finding, found.core
    verdicts = {name: recorded.recorded()[name] for name in ledger.claims()}
    verdicts[entry.claim.id] = replace(entry.verdict, outcome=Outcome.OPEN)
    text = written(FORMATS["markdown"], Report(verdicts))
    assert "its consequence has to be written anew" in text
    assert escaped(finding.says) not in text
