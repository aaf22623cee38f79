"""The strict reading of JSON: bytes -> objects, lists and strings -> exact numbers, or a rejection.

Numbers are exact rationals.  Nothing is evaluated whose size was not bounded before.
"""

from __future__ import annotations

import json
import re
from fractions import Fraction
from typing import Any, NoReturn

from cap.checker.kernel.rejection import Rejected, need

MAX_BYTES = 1 << 24
MAX_CHARACTERS = 4000
MAX_DEPTH = 16
MAX_SIZE = 10**30  # of parameters and their inverses, and of what becomes a double
NUMBER = r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+|/[1-9][0-9]*)?"
_NUMBER = re.compile(NUMBER)


def text(value: Any, where: str) -> str:
    """Return a string."""
    if not isinstance(value, str):
        raise Rejected(f"{where} is not a string")
    return value


def number(value: Any, where: str) -> Fraction:
    """Return an exact number: an integer, a decimal without exponent, or a fraction."""
    literal = text(value, where)
    if len(literal) > MAX_CHARACTERS:
        raise Rejected(f"{where} is longer than {MAX_CHARACTERS} characters")
    if _NUMBER.fullmatch(literal) is None:
        raise Rejected(f"{where} is not a number of the format")
    whole, _, decimals = literal.partition(".")
    if decimals:
        return Fraction(int(whole + decimals), 10 ** len(decimals))
    numerator, _, denominator = literal.partition("/")
    return Fraction(int(numerator), int(denominator or "1"))


def parsed(data: bytes) -> object:
    """Return the JSON value, built of objects, lists and strings; anything else rejects."""
    need(len(data) <= MAX_BYTES, "the file is larger than 16 MiB")
    try:
        value = json.loads(
            data.decode("utf-8"),
            object_pairs_hook=_object,
            parse_float=_no_number,
            parse_int=_no_number,
            parse_constant=_no_number,
        )
        _refuse_literals(value)
    except UnicodeDecodeError:
        raise Rejected("the file is not UTF-8") from None
    except json.JSONDecodeError:
        raise Rejected("the file is not JSON") from None
    except RecursionError:
        raise Rejected("the JSON is nested too deeply") from None
    return value


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    """Return the JSON object; a repeated key rejects."""
    result = dict(pairs)
    need(len(result) == len(pairs), "a JSON object repeats a key")
    return result


def _no_number(_: str) -> NoReturn:
    """Reject a JSON number."""
    raise Rejected("the file contains a JSON number; numbers must be strings")


def _refuse_literals(value: object, depth: int = 0) -> None:
    """Reject true, false and null, anywhere, and deep nesting."""
    if isinstance(value, dict | list):
        need(depth < MAX_DEPTH or not value, "the JSON is nested too deeply")
        for part in value.values() if isinstance(value, dict) else value:
            if part.__class__ is not str:
                _refuse_literals(part, depth + 1)
    else:
        text(value, "a value (true, false or null)")
