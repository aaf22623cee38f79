"""Shapes of values of which there are several kinds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from cap.checker.kernel.reading import text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import matched


class OrNone(NamedTuple):
    """A value of this shape or, for what does not exist, the word "none"."""

    shape: Any

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        return None if value == "none" else matched(value, self.shape, where)


class Cases(NamedTuple):
    """An object of one of several shapes: the one in the cases that has its value of a key."""

    key: str
    cases: Mapping[str, Mapping[str, Any]]

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        kind = value.get(self.key) if isinstance(value, dict) else None
        chosen = [case for name, case in self.cases.items() if name == kind]
        need(len(chosen) == 1, f"{where}.{self.key} is none of: {', '.join(self.cases)}")
        return matched(value, {self.key: text, **chosen[0]}, where)
