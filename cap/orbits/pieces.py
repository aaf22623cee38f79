"""Lemma B: a guard h is positive on a leg, which is cut in halves until it is so on each piece.

On a piece with the middle m and half-length r let D <= L² h.  By Taylor's formula

    h(t) >= h(m) + L h(m) (t - m) + D (t - m)²/2 >= h(m) - |L h(m)| r + min(D, 0) r²/2,

and h(t) >= h(m) - L h(m)²/(2 D) if D > 0.  A piece at whose start h vanishes, with length s, needs
L h + min(D, 0) s/2 > 0 there, or D > 0 if L h vanishes, too; one at whose end it does, the same
with -L h.
"""

from cap.orbits.along import Along
from cap.sets import interval
from cap.sets.interval import Ball

DEPTH = 30

Cut = float | None  # None: the end of the leg


def cuts_of(along: Along) -> list[float]:
    """Prove that h > 0 between the ends of a leg; return the times at which it was cut."""
    cuts: list[float] = []
    stack: list[tuple[Cut, Cut, int]] = [(None, None, 0)]
    while stack:
        a, b, depth = stack.pop()
        if not _is_positive(along, a, b):
            middle = (_double(a, along.leg.start.time) + _double(b, along.leg.end.time)) / 2
            h = along.height(Ball(middle))
            if h < 0 or depth == DEPTH:
                reason = "is negative" if h < 0 else "is not certain to be positive"
                raise along.failed(reason, Ball(middle), h)
            stack += [(middle, b, depth + 1), (a, middle, depth + 1)]
        elif b is not None:
            cuts.append(b)
    return cuts


def _double(cut: Cut, end: Ball) -> float:
    return float(end) if cut is None else cut


def _is_positive(along: Along, a: Cut, b: Cut) -> bool:
    """Return whether h > 0 on a piece, its ends apart where h vanishes there."""
    leg = along.leg
    starts, ends = a is None and along.vanishing > 0, b is None and along.last
    if starts and ends:
        return False
    begin, end = (
        (leg.start.time if a is None else Ball(a)),
        (leg.end.time if b is None else Ball(b)),
    )
    piece = interval.hull(begin, end)
    bend = interval.lower(along.bend(piece))
    dip = interval.least(bend, interval.ZERO)
    if starts and along.vanishing > 1:
        return along.vanishing == 2 and bool(bend > 0)
    if starts or ends:
        rate = along.rate(leg.start) if starts else -along.rate(leg.end)
        return bool(rate + dip * (end - begin) / 2 > 0)
    return _by_taylor(along, piece, bend, dip)


def _by_taylor(along: Along, piece: Ball, bend: Ball, dip: Ball) -> bool:
    middle = interval.point(piece)
    h, rate = along.line(middle)
    r = abs(piece - middle).abs_upper()
    if h - abs(rate) * r + dip * r * r / 2 > 0:
        return True
    return bool(bend > 0 and h - rate * rate / (2 * bend) > 0)
