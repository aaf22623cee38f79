"""The constants of the folded flow (`.backward`, `.paths`), enclosed."""

import math
from fractions import Fraction

from cap.areas.folded.backward import Constants
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.doubles import Interval, enclosing
from cap.sets.interval import Ball

BITS = 200


def system_of(p: Parameters, *, forwards: bool = False) -> Constants:
    """Return the constants of the flow, backwards or forwards, enclosed.

    Theta is pi - arccos a backwards, and arccos a forwards.
    """
    a, width = p.f / p.F, (p.r - p.l) * p.omega**2 / p.F
    with interval.workprec(BITS):
        ratio = interval.ball(a)
        theta = ratio.acos() if forwards else interval.pi() - ratio.acos()
        sine = ((1 - ratio) * (1 + ratio)).sqrt()
        found = enclosing(a), enclosing(width), of_ball(theta), of_ball(sine)
    return Constants(*(end for q in found for end in (q.mid, q.rad)))


def of_ball(x: Ball) -> Interval:
    """Return an interval around the nearest double that contains a ball."""
    low, high = interval.ends(x)
    mid = float((low + high) / 2)
    gap = max(high - Fraction(mid), Fraction(mid) - low)
    rad = float(gap)
    return Interval(mid, rad if Fraction(rad) >= gap else math.nextafter(rad, math.inf))
