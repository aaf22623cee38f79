"""Certified events of a flight: wall hits, turnings and onsets of sticking, and what lies between.

All statements hold for every state of a box at once.  On a flight of sign s let p = exp(μt) s v.
It has the derivative exp(μt) (s F cos ωt - f), so within any interval its least value is attained
at an end or at one of the known times `Oscillator.slow`.  `flies` proves with this that s v > 0.
Then x is monotone: the flight cannot return to the wall that it left, and meets the wall ahead at
most once.  A zero of x - wall, or of v, that `certified` proves is the next event, the only one in
its window, and nothing else happens before it.

The same code runs over balls (fast, for small boxes) and Taylor models (tight, for large ones).
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Generic, NamedTuple, TypeVar, cast

from cap.errors import NotProved
from cap.flow.model import Flight, Moment, Oscillator
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.scalar import Scalar
from cap.sets.taylor_model import TaylorModel

E = TypeVar("E", bound=Scalar)
Function = Callable[[Oscillator[Any], Flight[Any], Moment[Any]], Any]


class Expected(NamedTuple):
    """An event that is expected: its word (see `cap.flow.strobe`) and a time window.  Needs no
    trust."""

    word: str
    window: Ball


class NoCertainEvent(NotProved):
    """No zero was proved in the ``window`` of event ``number``; it may lie in ``newton``."""

    def __init__(self, number: int, expected: Expected, newton: Ball) -> None:
        self.number, self.window, self.newton = number, expected.window, newton
        reason = f"no {expected.word} is certain in its time window"
        super().__init__(f"event {number}", reason, {"window": expected.window, "newton": newton})


class Enclosure(NamedTuple, Generic[E]):
    """What the certification asks of a scalar type whose values are functions on a box.

    ``bound(q)`` is a ball with all values of q; ``widened(q, b)`` adds the ball b to each of them;
    ``curve(osc, flight, window, value, slope)`` approximates the zeros of ``value``, whose
    derivative by time is ``slope``; any function of the state will do, since Newton's step is
    verified.  What does not depend on the state may also be a ball.
    """

    bound: Callable[[E], Ball]
    widened: Callable[[E, Ball], E]
    curve: Callable[[Oscillator[Any], Flight[E], Ball, Function, Function], E]


class Event(NamedTuple, Generic[E]):
    """An event: its ``word``, time, the velocity just before it and cos ωt, enclosed.

    Of a capture ``time`` encloses when the hits accumulate, and cos ωt is over that time.
    """

    word: str
    time: E
    velocity: E
    cos: E


def hit_time(
    osc: Oscillator[Any], flight: Flight[E], expected: Expected, kind: Enclosure[E], number: int
) -> Moment[E]:
    """Prove that x(t) meets the wall ahead in the window, once, with s v > 0 on the window."""
    crossing = _beyond, Oscillator.velocity, flight.s
    return _certified(osc, flight, expected, kind, number, crossing)


def _beyond(osc: Oscillator[Any], flight: Flight[Any], moment: Moment[Any]) -> Any:
    """Return x - wall, for the wall ahead."""
    return osc.position(flight, moment) - osc.wall(flight.s)


def rest_time(
    osc: Oscillator[Any], flight: Flight[E], expected: Expected, kind: Enclosure[E], number: int
) -> Moment[E]:
    """Prove that v(t) vanishes in the window, once, with s v' < 0 on the window."""
    crossing = Oscillator.velocity, Oscillator.acceleration, -flight.s
    return _certified(osc, flight, expected, kind, number, crossing)


def _certified(
    osc: Oscillator[Any],
    flight: Flight[E],
    expected: Expected,
    kind: Enclosure[E],
    number: int,
    crossing: tuple[Function, Function, int],
) -> Moment[E]:
    """Prove that a function has exactly one zero in the window, for each state; return when.

    Parametric interval Newton: let its ``slope`` have the ``sign`` on the whole window, and let m
    be a time in it, which may depend on the state.  If N = m - value(m)/slope(window) lies in the
    window, then for each state of the box the window holds exactly one zero, and it lies in N.
    Repeated until the window hardly shrinks, or most of what it leaves is the value's own radius.
    """
    value, slope, sign = crossing
    window, time = expected.window, cast("E | None", None)
    while True:
        rate = kind.bound(slope(osc, flight, osc.moment(window)))
        if not (rate > 0 if sign > 0 else rate < 0):
            reason = f"the {expected.word} may not be transverse in its time window"
            raise NotProved(f"event {number}", reason, {"window": window, "rate": rate})
        middle = kind.curve(osc, flight, window, value, slope)
        offset = kind.bound(value(osc, flight, osc.moment(middle)))
        better = kind.widened(middle, -offset / rate)
        newton = kind.bound(better)
        if not (interval.subset(newton, window) and interval.subset(kind.bound(middle), window)):
            if time is None:
                raise NoCertainEvent(number, Expected(expected.word, window), newton)
            return osc.moment(time)
        time = better
        if 4 * newton.rad() > window.rad() or 2 * offset.rad() > abs(rate) * newton.rad():
            return osc.moment(time)
        window = newton


def flies(
    osc: Oscillator[Any],
    flight: Flight[E],
    times: tuple[Ball, Ball],
    bound: Callable[[E], Ball],
    released: int | None = None,
) -> Ball | None:
    """Prove that s v > 0 between ``times``, given that this holds at both ends.

    Where v vanishes at an end, it is enough that s v > 0 right after the start, or right before the
    end.  A flight that begins with a release does so at a slow moment, the one of number
    ``released``.  Returns an enclosure of the least of the speeds at the other slow moments between
    the times, None if there is none; if it is uncertain whether one is between, both cases are
    enclosed.
    """
    start, end = times
    if not start < end:
        raise NotProved("flight", "events may be out of order", {"start": start, "end": end})
    least: Ball | None = None
    for k in slow_numbers(osc, flight.s, start, end, bound):
        slow = osc.slow(flight.s, k)
        when = bound(slow.t)
        if k == released or when < start or when > end:
            continue
        velocity = bound(osc.velocity(flight, slow))
        speed = velocity if flight.s > 0 else -velocity
        if not speed > 0:
            sets = {"start": start, "end": end, "when": when, "speed": speed}
            raise NotProved(
                "flight", "the velocity may vanish, so the mass may turn or stick", sets
            )
        if not start < when < end:  # it may or may not be attained
            speed = interval.hull(speed, abs(bound(osc.velocity(flight, osc.moment(end)))))
        least = speed if least is None else interval.least(least, speed)
    return least


def _itself(q: Any) -> Ball:
    return cast(Ball, q)


def slow_numbers(
    osc: Oscillator[Any], s: int, start: Ball, end: Ball, bound: Callable[[Any], Ball] = _itself
) -> range:
    """Return numbers k that include all with `Oscillator.slow` (s, k) between the times.

    `Oscillator.slow` (s, k) is ``origin`` + kT.  Raises `NotProved` if k is uncertain by 1 or more.
    """
    origin = bound(osc.slow_right if s > 0 else osc.slow_left)
    if origin - osc.T < start and end < origin + osc.T:  # -1 and 1 are not between
        return range(0 if origin < start or end < origin else 1)
    first, last = (start - origin) / osc.T, (end - origin) / osc.T
    if not (first.rad() < interval.ONE and last.rad() < interval.ONE):
        raise NotProved("flight", "its time is too uncertain", {"start": start, "end": end})
    return interval.integers(first, last)


def next_slow(
    osc: Oscillator[Any], s: int, since: Ball, bound: Callable[[Any], Ball] = _itself
) -> int:
    """Return the number of the first slow moment after all times of ``since``.

    Raises `NotProved` if one of them may be at, or on both sides of, a slow moment.
    """
    for k in slow_numbers(osc, s, since, since + osc.T, bound):
        if bound(osc.slow(s, k - 1).t) < since < bound(osc.slow(s, k).t):
            return k
    raise NotProved("release", "whether the mass leaves at once is undecided", {"since": since})


def _middle(
    _osc: Oscillator[Any], _flight: Flight[Any], window: Ball, _value: Function, _slope: Function
) -> Ball:
    return interval.point(window)


def _curve(
    osc: Oscillator[Any],
    flight: Flight[Any],
    window: Ball,
    value: Function,
    slope: Function,
) -> Any:
    """Return an approximation of the zero of ``value`` by a polynomial: Newton's method on jets.

    It is computed from the polynomials of the Taylor models, without their remainders.  Of a flight
    that does not depend on the state the middle of the window will do.
    """
    models = [q for q in (flight.t, flight.x, flight.v) if isinstance(q, TaylorModel)]
    if not models:
        return interval.point(window)
    domain = models[0].domain
    near = Flight(flight.s, *(_polynomial(q) for q in (flight.t, flight.x, flight.v)))
    names = ("f", "e", "mu", "F_v", "F_x", "lag")
    constants = {name: _polynomial(getattr(osc, name)) for name in names}
    jets = replace(osc, **constants)
    t = Jet.constant(interval.point(window), domain.space)
    for _ in range(domain.space.order.bit_length() + 6):
        moment = jets.moment(t)
        t = t - value(jets, near, moment) / slope(jets, near, moment)
        t = Jet(t.space, [interval.point(c + Ball(0)) for c in t.coefficients])
    return TaylorModel(domain, t, Ball(0))


def _polynomial(q: Any) -> Any:
    return q.polynomial if isinstance(q, TaylorModel) else q


def _bound(q: Any) -> Ball:
    return cast(Ball, q.bound() if isinstance(q, TaylorModel) else q)


def _widened(q: Any, by: Ball) -> Any:
    return q.widened(by) if isinstance(q, TaylorModel) else q + by


BALLS = Enclosure[Ball](bound=lambda q: q, widened=Ball.__add__, curve=_middle)
TAYLOR_MODELS = Enclosure[TaylorModel](_bound, _widened, _curve)
