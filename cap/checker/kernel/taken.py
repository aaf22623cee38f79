"""Enclosures of what a quantity takes."""

from __future__ import annotations

from typing import Any, NamedTuple

from cap.checker.kernel.shapes import Enclosure, enclosure


class Taken(NamedTuple):
    """An enclosure of what a quantity takes, each end so many digits sharp."""

    unit: str | None
    digits: int

    def __call__(self, value: Any, where: str) -> Enclosure:
        """Read it."""
        return enclosure(value, where)._replace(unit=self.unit)
