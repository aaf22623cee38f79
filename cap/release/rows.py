"""Cells of the table of the release map, each with what is proved of it."""

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.parameters import Parameters

Kind = tuple[tuple[str, ...], int]
SIDES = {"r": "right", "l": "left"}
MIRROR = {"r": "l", "l": "r", "right": "left", "left": "right"}


class Row(NamedTuple):
    """[lower, upper], doubles taken exactly: all releases from there are of this ``kind``.

    That is the itinerary, and after how many half-periods the next release is, 0 if there is none.
    ``value``, ``slope``: ends of enclosures of G and G', NaN where they are not known.
    """

    lower: float
    upper: float
    kind: Kind
    value: tuple[float, float]
    slope: tuple[float, float]


def gaps_between(p: Parameters, rows: Sequence[Row]) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield the closed intervals, of some length, that the rows leave of [l, r]."""
    end = p.l
    for row in rows:
        if row.lower > end:
            yield end, Fraction(row.lower)
        end = Fraction(row.upper)
    if p.r > end:
        yield end, p.r


def clipped(p: Parameters, value: tuple[float, float]) -> tuple[float, float]:
    """Return an enclosure of G without what is certainly not between the walls."""
    low, high = float(p.l), float(p.r)
    if low > p.l:
        low = math.nextafter(low, -math.inf)
    if high < p.r:
        high = math.nextafter(high, math.inf)
    return max(value[0], low), min(value[1], high)


def shortened(words: tuple[str, ...], side: str = "") -> tuple[str, ...]:
    """Return an itinerary without the hits and turns that a capture stands for, but for one hit.

    If the mass settles at the wall of a ``side``, without all of those there before the release,
    and with the word for them.
    """
    end = len(words) - 1
    last: tuple[str, ...] = (f"settle {side}",)
    if not side:
        end -= 1
        if end < 0 or not words[end].startswith("capture"):
            return words
        side = words[end][-1]
        last = f"hit {side}", words[end]
    many = f"hit {side}", f"turn {SIDES[side]}", f"capture {side}"
    begin = end
    while begin > 0 and words[begin - 1] in many:
        begin -= 1
    return (*words[:begin], *last, words[-1])


def turned(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return the mirror image of an itinerary."""
    return tuple(" ".join(MIRROR.get(part, part) for part in word.split()) for word in words)
