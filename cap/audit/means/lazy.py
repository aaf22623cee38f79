"""Modules that are slow to import, imported where they are used."""

from importlib import import_module
from typing import Any


class Lazy:
    """A module that is imported when something of it is asked for."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, attribute: str) -> Any:
        """Return what the module has under this name."""
        return getattr(import_module(self._name), attribute)


sympy: Any = Lazy("sympy")
parser: Any = Lazy("sympy.parsing.sympy_parser")
