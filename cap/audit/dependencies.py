"""What decides a claim: the source of all modules that its module imports, and the libraries."""

import ast
import hashlib
import sys
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from cap.audit import subject

ROOT = Path(__file__).resolve().parents[2]
OURS = "cap"
WHOLE = ("cap.checker", "cap.proofs")  # packages whose modules may be loaded by name
LIBRARIES = ("python-flint", "sympy", "numpy", "numba", "mpmath")


@cache
def digest(module: str) -> str:
    """Return a digest of a module or some, of all our modules they import, and of the libraries.

    With each module counts the JSON file that has its name, which it reads: beside it, or, for the
    audit's, in the folder of the paper.
    """
    total = hashlib.sha256(_versions().encode())
    for name in sorted(set().union(*map(closure, module.split()))):
        total.update(name.encode() + _content(name))
    return total.hexdigest()


@cache
def _content(module: str) -> bytes:
    """Return a digest of the source of a module and of the data beside it."""
    files = [_file(module), _file(module).with_suffix(".json")]
    if module.startswith("cap.audit."):
        files.append(subject.file(f"{module.rpartition('.')[2]}.json"))
    parts = [file.read_bytes() if file.is_file() else b"" for file in files]
    return b"".join(hashlib.sha256(part).digest() for part in parts)


def closure(module: str) -> set[str]:
    """Return the module and all our modules that it imports, also inside of functions."""
    found, todo = set[str](), [module]
    while todo:
        name = todo.pop()
        if name not in found and _file(name).is_file():
            found.add(name)
            todo += [*_imported(name), *_beside(name)]
    return found


@cache
def _beside(module: str) -> tuple[str, ...]:
    """Return all modules of a package that counts as a whole, if this is one of them."""
    for package in WHOLE:
        if f"{module}.".startswith(f"{package}."):
            files = ROOT.joinpath(*package.split(".")).rglob("*.py")
            return tuple(".".join(f.relative_to(ROOT).with_suffix("").parts) for f in files)
    return ()


@cache
def _versions() -> str:
    """Return the versions of what computes."""
    found = [sys.version]
    for library in LIBRARIES:
        try:
            found.append(f"{library} {version(library)}")
        except PackageNotFoundError:
            found.append(f"no {library}")
    return "; ".join(found)


def _file(module: str) -> Path:
    """Return the file of a module of ours; there may be none of this name."""
    path = ROOT.joinpath(*module.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


@cache
def _imported(module: str) -> frozenset[str]:
    """Return the names of modules that may be imported; what is no module has no file."""
    names = set[str]()
    for node in ast.walk(ast.parse(_file(module).read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return frozenset(name for name in names if name.partition(".")[0] == OURS)
