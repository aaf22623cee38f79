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

from cap.cells.flight import Moment, System, fast_before, flown, force, launch, moment, slow, steepest
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
    place_anywhere,
    ranges,
    rebase,
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
    sqrt,
    square,
    upper,
    widened,
)

WIDEST = 1.0  # of the times of an undecided event, in units of 1/ω

SPEED_ABOVE, SPEED_BELOW, GAP_ABOVE, GAP_BELOW = 0, 1, 2, 3
BOUNCE, LEAN, TURN, HOLD, PASS = 1, 2, 4, 8, 16  # the possible continuations, as bits


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
def _stops(y: System, n: Motion, end: Moment) -> tuple[float, float, Moment]:
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
def _hits(y: System, n: Motion, w: tuple[float, float, Moment]) -> tuple[float, float]:
    """Return the first and last time of a hit, given what `_stops` says."""
    begun, latest, end = lower(n.flight.t), upper(n.flight.t), w[2].t
    sure, top = min(w[0], lower(end)), min(w[1], upper(end))
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
def _push(y: System, n: Motion, until: float) -> Interval:
    """Return all u' of the flights until a time."""
    begun = lower(n.flight.t)
    span = moment(n.flight.sign, between(begun, until))
    speed = n.flight.speed
    if y.viscous != 0:
        speed = clipped(_during(y, n, begun, until)[0], 0.0, math.inf)
    return force(y, span.cos, speed)


@kernel
def _hit_speed(y: System, n: Motion, begin: float, end: float) -> Interval:
    """Return the speeds of hits between two times; NaN if there are none.

    By the formula, and by the energy: u² at the hit is u0² + 2 u' gap0, with a mean of u'.
    """
    speed = clipped(_during(y, n, begin, end)[0], 0.0, math.inf)
    energy = square(n.flight.speed) + 2.0 * (_push(y, n, end) * n.flight.gap)
    if upper(energy) < 0:
        return energy / exact(0.0)
    least = lower(energy)
    low = lower(sqrt(exact(least))) if least > 0 else 0.0
    high = upper(sqrt(exact(upper(energy)))) if upper(energy) > 0 else 0.0
    return clipped(speed, low, high)


@kernel
def _stop_gap(y: System, n: Motion, begin: float, end: float) -> Interval:
    """Return the gaps at stops between two times; NaN if there are none.

    By the formula, and by the energy: a flight that stops has gone u0²/(-2u'), with a mean of u'.
    """
    gap = clipped(_during(y, n, begin, end)[1], 0.0, upper(y.width))
    push = _push(y, n, end)
    if not is_negative(push):
        return gap
    left = n.flight.gap - square(n.flight.speed) / (-2.0 * push)
    return clipped(gap, lower(left), upper(left))


@kernel
def windows(y: System, n: Motion, end: Moment) -> Windows:
    """Return when the motions may stop and hit; ``end`` is as the flight sees it."""
    stops = _stops(y, n, end)
    hits = _hits(y, n, stops)
    done = min(stops[1], hits[1])
    return Windows(stops[0], hits[0], done, min(done, upper(stops[2].t)), stops[2])


@kernel
def _possible(y: System, n: Motion, w: Windows) -> int:
    """Return the bits of all continuations that are not excluded."""
    found, sign = 0, n.flight.sign
    if w.hit <= w.top:
        pushed = moment(sign, between(w.hit, w.top)).cos + y.alpha
        speed = _hit_speed(y, n, w.hit, w.top)
        if is_finite(speed):
            found |= BOUNCE
            if not (is_positive(speed) or is_negative(pushed)):
                found |= LEAN
    if w.stop <= w.top:
        pushed = moment(sign, between(w.stop, w.top)).cos + y.alpha
        if is_finite(_stop_gap(y, n, w.stop, w.top)):
            found |= 0 if is_positive(pushed) else TURN
            found |= 0 if is_negative(pushed) else HOLD
    if w.done >= lower(w.horizon.t):
        speed, gap = ranges(y, n, w.horizon)
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
    w = windows(y, n, end)
    begin = min(w.hit, w.stop)
    known = is_finite(n.flight.t) and is_finite(n.flight.speed) and is_finite(n.flight.gap)
    if not (known and (begin > w.top or w.top - begin < WIDEST)):
        lose(n)
        return 1
    count, kind = chosen(_possible(y, n, w), choice)
    if kind == PASS:
        _go_on(y, n, w.horizon)
        n.ended = 1 if upper(w.horizon.t) >= lower(end.t) else 0
    elif kind in (BOUNCE, LEAN):
        _strike(y, n, (w.hit, w.top), kind)
    elif kind in (TURN, HOLD):
        _stop(y, n, (w.stop, w.top), kind)
    else:
        lose(n)
    n.certain = 0
    return count


@kernel
def _go_on(y: System, n: Motion, at: Moment) -> None:
    """Pass no event until a moment; if it is a slow one, the forcing pushes ahead from there."""
    sign, (speed, gap) = n.flight.sign, ranges(y, n, at)
    one_speed, one_gap = flown(y, n.centre, at)
    m = matrix_at(y, n, at.t)
    set_matrix(n, m.a, m.b, m.c, m.d)
    launch(n.centre, sign, at, one_speed, one_gap)
    inside = clipped(gap, 0.0, upper(y.width))
    launch(n.flight, sign, at, clipped(speed, 0.0, math.inf), inside)
    n.rising, n.bounced = 1, 0


@kernel
def _strike(y: System, n: Motion, times: tuple[float, float], kind: int) -> None:
    """Pass a hit between two times: the motions leave the wall, or rest at it."""
    sign, zero = n.flight.sign, exact(0.0)
    at = moment(sign, between(times[0], times[1]))
    speed = _hit_speed(y, n, times[0], times[1])
    tell(n, HIT_R if sign > 0 else HIT_L)
    if kind == LEAN:
        n.kind = WALL
        launch(n.flight, sign, at, zero, zero)
        return
    after = clipped(y.e * speed, 0.0, math.inf)
    launch(n.flight, -sign, reversed_(at), after, y.width)
    push = force(y, n.flight.cos, after)
    _begin_anew(n, at.t, exact(after.mid), y.width)
    rebase(n, at.t.rad, after.rad)
    set_matrix(n, -after, zero, -push, exact(1.0))
    n.rising, n.bounced = 1 if is_positive(n.flight.cos - y.alpha) else 0, 1


@kernel
def _begin_anew(n: Motion, t: Interval, speed: Interval, gap: Interval) -> None:
    """Let the flight for m begin in the middle of a time.

    For those who begin at a time t0 with a speed u0, the derivative of (s x, u) at a fixed time by
    t0 is the drift of (-u0, -u'(t0)).
    """
    at = moment(n.flight.sign, exact(t.mid))
    launch(n.centre, n.flight.sign, at, speed, gap)


@kernel
def _stop(y: System, n: Motion, times: tuple[float, float], kind: int) -> None:
    """Pass a stop between two times: the motions turn, or rest."""
    sign, begin, zero = n.flight.sign, times[0], exact(0.0)
    if kind == TURN:
        begin = _pushed_since(y, -sign, times[0], times[1])
    if not begin <= times[1]:
        lose(n)
        return
    at = moment(sign, between(begin, times[1]))
    gap = _stop_gap(y, n, begin, times[1])
    n.bounced = 0
    if kind == HOLD:
        n.kind = REST
        tell(n, STICK)
        launch(n.flight, sign, at, zero, gap)
        place_anywhere(n)
        return
    tell(n, TURN_RIGHT if sign < 0 else TURN_LEFT)
    behind = clipped(y.width - gap, 0.0, upper(y.width))
    launch(n.flight, -sign, reversed_(at), zero, behind)
    _begin_anew(n, at.t, zero, exact(behind.mid))
    rebase(n, at.t.rad, behind.rad)
    set_matrix(n, zero, exact(-1.0), y.alpha - n.flight.cos, zero)
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
