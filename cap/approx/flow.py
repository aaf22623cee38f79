"""The flow over one period in floats, for orbits whose velocity never vanishes.

No event is looked for with a time step.  On a flight of sign s the speed s v is monotone between
the two times in a period at which the acceleration vanishes (cos ωt = s f/F), which brackets the
zeros of v; between them x is monotone, which brackets the wall hits.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from cap.errors import BadInput
from cap.matrix import Matrix
from cap.model import Flight, Functions, Oscillator
from cap.parameters import Parameters

TOO_MANY_HITS = (
    200  # per period; more would be a mass too fast for any orbit that the search can find
)


class Turns(Exception):
    """The velocity vanishes at ``time``; from there on the orbit may turn, stick or be captured."""

    def __init__(self, time: float) -> None:
        self.time = time
        super().__init__(f"the orbit turns at t = {time:.6g}")


@dataclass(frozen=True, slots=True)
class Orbit:
    """One period of an orbit: wall hits in (0, T], the velocities just before them, the end.

    ``end`` is (x, v) at t = T, ``monodromy`` its derivative in the state at t = 0, ``least_speed``
    the minimum of the speed s v over [0, T].
    """

    hit_times: tuple[float, ...]
    hit_velocities: tuple[float, ...]
    end: tuple[float, float]
    monodromy: Matrix[float]
    least_speed: float


def oscillator(p: Parameters) -> Oscillator[float]:
    """Return the oscillator with the floats next to its exact constants."""
    functions = Functions(float, math.pi, _sin_cos, math.acos, math.sqrt)
    return Oscillator.build(p, functions)


def one_period(o: Oscillator[float], x: float, v: float, *, formal: bool = False) -> Orbit:
    """Follow the orbit of (x, v) from t = 0 to t = T.

    Raises `Turns` where the velocity first vanishes.  With ``formal`` the flight goes on with the
    sign that it has, as if friction did not notice: the lifted orbit, on which Newton's method for
    a periodic orbit may start, and whose ``least_speed`` may then be negative.  Where it hits a
    wall with speed 0, though, even that ends with `Turns`: there is no derivative.
    Raises `BadInput` unless l < x < r, v is finite and not 0, and the hits are fewer than
    `TOO_MANY_HITS`.
    """
    _check(o, x, v)
    flight, t, least = o.start(1 if v > 0 else -1, x, v), 0.0, abs(v)
    hits: list[tuple[float, float]] = []
    while (hit := _next_hit(o, flight, t, formal=formal)) is not None:
        if len(hits) == TOO_MANY_HITS:
            raise BadInput(
                f"more than {TOO_MANY_HITS} wall hits in one period: v = {v!r} is too fast"
            )
        least = min(least, _least_speed(o, flight, t, hit))
        sin, cos = o.phase(hit)
        hits.append((hit, o.velocity(flight, hit, sin)))
        if hits[-1][1] == 0:
            raise Turns(hit)
        flight, t = o.reflect(flight, hit, sin, cos), hit
    least = min(least, _least_speed(o, flight, t, o.T))
    times, velocities = tuple(t for t, _ in hits), tuple(v for _, v in hits)
    return Orbit(times, velocities, o.end(flight), monodromy(o, hits), least)


def monodromy(o: Oscillator[float], hits: Sequence[tuple[float, float]]) -> Matrix[float]:
    """Return the derivative of the time-T map: a product of shears and saltation matrices.

    ``hits`` are the pairs (time, velocity just before the hit) in [0, T], in the order of time.
    """
    m: Matrix[float] = (1.0, 0.0), (0.0, 1.0)
    t = 0.0
    for hit, velocity in hits:
        _, cos = o.phase(hit)
        m = o.kick(m, hit - t, o.saltation(velocity, cos))
        t = hit
    return o.drift(m, o.T - t)


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


def _sin_cos(angle: float) -> tuple[float, float]:
    return math.sin(angle), math.cos(angle)


def _check(o: Oscillator[float], x: float, v: float) -> None:
    if not (math.isfinite(x) and math.isfinite(v)):
        raise BadInput(f"the state must be finite: (x, v) = ({x!r}, {v!r})")
    if not o.l < x < o.r:
        raise BadInput(f"x must lie strictly between the walls {o.l!r} and {o.r!r}: x = {x!r}")
    if v == 0:
        raise BadInput("the velocity at t = 0 must not be 0")


def _speed(o: Oscillator[float], flight: Flight[float], t: float) -> tuple[float, float]:
    """Return the speed s v and its derivative."""
    sin, cos = o.phase(t)
    return flight.s * o.velocity(flight, t, sin), flight.s * o.F * cos - o.f


def _excess(o: Oscillator[float], flight: Flight[float], t: float) -> tuple[float, float]:
    """Return how far the mass is beyond the wall ahead, and the speed."""
    sin, cos = o.phase(t)
    beyond = o.position(flight, t, cos) - o.wall(flight.s)
    return flight.s * beyond, flight.s * o.velocity(flight, t, sin)


def _least_speed(o: Oscillator[float], flight: Flight[float], a: float, b: float) -> float:
    slow, least = o.slowest(flight)
    ends = min(_speed(o, flight, a)[0], _speed(o, flight, b)[0])
    return min(ends, least) if a < slow < b else ends


def _turnings(o: Oscillator[float], flight: Flight[float], a: float, b: float) -> list[float]:
    """Return the zeros in (a, b) of the velocity: at most one between zeros of the acceleration."""
    slow, _ = o.slowest(flight)
    knots = [a, *(t for t in sorted((slow, o.T - slow)) if a < t < b), b]
    return [
        root(lambda t: _speed(o, flight, t), p, q)
        for p, q in pairwise(knots)
        if (_speed(o, flight, p)[0] > 0) != (_speed(o, flight, q)[0] > 0)
    ]


def _next_hit(
    o: Oscillator[float], flight: Flight[float], start: float, *, formal: bool
) -> float | None:
    """Return the first time in (start, T] at which the wall ahead is hit, or None."""
    turnings = _turnings(o, flight, start, o.T)
    for p, q in pairwise([start, *turnings, o.T]):
        if _excess(o, flight, q)[0] >= 0:
            return root(lambda t: _excess(o, flight, t), p, q)
        if turnings and not formal:
            raise Turns(turnings[0])
    return None
