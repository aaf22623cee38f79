"""The area that two families of cells leave, in the columns of launches that they share.

Between the runs of a column lie *gaps*, from an edge up to the next.  A launch that is in no cell
of either family lies in a gap of both.  Their areas in (t, E) are bounded from above: a column is
cut into ``PARTS``; on a part of half-width d in s, an edge q lies above its chord by at most
max(0, -q_2) d^2 and below it by at most max(0, q_2) d^2.  So a gap lies between two lines, and two
gaps meet where

    w = min(b, d) - max(a, c) > 0,     a, c the lower lines and b, d the upper ones.

w is linear between the places where a = c and where b = d.

*Rounding.*  The ends of the lines are exact in doubles (`LARGEST` of the columns).  For numbers
below 2^12 each operation errs by less than 2^-40 in all: w where it is evaluated, and, as w is
concave, what chords between places that are not exact leave out, which is at most the difference of
two lines there.  So ``SLACK`` = 2^-36 per part of unit width is more than what is lost.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import accumulate

from cap.checker.kernel.parabolas import Edge
from cap.checker.kernel.rejection import need
from cap.checker.strips.columns import UNIT, Column

PARTS = 4
SLACK = 2.0**-36
HIGH = 2.0**12
MOST = 1 << 13  # pairs of gaps of a part of a column that may meet

Gap = tuple[Edge, Edge]
Line = tuple[float, float]
Work = Callable[..., list[float]]  # a map over tasks


def gaps(column: Column) -> list[Gap]:
    """Return the gaps of a column, from the lowest to the highest."""
    found, below = list[Gap](), (0, 0, 0)
    for run in column:
        if not run.bottom:
            found.append((below, run.edges[0]))
        below = run.edges[-1]
    return found


def mirrored(found: list[Gap]) -> list[Gap]:
    """Return gaps with -s for s."""
    return [((a, -b, c), (d, -e, f)) for (a, b, c), (d, e, f) in found]


def left(work: Work, forward: Iterable[list[Gap]], backward: Sequence[list[Gap]]) -> list[float]:
    """Return upper bounds of the areas that two families leave, for columns of width 1."""
    return work(_both, zip(forward, map(mirrored, reversed(backward)), strict=True))


def _both(columns: tuple[list[Gap], list[Gap]]) -> float:
    """Return the bound for one column."""
    return shared(*columns)


def shared(one: list[Gap], two: list[Gap]) -> float:
    """Return an upper bound of the area that lies in gaps of both, for a column of width 1."""
    return sum(_part(one, two, part) for part in range(PARTS)) / PARTS * (1 + 2.0**-40)


def _part(one: list[Gap], two: list[Gap], part: int) -> float:
    """Return the bound for one part, stretched to width 1."""
    first, second = ([_lines(gap, part) for gap in found] for found in (one, two))
    rest, others = _lowest(first), _lowest(second)  # lines, unlike edges, need not be in order
    areas, begin = list[float](), 0
    for k, (a, b) in enumerate(first):
        while begin < len(second) and max(second[begin][1]) <= rest[k]:
            begin += 1
        for n in range(begin, len(second)):
            if others[n] >= max(b):
                break
            need(len(areas) < MOST, "too many gaps may meet")
            areas.append(_meeting(a, b, *second[n]))
    return math.fsum(areas)


def _lowest(found: list[tuple[Line, Line]]) -> list[float]:
    """Return how low each and all after it come."""
    return list(accumulate((min(low) for low, _ in reversed(found)), min))[::-1]


def _lines(gap: Gap, part: int) -> tuple[Line, Line]:
    """Return lines below and above a gap, by their ends."""
    low, high = gap
    s, d = -1 + 2 * part / PARTS, 1 / PARTS
    return _chord(low, s, -max(0, low[2]) * d * d), _chord(high, s, max(0, -high[2]) * d * d)


def _chord(edge: Edge, s: float, by: float) -> Line:
    """Return the chord of an edge from s on, moved."""
    a, b, c = edge
    ends = [UNIT * (a + x * (b + x * c) + by) for x in (s, s + 2 / PARTS)]
    need(max(map(abs, ends)) < HIGH, "an edge is too high")
    return ends[0], ends[1]


def _meeting(a: Line, b: Line, c: Line, d: Line) -> float:
    """Return an upper bound of the integral of max(0, w) over [0, 1]."""
    places = [0.0, *sorted([*_crossing(a, c), *_crossing(b, d)]), 1.0]
    widths = [min(_at(b, x), _at(d, x)) - max(_at(a, x), _at(c, x)) for x in places]
    total, empty = 0.0, True
    for k in range(len(places) - 1):
        v, w = widths[k], widths[k + 1]
        if v <= 0 and w <= 0:
            continue
        part, empty = places[k + 1] - places[k], False
        if v < 0 or w < 0:
            high, low = max(v, w), min(v, w)
            part, v, w = part * high / (high - low), high, 0.0
        total += part * (v + w) / 2
    return total if empty else total + SLACK


def _crossing(p: Line, q: Line) -> list[float]:
    """Return where two lines cross within (0, 1)."""
    left, right = p[0] - q[0], p[1] - q[1]
    return [left / (left - right)] if left * right < 0 else []


def _at(p: Line, x: float) -> float:
    return p[0] + (p[1] - p[0]) * x
