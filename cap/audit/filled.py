"""Words with numbers in them: ``{name}``, or ``{name:places}``, rounded so that they stay true.

{x}      words, or an expression; {x.name} or {x.0} of what has parts
{x:8}    a number, enclosed and rounded outwards to 8 places
{x:<4}   a bound from below, {x:>4} from above
{x:in6}  a range in which something holds, rounded inwards
{x:,3}   an exact decimal, with commas between thousands
"""

import re
from collections.abc import Callable, Mapping
from decimal import Decimal
from numbers import Rational
from types import MappingProxyType
from typing import Any

from cap.audit.means import algebra, balls
from cap.audit.means.stored import claimed
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.sets.interval import Ball

Balls = Mapping[Any, Ball]
_HOLE = re.compile(r"\{([A-Za-z][\w-]*(?:\.\w+)*)(?::(<|>|in|,|)(\d+))?\}")
_ROUNDED: dict[str, Callable[[Any, int], str]] = {
    "": balls.pair,
    "<": lambda each, places: balls.below(balls.ends(each)[0], places),
    ">": lambda each, places: balls.above(balls.ends(each)[1], places),
    "in": balls.inner,
    ",": lambda each, places: f"{Decimal(balls.pair(each, places)):,}",
}


def filled(text: str, words: Mapping[str, object], balls: Balls = MappingProxyType({})) -> str:
    """Return a text with every hole filled, from words or from what a certificate claims.

    ``balls`` enclose symbols in the words.  Raises `NotProved` if there is nothing of some name.
    """

    def shown(hole: re.Match[str]) -> str:
        return _shown(_value(hole[1], words), hole[2] or "", hole[3], balls)

    return _HOLE.sub(shown, text)


def _value(name: str, words: Mapping[str, object]) -> object:
    if (value := words[name] if name in words else claimed(name)) is not None:
        return value
    first, *path = name.split(".")
    if first not in words:
        raise NotProved("audit", f"there are no words for {name!r}")
    value = words[first]
    for each in path:
        value = value[int(each)] if isinstance(value, list) else getattr(value, each)
    return value


def _shown(value: Any, way: str, places: str | None, known: Balls) -> str:
    if places is None:
        words = value if isinstance(value, list) else [value]
        return ", ".join(algebra.shown(w) if hasattr(w, "free_symbols") else str(w) for w in words)
    if not isinstance(value, Enclosure | Ball | Rational):
        with balls.precisely():
            value = algebra.enclosure(value, known)
    return _ROUNDED[way](value, int(places))
