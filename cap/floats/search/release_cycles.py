"""The cycles on which releases end, in floats: from them proofs start, and nothing is proved."""

import math
from collections.abc import Iterable

import numpy as np

from cap.floats.engine.releases import images, period_of
from cap.floats.findings import Floats
from cap.floats.search.request import Release
from cap.parameters import Parameters

PLACES = 400  # between the walls, from which releases are followed
TRANSIENT, LONGEST = 200, 16  # iterates before a cycle is looked for; its period
CLOSE = 1e-7  # of R
NEAR = 1e-3  # of R: a cycle is so near to the places of an orbit that comes to it
STEPS, LAST = 8, 1e-11  # of Newton's method at most; the size of the last one, of R
Cycle = list[Release]


def release_cycles(p: Parameters) -> list[Cycle]:
    """Return the attracting cycles on which releases from places between the walls end.

    Each begins at its least place; what ends at the segment, or comes back never, is left out.
    """
    l, R = float(p.l), float(p.R)
    x = l + R * (np.arange(PLACES) + 0.5) / PLACES
    for _ in range(TRANSIENT):
        x = images(p, x).value
        x = x[np.isfinite(x)]
    late = [x]
    for _ in range(2 * LONGEST):
        late.append(images(p, late[-1]).value)
    places = np.array(late)
    periods = [period_of(places[:, [k]], CLOSE * R) for k in range(len(x))]
    found = cycles(p, zip(places[0].tolist(), periods, strict=True))
    return sorted(_from_least(cycle) for cycle in found if cycle)


def settled(p: Parameters, iterates: Floats, close: float) -> int:
    """Return the period of the attracting cycles that orbits (N, K), the columns, are on; or 0.

    Their period is one to within ``close`` of R; the cycles are those of `attracting`, and their
    periods the same.  Columns that end, with NaN, do not count.
    """
    period = period_of(iterates, close * float(p.R))
    last = iterates[-1][np.isfinite(iterates).all(axis=0)]
    periods = {len(cycle) for cycle in cycles(p, ((x, period) for x in last.tolist()))}
    return periods.pop() if len(periods) == 1 else 0


def cycles(p: Parameters, ends: Iterable[tuple[float, int]]) -> list[Cycle]:
    """Return the cycles of `attracting` near places with a period, each once.

    An empty one is among them for each place near which there is none.
    """
    found: list[Cycle] = []

    def known(x: float) -> bool:
        return any(abs(x - each.x) < 10 * CLOSE * float(p.R) for cycle in found for each in cycle)

    for x, period in ends:
        if not known(x):
            cycle = attracting(p, x, period)
            if not (cycle and known(cycle[0].x)):
                found.append(cycle)
    return found


def attracting(p: Parameters, x: float, period: int) -> Cycle:
    """Return the attracting cycle near a place of which ``period`` seems to be a period, or none.

    Of the divisors of that it is the first for which Newton's method leads to a cycle nearby with a
    product of slopes below 1 in modulus: so a cycle that attracts like (-0.95)^n, where every
    second turn is closer than the next one, is not taken for one of twice its period.
    """
    for n in (n for n in range(1, period + 1) if period % n == 0):
        cycle = _newton(p, x, n)
        near = bool(cycle) and abs(cycle[0].x - x) < NEAR * float(p.R)
        if near and abs(math.prod(each.slope for each in cycle)) < 1:
            return cycle
    return []


def _newton(p: Parameters, x: float, n: int) -> Cycle:
    """Return the cycle of n places to which Newton's method leads from a place, or none."""
    for _ in range(STEPS):
        cycle, end = _orbit(p, x, n)
        slope = math.prod(each.slope for each in cycle)
        if not math.isfinite(end) or slope == 1:
            return []
        step = (end - x) / (1 - slope)
        if abs(step) < LAST * float(p.R):
            return cycle
        x += step
    return []


def _orbit(p: Parameters, x: float, n: int) -> tuple[Cycle, float]:
    """Return n releases, from a place on, and the place of the next one."""
    found: Cycle = []
    for _ in range(n):
        image = images(p, [x])
        found.append(Release(x, float(image.slope[0])))
        x = float(image.value[0])
    return found, x


def _from_least(cycle: Cycle) -> Cycle:
    """Return a cycle from its least place on."""
    least = cycle.index(min(cycle))
    return cycle[least:] + cycle[:least]
