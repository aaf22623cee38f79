"""The strict reading of JSON: bytes -> objects, lists and strings -> exact numbers, or a rejection.

Numbers are exact rationals, in strings: every leaf of a certificate is read as a string, so JSON's
own numbers, true, false and null reject.  Nothing is evaluated whose size was not bounded before.
"""

from __future__ import annotations

import json
import re
from fractions import Fraction
from typing import Any

from cap.checker.kernel.rejection import Rejected, need

MAX_BYTES = 1 << 24
MAX_CHARACTERS = 4000
MAX_SIZE = 10**30  # of parameters and their inverses, and of what becomes a double
NUMBER = r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+|/[1-9][0-9]*)?"


def text(value: Any, where: str) -> str:
    """Return a string."""
    if not isinstance(value, str):
        raise Rejected(f"{where} is not a string")
    return value


def number(value: Any, where: str) -> Fraction:
    """Return an exact number: an integer, a decimal without exponent, or a fraction."""
    literal = text(value, where)
    short = len(literal) <= MAX_CHARACTERS
    need(short, f"{where} is longer than {MAX_CHARACTERS} characters")
    need(re.fullmatch(NUMBER, literal) is not None, f"{where} is not a number of the format")
    return Fraction(literal)


def parsed(data: bytes) -> Any:
    """Return the JSON value, in which no object repeats a key; a shape is still to be matched."""
    need(len(data) <= MAX_BYTES, "the file is larger than 16 MiB")
    try:
        # no leaf may be a JSON number; to read one as a float takes little time
        return json.loads(data.decode("utf-8"), object_pairs_hook=_object, parse_int=float)
    except (ValueError, RecursionError) as error:
        raise Rejected(f"the file is not JSON in UTF-8: {error}") from None


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    """Return the JSON object; a repeated key rejects."""
    result = dict(pairs)
    need(len(result) == len(pairs), "a JSON object repeats a key")
    return result
