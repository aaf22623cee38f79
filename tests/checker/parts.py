"""The checker's classes, functions and constants by name, wherever in the checker they are.

from checker.parts import Mechanics, capture
"""

from __future__ import annotations

import pkgutil
from importlib import import_module
from types import ModuleType

import cap.checker

MODULES = [info.name for info in pkgutil.walk_packages(cap.checker.__path__, "cap.checker.")]


def home(name):
    """Return the one module that defines a name."""
    found = []
    for module in map(import_module, MODULES):
        part = vars(module).get(name)
        if isinstance(part, ModuleType):
            continue
        if part is not None and getattr(part, "__module__", module.__name__) == module.__name__:
            found.append(module)
    if len(found) != 1:
        raise AttributeError(f"{name} is defined in {len(found)} modules")
    return found[0]


def __getattr__(name):
    """Return a part of the checker."""
    if name.startswith("__"):
        raise AttributeError(name)
    return getattr(home(name), name)
