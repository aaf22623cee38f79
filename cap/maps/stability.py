"""What kind of fixed point a planar map has, from the trace and determinant of its derivative.

The multipliers are the zeros of λ² - trace λ + det.  Where nothing loses phase space det = 1
exactly, and after a stick or a capture det = 0 exactly: the balls then have radius zero.
"""

from cap.errors import NotProved
from cap.sets.interval import Ball

SINKS = ("sink focus", "sink node", "superstable")

Multiplier = Ball | tuple[Ball, Ball]


def stability(trace: Ball, det: Ball) -> str:
    """Return the type; 0 <= det <= 1.  Raises `NotProved` if it is not certain.

    ``elliptic``: det is exactly 1, |trace| < 2.  ``sink focus`` and ``sink node``: both multipliers
    are inside the unit circle, not real and real.  ``superstable``: the same with one of them
    exactly 0.  ``saddle`` and ``flip saddle``: one is real and outside, positive or negative.
    """
    if trace > 1 + det:
        return "saddle"
    if trace < -1 - det:
        return "flip saddle"
    if abs(trace) < 1 + det:
        if det == 1:
            return "elliptic"
        if det.is_zero():
            return "superstable"
        if 0 < det < 1 and trace * trace < 4 * det:
            return "sink focus"
        if 0 < det < 1 and trace * trace > 4 * det:
            return "sink node"
    raise NotProved("stability", "its type is not certain", {"trace": trace, "determinant": det})


def multipliers(trace: Ball, det: Ball) -> tuple[Multiplier, Multiplier]:
    """Return the multipliers: real, the larger one first, or pairs (re, im), im > 0 first.

    Raises `NotProved` if they may be a double one.
    """
    if det.is_zero():
        return trace, Ball(0)
    half = trace / 2
    square = half * half - det
    if square > 0:
        return real_multipliers(trace, det)
    if square < 0:
        root = (-square).sqrt()
        return (half, root), (half, -root)
    sets = {"trace": trace, "determinant": det}
    raise NotProved("stability", "there may be a double multiplier", sets)


def real_multipliers(trace: Ball, det: Ball) -> tuple[Ball, Ball]:
    """Return the multipliers, the larger one first; the caller knows that trace² > 4 det > 0."""
    half = trace / 2
    root = (half * half - det).sqrt()
    larger = half + root if half > 0 else half - root
    return larger, det / larger
