"""The flow of N masses between two walls in floats; nothing rigorous trusts it.

    m_i x_i'' = F cos ωt - f_i sgn x_i',      l <= x_1 <= .. <= x_N <= r,      f_i = f, or f m_i,

with elastic hits and collisions (eq:Nparticle, eq:Ncollision): `cap.system.masses`, followed by
`cap.floats.models.engine`.  A mass whose velocity becomes 0 turns, or rests until it is released
or another one hits it.  Contacts that accumulate, and masses that stay in contact, are refused:
`Unresolved`.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from cap.errors import BadInput
from cap.floats.models.closing import logged, product
from cap.floats.models.engine import Engine
from cap.floats.models.legs import NONE, Legs
from cap.floats.models.source import MANY, NO_MODE
from cap.parameters import Parameters
from cap.system import masses as models

SLOWEST = 1e-9  # closing speed of a contact, of F/(ω m): slower ones are about to accumulate
NEAR = 1e-13  # of a period: two times that rounding may have made different

Floats = npt.NDArray[np.float64]


class Unresolved(Exception):
    """Contacts accumulate, or last, at ``time``: this engine does not follow the motion there."""

    def __init__(self, time: float, why: str) -> None:
        self.time = time
        super().__init__(f"{why} at t = {time:.6g}")


@dataclass(frozen=True)
class Particles:
    """The system: exact parameters and masses; with ``proportional`` friction f_i = f m_i.

    Raises `BadInput` unless masses are positive, friction is below the forcing, e = 1 and μ = 0.
    """

    parameters: Parameters
    masses: tuple[Fraction, ...]
    proportional: bool = False

    def __post_init__(self) -> None:
        """Raise `BadInput` for what is no such system."""
        if not self.masses or min(self.masses) <= 0:
            raise BadInput("give at least one mass, and positive ones")
        if not self.parameters.conserves:
            raise BadInput("particles have elastic walls and no viscosity: e = 1, mu = 0")
        for f in self.friction:
            replace(self.parameters, f=f)

    @property
    def friction(self) -> tuple[Fraction, ...]:
        """All f_i."""
        f = self.parameters.f
        return tuple(f * m if self.proportional else f for m in self.masses)

    @property
    def period(self) -> float:
        """T = 2π/ω."""
        return 2 * math.pi / float(self.parameters.omega)


@lru_cache(maxsize=8)
def engine(system: Particles) -> Engine:
    """Return the flow of a system; few orbits are followed of each."""
    p, m, law = system.parameters, system.masses, system.proportional
    return Engine(models.masses(p, m, proportional=law), interpreted=True)


@dataclass(frozen=True, slots=True)
class Event:
    """What happens: ``word`` (as "hit l", "meet 1 2", "turn 2 left", "stick 1"), when and where.

    ``positions`` are those of all masses, ``before`` and ``after`` their velocities.
    """

    word: str
    time: float
    x: float
    positions: tuple[float, ...]
    before: tuple[float, ...]
    after: tuple[float, ...]


@dataclass(frozen=True)
class Path:
    """The events of an orbit, x and v of the masses at its end, and its ``legs``.

    ``least_speed`` is the minimum of all |v_i|: 0 if a mass turns or rests.
    """

    events: tuple[Event, ...]
    x: tuple[float, ...]
    v: tuple[float, ...]
    legs: Legs
    least_speed: float

    @cached_property
    def monodromy(self) -> Floats:
        """The derivative of the end in the start, in the order (x_1, .., x_N, v_1, .., v_N)."""
        return product(self.legs.derivatives())

    def state(self, time: float) -> Floats:
        """Return (x, v) so long after the start."""
        k = min(int(np.searchsorted(self.legs.end, time)), len(self.legs.end) - 1)
        return np.asarray(self.legs.at(k, np.array([time - self.legs.begin[k]]))[0])

    @property
    def words(self) -> tuple[str, ...]:
        """The itinerary."""
        return tuple(event.word for event in self.events)


def follow(
    system: Particles, x: Sequence[float], v: Sequence[float], end: float, start: float = 0.0
) -> Path:
    """Follow the orbit of (x, v) from the time ``start`` to ``end``.

    Raises `BadInput` unless l < x_1 < .. < x_N < r and all v are finite; `Unresolved` where
    contacts accumulate or last.  Simultaneous events are taken one by one.
    """
    _check(system, x, v)
    flow, n = engine(system), len(system.masses)
    states, phase = np.array([[*x, *v]], dtype=float), start * float(system.parameters.omega)
    modes = np.array([flow.modes.index(mode(system, v, phase))])
    periods = max(1, math.ceil((end - start) / system.period - NEAR))
    ends = logged(flow, states, modes, periods, phase)
    log = ends.log[ends.log[:, 1] <= end - start]
    if ends.flags[0] & (MANY | NO_MODE) and len(log) == len(ends.log):
        raise Unresolved(start + max(log[:, 1], default=0.0), "contacts accumulate, or last,")
    legs = Legs.of(flow, states, modes, replace(ends, log=log), end - start, phase)
    arrivals = np.vstack([legs.at(k, np.array([d])) for k, d in enumerate(legs.end - legs.begin)])
    events = tuple(_events(system, legs, arrivals, start))
    last = arrivals[-1].tolist()
    least = min(map(abs, _speeds(system, legs)), default=0.0)
    return Path(events, tuple(last[:n]), tuple(last[n:]), legs, least)


def _check(system: Particles, x: Sequence[float], v: Sequence[float]) -> None:
    n, p = len(system.masses), system.parameters
    if len(x) != n or len(v) != n or not all(map(math.isfinite, (*x, *v))):
        raise BadInput(f"give {n} positions and {n} velocities, all finite")
    if not all(a < b for a, b in pairwise((float(p.l), *x, float(p.r)))):
        raise BadInput(f"the positions must increase strictly between the walls: {tuple(x)}")


def mode(system: Particles, v: Sequence[float], phase: float = 0.0) -> str:
    """Return the mode of velocities; where one is 0 the force decides whether the mass rests."""
    force = float(system.parameters.F) * math.cos(phase)
    pushed = (force * (abs(force) > float(f)) for f in system.friction)
    return "".join("-0+"[int(np.sign(u or a)) + 1] for u, a in zip(v, pushed, strict=True))


def _events(system: Particles, legs: Legs, arrivals: Floats, start: float) -> Iterator[Event]:
    """Give the events; `Unresolved` at a contact that is too slow."""
    n, p = len(system.masses), system.parameters
    slowest = SLOWEST * float(p.F / (p.omega * system.masses[0]))
    for k in np.flatnonzero(legs.word != NONE):
        word = told(legs.engine.words[legs.word[k]], legs.engine.modes[legs.to[k]])
        time = start + float(legs.end[k])
        x, before, after = (
            tuple(z.tolist()) for z in (arrivals[k, :n], arrivals[k, n:], legs.state[k + 1, n:])
        )
        kind, *rest = word.split()
        i = {"l": 0, "r": n - 1}[rest[0]] if kind == "hit" else int(rest[0]) - 1
        closing = before[i] - before[i + 1] if kind == "meet" else before[i]
        if kind in ("hit", "meet") and abs(closing) < slowest:
            raise Unresolved(time, "contacts accumulate, or one is tangent,")
        yield Event(word, time, x[i], x, before, after)


def told(word: str, to: str) -> str:
    """Return the word of an event: what stops turns, or sticks, as the mode after it says."""
    kind, *rest = word.split()
    sides = {"+": "right", "-": "left", "r": "right", "l": "left"}
    if kind == "stop":
        s = to[int(rest[0]) - 1]
        return f"turn {rest[0]} {sides[s]}" if s in sides else f"stick {rest[0]}"
    return f"release {rest[0]} {sides[rest[1]]}" if kind == "release" else word


def _speeds(system: Particles, legs: Legs) -> Iterator[float]:
    """Give the velocities at the ends of all flights and where an acceleration is 0.

    Nothing if a mass stops.
    """
    modes = [legs.engine.modes[k] for k in legs.mode]
    words = [legs.engine.words[k] for k in legs.word if k != NONE]
    if any("0" in each for each in modes) or any(word.startswith("stop") for word in words):
        return
    p, n = system.parameters, len(system.masses)
    for k, each in enumerate(modes):
        sides = zip(each, system.friction, strict=True)
        ratios = {float((f if s == "+" else -f) / p.F) for s, f in sides}
        a, b = float(legs.begin[k]), float(legs.end[k])
        slow = (t for q in ratios for t in _angles(q, legs, a, b))
        yield from legs.at(k, np.array([a, *slow, b]) - a)[:, n:].ravel().tolist()


def _angles(ratio: float, legs: Legs, a: float, b: float) -> list[float]:
    """Return the times in (a, b) at which the cosine of the clock is ``ratio``."""
    turn, found = 2 * math.pi, []
    for angle in (math.acos(ratio), -math.acos(ratio)):
        first = math.ceil((legs.phase + legs.omega * a - angle) / turn)
        last = math.floor((legs.phase + legs.omega * b - angle) / turn)
        found += [(angle + k * turn - legs.phase) / legs.omega for k in range(first, last + 1)]
    return found
