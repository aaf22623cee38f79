"""Compiled: a region of a strip followed backwards, and the areas of the states that enter it.

A strip is a set of states at t = 0 with one fate: see `cap.checker.folded.strips`.  Backwards its
states begin at the time pi, folded, with the density 1.  A region lies between two edges q = e_0 +
e_1 Y + e_2 Y² over speeds middle + half Y.  What enters it are the states at the odd multiples of
pi that are passed, as long as all have been outside of the strip at each before.
"""

import math
from typing import NamedTuple

from cap.cells.backward import PI_ERROR, ROUND, Event, Flight, System
from cap.cells.polynomials import (
    LAST,
    Model,
    between,
    ends,
    exact,
    integral_below,
    moved,
    scaled,
    total,
)
from cap.cells.regions import (
    APART,
    NONE,
    Limits,
    Region,
    Seen,
    after,
    first,
    known,
    next_of,
    passing,
    sides,
    slow_at,
    spread,
)
from cap.sets.compiled import kernel

ALL = 1 - 2.0**-40  # of a sum of areas, less rounding


class Strip(NamedTuple):
    """The states (x, s) with |w| < d, x and x + k w in (left, right), w = s - v, v in [slow, fast].

    x = edge - W - p.  There is no strip if d is 0.
    """

    left: float
    right: float
    slow: float
    fast: float
    d: float
    k: float
    edge: float
    edge_error: float


NOWHERE = Strip(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def _entry(r: Region) -> tuple[Flight, Model]:
    """Return the flight from the strip, and its density in X and Y."""
    place, wide = sides(r)
    size = (abs(r.middle) + r.half) * ROUND
    A = between((r.middle, r.half, 0.0), NONE, size)
    B = moved(place, -1.0, ROUND)
    density = scaled(wide, r.half, size)
    errors = A[LAST], B[LAST]
    far = PI_ERROR + 8 * ROUND
    begun = math.pi - far, math.pi + far
    f = Flight(exact(A), exact(B), (1.0, 0.0, 0.0, 1.0), errors, errors, math.pi, begun, 1)
    return f, density


@kernel
def _other(strip: Strip, least: float, most: float) -> bool:
    """Return whether speeds between these are outside a strip."""
    return most < strip.slow - strip.d or least > strip.fast + strip.d


@kernel
def _beyond(strip: Strip, x: Model) -> bool:
    """Return whether all x are outside."""
    low, high = ends(x)
    return high < strip.left or low > strip.right


@kernel
def _outside(y: System, strip: Strip, p: Model, s: Model) -> bool:
    """Return whether all states are outside a strip."""
    least, most = ends(s)
    if _other(strip, least, most):
        return True
    error = strip.edge_error + y.width_error + (abs(strip.edge) + y.width) * ROUND
    x = moved(scaled(p, -1.0, 0.0), strip.edge - y.width, error)
    w = moved(s, -0.5 * (strip.fast + strip.slow), strip.fast - strip.slow)
    return _beyond(strip, x) or _beyond(strip, total(x, scaled(w, strip.k, 0.0)))


@kernel
def _flown(
    y: System, strip: Strip, f: Flight, density: Model, V: float, passed: int
) -> tuple[bool, float, int]:
    """Return whether all is outside at the strobes passed for certain, the area there, the next."""
    area, j = 0.0, first(f)
    while True:
        flying, p, s = passing(y, f, j)
        if not flying:
            return True, area, j
        if (j + passed) % 2:
            if not _outside(y, strip, p, s):
                return False, area, j
            area += integral_below(density, s, V)
        j += 1


@kernel
def _during(strip: Strip, event: Event, j: int, passed: int) -> tuple[bool, int]:
    """Return whether all is outside at the strobes from j pi on not after an event, and the next.

    s changes at a rate below 2.
    """
    while j * math.pi <= event.ends[1]:
        more = 2 * (event.ends[1] - min(j * math.pi, event.ends[0]) + APART)
        if (j + passed) % 2 and not _other(strip, event.least - more, event.most + more):
            return False, j
        j += 1
    return True, j


@kernel
def entered(y: System, strip: Strip, r: Region, limits: Limits) -> Seen:
    """Follow a region of a strip backwards as long as it is certain what happens."""
    f, density = _entry(r)
    area, last, passed, coming = 0.0, 0, 0, 2
    for n in range(limits.flights):
        if not known(f, limits.size) or first(f) + passed != coming:
            break
        outside, got, j = _flown(y, strip, f, density, limits.V, passed)
        kind, event = next_of(y, f)
        if outside and event.why == 0:
            begin = j + (j + passed + 1) % 2
            outside, j = _during(strip, event, j, passed)
            for k in range(begin, j, 2):
                got += slow_at(y, f, density, event, k, limits.V)
        if got > 0:
            area, last = area + got, n + 1
        if not outside or event.why != 0:
            break
        coming = j + passed
        f, density = after(y, f, density, kind, event)
        passed += round((event.near - f.ref) / math.pi)
    across, far = spread(f)
    return Seen(area * ALL, 0.0, last, across, far)
