"""Shapes that only some certificates of a theorem need."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from cap.checker.kernel.shapes import matched


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
