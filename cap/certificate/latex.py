r"""The numbers of a verified certificate as LaTeX macros, named and rounded by its theorem's table.

An enclosure and an upper bound are rounded outwards.  A region, and what else is claimed exactly,
are printed as they are: what is claimed of all their points need not hold of larger ones.
"""

import re
from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor
from typing import Any

from cap.checker.kernel.alternatives import OneOrOther
from cap.checker.kernel.choices import Cases, OrNone
from cap.checker.kernel.later import Later
from cap.checker.kernel.optional import First, Maybe
from cap.checker.kernel.reading import number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure, Many, region
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems import load

_DIGITS = ("Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")


def macros(c: Certificate, prefix: str, digits: int) -> Iterator[str]:
    r"""Yield a LaTeX ``\newcommand`` for each number claimed, with so many digits.

    Before those of a claim, a comment tells its symbol, where it has one, and its meaning.
    """
    stem = "cap" + _name(prefix)
    for field in load(c.theorem).CLAIMS:
        if field.name in c.claims:
            symbol = f"${field.symbol}$: " if field.symbol else ""
            yield f"% {symbol}{field.meaning}"
            for path, claim, kind in _leaves(c.claims[field.name], field.shape, _name(field.name)):
                exact = isinstance(claim, str | int) or kind in (region, number)
                shown = str(claim) if exact else latex(claim, digits)
                yield f"\\newcommand{{\\{stem}{path}}}{{{shown}}}"


def _leaves(value: Any, shape: Any, path: str) -> Iterator[tuple[str, Any, Any]]:
    """Yield the numbers in a claim with their names and shapes; nothing for what is not there."""
    match shape:
        case dict():
            for key, part in value.items():
                yield from _leaves(part, shape[key], path + _name(key.replace("-", "minus ")))
        case Many(part, _, _):
            yield from _leaves(value, [part] * len(value), path)
        case First(shapes):
            yield from _leaves(value, list(shapes[: len(value)]), path)
        case list():
            for n, (part, inner) in enumerate(zip(value, shape, strict=True), start=1):
                yield from _leaves(part, inner, path + _name(str(n)))
        case OneOrOther(thing, other):
            yield from _leaves(value, thing if isinstance(value, dict) else other, path)
        case Cases(key, cases):
            yield from _leaves(value, {key: text, **cases[value[key]]}, path)
        case Maybe() | OrNone() | Later():
            yield from _leaves(value, shape.shape, path) if value is not None else ()
        case _:
            yield path, value, shape


def _name(key: str) -> str:
    """Return a name of letters: words capitalised, digits spelled."""
    parts = re.findall("[A-Za-z]+|[0-9]", key)
    return "".join(_DIGITS[int(p)] if p in "0123456789" else p[0].upper() + p[1:] for p in parts)


def latex(claim: Enclosure | Fraction, digits: int) -> str:
    """Return an enclosure, or an upper bound, with so many significant digits, rounded outwards."""
    lower, upper = claim[:2] if isinstance(claim, Enclosure) else (claim, claim)
    exponent = _exponent(max(abs(lower), abs(upper)))
    shown = exponent if exponent < -4 or exponent >= digits else 0
    places = digits - 1 - exponent + shown
    ends = [_decimal(lower / Fraction(10) ** shown, places, down=True)]
    ends.append(_decimal(upper / Fraction(10) ** shown, places, down=False))
    low, high = (Fraction(end) * Fraction(10) ** shown for end in ends)
    need(low <= lower and upper <= high, "a printed number does not contain the number claimed")
    body = f"[{ends[0]}, {ends[1]}]" if isinstance(claim, Enclosure) else ends[1]
    return body + (f" \\cdot 10^{{{shown}}}" if shown else "")


def _exponent(q: Fraction) -> int:
    """Return floor(log10 q) or one more for q > 0, 0 for q = 0: it only sets the digits shown."""
    return len(str(q.numerator)) - len(str(q.denominator)) if q else 0


def _decimal(q: Fraction, places: int, *, down: bool) -> str:
    """Return q rounded down or up to so many decimal places."""
    scaled = q * 10**places
    units = floor(scaled) if down else ceil(scaled)
    digits = str(abs(units)).zfill(places + 1)
    point = len(digits) - places
    return ("-" if units < 0 else "") + digits[:point] + ("." + digits[point:] if places else "")
