"""The page on own systems: its model is the example's, and its code prints what it says."""

import doctest
from pathlib import Path
from textwrap import dedent

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/own-systems.md"


def test_the_model():
    """The ten lines are those of the file."""
    text = PAGE.read_text(encoding="utf-8")
    block = text[text.index("    from fractions") : text.index("\n- **Names.**")]
    file = (ROOT / "examples/ball.py").read_text(encoding="utf-8")
    assert dedent(block).strip() == file[file.index("from fractions") :].strip()


def test_all_examples_are_listed():
    """Each with a link."""
    text = PAGE.read_text(encoding="utf-8")
    for path in (ROOT / "examples").glob("*.py"):
        assert f"(../examples/{path.name})" in text


def test_the_examples(monkeypatch):
    """In the root of the repository."""
    monkeypatch.chdir(ROOT)
    options = doctest.ELLIPSIS | doctest.REPORT_NDIFF
    found = doctest.testfile(str(PAGE), module_relative=False, optionflags=options)
    assert found.attempted > 15
    assert found.failed == 0
