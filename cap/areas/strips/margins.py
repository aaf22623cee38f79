"""Compiled, in doubles: the edges above which launches leave by the ceiling, and below which they
stop.  It steers; nothing rests on it.
"""

import math

from cap.areas.strips.cover import Cover, Floats, at, time
from cap.areas.strips.fit import through
from cap.areas.strips.hits import fly
from cap.sets.compiled import kernel, sources
from cap.sets.kept import kept

SLACK = 1e-7  # by which launches do it certainly
FIRST, WIDER, TRIES = 2e-7, 3.0, 12  # the bottom is so much lower than it might be
SAMPLES = 9  # of an edge


@kernel
def _ceiling(y: Floats, t: float) -> float:
    return float(y[4] - y[2] * math.cos(t - y[3]))


@kernel
def _stops(y: Floats, t: float, E: float) -> bool:
    return _ceiling(y, t) - SLACK > E and (E <= 0 or fly(t, math.sqrt(2 * E), y[0], y[1])[1] <= 0)


@kernel
def _bottom(cover: Cover, j: int, z: Floats) -> bool:
    """Find an edge on which launches stop."""
    y, p = cover.y, cover.bottom[j]
    for k in range(5):
        t, low = time(cover.lines, j, 0.5 * k - 1), 0.0
        high = _ceiling(y, t)
        for _ in range(50):
            middle = 0.5 * (low + high)
            if _stops(y, t, middle):
                low = middle
            else:
                high = middle
        z[k] = low
    inward = FIRST
    for _ in range(TRIES):
        through(z, p, -inward)
        good = True
        for k in range(SAMPLES):
            s = 2.0 * k / (SAMPLES - 1) - 1
            E = at(p, s)
            good = good and E > 0 and _stops(y, time(cover.lines, j, s), E)
        if good:
            return True
        inward *= WIDER
    return False


def _begin(cover: Cover, z: Floats) -> None:
    """Find tops and bottoms; ``z`` (5,) is room."""
    for j in range(len(cover.top)):
        for k in range(5):
            z[k] = _ceiling(cover.y, time(cover.lines, j, 0.5 * k - 1))
        through(z, cover.top[j], SLACK)
        cover.has_bottom[j] = _bottom(cover, j, z)


begin = kept(_begin, sources(), error_model="numpy")
