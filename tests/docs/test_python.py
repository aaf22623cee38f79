"""The examples of `docs/python.md` print what the page shows."""

import doctest
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def test_the_pages():
    """Beside CI the pages of all modules are made, where a warning is an error."""
    assert 'python docs/pages.py "' in (ROOT / ".ci/beside").read_text("utf-8")
    assert 'simplefilter("error")' in (ROOT / "docs/api.py").read_text("utf-8")


@pytest.mark.slow
def test_the_examples(monkeypatch):
    """All of them, in their order, in the root of the repository."""
    monkeypatch.chdir(ROOT)
    options = doctest.ELLIPSIS | doctest.REPORT_NDIFF
    page = str(ROOT / "docs/python.md")
    found = doctest.testfile(page, module_relative=False, optionflags=options, encoding="utf-8")
    assert found.attempted > 20
    assert found.failed == 0
