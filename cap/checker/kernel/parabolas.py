"""Regions between parabolas, as a certificate lists them.

An *edge* is q_0 + q_1 s + q_2 s^2, for s in [-1, 1], its coefficients integers in some unit.

*As text.*  An integer z is written as 2 z or, if negative, -2 z - 1, in base 64, in digits of five
bits, least first, with 32 added to all but the last.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from cap.checker.kernel.rejection import need

Edge = tuple[int, int, int]

_DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
_VALUES = {digit: value for value, digit in enumerate(_DIGITS)}


def integers(text: str) -> list[int]:
    """Return the integers that are written in a text."""
    found, value, shift = list[int](), 0, 0
    for digit in text:
        need(digit in _VALUES and shift < 60, "a text is not a sequence of integers")
        value |= (_VALUES[digit] & 31) << shift
        shift += 5
        if _VALUES[digit] < 32:
            found.append(value >> 1 if value % 2 == 0 else -(value >> 1) - 1)
            value, shift = 0, 0
    need(shift == 0, "a text ends within an integer")
    return found


def endings(text: str) -> int:
    """Return how many integers are written in a text."""
    return sum(_VALUES.get(digit, 0) < 32 for digit in text)


def ordered(edges: Sequence[Edge]) -> None:
    """Check that each edge is below the next: their difference is positive at s = -1 and 1, and at
    its minimum, -d_1/(2 d_2), if that lies between.
    """
    for low, high in pairwise(edges):
        a, b, c = (q - p for p, q in zip(low, high, strict=True))
        inside = abs(b) < 2 * c
        apart = a + c > abs(b) and (not inside or 4 * a * c > b * b)
        need(apart, "an edge is not below the next")
