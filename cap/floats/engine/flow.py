"""The hits of a lifted orbit in floats, from which Newton's method for hit times begins.

A lifted flight goes on with the sign that it has, as if friction did not notice that the velocity
vanishes; an orbit that never stops is its own lift.  No event is looked for with a time step.  On a
flight of sign s the speed s v is monotone between the two times in a period at which the
acceleration vanishes (cos ωt = s f/F), which brackets the zeros of v; between them x is monotone,
which brackets the wall hits.  Orbits with all their events: `cap.flow.itinerary`, of many at once
`cap.floats.engine.swarm`.
"""

import math
from collections.abc import Sequence
from itertools import pairwise

from cap.errors import BadInput
from cap.flow.itinerary import root
from cap.flow.model import Flight, Oscillator
from cap.sets.matrix import Matrix

TOO_MANY_HITS = (
    200  # per period; more would be a mass too fast for any orbit that the search can find
)


class Turns(Exception):
    """A wall is hit at ``time`` with the speed 0: there is no derivative."""

    def __init__(self, time: float) -> None:
        self.time = time
        super().__init__(f"the orbit turns at t = {time:.6g}")


def hit_times(o: Oscillator[float], x: float, v: float) -> tuple[float, ...]:
    """Return the times in (0, T] at which the lifted orbit of (x, v) at t = 0 hits a wall.

    Raises `Turns`, and `BadInput` unless l < x < r, v is finite and not 0, and the hits are fewer
    than `TOO_MANY_HITS`.
    """
    _check(o, x, v)
    flight, t = o.launch(1 if v > 0 else -1, o.moment(0.0), x, v), 0.0
    hits: list[float] = []
    while (hit := _next_hit(o, flight, t)) is not None:
        if len(hits) == TOO_MANY_HITS:
            raise BadInput(
                f"more than {TOO_MANY_HITS} wall hits in one period: v = {v!r} is too fast"
            )
        moment = o.moment(hit)
        velocity = o.velocity(flight, moment)
        if velocity == 0:
            raise Turns(hit)
        hits.append(hit)
        flight, t = o.reflect(flight, moment, velocity), hit
    return tuple(hits)


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


def _turnings(o: Oscillator[float], flight: Flight[float], a: float, b: float) -> list[float]:
    """Return the zeros in (a, b) of the velocity: at most one between zeros of the acceleration."""
    slow = o.slow(flight.s, 0).t
    knots = [a, *(t for t in sorted((slow, o.T - slow)) if a < t < b), b]
    return [
        root(lambda t: _speed(o, flight, t), p, q)
        for p, q in pairwise(knots)
        if (_speed(o, flight, p)[0] > 0) != (_speed(o, flight, q)[0] > 0)
    ]


def _next_hit(o: Oscillator[float], flight: Flight[float], start: float) -> float | None:
    """Return the first time in (start, T] at which the wall ahead is hit, or None."""
    for p, q in pairwise([start, *_turnings(o, flight, start, o.T), o.T]):
        if _excess(o, flight, q)[0] >= 0:
            return root(lambda t: _excess(o, flight, t), p, q)
    return None
