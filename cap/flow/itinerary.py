"""The orbit of one state in floats, through all its events: hints for the prover, not rigorous.

No event is looked for with a time step.  On a flight of sign s, p = exp(μt) s v is monotone between
the known times at which cos ωt = s f/F, which brackets the zeros of v; between them x is monotone,
which brackets the hits.  What a zero of v becomes, the forcing decides (`cap.flow.strobe`).
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from cap.errors import BadInput, NotProved
from cap.flow import relaxation
from cap.flow.capture import Entry, accumulation
from cap.flow.model import Flight, Functions, Oscillator
from cap.flow.strobe import oscillator as ball_oscillator
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

MOST_EVENTS = 2000  # in one call: more would be a mass too fast for anything that steers by this
WINDOWS = (1.05, 1.2, 1.5, 2.0, 3.0)  # tried for the lemma of capture, in times of its estimate


@dataclass(frozen=True, slots=True)
class Happening:
    """An event in floats: its word, when, where, the velocity just before it.

    Of a capture ``time`` is the end of the window in which the lemma of `cap.flow.capture` holds.
    """

    word: str
    time: float
    x: float
    velocity: float


@dataclass(frozen=True)
class Path:
    """The events of an orbit, its (x, v) at the end, and the derivative of that in the start.

    Of v = 0, launched at once, the derivative by v is that to the side of the launch.  ``wall`` is
    1 or -1 if the mass rests at r or l at the end, else 0.
    """

    events: tuple[Happening, ...]
    end: tuple[float, float]
    monodromy: Matrix[float]
    wall: int

    @property
    def words(self) -> tuple[str, ...]:
        """The itinerary."""
        return tuple(event.word for event in self.events)


def oscillator(p: Parameters) -> Oscillator[float]:
    """Return the oscillator with the floats next to its exact constants."""
    functions = Functions(float, math.pi, _sin_cos, math.acos, math.sqrt, relaxation.of_floats)
    return Oscillator.build(p, functions)


def _sin_cos(angle: float) -> tuple[float, float]:
    return math.sin(angle), math.cos(angle)


def itinerary(
    p: Parameters, x: float, v: float, end: float, *, start: float = 0.0, wall: int = 0
) -> Path:
    """Follow the orbit of (x, v) from the time ``start`` to the time ``end``.

    ``wall`` is 1 or -1 if the mass starts exactly at r or l.  Raises `BadInput` for states that are
    no states, and for more than `MOST_EVENTS` events.
    """
    o = oscillator(p)
    if not (math.isfinite(x) and math.isfinite(v)):
        raise BadInput(f"the state must be finite: (x, v) = ({x!r}, {v!r})")
    if not (wall or o.l < x < o.r):
        raise BadInput(f"x must lie strictly between the walls {o.l!r} and {o.r!r}: x = {x!r}")
    runner = _Runner(p, o, (start, end))
    runner.begin(x, v, wall)
    while runner.step():
        if len(runner.events) > MOST_EVENTS:
            raise BadInput(
                f"more than {MOST_EVENTS} events before t = {end:.6g}, from (x, v) = ({x!r}, {v!r})"
            )
    return Path(tuple(runner.events), runner.state, runner.monodromy, runner.wall)


class _Runner:
    """An orbit as far as it has been followed: it flies, or rests at ``state[0]``."""

    def __init__(self, p: Parameters, o: Oscillator[float], times: tuple[float, float]) -> None:
        self.p, self.o = p, o
        self.now, self.end = times
        self.events: list[Happening] = []
        self.monodromy: Matrix[float] = (1.0, 0.0), (0.0, 1.0)
        self.flight: Flight[float] | None = None
        self.from_rest = False  # the flight began with a turning or a release: its speed rises
        self.state, self.wall = (0.0, 0.0), 0

    def begin(self, x: float, v: float, wall: int) -> None:
        """Start the orbit."""
        self.state = x, v
        if v and wall * v <= 0:
            self._launch(1 if v > 0 else -1, x, v)
        elif v:
            raise BadInput("the mass moves into the wall: give the velocity after the hit")
        else:
            self._stopped(x, wall)
        if self.flight is None:
            pressed = wall * self.o.forcing(self.o.moment(self.now)) > self.o.f
            self.monodromy = (0.0 if pressed else 1.0, 0.0), (0.0, 0.0)

    def _launch(self, s: int, x: float, v: float) -> None:
        self.flight, self.wall = self.o.launch(s, self.o.moment(self.now), x, v), 0
        self.from_rest = v == 0

    def _stopped(self, x: float, wall: int) -> str:
        """Let the forcing decide what becomes of a mass with v = 0; return the word."""
        o = self.o
        force = o.forcing(o.moment(self.now))
        for side, word in ((1, "turn right"), (-1, "turn left")):
            if side * force > o.f and wall != side:
                self._launch(side, x, 0.0)
                return word
        self.flight, self.state, self.wall = None, (x, 0.0), wall
        return "stick"

    def step(self) -> bool:
        """Pass the next event; return False at the end."""
        return self._release() if self.flight is None else self._fly(self.flight)

    def _release(self) -> bool:
        x, _ = self.state
        sides = [side for side in (1, -1) if side != self.wall]
        time, side = min((self._slow_after(side), side) for side in sides)
        if time >= self.end:
            return False
        self.now = time
        self._launch(side, x, 0.0)
        self._record("release right" if side > 0 else "release left", x, 0.0)
        return True

    def _slow_after(self, side: int) -> float:
        first = self.o.slow(side, 0).t
        k = math.floor((self.now - first) / self.o.T)
        while first + k * self.o.T < self.now:
            k += 1
        return first + k * self.o.T

    def _record(self, word: str, x: float, velocity: float) -> None:
        self.events.append(Happening(word, self.now, x, velocity))

    def _pieces(self, s: int) -> Iterator[tuple[float, float]]:
        """Give the parts of [now, end] on which p is monotone, in their order."""
        o, a = self.o, self.now
        slow = o.slow(s, 0).t
        fast = 2 * (0.0 if s > 0 else math.pi / o.omega) - slow  # the other zero of s F cos ωt - f
        phases = sorted(t % o.T for t in (slow, fast))
        k = math.floor(a / o.T)
        while a < self.end:
            for phase in phases:
                t = k * o.T + phase
                if a + 1e-13 * (o.T + abs(a)) < t < self.end:  # a flight may begin at such a time
                    yield a, t
                    a = t
            k += 1
            if k * o.T > self.end:
                yield a, self.end
                return

    def _fly(self, flight: Flight[float]) -> bool:
        o, s, start = self.o, flight.s, self.now
        wall = o.wall(s)

        def speed(t: float) -> tuple[float, float]:
            moment = o.moment(t)
            return s * o.velocity(flight, moment), s * o.acceleration(flight, moment)

        def excess(t: float) -> tuple[float, float]:
            moment = o.moment(t)
            return s * (o.position(flight, moment) - wall), s * o.velocity(flight, moment)

        for a, b in self._pieces(s):
            rises = self.from_rest and a == start
            stops = not rises and speed(b)[0] <= 0
            last = root(speed, a, b) if stops else b
            if excess(last)[0] >= 0:
                self._pass(flight, root(excess, a, last))
                return self._hit(flight)
            if stops:
                self._pass(flight, last)
                self._stop(flight)
                return True
        self._pass(flight, self.end)
        end = o.moment(self.end)
        self.state = o.position(flight, end), s * max(s * o.velocity(flight, end), 0.0)
        return False

    def _pass(self, flight: Flight[float], time: float) -> None:
        self.monodromy = self.o.drift(self.monodromy, time - flight.t)
        self.now = time

    def _stop(self, flight: Flight[float]) -> None:
        o, moment = self.o, self.o.moment(self.now)
        x = o.position(flight, moment)
        word = self._stopped(x, 0)
        factor = 0.0 if word == "stick" else o.turning_factor(flight.s, moment.cos)
        (a, b), (c, d) = self.monodromy
        self.monodromy = (a, b), (factor * c, factor * d)
        self._record(word, x, 0.0)

    def _hit(self, flight: Flight[float]) -> bool:
        o, s, moment = self.o, flight.s, self.o.moment(self.now)
        velocity = o.velocity(flight, moment)
        self._record("hit r" if s > 0 else "hit l", o.wall(s), velocity)
        if s * velocity > 0:
            salt = o.saltation(s, velocity, moment.cos)
            self.monodromy = o.hit(self.monodromy, salt)
            self.flight, self.from_rest = o.reflect(flight, moment, velocity), False
            self._capture(s, o.e * abs(velocity))
        else:
            self._stopped(o.wall(s), s)
        return True

    def _capture(self, s: int, speed: float) -> None:
        """Let the wall capture the mass, if the lemma says so before the end."""
        until = _captured_until(self.p, self.o, s, (self.now, speed))
        if until is None or until > self.end:
            return
        self.now = until
        self._record("capture r" if s > 0 else "capture l", self.o.wall(s), 0.0)
        self.monodromy = (0.0, 0.0), (0.0, 0.0)
        self.flight, self.state, self.wall = None, (self.o.wall(s), 0.0), s


def _captured_until(
    p: Parameters, o: Oscillator[float], s: int, leaving: tuple[float, float]
) -> float | None:
    """Return the end of a window in which the lemma of capture holds, if one is found."""
    time, speed = leaving
    force = s * o.forcing(o.moment(time))
    if not force > o.f:
        return None
    hold, press = force - o.f, force + o.f
    ratio = o.e * math.sqrt(hold / press)
    if ratio >= 1:
        return None
    estimate = (1 / press + 1 / math.sqrt(press * hold)) * speed / (1 - ratio)
    if not estimate < o.T / 2:
        return None
    with interval.workprec(53):
        balls, entry = ball_oscillator(p), Entry(Ball(time), Ball(0), Ball(speed), leaving=True)
        for stretch in WINDOWS:
            until = time + stretch * estimate
            try:
                accumulation(balls, s, entry, Ball(until))
            except NotProved:
                continue
            return until
    return None


def root(g: Callable[[float], tuple[float, float]], a: float, b: float) -> float:
    """Return the point of [a, b] where ``g``, which gives value and slope, changes its sign.

    Assumes that it changes once.  Newton's method; a step out of the bracket becomes a bisection.
    """
    rising = g(a)[0] < g(b)[0]
    small = 2.0**-52 * (abs(a) + abs(b))
    t = (a + b) / 2
    for _ in range(200):  # plain bisection would need about 60, Newton's method about 5
        value, slope = g(t)
        a, b = (a, t) if (value > 0) == rising else (t, b)
        new = t - value / slope if slope else math.inf
        if not a <= new <= b:
            new = (a + b) / 2
        if abs(new - t) <= small:
            return new
        t = new
    return t
