"""The general part of the audit knows no paper: neither what one says nor what decides it."""

import ast
import json
from pathlib import Path

import pytest

from cap.audit import papers, subject

AUDIT = Path(papers.__file__).parents[1]
GENERAL = sorted(
    path for path in AUDIT.rglob("*.py") if "papers" not in path.relative_to(AUDIT).parts
)
SPECIAL = ("cap.paper", "cap.proofs", "cap.audit.papers.")


def modules(path):
    """Return the names of the modules that a file imports, anywhere in it."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield f"{node.module}."
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


@pytest.mark.parametrize("path", GENERAL, ids=lambda path: str(path.relative_to(AUDIT)))
def test_no_paper(path):
    """No file imports or names a paper, its figures, its theorems, or a place in it."""
    allowed = {"cap.audit.papers.FIRST", "cap.audit.papers."}
    for name in modules(path):
        assert name in allowed or not f"{name}.".startswith(SPECIAL)
    text = path.read_text(encoding="utf-8")
    for paper in subject.names():
        assert paper not in text
        known = json.loads((subject.FOLDER / paper / "labels.json").read_text(encoding="utf-8"))
        labels = [place["label"] for place in known["places"] if ":" in place["label"]]
        assert not [label for label in labels if label in text]
        assert known["author"].rpartition(" ")[2] not in text
    assert "cap.paper" not in text


def test_what_is_general():
    """Files that everything goes through are among those that are looked at."""
    found = {path.name for path in GENERAL}
    assert {"command.py", "tables.py", "subject.py", "ledger.py", "markdown.py"} <= found
