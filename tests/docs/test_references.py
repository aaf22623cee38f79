"""What the pages refer to is there: files, links, names of modules and functions."""

import ast
import pkgutil
import re
from pathlib import Path

import pytest

import cap.checker
from cap.audit.means.written import anchor

ROOT = Path(__file__).parents[2]
FOLDERS = (ROOT, ROOT / "docs", ROOT / "docs/theorems", ROOT / "certificates")
PAGES = [page for folder in FOLDERS for page in sorted(folder.glob("*.md"))]
SOURCES = sorted([*(ROOT / "cap").rglob("*.py"), *(ROOT / "proofs").rglob("*.py")])
TOPS = "cap|proofs|certificates|docs|tests|benchmarks"
PATH = re.compile(rf"`((?:{TOPS})/[\w./*-]*)`")
NAME = re.compile(r"`(cap(?:\.[A-Za-z_]\w*)+)`")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)(#[^)\s]+)?\)")
COMMANDS = {"cap.prove", "cap.verify", "cap.explore", "cap.audit"}  # by `python -m`


def resolved(name):
    """Return whether a dotted name is a module, or something in one."""
    try:
        pkgutil.resolve_name(name)
    except (ImportError, AttributeError, ValueError):
        return False
    return True


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page(page):
    """Each file, each linked section, and each dotted name that a page mentions exists."""
    text = page.read_text(encoding="utf-8")
    assert [path for path in PATH.findall(text) if not list(ROOT.glob(path.rstrip("/")))] == []
    for target, section in LINK.findall(text):
        linked = page.parent / target
        assert linked.exists(), target
        if section:
            titles = re.findall(r"^#+ (.+)$", linked.read_text(encoding="utf-8"), re.MULTILINE)
            assert section[1:] in map(anchor, titles), target + section
    assert [name for name in set(NAME.findall(text)) - COMMANDS if not resolved(name)] == []


def rooms(folder):
    """Return the names of the packages in a folder."""
    return {path.parent.name for path in folder.glob("*/__init__.py")}


def test_the_rooms():
    """The page for those who add a theorem has all packages of `cap`, and no others."""
    text = (ROOT / "docs/adding-a-theorem.md").read_text(encoding="utf-8")
    cells = re.findall(r"^\| (`cap/.*?) \|", text, re.MULTILINE)
    named = set(re.findall(r"`cap/(\w+)/`", " ".join(cells)))
    assert named == rooms(ROOT / "cap") - {"proofs"}


def test_the_rooms_of_the_checker():
    """Its docstring has all its packages, and the module of the verdict."""
    named = re.findall(r"^    (\w+) +\w", cap.checker.__doc__, re.MULTILINE)
    assert sorted(named) == sorted([*rooms(ROOT / "cap/checker"), "verdict"])


@pytest.mark.slow
def test_the_docstrings():
    """Each dotted name of this package in a docstring exists."""
    wrong = []
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                names = set(NAME.findall(ast.get_docstring(node) or ""))
                wrong += [(path.name, name) for name in names - COMMANDS if not resolved(name)]
    assert wrong == []
