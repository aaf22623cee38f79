"""What intervals of doubles leave undecided of the table of the release map, by Taylor models."""

import math
from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from heapq import heappop, heappush
from typing import Any

from cap.errors import BadInput, NotProved
from cap.flow.event import Expected
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.flow.windows import Itinerary
from cap.parameters import Parameters
from cap.release.cell import cell, slack
from cap.release.passage import foreseen, words
from cap.release.rows import Row, clipped, gaps_between, shortened
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 128
MOST = 400  # cells
FINEST = Fraction(1, 2**40)  # of R


def refined(p: Parameters, rows: Sequence[Row], periods: int, allowed: Fraction) -> list[Row]:
    """Return the rows with more of them in the gaps, the longest first, until what is left of these
    is less than is ``allowed``, or cells are too many."""
    rows, heap = list(rows), list[tuple[Fraction, Fraction, Fraction]]()
    for a, b in gaps_between(p, rows):
        heappush(heap, (a - b, a, b))
    left = sum((b - a for _, a, b in heap), Fraction(0))
    with interval.workprec(BITS):
        osc = oscillator(p)
        for _ in range(MOST):
            if left <= allowed or not heap or heap[0][1] - heap[0][2] > -FINEST * p.R:
                break
            _, a, b = heappop(heap)
            found = _row(osc, p, (a, b), periods)
            if found is not None:
                rows.append(found)
                left -= b - a
                continue
            middle = Fraction(float((a + b) / 2))
            for part in ((a, middle), (middle, b)):
                if part[0] < part[1]:
                    heappush(heap, (part[0] - part[1], *part))
    return sorted(rows)


def _row(
    osc: Oscillator[Any], p: Parameters, ends: tuple[Fraction, Fraction], periods: int
) -> Row | None:
    """Return what is proved of a cell whose ends are doubles, if it is."""
    a, b = float(ends[0]), float(ends[1])
    if (Fraction(a), Fraction(b)) != ends:
        return None
    try:
        found = cell(osc, *ends, _expected(p, a, b))
    except (NotProved, BadInput):
        return None
    if found.half_periods >= 2 * periods:
        return None
    kind = shortened(tuple(event.word for event in found.times)), found.half_periods
    return Row(a, b, kind, clipped(p, outward(found.value)), outward(found.slope))


def _expected(p: Parameters, a: float, b: float) -> Itinerary:
    """Return the events foreseen in the middle, with their times at the ends in the windows.

    It steers: windows that are too narrow are enlarged one by one, which takes long.
    """
    events = foreseen(p, (a + b) / 2)[0]
    for end in (a, b):
        with suppress(BadInput):
            others = foreseen(p, end)[0]
            if words(others) == words(events):
                both = zip(events, others, strict=True)
                events = tuple(
                    Expected(e.word, interval.hull(e.window, other.window)) for e, other in both
                )
    return slack(events)


def outward(x: Ball) -> tuple[float, float]:
    """Return doubles below and above a ball."""
    low, high = interval.ends(x)
    a, b = float(low), float(high)
    return (
        a if a <= low else math.nextafter(a, -math.inf),
        b if b >= high else math.nextafter(b, math.inf),
    )
