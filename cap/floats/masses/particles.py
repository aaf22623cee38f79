"""The flow of N masses between two walls in floats; nothing rigorous trusts it.

    m_i x_i'' = F cos ωt - f_i sgn x_i',   l <= x_1 <= .. <= x_N <= r,      f_i = f, or f m_i,

with elastic hits and collisions (eq:Nparticle, eq:Ncollision).  A mass alone is the oscillator of
`cap.flow.model` with F/m_i and f_i/m_i.  Its velocity may become 0: it turns if |F cos ωt| > f_i,
else it rests, until |F cos ωt| = f_i or another mass hits it.

No event is looked for with a time step.  The gap between neighbours has the second derivative
P cos ωt - Q, with constants P and Q while nothing happens, and a wall is a neighbour that rests:
so the zeros of it are known, between them the slope of the gap is monotone, and between its zeros
the gap is (`cap.floats.masses.contacts`).  Contacts that accumulate, and masses that stay in
contact, are refused: `Unresolved`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from cap.errors import BadInput
from cap.floats.masses.contacts import Curve, first_contact, first_stop, zeros
from cap.flow import itinerary
from cap.flow.model import Flight, Moment, Oscillator
from cap.parameters import Parameters

MOST_EVENTS = 2000  # in one call
SLOWEST = 1e-9  # closing speed of a contact, of F/(ω m): slower ones are about to accumulate

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
        self.oscillators()

    def oscillators(self) -> tuple[Oscillator[float], ...]:
        """Return the oscillator that each mass is alone."""
        p = self.parameters
        return tuple(
            itinerary.oscillator(replace(p, F=p.F / m, f=p.f if self.proportional else p.f / m))
            for m in self.masses
        )


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
    """The events of an orbit, x and v of the masses at its end, and their derivative.

    ``monodromy`` is the 2N x 2N matrix, in the order (x_1, .., x_N, v_1, .., v_N), of the end in
    the start.  ``least_speed`` is the minimum of all |v_i|: 0 if a mass turns or rests.
    """

    events: tuple[Event, ...]
    x: tuple[float, ...]
    v: tuple[float, ...]
    monodromy: Floats
    least_speed: float

    @property
    def words(self) -> tuple[str, ...]:
        """The itinerary."""
        return tuple(event.word for event in self.events)


@dataclass(frozen=True, slots=True)
class _Mass:
    """A mass on a flight, or at rest at ``x``; ``rises``: the flight began at rest."""

    o: Oscillator[float]
    flight: Flight[float] | None
    x: float = 0.0
    rises: bool = False

    @property
    def sign(self) -> int:
        return self.flight.s if self.flight else 0

    def at(self, moment: Moment[float]) -> tuple[float, float, float]:
        """Return x, v and the acceleration."""
        o, flight = self.o, self.flight
        if flight is None:
            return self.x, 0.0, 0.0
        v, a = o.velocity(flight, moment), o.acceleration(flight, moment)
        return o.position(flight, moment), v, a

    def least(self, a: float, b: float) -> float:
        """Return the least speed over [a, b]."""
        if self.flight is None or self.rises:
            return 0.0
        knots = [a, *zeros(self.o.omega, self.sign * self.o.ratio, a, b), b]
        return min(abs(self.at(self.o.moment(t))[1]) for t in knots)


def follow(
    system: Particles, x: Sequence[float], v: Sequence[float], end: float, start: float = 0.0
) -> Path:
    """Follow the orbit of (x, v) from the time ``start`` to ``end``.

    Raises `BadInput` unless l < x_1 < .. < x_N < r and all v are finite, or after `MOST_EVENTS`;
    `Unresolved` where contacts accumulate or last.  Simultaneous events are taken one by one.
    """
    n, p = len(system.masses), system.parameters
    places = (float(p.l), *x, float(p.r))
    if len(x) != n or len(v) != n or not all(map(math.isfinite, (*x, *v))):
        raise BadInput(f"give {n} positions and {n} velocities, all finite")
    if not all(a < b for a, b in pairwise(places)):
        raise BadInput(f"the positions must increase strictly between the walls: {tuple(x)}")
    runner = _Runner(system, (start, end), [float(y) for y in x], [float(u) for u in v])
    while runner.step():
        if len(runner.events) > MOST_EVENTS:
            raise BadInput(f"more than {MOST_EVENTS} events before t = {end:.6g}")
    x_end, v_end, _ = runner.state()
    events = tuple(runner.events)
    return Path(events, x_end, v_end, runner.monodromy, runner.least_speed)


class _Runner:
    """An orbit as far as it has been followed."""

    def __init__(
        self,
        system: Particles,
        times: tuple[float, float],
        x: Sequence[float],
        v: Sequence[float],
    ) -> None:
        self.m = [float(m) for m in system.masses]
        self.o = system.oscillators()
        self.now, self.end = times
        self.events: list[Event] = []
        self.monodromy: Floats = np.eye(2 * len(self.m))
        self.least_speed = math.inf
        self.bodies: list[_Mass] = []
        self.bodies = [self._with(i, *each)[0] for i, each in enumerate(zip(x, v, strict=True))]

    def _moment(self, t: float) -> Moment[float]:
        return self.o[0].moment(t)

    def state(self) -> tuple[tuple[float, ...], tuple[float, ...], Floats]:
        """Return x, v and the accelerations now."""
        moment = self._moment(self.now)
        rows = [body.at(moment) for body in self.bodies]
        x, v, a = (tuple(row[k] for row in rows) for k in range(3))
        return x, v, np.array(a)

    def _with(self, i: int, x: float, v: float) -> tuple[_Mass, str]:
        """Return the mass i that has x and v now; for v = 0 the force decides what it does."""
        o, moment = self.o[i], self._moment(self.now)
        if v:
            return _Mass(o, o.launch(1 if v > 0 else -1, moment, x, v)), ""
        force = o.forcing(moment)
        if abs(force) > o.f:
            side = 1 if force > 0 else -1
            word = f"turn {i + 1} {'right' if side > 0 else 'left'}"
            return _Mass(o, o.launch(side, moment, x, 0.0), rises=True), word
        return _Mass(o, None, x), f"stick {i + 1}"

    def step(self) -> bool:
        """Pass the next event; return False at the end."""
        n, best = len(self.m), (self.end, -1)
        for k in range(3 * n + 1):
            time = self._time(k, best[0])
            if time is not None and time < best[0]:
                best = time, k
        time, k = best
        self._pass(time)
        if k < 0:
            return False
        if k <= n:
            self._contact(k)
        elif k <= 2 * n:
            self._stop(k - n - 1)
        else:
            self._release(k - 2 * n - 1)
        return True

    def _time(self, k: int, until: float) -> float | None:
        """Return the time before ``until`` of the candidate k: contacts, stops, releases."""
        n = len(self.m)
        if k <= n:
            return self._closing(k, until)
        body = self.bodies[(k - n - 1) % n]
        if (k <= 2 * n) != bool(body.flight):
            return None
        o = body.o
        if body.flight:
            knots = [self.now, *zeros(o.omega, body.sign * o.ratio, self.now, until), until]
            rises = body.rises and body.flight.t == self.now
            return first_stop(_speed(body), knots, rises=rises)
        ends = [  # another mass may have been released just now
            time
            for side in (1, -1)
            for time in zeros(o.omega, side * o.ratio, self.now, until, with_first=True)
        ]
        return min(ends, default=None)

    def _closing(self, k: int, until: float) -> float | None:
        """Return when the gap between the bodies k and k + 1 closes, 0 and N + 1 the walls."""
        left, right = (self.bodies[j] if 0 <= j < len(self.m) else None for j in (k - 1, k))
        if not ((left and left.flight) or (right and right.flight)):
            return None
        pulls = [
            (body.o.F, body.o.drag(body.sign)) if body and body.flight else (0.0, 0.0)
            for body in (left, right)
        ]
        P, Q = pulls[1][0] - pulls[0][0], pulls[1][1] - pulls[0][1]
        inflections = zeros(self.o[0].omega, Q / P, self.now, until) if P else []
        return first_contact(self._gap(left, right), [self.now, *inflections, until])

    def _gap(self, left: _Mass | None, right: _Mass | None) -> Curve:
        walls = self.o[0].l, self.o[0].r

        def gap(t: float) -> tuple[float, float]:
            moment = self._moment(t)
            x, v, _ = left.at(moment) if left else (walls[0], 0.0, 0.0)
            y, u, _ = right.at(moment) if right else (walls[1], 0.0, 0.0)
            return y - x, u - v

        return gap

    def _pass(self, time: float) -> None:
        """Go on to a time: the derivative of a flight is a shear."""
        n = len(self.m)
        for i, body in enumerate(self.bodies):
            self.least_speed = min(self.least_speed, body.least(self.now, time))
            self.monodromy[i] += (time - self.now) * self.monodromy[n + i]
        self.now = time

    def _contact(self, k: int) -> None:
        """Let the mass at a wall (k = 0, N), or the k-th and the next, change their velocities."""
        n = len(self.m)
        x, v, a = self.state()
        if k in (0, n):
            i, wall = (0, self.o[0].l) if k == 0 else (n - 1, self.o[0].r)
            changed, word, place = {i: -v[i]}, "hit r" if k else "hit l", wall
        else:
            i, j = k - 1, k
            share = 2 / (self.m[i] + self.m[j]) * (v[i] - v[j])
            changed = {i: v[i] - share * self.m[j], j: v[j] + share * self.m[i]}
            word, place = f"meet {k} {k + 1}", x[i]
        normal, C = self._rule(k)
        self._checked(abs(float(normal @ np.array(v))))
        for j, velocity in changed.items():
            self.bodies[j], _ = self._with(j, place, velocity)
        self._salt(C, normal, np.array(v), a)
        self._record(word, place, v)

    def _checked(self, closing: float) -> None:
        if closing < SLOWEST * self.o[0].F_v:
            raise Unresolved(self.now, "contacts accumulate, or one is tangent,")

    def _rule(self, k: int) -> tuple[Floats, Floats]:
        """Return the normal of the contact k, and C = 1 - 2 M⁻¹ n nᵀ/(nᵀ M⁻¹ n)."""
        n = len(self.m)
        one, light = np.eye(n + 1)[:, :n], 1 / np.array(self.m)
        normal = (one[k - 1] if k else np.zeros(n)) - one[k]
        pull = light * normal
        return normal, np.eye(n) - 2 * np.outer(pull, normal) / (normal @ pull)

    def _salt(self, C: Floats, normal: Floats, v: Floats, a: Floats) -> None:
        """Multiply by S = ((C, 0), (K, C)), K = (a⁺ - C a⁻) nᵀ/(nᵀ v⁻); who rests has δv = 0."""
        n = len(self.m)
        _, _, after = self.state()
        K = np.outer(after - C @ a, normal) / (normal @ v)
        top, low = self.monodromy[:n], self.monodromy[n:]
        self.monodromy = np.vstack([C @ top, K @ top + C @ low])
        for i, body in enumerate(self.bodies):
            if body.flight is None:
                self.monodromy[n + i] = 0.0

    def _stop(self, i: int) -> None:
        x, v, before = self.state()
        self.bodies[i], word = self._with(i, x[i], 0.0)
        after = self.state()[2][i]
        self.monodromy[len(self.m) + i] *= after / before[i]
        self._record(word, x[i], v)

    def _release(self, i: int) -> None:
        x, v, _ = self.state()
        side = 1 if self._moment(self.now).cos > 0 else -1
        o = self.o[i]
        self.bodies[i] = _Mass(o, o.launch(side, self._moment(self.now), x[i], 0.0), rises=True)
        self._record(f"release {i + 1} {'right' if side > 0 else 'left'}", x[i], v)

    def _record(self, word: str, x: float, before: tuple[float, ...]) -> None:
        positions, after, _ = self.state()
        self.events.append(Event(word, self.now, x, positions, before, after))


def _speed(body: _Mass) -> Curve:
    def speed(t: float) -> tuple[float, float]:
        _, v, a = body.at(body.o.moment(t))
        return body.sign * v, body.sign * a

    return speed
