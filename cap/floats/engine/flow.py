"""The flow over one period in floats, for orbits whose velocity never vanishes.

No event is looked for with a time step.  On a flight of sign s the speed s v is monotone between
the two times in a period at which the acceleration vanishes (cos ωt = s f/F), which brackets the
zeros of v; between them x is monotone, which brackets the wall hits.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from cap.errors import BadInput
from cap.flow.itinerary import root
from cap.flow.model import Flight, Moment, Oscillator
from cap.sets.matrix import Matrix

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
    flight, t, least = o.launch(1 if v > 0 else -1, o.moment(0.0), x, v), 0.0, abs(v)
    hits: list[tuple[float, float]] = []
    while (hit := _next_hit(o, flight, t, formal=formal)) is not None:
        if len(hits) == TOO_MANY_HITS:
            raise BadInput(
                f"more than {TOO_MANY_HITS} wall hits in one period: v = {v!r} is too fast"
            )
        least = min(least, _least_speed(o, flight, t, hit))
        moment = o.moment(hit)
        hits.append((hit, velocity := o.velocity(flight, moment)))
        if velocity == 0:
            raise Turns(hit)
        flight, t = o.reflect(flight, moment, velocity), hit
    least = min(least, _least_speed(o, flight, t, o.T))
    times, velocities = tuple(t for t, _ in hits), tuple(v for _, v in hits)
    last = Moment(o.T, 0.0, 1.0)
    end = o.position(flight, last), o.velocity(flight, last)
    return Orbit(times, velocities, end, monodromy(o, hits), least)


def monodromy(o: Oscillator[float], hits: Sequence[tuple[float, float]]) -> Matrix[float]:
    """Return the derivative of the time-T map: a product of shears and saltation matrices.

    ``hits`` are the pairs (time, velocity just before the hit) in [0, T], in the order of time.
    """
    m: Matrix[float] = (1.0, 0.0), (0.0, 1.0)
    t = 0.0
    for hit, velocity in hits:
        salt = o.saltation(1 if velocity > 0 else -1, velocity, o.moment(hit).cos)
        m = o.hit(o.drift(m, hit - t), salt)
        t = hit
    return o.drift(m, o.T - t)


def _check(o: Oscillator[float], x: float, v: float) -> None:
    if not (math.isfinite(x) and math.isfinite(v)):
        raise BadInput(f"the state must be finite: (x, v) = ({x!r}, {v!r})")
    if not o.l < x < o.r:
        raise BadInput(f"x must lie strictly between the walls {o.l!r} and {o.r!r}: x = {x!r}")
    if v == 0:
        raise BadInput("the velocity at t = 0 must not be 0")


def _speed(o: Oscillator[float], flight: Flight[float], t: float) -> tuple[float, float]:
    """Return the speed s v and its derivative."""
    moment = o.moment(t)
    return flight.s * o.velocity(flight, moment), flight.s * o.acceleration(flight, moment)


def _excess(o: Oscillator[float], flight: Flight[float], t: float) -> tuple[float, float]:
    """Return how far the mass is beyond the wall ahead, and the speed."""
    moment = o.moment(t)
    beyond = o.position(flight, moment) - o.wall(flight.s)
    return flight.s * beyond, flight.s * o.velocity(flight, moment)


def _least_speed(o: Oscillator[float], flight: Flight[float], a: float, b: float) -> float:
    slow = o.slow(flight.s, 0)
    ends = min(_speed(o, flight, a)[0], _speed(o, flight, b)[0])
    return min(ends, flight.s * o.velocity(flight, slow)) if a < slow.t < b else ends


def _turnings(o: Oscillator[float], flight: Flight[float], a: float, b: float) -> list[float]:
    """Return the zeros in (a, b) of the velocity: at most one between zeros of the acceleration."""
    slow = o.slow(flight.s, 0).t
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
