"""The theorems, one file each: statement, tables of claims and hints, citations, proof, words.

A certificate names one; the name is looked up among the files here, and no other file is loaded.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from cap.checker.kernel.theorem import Theorem

NAMES = sorted(module.name for module in iter_modules(__path__))


def load(name: str) -> type[Theorem]:
    """Return the theorem of one of these names."""
    theorem: type[Theorem] = import_module(f"{__name__}.{NAMES[NAMES.index(name)]}").THEOREM
    return theorem
