"""Integers of either sign."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from cap.checker.kernel.reading import text
from cap.checker.kernel.rejection import Rejected

_INTEGER = re.compile("-?[0-9]+", re.ASCII)


class Integer(NamedTuple):
    """An integer of either sign, of so many digits at most."""

    digits: int

    def __call__(self, value: Any, where: str) -> int:
        """Read it."""
        if _INTEGER.fullmatch(text(value, where)) and len(value) <= self.digits + (value[0] == "-"):
            return int(value)
        raise Rejected(f"{where} is not an integer of at most {self.digits} digits")
