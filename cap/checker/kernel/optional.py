"""Shapes of what may be missing: a field, or the last items of a list."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from cap.checker.kernel.shapes import matched


class Maybe(NamedTuple):
    """The value of a field that may be missing."""

    shape: Any
    optional: bool = True

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        return matched(value, self.shape, where)


class First(NamedTuple):
    """A list of the first few of these values."""

    shapes: Sequence[Any]

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        count = len(value) if isinstance(value, list) else 0
        return matched(value, list(self.shapes[:count]), where)
