"""Events that may be one thing or another: each possible continuation, none dropped.

Nothing is assumed here of the set but that its motions obey the formula of the flight, with speeds
and gaps in the ranges, until their first event.  Let T_0 be the interval of the times when they
begin.

*Stops.*  The speed u of a motion falls to 0 between a fast time and the next slow time, or not at
all: exp(μt) u rises elsewhere.  So if u > 0 at the beginning, and u > 0 is certain at a time t of
such an arc and at all slow times before, there is no stop until t.  If u < 0 is certain at a time
after T_0, by the formula, each motion has stopped, or hit the wall, before it.

*Hits.*  While u > 0 the gap falls.  So if gap > 0 is certain at a time until which u > 0 is
certain, there is no hit until then.  If gap < 0 is certain at a time after T_0, by the formula,
each motion has had an event before it.
"""

import math
from typing import NamedTuple

from cap.cells.flight import Moment, System, fast_before, flown, launch, moment, slow, steepest
from cap.cells.motion import (
    HIT_L,
    HIT_R,
    REST,
    STICK,
    TURN_LEFT,
    TURN_RIGHT,
    WALL,
    Motion,
    exact,
    lose,
    matrix_at,
    ranges,
    set_matrix,
    tell,
)
from cap.cells.transverse import reversed_
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    between,
    clipped,
    is_finite,
    is_negative,
    is_positive,
    lower,
    magnitude,
    upper,
    widened,
)

WIDEST = 1.0  # of the times of an undecided event, in units of 1/ω

SPEED_ABOVE, SPEED_BELOW, GAP_ABOVE, GAP_BELOW = 0, 1, 2, 3
BOUNCE, LEAN, TURN, HOLD, PASS = 1, 2, 4, 8, 16  # the possible continuations, as bits


class Windows(NamedTuple):
    """The first and last time at which a motion of the set may stop, and hit; inf: never.

    ``top``: each motion has had an event by then, or the end is reached.
    """

    stop: float
    hit: float
    done: float
    top: float


@kernel
def _margin(y: System, n: Motion, t: float, question: int) -> float:
    """Return a number that is > 0 only if, at the time t, all speeds or gaps are > 0, or < 0."""
    speed, gap = ranges(y, n, moment(n.flight.sign, exact(t)))
    if question == SPEED_ABOVE:
        return lower(speed)
    if question == SPEED_BELOW:
        return -upper(speed)
    return lower(gap) if question == GAP_ABOVE else -upper(gap)


@kernel
def _edge(y: System, n: Motion, sure: float, unsure: float, question: int) -> float:
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
def _stops(y: System, n: Motion, end: Moment) -> tuple[float, float]:
    """Return the first and last time of a stop; the first is below, the last above the truth."""
    begun, latest = lower(n.flight.t), upper(n.flight.t)
    first, last = math.inf, math.inf
    if not (n.rising != 0 or is_positive(n.flight.speed)):
        first = begun
    for k in range(4):
        at = slow(y, n.flight.sign, k)
        passed = lower(at.t) <= latest if n.rising != 0 else upper(at.t) < begun
        if passed:
            continue
        falls = lower(fast_before(y, at))
        if falls > upper(end.t):
            break
        final = upper(at.t) >= lower(end.t)
        knot = end if final else at
        speed = ranges(y, n, knot)[0]
        if first == math.inf and not is_positive(speed):
            first = _edge(y, n, max(begun, falls), lower(knot.t), SPEED_ABOVE)
        if is_negative(speed) and latest < lower(knot.t):
            last = upper(knot.t)
            if _margin(y, n, last, SPEED_BELOW) > 0:
                last = _edge(y, n, last, max(latest, falls), SPEED_BELOW)
            break
        if final:
            break
    return first, last


@kernel
def _hits(y: System, n: Motion, end: Moment, stops: tuple[float, float]) -> tuple[float, float]:
    """Return the first and last time of a hit, given those of a stop."""
    begun, latest = lower(n.flight.t), upper(n.flight.t)
    sure, top = min(stops[0], lower(end.t)), min(stops[1], upper(end.t))
    first, last = math.inf, math.inf
    if sure >= begun and _margin(y, n, sure, GAP_ABOVE) > 0:
        if sure < top and not is_positive(_during(y, n, sure, top)[1]):
            first = sure
    else:
        first = _edge(y, n, begun, max(begun, sure), GAP_ABOVE)
    if latest < top and _margin(y, n, top, GAP_BELOW) > 0:
        last = _edge(y, n, top, latest, GAP_BELOW)
    return first, last


@kernel
def _during(y: System, n: Motion, begin: float, end: float) -> tuple[Interval, Interval]:
    """Return all speeds and gaps at the times between two, by the formula."""
    span = between(begin, end)
    at = moment(n.flight.sign, exact(span.mid))
    speed, gap = ranges(y, n, at)
    speed = widened(speed, magnitude(exact(span.rad * steepest(y, at, speed, span.rad))))
    return speed, widened(gap, magnitude(exact(span.rad * magnitude(speed))))


@kernel
def _windows(y: System, n: Motion, end: Moment) -> Windows:
    """Return when the motions may stop and hit; ``end`` is as the flight sees it."""
    stops = _stops(y, n, end)
    hits = _hits(y, n, end, stops)
    done = min(stops[1], hits[1])
    return Windows(stops[0], hits[0], done, min(done, upper(end.t)))


@kernel
def _possible(y: System, n: Motion, w: Windows, end: Moment) -> int:
    """Return the bits of all continuations that are not excluded."""
    found = 0
    if w.hit <= w.top:
        pushed = moment(n.flight.sign, between(w.hit, w.top)).cos + y.alpha
        speed, _ = _during(y, n, w.hit, w.top)
        if not is_negative(speed):
            found |= BOUNCE
            if not (is_positive(speed) or is_negative(pushed)):
                found |= LEAN
    if w.stop <= w.top:
        pushed = moment(n.flight.sign, between(w.stop, w.top)).cos + y.alpha
        _, gap = _during(y, n, w.stop, w.top)
        if not is_negative(gap):
            found |= 0 if is_positive(pushed) else TURN
            found |= 0 if is_negative(pushed) else HOLD
    if w.done >= lower(end.t):
        speed, gap = ranges(y, n, end)
        if not (is_negative(speed) or is_negative(gap)):
            found |= PASS
    return found


@kernel
def chosen(bits: int, choice: int) -> tuple[int, int]:
    """Return how many bits there are, and the one of this number; if there is one only, that."""
    count, found = 0, 0
    for k in range(5):
        if bits >> k & 1:
            if count in (0, choice):
                found = 1 << k
            count += 1
    return count, found if choice < count else bits if count == 1 else 0


@kernel
def branch(y: System, n: Motion, end: Moment, choice: int) -> int:
    """Pass the next event of a flight, as the continuation of this number has it.

    Return how many continuations there may be.  A motion of the set has one of them at least.
    """
    w = _windows(y, n, end)
    begin = min(w.hit, w.stop)
    known = is_finite(n.flight.t) and is_finite(n.flight.speed) and is_finite(n.flight.gap)
    if not (known and (begin > w.top or w.top - begin < WIDEST)):
        lose(n)
        return 1
    count, kind = chosen(_possible(y, n, w, end), choice)
    if kind == PASS:
        _arrive(y, n, end)
    elif kind in (BOUNCE, LEAN):
        _strike(y, n, (w.hit, w.top), kind)
    elif kind in (TURN, HOLD):
        _stop(y, n, (w.stop, w.top), kind)
    else:
        lose(n)
    n.certain = 0
    return count


@kernel
def _arrive(y: System, n: Motion, end: Moment) -> None:
    """Pass no event until the end."""
    sign, (speed, gap) = n.flight.sign, ranges(y, n, end)
    if n.linear != 0:
        one_speed, one_gap = flown(y, n.centre, end)
        m = matrix_at(y, n, end.t)
        set_matrix(n, m.a, m.b, m.c, m.d)
        launch(n.centre, sign, end, one_speed, one_gap)
    inside = clipped(gap, 0.0, upper(y.width))
    launch(n.flight, sign, end, clipped(speed, 0.0, math.inf), inside)
    n.ended = 1


@kernel
def _strike(y: System, n: Motion, times: tuple[float, float], kind: int) -> None:
    """Pass a hit between two times: the motions leave the wall, or rest at it."""
    sign = n.flight.sign
    at = moment(sign, between(times[0], times[1]))
    speed, _ = _during(y, n, times[0], times[1])
    tell(n, HIT_R if sign > 0 else HIT_L)
    n.linear = 0
    if kind == LEAN:
        n.kind = WALL
        launch(n.flight, sign, at, exact(0.0), exact(0.0))
        return
    after = clipped(y.e * clipped(speed, 0.0, math.inf), 0.0, math.inf)
    launch(n.flight, -sign, reversed_(at), after, y.width)
    n.rising, n.bounced = 1 if is_positive(n.flight.cos - y.alpha) else 0, 1


@kernel
def _stop(y: System, n: Motion, times: tuple[float, float], kind: int) -> None:
    """Pass a stop between two times: the motions turn, or rest."""
    sign, begin = n.flight.sign, times[0]
    if kind == TURN:
        begin = _pushed_since(y, -sign, times[0], times[1])
    if not begin <= times[1]:
        lose(n)
        return
    at = moment(sign, between(begin, times[1]))
    gap = clipped(_during(y, n, begin, times[1])[1], 0.0, upper(y.width))
    n.linear, n.bounced = 0, 0
    if kind == HOLD:
        n.kind = REST
        tell(n, STICK)
        launch(n.flight, sign, at, exact(0.0), gap)
        return
    tell(n, TURN_RIGHT if sign < 0 else TURN_LEFT)
    behind = clipped(y.width - gap, 0.0, upper(y.width))
    launch(n.flight, -sign, reversed_(at), exact(0.0), behind)
    n.rising = 1


@kernel
def _pushed_since(y: System, sign: float, begin: float, end: float) -> float:
    """Return since when, between two times, the forcing can push a mass at rest to a side.

    It does from a slow time of that side to the next fast time.  Infinity if this may be so in two
    separate parts of the time between, which is shorter than `WIDEST`.
    """
    for k in range(4):
        at = slow(y, sign, k)
        if begin <= upper(at.t) and lower(at.t) <= end:
            since = max(begin, lower(at.t))
            return since if upper(fast_before(y, at)) < begin else math.inf
    return begin
