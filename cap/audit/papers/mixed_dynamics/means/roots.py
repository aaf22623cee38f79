"""All roots of a function on an interval, in balls."""

from collections.abc import Callable
from fractions import Fraction

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

DEEPEST = 90  # bisections of the interval


def roots(
    function: Callable[[Ball], Ball],
    slope: Callable[[Ball], Ball],
    low: Ball,
    high: Ball,
    width: Fraction = Fraction(1),
) -> list[Ball]:
    """Return disjoint enclosures of all zeros in [low, high], each with one zero, ascending.

    Intervals are bisected until the function has a sign, or is monotone with opposite signs at the
    ends, on no more than this width.  Raises `NotProved` if that does not come to an end.
    """
    found: list[Ball] = []
    todo = [(interval.ends(interval.hull(low, high)), 0)]
    while todo:
        (a, b), depth = todo.pop()
        if depth > DEEPEST:
            raise NotProved("roots", "an interval stays undecided", {"near": (float(a), float(b))})
        whole = interval.hull(interval.ball(a), interval.ball(b))
        value, rate = function(whole), slope(whole)
        if value > 0 or value < 0:
            continue
        ends = function(interval.ball(a)), function(interval.ball(b))
        signed = all(end > 0 or end < 0 for end in ends)
        if (rate > 0 or rate < 0) and signed and b - a <= width:
            if (ends[0] > 0) is not bool(ends[1] > 0):
                found.append(whole)
            continue
        middle = (a + b) / 2
        todo += [((middle, b), depth + 1), ((a, middle), depth + 1)]
    return found
