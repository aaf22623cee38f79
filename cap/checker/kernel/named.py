"""Shapes of objects whose names a certificate chooses."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from cap.checker.kernel.reading import text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import matched


class Named(NamedTuple):
    """An object of at most so many values of one shape, under names that are only compared.

    A name has letters, digits, blanks, and the signs _ + - inside or alone.
    """

    shape: Any
    most: int

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        few = isinstance(value, dict) and len(value) <= self.most
        need(few, f"{where} is not an object with at most {self.most} names")
        return {name(key, where): matched(part, self.shape, where) for key, part in value.items()}


NAME = "[A-Za-z0-9+-](?:[A-Za-z0-9_+ -]{0,38}[A-Za-z0-9_+-])?"


def name(value: Any, where: str) -> str:
    """Return a name."""
    need(re.fullmatch(NAME, text(value, where)) is not None, f"{where} has a name that is none")
    return str(value)
