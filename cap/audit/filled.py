"""Words with numbers in them, ``{name}`` or ``{name:8}``, rounded so that they stay true.

``docs/own-paper.md`` says which roundings there are.
"""

import re
from collections.abc import Callable, Mapping
from decimal import Decimal
from fractions import Fraction
from functools import reduce
from math import ceil, floor
from numbers import Rational
from types import MappingProxyType
from typing import Any

from cap.audit.means import algebra
from cap.audit.means.stored import claimed, part
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

Balls = Mapping[Any, Ball]
_HOLE = re.compile(r"\{([A-Za-z][\w-]*(?:\.\w+)*)(?::(<|>|in|,|)(\d+))?\}")


def ends(value: Any) -> tuple[Fraction, Fraction]:
    """Return the ends of what a certificate claims, of a ball, or of an exact number."""
    if isinstance(value, Enclosure):
        return value.lower, value.upper
    return (Fraction(value),) * 2 if isinstance(value, Rational) else interval.ends(value)


def below(q: Fraction, places: int) -> str:
    """Return a number, rounded down."""
    return interval.fixed(floor(q * 10**places), places)


def above(q: Fraction, places: int) -> str:
    """Return a number, rounded up."""
    return interval.fixed(ceil(q * 10**places), places)


def pair(value: Any, places: int) -> str:
    """Return an enclosure in words: [lower, upper], rounded outwards, or a number."""
    lower, upper = ends(value)
    low, high = below(lower, places), above(upper, places)
    return low if low == high else f"[{low}, {high}]"


def inner(value: Any, places: int) -> str:
    """Return a range in which something holds, in words, rounded inwards."""
    lower, upper = ends(value)
    return f"[{above(lower, places)}, {below(upper, places)}]"


_ROUNDED: dict[str, Callable[[Any, int], str]] = {
    "": pair,
    "in": inner,
    ",": lambda value, places: f"{Decimal(pair(value, places)):,}",
    "<": lambda value, places: below(ends(value)[0], places),
    ">": lambda value, places: above(ends(value)[1], places),
}


def filled(text: str, words: Mapping[str, object], balls: Balls = MappingProxyType({})) -> str:
    """Return a text with every hole filled, from words or from what a certificate claims.

    ``balls`` enclose symbols in the words.  Raises `NotProved` if there is nothing of some name.
    """

    def shown(hole: re.Match[str]) -> str:
        return _shown(_value(hole[1], words), hole[2] or "", hole[3], balls)

    return _HOLE.sub(shown, text)


def _value(name: str, words: Mapping[str, object]) -> object:
    value = words[name] if name in words else claimed(name)
    if value is None:
        first, *path = name.split(".")
        value = reduce(part, path, words.get(first))
    if value is None:
        raise NotProved("audit", f"there are no words for {name!r}")
    return value


def _shown(value: Any, way: str, places: str | None, known: Balls) -> str:
    if places is None:
        words = value if isinstance(value, list) else [value]
        return ", ".join(algebra.shown(w) if hasattr(w, "free_symbols") else str(w) for w in words)
    if not isinstance(value, Enclosure | Ball | Rational):
        with algebra.precisely():
            value = algebra.enclosure(value, known)
    return _ROUNDED[way](value, int(places))
