"""Parts of theorems that only some certificates claim: their files are loaded only then."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from cap.checker.kernel.shapes import matched


def loaded(module: str) -> Any:
    """Return the part of a theorem that a module contains; it is loaded if it was not before."""
    return import_module(module).PART


class Later(NamedTuple):
    """A value of a shape that is looked up when there is one: its file may not be loaded before."""

    look_up: Callable[[], Any]

    @property
    def shape(self) -> Any:
        """The shape."""
        return self.look_up()

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        return matched(value, self.shape, where)
