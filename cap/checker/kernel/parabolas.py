"""Parabolas, and integers as text, as certificates list them.

An *edge* is q_0 + q_1 s + q_2 s^2, for s in [-1, 1], its coefficients integers in some unit.

*As text.*  An integer z is written as 2 z or, if negative, -2 z - 1, in bytes with seven bits of
it, least first, with 128 added to all but the last.  The bytes are compressed (zlib) and written in
base 85.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Iterator, Sequence
from itertools import pairwise

from cap.checker.kernel.rejection import Rejected, need

Edge = tuple[int, int, int]

BYTES = 1 << 24  # of a text


def integers(text: str) -> Iterator[int]:
    """Give the integers that are written in a text."""
    value, shift = 0, 0
    for byte in _unpacked(text):
        value |= (byte & 127) << shift
        shift += 7
        need(shift < 98, "an integer is too long")
        if byte < 128:
            yield value >> 1 if value % 2 == 0 else -(value >> 1) - 1
            value, shift = 0, 0
    need(shift == 0, "a text ends within an integer")


def _unpacked(text: str) -> bytes:
    """Return the bytes that are written in a text."""
    unpacking = zlib.decompressobj()
    try:
        found = unpacking.decompress(base64.b85decode(text), BYTES)
    except (ValueError, zlib.error):
        raise Rejected("a text is not in base 85, or not compressed") from None
    need(unpacking.eof and not unpacking.unused_data, "a text goes on, or is too long")
    return found


def ordered(edges: Sequence[Edge]) -> None:
    """Check that each edge is below the next: their difference is positive at s = -1 and 1, and at
    its minimum, -d_1/(2 d_2), if that lies between.
    """
    for low, high in pairwise(edges):
        a, b, c = (q - p for p, q in zip(low, high, strict=True))
        inside = abs(b) < 2 * c
        apart = a + c > abs(b) and (not inside or 4 * a * c > b * b)
        need(apart, "an edge is not below the next")
