"""When the motions of a set may stop, and when they may hit the wall ahead.

Nothing is assumed here of the set but that its motions obey the formula of the flight, with speeds
and gaps in the ranges, until their first event.  Let T_0 be the interval of the times when they
begin.

*Stops.*  The speed u of a motion falls to 0 between a fast time and the next slow time, or not at
all: exp(μt) u rises elsewhere.  So if u > 0 is certain at a time t of such an arc and at all slow
times before, there is no stop until t: u >= 0 at the beginning.  If u < 0 is certain at a time
after T_0, by the formula, each motion has stopped, or hit the wall, before it.

*Hits.*  While u > 0 the gap falls.  So if gap > 0 is certain at a time until which u > 0 is
certain, there is no hit until then.  If gap < 0 is certain at a time after T_0, by the formula,
each motion has had an event before it.
"""

import math
from typing import NamedTuple

from cap.boxes.flight import Constants, Moment, fast_before, moment, slow, steepest
from cap.boxes.motion import Motion, exact, ranges
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    between,
    is_negative,
    is_positive,
    lower,
    magnitude,
    upper,
    widened,
)

SPEED_ABOVE, SPEED_BELOW, GAP_ABOVE, GAP_BELOW = 0, 1, 2, 3


class Windows(NamedTuple):
    """What is asked is what happens until the ``horizon``.

    A motion of the set neither stops before ``stop`` nor hits the wall before ``hit`` (inf: never).
    By ``done`` each has had an event; ``top`` is that or the horizon.
    """

    stop: float
    hit: float
    done: float
    top: float
    horizon: Moment


@kernel
def _margin(y: Constants, n: Motion, t: float, question: int) -> float:
    """Return a number that is > 0 only if, at the time t, all speeds or gaps are > 0, or < 0."""
    speed, gap = ranges(y, n, moment(n.flight.sign, exact(t)))
    if question == SPEED_ABOVE:
        return lower(speed)
    if question == SPEED_BELOW:
        return -upper(speed)
    return lower(gap) if question == GAP_ABOVE else -upper(gap)


@kernel
def _edge(y: Constants, n: Motion, sure: float, unsure: float, question: int) -> float:
    """Return a time, from ``sure`` towards ``unsure``, at which the margin is still positive.

    It is ``sure`` itself if none is found.  Regula falsi and bisection in turn.
    """
    good, bad = _margin(y, n, sure, question), _margin(y, n, unsure, question)
    if not good > 0:
        return sure
    if bad > 0:
        return unsure
    for k in range(24):
        part = 0.98 * good / (good - bad) if k % 2 == 0 and bad < 0 else 0.5
        t = sure + part * (unsure - sure)
        value = _margin(y, n, t, question)
        if value > 0:
            sure, good = t, value
        else:
            unsure, bad = t, value
    return sure


@kernel
def _stops(y: Constants, n: Motion, end: Moment) -> tuple[float, float, Moment]:
    """Return the first and last time of a stop, inf for never, and the horizon.

    That is the first slow moment at which u > 0 is not certain, or the end.  A slow moment before
    which not all motions have begun is none: for them, the formula does not hold there.
    """
    begun, latest = lower(n.flight.t), upper(n.flight.t)
    first, horizon, falls = math.inf, end, begun
    for k in range(4):
        at = slow(y, n.flight.sign, k)
        falls = lower(fast_before(y, at))
        passed = lower(at.t) <= latest if n.rising != 0 else upper(at.t) < begun
        final = upper(at.t) >= lower(end.t)
        if passed and not final:
            continue
        horizon = end if final else at
        certain = is_positive(ranges(y, n, horizon)[0])
        if not certain and lower(horizon.t) <= latest:
            first = begun
        elif not certain and first == math.inf and falls <= upper(horizon.t):
            first = _edge(y, n, max(begun, falls), lower(horizon.t), SPEED_ABOVE)
        if final or not (certain or lower(horizon.t) <= latest):
            break
    last = math.inf
    if latest < lower(horizon.t) and is_negative(ranges(y, n, horizon)[0]):
        last = upper(horizon.t)
        if _margin(y, n, last, SPEED_BELOW) > 0:
            last = _edge(y, n, last, max(latest, falls), SPEED_BELOW)
    return first, last, horizon


@kernel
def _hits(y: Constants, n: Motion, w: tuple[float, float, Moment]) -> tuple[float, float]:
    """Return the first and last time of a hit, given what `_stops` says."""
    begun, latest, end = lower(n.flight.t), upper(n.flight.t), w[2].t
    sure, top = min(w[0], lower(end)), min(w[1], upper(end))
    first, last = math.inf, math.inf
    if sure >= begun and _margin(y, n, sure, GAP_ABOVE) > 0:
        if sure < top and not is_positive(during(y, n, sure, top)[1]):
            first = sure
    else:
        first = _edge(y, n, begun, max(begun, sure), GAP_ABOVE)
    if latest < top and _margin(y, n, top, GAP_BELOW) > 0:
        last = _edge(y, n, top, latest, GAP_BELOW)
    return first, last


@kernel
def during(y: Constants, n: Motion, begin: float, end: float) -> tuple[Interval, Interval]:
    """Return all speeds and gaps at the times between two, by the formula."""
    span = between(begin, end)
    at = moment(n.flight.sign, exact(span.mid))
    speed, gap = ranges(y, n, at)
    speed = widened(speed, magnitude(exact(span.rad * steepest(y, at, speed, span.rad))))
    return speed, widened(gap, magnitude(exact(span.rad * magnitude(speed))))


@kernel
def windows(y: Constants, n: Motion, end: Moment) -> Windows:
    """Return when the motions may stop and hit; ``end`` is as the flight sees it."""
    stops = _stops(y, n, end)
    hits = _hits(y, n, stops)
    done = min(stops[1], hits[1])
    return Windows(stops[0], hits[0], done, min(done, upper(stops[2].t)), stops[2])
