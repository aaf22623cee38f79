"""Lemma B: a guard h is positive on a leg, which is cut in halves until it is so on each piece.

On a piece [a, b] of the length s let m <= L² h <= M.  By Taylor's formula h is positive

* by a chord, if h(a) and h(b) are above max(M, 0) s²/8;
* by a tangent, if h(a) + min(L h(a), 0) s + min(m, 0) s²/2 > 0; and so from b backwards;
* on a piece at whose start h vanishes, if L h + min(m, 0) s/2 > 0 there, or if M <= 0 and h(b) > 0;
  if L h vanishes, too, if m > 0; and so backwards on one at whose end it vanishes.
"""

from collections.abc import Callable
from functools import cache

from cap.orbits.along import Along
from cap.sets import interval
from cap.sets.interval import Ball

DEPTH = 40
PLACES = 10  # decimals of a cut

Cut = float | None  # None: the end of the leg
Lines = Callable[[float], tuple[Ball, Ball]]  # h and L h at a cut


def cuts_of(
    along: Along, longest: float = float("inf"), window: tuple[float, float] | None = None
) -> list[float]:
    """Prove that h > 0 between the ends of a leg; return the times at which it was cut.

    No piece is longer than ``longest``.  One of them may be a window, in which nothing is proved.
    """
    cuts: list[float] = []
    first, last = float(along.leg.start.time), float(along.leg.end.time)
    lines: Lines = cache(lambda t: along.line(Ball(t)))  # a cut is the end of several pieces
    stack: list[tuple[Cut, Cut, int]] = [(None, None, 0)]
    if window:
        stack = [(window[1], None, 0), (None, window[0], 0)]
        cuts = [window[1]]
    while stack:
        a, b, depth = stack.pop()
        begin, end = first if a is None else a, last if b is None else b
        if end - begin > longest or not is_positive(along, lines, a, b):
            middle = round((begin + end) / 2, PLACES)
            if depth == DEPTH or not begin < middle < end:
                raise _failed(along, middle)
            stack += [(middle, b, depth + 1), (a, middle, depth + 1)]
            if depth > 2 and along.height(Ball(middle)) < 0:
                raise _failed(along, middle)
        elif b is not None:
            cuts.append(b)
    return sorted(cuts)


def _failed(along: Along, time: float) -> Exception:
    h = along.height(Ball(time))
    return along.failed("is negative" if h < 0 else "is not certain to be positive", Ball(time), h)


def is_positive(along: Along, lines: Lines, a: Cut, b: Cut) -> bool:
    """Return whether h > 0 on a piece, its ends apart where h vanishes there."""
    leg = along.leg
    starts, ends = a is None and along.vanishing > 0, b is None and along.last > 0
    if starts and ends:
        return False
    begin = leg.start.time if a is None else Ball(a)
    end = leg.end.time if b is None else Ball(b)
    bend = along.bend(interval.hull(begin, end))
    s, concave = end - begin, bend <= 0
    dip = interval.least(interval.lower(bend), interval.ZERO) * s
    zeros = along.vanishing if starts else along.last if ends else 0
    if zeros > 1:
        return zeros == 2 and bool(bend > 0)
    if starts:
        return bool(along.rate(leg.start) + dip / 2 > 0 or (concave and along.height(end) > 0))
    if ends:
        return bool(-along.rate(leg.end) + dip / 2 > 0 or (concave and along.height(begin) > 0))
    sag = interval.ZERO if concave else interval.upper(bend) * s * s / 8
    low, rising = along.line(begin) if a is None else lines(a)
    high, falling = along.line(end) if b is None else lines(b)
    if low > sag and high > sag:
        return True
    down, up = (interval.least(r, interval.ZERO) * s for r in (rising, -falling))
    return bool(low + down + dip * s / 2 > 0 or high + up + dip * s / 2 > 0)
