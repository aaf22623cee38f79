"""Each theorem has a page that says what checker and prover say of it; no text is a wall."""

import re
from pathlib import Path

import pytest

from cap.checker.theorems import load
from cap.proofs import symbolic
from cap.proofs.theorems import THEOREMS

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted([*DOCS.glob("*.md"), *(DOCS / "theorems").glob("*.md")])
NAMES = (*THEOREMS, *symbolic.NAMES)
LONGEST = 120  # words
ITEM = re.compile(r"\s*([-*]|\d+\.)\s+")


def paragraphs(text):
    """Give the paragraphs and the items of lists; blocks of code, tables and titles apart."""
    text = re.sub(r"^( *)```.*?^\1```", "", text, flags=re.MULTILINE | re.DOTALL)
    for block in re.split(r"\n\s*\n", text):
        words = []
        for line in block.splitlines():
            if ITEM.match(line) or line.startswith(("|", "#")):
                yield words
                words = []
            if not line.startswith(("|", "#", "    ")):
                words += ITEM.sub("", line, count=1).split()
        yield words


def page(name):
    """Return the page of a theorem."""
    return (DOCS / f"theorems/{name}.md").read_text(encoding="utf-8")


def section(name, title):
    """Return a section of this page."""
    (found,) = re.findall(rf"^## {title}\n(.*?)(?=^## |\Z)", page(name), re.MULTILINE | re.DOTALL)
    return found


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_no_paragraph_is_a_wall(path):
    """At most 120 words."""
    long = [words for words in paragraphs(path.read_text(encoding="utf-8")) if len(words) > LONGEST]
    assert [" ".join(words[:12]) for words in long] == []


def test_a_wall_is_seen():
    """Also in an item of a list, and in lines of any length."""
    wall = "word " * 121
    for text in (wall, f"- {wall}", wall.replace(" ", "\n"), f"1. one\n2. {wall}", f"a\n\n{wall}"):
        assert max(map(len, paragraphs(text))) > LONGEST
    for text in (
        f"```\n{wall}\n```",
        f"| {wall} |",
        f"    {wall}",
        f"{wall[:300]}\n\n{wall[300:]}",
    ):
        assert max(map(len, paragraphs(text))) <= LONGEST


def test_each_theorem_has_a_page():
    """And no page is about none."""
    assert {path.stem for path in (DOCS / "theorems").iterdir()} == set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_the_sections(name):
    """It has a statement, a command, times, what is not claimed, and what is cited."""
    assert page(name).startswith(f"# `{name}`\n")
    assert section(name, "Statement").strip()
    command = "attractor" if name == "entropies" else name
    assert f"    python -m cap.prove {command}" in section(name, "Command")
    assert re.search(r"[Pp]rocessor time|two cores", section(name, "Command"))
    assert section(name, "Not claimed").strip()


@pytest.mark.parametrize("name", THEOREMS)
def test_what_is_cited(name):
    """The page cites what the checker cites, and nothing else."""
    cited = re.findall(r"^- (.*?): [^:]*$", section(name, "Cited"), re.MULTILINE)
    assert cited == [citation["theorem"] for citation in load(name).CITES]
    if not cited:
        assert section(name, "Cited").startswith("\nNothing.")


def test_the_index():
    """Each theorem is in the table, with the words of `--list`."""
    rows = re.findall(
        r"^\| \[`(\w+)`\]\(theorems/(\w+)\.md\) \| (.*?) \|",
        (DOCS / "theorems.md").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    said = {name: theorem.summary for name, theorem in THEOREMS.items()}
    said |= {name: symbolic.proof(name).SUMMARY for name in symbolic.NAMES}
    assert all(name == file for name, file, _ in rows)
    assert sorted((name, summary) for name, _, summary in rows) == sorted(said.items())
