"""Many orbits at once in floats, through all their events: hits, turns, sticking and capture.

The float counterpart of `cap.flow.strobe` for pictures, diagnostics and search: basins, portraits,
Lyapunov exponents, SALI.  No event is looked for with a time step: see `cap.floats.engine.events`,
which is compiled by numba.  `cap.floats.models.engine` follows any system; of this one it has 0.65
of the speed (`benchmarks/bench_swarm.py`), and no parts of periods: so it is written out here, and
a test compares the two.

``grazing`` says where rounding may have chosen between two itineraries: the speed and the force
that is left, |a| - f, vanish together, or the speed vanishes at one of its minima or at a wall, up
to 1e-12 of the natural unit.  The sign that was computed decides then.  A mass at rest where
|a| = f moves if |a| grows, and stays if it falls.  (Not rare: a mass released from a wall, which
sticks before the other, comes back exactly to the wall half a period later, at speed 0.)
"""

import math
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.errors import BadInput
from cap.floats.engine import events
from cap.floats.engine.events import Floats, Log
from cap.floats.engine.flight import FULL_TURN, Constants
from cap.flow.words import WORDS
from cap.parameters import Parameters

_WORTH_A_THREAD = 256  # orbits


@dataclass(frozen=True, slots=True)
class Swarm:
    """N orbits from time t0 over some forcing periods.

    ``states`` (N, 2) are (x, v) at the end; with ``every`` (N, K, 2), at the start, after each
    period, and at the end.  nan from where an orbit is lost.
    ``counts`` (N, 9) says how often each event of `WORDS` happened, ``first`` (N, 9) at which time
    t it first did (nan: never).  A release at the very end is not counted.
    ``monodromy`` (N, 2, 2) is the derivative of the last state in the first, columns (x, v); with
    ``every`` (N, K - 1, 2, 2), of each state in the one before; None unless asked for.  Not finite
    after a hit with speed 0, and where it overflows.
    ``grazing`` (N,): see above.  ``lost`` (N,): the start was not finite or not between the walls,
    or there were more than `events.TOO_MANY` events in a period (the mass was too fast; or f << F,
    e = 1, and μ made its bounces at a wall ever smaller without a capture).
    """

    states: Floats
    counts: NDArray[np.int64]
    first: Floats
    monodromy: Floats | None
    grazing: NDArray[np.bool_]
    lost: NDArray[np.bool_]

    def count(self, kind: str) -> NDArray[np.int64]:
        """Return how often, (N,), an event such as "turn left" happened, or of a kind: "turn"."""
        return np.asarray(self.counts[:, _columns(kind)].sum(axis=1))

    def first_time(self, kind: str) -> Floats:
        """Return the time t, (N,), of the first event of this kind; nan if there is none."""
        return np.asarray(np.fmin.reduce(self.first[:, _columns(kind)], axis=1))

    @property
    def turned(self) -> NDArray[np.bool_]:
        """Which orbits, (N,), turned between the walls."""
        return self.count("turn") > 0

    @property
    def stuck(self) -> NDArray[np.bool_]:
        """Which orbits, (N,), came to rest between the walls."""
        return self.count("stick") > 0

    @property
    def captured(self) -> NDArray[np.bool_]:
        """Which orbits, (N,), were captured at a wall."""
        return self.count("capture") > 0

    @property
    def stopped(self) -> NDArray[np.bool_]:
        """Which orbits, (N,), turned, came to rest or were captured."""
        return self.turned | self.stuck | self.captured

    @property
    def derivatives(self) -> Floats:
        """The ``monodromy``, which was asked for; else `TypeError`."""
        if self.monodromy is None:
            raise TypeError
        return self.monodromy


@dataclass(frozen=True, slots=True)
class Event:
    """An event at a time t, with the velocities just before and after it.

    Both are 0 at turns, sticks and releases.  Before a capture it is the velocity after the last
    hit that was computed; infinitely many smaller ones follow.
    """

    time: float
    word: str
    x: float
    before: float
    after: float


def follow(
    p: Parameters,
    states: ArrayLike,
    periods: float,
    t0: float = 0.0,
    *,
    every: bool = False,
    derivative: bool = False,
) -> Swarm:
    """Follow the orbits of ``states`` (N, 2) from t0 for ``periods`` T; a fraction is allowed.

    Each orbit is the same, to the last bit, whatever the others are.
    """
    units, ends = _Units.of(p, t0), _ends(periods)
    given = _array(states, 2)
    starts = units.starts(given)
    rows = np.full((len(starts), len(ends) + 1 if every else 1, 3), np.nan)
    rows[:, 0] = starts
    spans = (len(ends) if every else 1) if derivative else 0
    tangents = np.tile(np.eye(2).ravel(), (len(starts), spans, 1))
    log = _log(len(starts), 0)
    _in_threads(units.system, ends, rows, tangents, log)
    result = units.states(rows)
    if every or not len(ends):  # the starts without the rounding of the units
        result[:, 0] = np.where(np.isnan(result[:, 0]), np.nan, given)
    return Swarm(
        result if every else result[:, 0],
        log.counts,
        units.t0 + log.first / units.omega,
        units.derivatives(tangents if every else tangents[:, 0]) if derivative else None,
        log.flags[:, 0],
        log.flags[:, 1],
    )


def itinerary(
    p: Parameters, state: ArrayLike, periods: float, t0: float = 0.0
) -> tuple[Event, ...]:
    """Return the events of one orbit in their order: at t0, and up to the end of the periods."""
    units, ends = _Units.of(p, t0), _ends(periods)
    starts = units.starts(_array(state, 1)[None, :])
    room = 64
    while True:
        log = _log(1, room)
        events.follow(units.system, ends, starts[:, None].copy(), np.empty((1, 0, 4)), log)
        count = int(log.counts.sum())
        if count <= room:
            return tuple(units.event(row) for row in log.table[:count])
        room = count


def stretch(monodromy: Floats, vectors: ArrayLike) -> tuple[Floats, Floats]:
    """Carry deviations along orbits: Lyapunov exponents, SALI and GALI are functions of these.

    ``monodromy`` (N, K, 2, 2) is that of `follow` with ``every``; ``vectors`` broadcasts to
    (N, M, 2).  Returns the unit vectors (N, K, M, 2) after each period, and the logarithms
    (N, K, M) of the factors by which they had grown before they were made unit vectors: -inf where
    the derivative takes one to 0, from where on it is 0.  To go on, pass the last ones.
    """
    n, periods = monodromy.shape[:2]
    w = np.asarray(vectors, dtype=float)
    w = np.broadcast_to(w, (n, *w.shape[-2:]))
    units, growth = np.empty((n, periods, *w.shape[1:])), np.empty((n, periods, w.shape[1]))
    for k in range(periods):
        M = monodromy[:, k, None]
        w = M[..., 0] * w[..., :1] + M[..., 1] * w[..., 1:]
        length = np.hypot(w[..., 0], w[..., 1])
        with np.errstate(divide="ignore"):
            growth[:, k] = np.log(length)
        w = w / np.where(length == 0, 1.0, length)[..., None]
        units[:, k] = w
    return units, growth


def _columns(kind: str) -> list[int]:
    found = [i for i, word in enumerate(WORDS) if kind in (word, word.split()[0])]
    if not found:
        raise BadInput(f"no such event: {kind!r} (one of {', '.join(WORDS)})")
    return found


def _array(states: ArrayLike, axes: int) -> Floats:
    result = np.asarray(states, dtype=float)
    if result.ndim != axes or result.shape[-1] != 2:
        raise BadInput(f"states must be pairs (x, v): not an array of shape {result.shape}")
    return result


def _ends(periods: float) -> Floats:
    """Return the phases at which the periods end: 2π, but for a last fraction."""
    if not (math.isfinite(periods) and periods >= 0):
        raise BadInput(f"the number of periods must be finite and not negative: {periods!r}")
    fraction, whole = math.modf(periods)
    ends = np.full(int(whole) + (fraction > 0), FULL_TURN)
    if fraction > 0:
        ends[-1] = fraction * FULL_TURN
    return ends


def _log(n: int, room: int) -> Log:
    words = len(WORDS)
    counts, first = np.zeros((n, words), dtype=np.int64), np.full((n, words), np.nan)
    return Log(counts, first, np.zeros((n, 2), dtype=np.bool_), np.empty((room, 7)))


def _in_threads(system: Constants, ends: Floats, rows: Floats, tangents: Floats, log: Log) -> None:
    """Follow the orbits, those of each thread in one piece: the compiled code releases the GIL."""
    pieces = max(1, min(os.cpu_count() or 1, len(rows) // _WORTH_A_THREAD))
    cuts = [len(rows) * k // pieces for k in range(pieces + 1)]

    def follow_piece(k: int) -> None:
        own = slice(cuts[k], cuts[k + 1])
        mine = Log(log.counts[own], log.first[own], log.flags[own], log.table)
        events.follow(system, ends, rows[own], tangents[own], mine)

    if pieces == 1:
        follow_piece(0)
        return
    with ThreadPoolExecutor(pieces) as pool:
        list(pool.map(follow_piece, range(pieces)))


@dataclass(frozen=True, slots=True)
class _Units:
    """The system in units of 1/ω and F/ω², and the way there and back."""

    system: Constants
    length: float
    speed: float
    omega: float
    walls: tuple[float, float]
    t0: float

    @classmethod
    def of(cls, p: Parameters, t0: float) -> "_Units":
        if not math.isfinite(t0):
            raise BadInput(f"the time must be finite: t0 = {t0!r}")
        phase = float(p.omega) * t0 % FULL_TURN
        arc = math.acos(p.f / p.F)
        knots = -arc, math.pi - arc, arc, math.pi + arc  # slow, fast; each to the right, the left
        alpha, m, e, width = map(float, (p.f / p.F, p.mu / p.omega, p.e, p.R * p.omega**2 / p.F))
        system = Constants(
            alpha, m, e, width, phase, *((knot - phase) % FULL_TURN for knot in knots)
        )
        speed, length = p.F / p.omega, p.F / p.omega**2
        walls = float(p.l), float(p.r)
        return cls(system, float(length), float(speed), float(p.omega), walls, float(t0))

    def starts(self, states: Floats) -> Floats:
        """Return v, the nearer wall and the distance from it."""
        l, r = self.walls
        x, v = states[:, 0], states[:, 1]
        right = r - x < x - l
        depth = np.where(right, r - x, x - l) / self.length
        return np.stack([v / self.speed, np.where(right, 1.0, -1.0), depth], axis=-1)

    def states(self, rows: Floats) -> Floats:
        """Return (x, v) from what `starts` gives."""
        x = self._position(rows[..., 1], rows[..., 2])
        return np.stack([x, rows[..., 0] * self.speed], axis=-1)

    def derivatives(self, tangents: Floats) -> Floats:
        """Return the derivatives in the units of the parameters."""
        units = np.array([[1.0, 1 / self.omega], [self.omega, 1.0]])
        return np.asarray(tangents.reshape(*tangents.shape[:-1], 2, 2) * units)

    def event(self, row: Floats) -> Event:
        period, phase, word, wall, depth, before, after = map(float, row)
        time = self.t0 + (FULL_TURN * period + phase) / self.omega
        x = float(self._position(np.asarray(wall), np.asarray(depth)))
        return Event(time, WORDS[int(word)], x, before * self.speed, after * self.speed)

    def _position(self, wall: Floats, depth: Floats) -> Floats:
        l, r = self.walls
        beside = depth * self.length
        return np.asarray(np.clip(np.where(wall > 0, r - beside, l + beside), l, r))
