"""Sequences of letters, as itineraries of symbols."""

from __future__ import annotations

from typing import Any, NamedTuple

from cap.checker.kernel.reading import text
from cap.checker.kernel.rejection import need


class Letters(NamedTuple):
    """A sequence of these letters, so many at most."""

    letters: str
    most: int

    def __call__(self, value: Any, where: str) -> str:
        """Read it."""
        read = text(value, where)
        fits = 0 < len(read) <= self.most and set(read) <= set(self.letters)
        need(fits, f"{where} is not a sequence of at most {self.most} letters {self.letters}")
        return read
