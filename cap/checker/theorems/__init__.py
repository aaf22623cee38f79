"""The theorems, one file each: statement, tables of claims and hints, citations, proof, words.

A certificate names one; the name is looked up among the files here, and no other file is loaded.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from cap.checker.kernel.theorem import Theorem

NAMES = sorted(file.stem for file in Path(__file__).parent.glob("[a-z]*.py"))


def load(name: str) -> type[Theorem]:
    """Return the theorem of one of these names."""
    theorem: type[Theorem] = import_module(f"{__name__}.{NAMES[NAMES.index(name)]}").THEOREM
    return theorem
