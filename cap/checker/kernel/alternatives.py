"""Shapes of values of which there are two kinds, an object and another."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from cap.checker.kernel.shapes import matched


class OneOrOther(NamedTuple):
    """An object of the first shape, or what is no object, of the second shape."""

    thing: Mapping[str, Any]
    other: Any

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        return matched(value, self.thing if isinstance(value, dict) else self.other, where)
