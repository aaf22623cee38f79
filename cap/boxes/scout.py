"""Which event a flight in doubles meets first, and when.  It steers; nothing rests on it."""

import math

from cap.boxes.flight import Moment, NearFlight, NearSystem, flown, force
from cap.sets.circular import sin_cos_of_double
from cap.sets.compiled import kernel

HIT, STOP, ARRIVE = 0, 1, 2

_CLOSE = 1e-6  # a step of Newton's method so small is the last one
_FULL = 2 * math.pi
QUICK, MOST = 5, 60


@kernel
def _at(sign: float, t: float) -> Moment:
    sine, cosine = sin_cos_of_double(t)
    return Moment(t, sign * sine, sign * cosine)


@kernel
def _root(
    y: NearSystem, n: NearFlight, event: int, times: tuple[float, float], t: float, most: int
) -> float:
    """Return where the speed (`STOP`) or the gap (`HIT`) falls to 0 between two times, or NaN.

    Newton's method from t, ``most`` steps; a step out of the bracket becomes a bisection.
    """
    low, high = times
    for _ in range(most):
        at = _at(n.sign, t)
        speed, gap = flown(y, n, at)
        value, slope = (gap, -speed) if event == HIT else (speed, force(y, at.cos, speed))
        if value > 0:
            low = t
        else:
            high = t
        new: float = t - value / slope
        if not (low <= new <= high):
            new = 0.5 * (low + high)
        if abs(new - t) < _CLOSE:
            return new
        t = new
    return math.nan


@kernel
def _guess(y: NearSystem, at: Moment, speed: float, gap: float, high: float) -> float:
    """Return when the gap would be 0 if the force stayed as it is at a moment, or a middle."""
    push = force(y, at.cos, speed)
    square = speed * speed + 2 * push * gap
    t = at.t + 2 * gap / (speed + math.sqrt(square)) if square > 0 else math.inf
    return t if at.t < t < high else 0.5 * (at.t + high)


@kernel
def _stop_or_hit(
    y: NearSystem, n: NearFlight, low: Moment, high: float, speed: float, gap: float
) -> tuple[int, float]:
    """Return which is first, and when, if the speed falls to 0 between two times."""
    times = low.t, high
    t = _root(y, n, HIT, times, _guess(y, low, speed, gap, high), QUICK)
    if flown(y, n, _at(n.sign, t))[0] > 0:
        return HIT, t
    t = _root(y, n, STOP, times, 0.5 * (low.t + high), MOST)
    if flown(y, n, _at(n.sign, t))[1] > 0:
        return STOP, t
    return HIT, _root(y, n, HIT, (low.t, t), 0.5 * (low.t + t), MOST)


@kernel
def scout(y: NearSystem, n: NearFlight, end: Moment) -> tuple[int, float]:
    """Return the first event of a flight and its time, or `ARRIVE` and that of the ``end``."""
    falling = _FULL - 2 * y.arc  # the time from a fast to a slow moment
    slow = y.slow_right if n.sign > 0 else y.slow_left
    slow += _FULL * math.floor((n.t - slow) / _FULL + 1 + 1e-9)
    rises = slow - falling > n.t
    knot = slow - falling if rises else slow
    low, low_speed, low_gap = Moment(n.t, n.sin, n.cos), n.speed, n.gap
    for _ in range(8):
        last = knot >= end.t
        at = end if last else Moment(knot, y.sine if rises else -y.sine, y.alpha)
        speed, gap = flown(y, n, at)
        if speed <= 0 and not rises:
            return _stop_or_hit(y, n, low, at.t, low_speed, low_gap)
        if gap <= 0:
            guess = _guess(y, low, low_speed, low_gap, at.t)
            return HIT, _root(y, n, HIT, (low.t, at.t), guess, MOST)
        if last:
            break
        low, low_speed, low_gap, rises = at, speed, gap, not rises
        knot += _FULL - falling if rises else falling
    return ARRIVE, end.t
