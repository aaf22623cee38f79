"""The general part of the audit knows no paper: neither what one says nor what decides it."""

import ast
import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from cap.audit import papers, subject
from cap.audit.means import stored
from cap.audit.papers import FIRST

AUDIT = Path(papers.__file__).parents[1]
GENERAL = sorted(
    path for path in AUDIT.rglob("*.py") if "papers" not in path.relative_to(AUDIT).parts
)
TEMPLATES = sorted((AUDIT / "report" / "templates").iterdir())
SPECIAL = ("cap.paper.", "cap.parameters.", "cap.proofs.", "cap.audit.papers.")


def modules(path):
    """Return the names of the modules that a file imports, anywhere in it."""
    if path.suffix != ".py":
        return
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield f"{node.module}."
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


@pytest.mark.parametrize("path", GENERAL + TEMPLATES, ids=lambda path: str(path.relative_to(AUDIT)))
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
    assert not [each for each in ("cap.paper", "cap.explore", "cap.prove") if each in text]


def loaded(code):
    """Return our modules that are loaded in a new interpreter by the code."""
    command = [sys.executable, "-c", f"{code}\nimport sys\nprint()\nprint(*sys.modules)"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {name for name in done.stdout.splitlines()[-1].split() if name.startswith("cap.")}


def special(names):
    """Return those that know a paper, or what it is about."""
    return {name for name in names if f"{name}.".startswith(SPECIAL)} - {"cap.audit.papers"}


def test_it_loads_no_paper():
    """All its modules together load, through others too, nothing that knows a paper."""
    names = [".".join(("cap.audit", *p.relative_to(AUDIT).with_suffix("").parts)) for p in GENERAL]
    wanted = [n.removesuffix(".__init__") for n in names if not n.endswith(".__main__")]
    assert special(loaded(f"import {', '.join(wanted)}")) == set()


def test_a_paper_loads_no_other():
    """A report on one of them loads nothing of the others, nor the figures of the first."""
    for paper in sorted(set(subject.names()) - {FIRST}):
        code = "from cap.audit import command"
        names = loaded(f"{code}\ncommand.main(['--of', {paper!r}, '--recorded'])")
        assert f"cap.audit.papers.{paper}" in names
        others = {name for name in names if name.startswith("cap.audit.papers.")}
        assert {name.split(".")[3] for name in others} == {paper}
        assert not [name for name in names if f"{name}.".startswith("cap.paper.")]


def test_the_parameters_are_those_of_the_paper():
    """A certificate is about them if it has these and no others; tables have none."""
    own = dict.fromkeys(("F", "omega", "r", "e"), Fraction(1))
    own |= {"f": Fraction(2, 5), "l": Fraction(-1), "mu": Fraction(0)}
    about = [own, own | {"f": Fraction(1, 2)}, own | {"masses": (Fraction(1),)}, {}]
    certificates = [stored.Stored("example.json", each, {}) for each in about]
    assert [stored.at_the_paper(each) for each in certificates] == [True, False, False, False]
    subject.choose("church_fortin")
    try:
        assert not any(stored.at_the_paper(each) for each in certificates)
    finally:
        subject.choose(FIRST)


def test_what_is_general():
    """Files that everything goes through are among those that are looked at."""
    found = {path.name for path in GENERAL}
    assert {"command.py", "tables.py", "subject.py", "ledger.py", "formats.py"} <= found
