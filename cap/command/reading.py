"""What a referee of a theorem has to read: the files of the checker that its certificates load.

In an order in which nothing is used before it was read, with lines of code, and of mathematics:
docstrings and comments.  Some theorems have parts that a certificate may claim or not, and whose
files are loaded only then: what each adds is listed after the rest.  The files are those that are
loaded now, so nothing else may have been loaded before.
"""

from __future__ import annotations

import ast
import inspect
import sys
from collections.abc import Iterator, Sequence
from importlib import import_module
from typing import NamedTuple

from cap.checker import theorems, verdict

ROOM = "cap.checker."
_DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef)


class Page(NamedTuple):
    """A file to be read."""

    name: str
    code: int
    mathematics: int


def pages(theorem: str) -> list[Page]:
    """Return the files for a theorem in their order; packages without code are left out."""
    theorems.load(theorem)
    return _pages(f"{theorems.__name__}.{theorem}", verdict.__name__)


def added(theorem: str) -> Iterator[tuple[str, list[Page]]]:
    """Give what may be claimed, with the files that it adds to those for all certificates."""
    known = {page.name for page in pages(theorem)}
    for name, module in theorems.load(theorem).PARTS.items():
        import_module(module)
        yield name, [page for page in _pages(module) if page.name not in known]


def told(pages: Sequence[Page]) -> Iterator[str]:
    """Give a line for each file, and the total."""
    yield "code  mathematics"
    for name, code, mathematics in pages:
        yield f"{code:4d}  {mathematics:11d}  {name}"
    code, mathematics = sum(p.code for p in pages), sum(p.mathematics for p in pages)
    yield f"{code:4d}  {mathematics:11d}  in all"


def _pages(*modules: str) -> list[Page]:
    """Return the files of loaded modules, and of what they import."""
    found: dict[str, Page] = {}
    for module in modules:
        for name in _ordered(module, set()):
            found.setdefault(name, _page(name))
    return [page for page in found.values() if page.code]


def _ordered(module: str, seen: set[str]) -> Iterator[str]:
    """Give the loaded modules of the checker that a module imports, then itself."""
    if module in seen or module not in sys.modules or not module.startswith(ROOM):
        return
    seen.add(module)
    for node in ast.walk(_tree(module)):
        if isinstance(node, ast.ImportFrom) and node.module:
            for name in (node.module, *(f"{node.module}.{alias.name}" for alias in node.names)):
                yield from _ordered(name, seen)
    yield module


def _tree(module: str) -> ast.Module:
    """Return a module, parsed."""
    return ast.parse(inspect.getsource(sys.modules[module]))


def _page(module: str) -> Page:
    """Count the lines of a module that are not empty."""
    lines = inspect.getsource(sys.modules[module]).splitlines()
    explained = {n for n, line in enumerate(lines, start=1) if line.lstrip().startswith("#")}
    for node in ast.walk(_tree(module)):
        if isinstance(node, _DOCUMENTED) and ast.get_docstring(node) is not None:
            first = node.body[0]
            explained |= set(range(first.lineno, (first.end_lineno or first.lineno) + 1))
    filled = {n for n, line in enumerate(lines, start=1) if line.strip()}
    name = module.removeprefix(ROOM).replace(".", "/")
    package = "/__init__" if hasattr(sys.modules[module], "__path__") else ""
    return Page(f"{name}{package}.py", len(filled - explained), len(filled & explained))
