"""The cycles on which releases end, in floats: from them proofs start, and nothing is proved."""

import numpy as np

from cap.floats.releases import images, period_of
from cap.floats.request import Release
from cap.parameters import Parameters

PLACES = 400  # between the walls, from which releases are followed
TRANSIENT, LONGEST = 200, 16  # iterates before a cycle is looked for; its period
CLOSE = 1e-7  # of R


def release_cycles(p: Parameters) -> list[list[Release]]:
    """Return the attracting cycles on which releases from places between the walls end.

    Each begins at its least place; what ends at the segment, or comes back never, is left out.
    """
    l, R = float(p.l), float(p.R)
    x = l + R * (np.arange(PLACES) + 0.5) / PLACES
    for _ in range(TRANSIENT):
        x = images(p, x).value
        x = x[np.isfinite(x)]
    places, slopes = [x], []
    for _ in range(2 * LONGEST):
        found = images(p, places[-1])
        places.append(found.value)
        slopes.append(found.slope)
    late, steep, close = np.array(places), np.array(slopes), CLOSE * R
    cycles: list[list[Release]] = []
    for n in range(len(x)):
        cycle = _cycle(late[:, n], steep[:, n], close)
        if cycle and not any(abs(cycle[0].x - known[0].x) < 10 * close for known in cycles):
            cycles.append(cycle)
    return sorted(cycles)


def _cycle(places: np.ndarray, slopes: np.ndarray, close: float) -> list[Release]:
    """Return the cycle that an orbit is on, if it is an attracting one, from its least place on."""
    period = period_of(places[:, None], close)
    if not (period and abs(np.prod(slopes[:period])) < 1):
        return []
    least = int(np.argmin(places[:period]))
    turn = [(least + k) % period for k in range(period)]
    return [Release(float(places[k]), float(slopes[k])) for k in turn]
