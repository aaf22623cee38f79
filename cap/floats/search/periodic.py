"""Search for T-periodic orbits whose velocity never vanishes, in floats.

The orbits found steer the prover.  That one is found is no proof that it exists, and that none is
found is no proof that there is none: Newton's method starts from finitely many seeds.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cap.errors import BadInput
from cap.floats.engine import flow, lifted
from cap.floats.engine.lifted import Array, Ratios
from cap.flow.itinerary import oscillator
from cap.parameters import Parameters
from cap.sets import matrix
from cap.sets.matrix import Matrix

SAME = 1e-8  # orbits whose states at t = 0 differ by less (relative) are one orbit
MOST_HITS = 6  # per period: the search goes no further
EDGE = 1e-9  # a hit so near t = 0 (in periods) has no itinerary: it may fall on either side


@dataclass(frozen=True)
class Guess:
    """A float orbit of period T, through (x, v) at t = 0; it only steers the prover.

    ``hits`` are their times in (0, T), ascending, and the velocities just before; ``least_speed``
    is the minimum of |v|, and positive.
    """

    x: float
    v: float
    hits: tuple[tuple[float, float], ...]
    monodromy: Matrix[float]
    least_speed: float

    @property
    def hit_times(self) -> tuple[float, ...]:
        """The times of its hits."""
        return tuple(time for time, _ in self.hits)

    @property
    def trace(self) -> float:
        """The trace of the monodromy matrix."""
        return matrix.trace(self.monodromy)

    @property
    def kind(self) -> str:
        """``"elliptic"`` if |trace| < 2, else ``"saddle"``."""
        return "elliptic" if abs(self.trace) < 2 else "saddle"


def orbits(p: Parameters, hits: int) -> list[Guess]:
    """Return the orbits found with ``hits`` wall hits per period, ascending in x, then v.

    Raises `BadInput` unless ``hits`` is even and positive: the walls are hit in turn.
    """
    if hits < 2 or hits % 2:
        raise BadInput(f"the number of hits per period must be 2, 4, 6, ...: {hits}")
    ratios = _ratios(p)
    times = lifted.newton(lifted.seeds(hits), ratios)
    _, speeds = lifted.slowest(times, ratios)
    times = times[speeds.min(axis=1) > 0]
    times = _distinct(times[lifted.is_isolated(times, ratios)], ratios)
    times = _distinct(np.concatenate([times, lifted.mirror(times)]), ratios)
    guesses = [_guess(p, row, ratios) for row in times if not _at_edge(row)]
    return sorted(guesses, key=lambda g: (g.x, g.v))


def through(p: Parameters, hit_times: Sequence[float], *, right_first: bool) -> Guess:
    """Return the periodic orbit that hits the walls in turn at these times, ascending in (0, T)."""
    row = float(p.omega) * np.array(hit_times)
    if not right_first:
        row = np.append(row[1:], row[0] + lifted.PERIOD)
    return _guess(p, row, _ratios(p))


def near(p: Parameters, x: float, v: float) -> Guess:
    """Return the periodic orbit to which Newton's method leads from the itinerary of (x, v).

    The orbit of (x, v) may turn; then its lifted form is the start.  Raises `BadInput` if (x, v) is
    no state between the walls with v != 0, or if no genuine periodic orbit is reached.
    """
    o = oscillator(p)
    try:
        times = o.omega * np.array(flow.hit_times(o, x, v))
    except flow.Turns as grazes:
        raise BadInput(f"({x!r}, {v!r}) is no start: {grazes}") from None
    complaint = "its orbit turns, or the period ends, before it hits a wall"
    for start in _itineraries(times, starts_left=v < 0):
        found = lifted.newton(start[None], _ratios(p))
        complaint = _complaint(p, found)
        if not complaint:
            return _guess(p, found[0], _ratios(p))
    raise BadInput(f"no periodic orbit found from ({x!r}, {v!r}): {complaint}")


def _itineraries(times: Array, *, starts_left: bool) -> list[Array]:
    """Return the rows of hit times, the first of the right wall, to start Newton's method from.

    An odd number of hits is not periodic: the last and the next first are of one wall.  Then the
    last is one too many, or one between them is missing.
    """
    if not len(times):
        return []
    rows = [times]
    if len(times) % 2:
        missing = (times[-1] + times[0] + lifted.PERIOD) / 2
        rows = [row for row in (times[:-1], np.append(times, missing)) if len(row)]
    if starts_left:
        rows = [np.append(row[1:], row[0] + lifted.PERIOD) for row in rows]
    return rows


def _complaint(p: Parameters, found: Array) -> str:
    """Say what is wrong with the outcome of Newton's method, of shape (0, N) or (1, N), or ""."""
    if not len(found):
        return "Newton's method for the hit times does not converge"
    if _at_edge(found[0]):
        return "Newton's method leads to an orbit that hits a wall at t = 0"
    when, speeds = (part[0] for part in lifted.slowest(found, _ratios(p)))
    k = speeds.argmin()
    if speeds[k] > 0:
        return ""
    t = float(when[k] % lifted.PERIOD / p.omega)
    return f"Newton's method leads to an orbit that is not genuine: it turns before t = {t:.6g}"


def _ratios(p: Parameters) -> Ratios:
    return Ratios(float(p.f / p.F), float(p.R * p.omega**2 / p.F))


def _at_edge(times: Array) -> bool:
    phase = times / lifted.PERIOD
    return bool(np.abs(phase - np.rint(phase)).min() < EDGE)


def _distinct(times: Array, ratios: Ratios) -> Array:
    """Return one row for each orbit: orbits of period T are the same if their states at 0 are."""
    states = lifted.states(times, ratios)
    same = SAME * max(1.0, ratios.rho)
    chosen = []
    left = np.arange(len(times))
    while len(left):
        chosen.append(left[0])
        left = left[np.abs(states[left] - states[left[0]]).max(axis=1) > same]
    return times[chosen]


def _guess(p: Parameters, times: Array, ratios: Ratios) -> Guess:
    """Return the orbit with these lifted hit times, shape (N,), in the units of ``p``."""
    o = oscillator(p)
    length, speed = float(p.F / p.omega**2), float(p.F / p.omega)
    row = times[None]
    signs, _, _, end = lifted.flights(row, ratios)
    hit_times = row[0] % lifted.PERIOD / o.omega
    velocities = speed * np.roll(signs * end[0], 1)
    hits = sorted(zip(hit_times.tolist(), velocities.tolist(), strict=True))
    distance, velocity = lifted.states(row, ratios)[0].tolist()
    return Guess(
        x=o.l + length * distance,
        v=speed * velocity,
        hits=tuple(hits),
        monodromy=flow.monodromy(o, hits),
        least_speed=speed * float(lifted.slowest(row, ratios)[1].min()),
    )
