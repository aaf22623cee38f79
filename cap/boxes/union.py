"""Events that may be one thing or another: each possible continuation, none dropped."""

import math

from cap.boxes.flight import (
    Constants,
    Moment,
    cosines,
    fast_before,
    flown,
    force,
    launch,
    moment,
    slow,
)
from cap.boxes.motion import (
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
from cap.boxes.transverse import reversed_
from cap.boxes.windows import Windows, during, windows
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    between,
    clipped,
    is_finite,
    is_negative,
    is_positive,
    lower,
    sqrt,
    square,
    upper,
)

WIDEST = 1.0  # of the times of an undecided event, in units of 1/ω

BOUNCE, LEAN, TURN, HOLD, PASS = 1, 2, 4, 8, 16  # the possible continuations, as bits


@kernel
def _push(y: Constants, n: Motion, until: float) -> Interval:
    """Return all u' of the flights until a time."""
    begun = lower(n.flight.t)
    push = cosines(n.flight.sign, begun, until) - y.alpha
    if y.viscous != 0:
        push = push - y.mu * clipped(during(y, n, begun, until)[0], 0.0, math.inf)
    return push


@kernel
def _hit_speed(y: Constants, n: Motion, begin: float, end: float) -> Interval:
    """Return the speeds of hits between two times; NaN if there are none.

    By the formula, and by the energy: u² at the hit is u0² + 2 u' gap0, with a mean of u'.
    """
    speed = clipped(during(y, n, begin, end)[0], 0.0, math.inf)
    energy = square(n.flight.speed) + 2.0 * (_push(y, n, end) * n.flight.gap)
    if upper(energy) < 0:
        return energy / exact(0.0)
    least = lower(energy)
    low = lower(sqrt(exact(least))) if least > 0 else 0.0
    high = upper(sqrt(exact(upper(energy)))) if upper(energy) > 0 else 0.0
    return clipped(speed, low, high)


@kernel
def _stop_gap(y: Constants, n: Motion, begin: float, end: float) -> Interval:
    """Return the gaps at stops between two times; NaN if there are none.

    By the formula, and by the energy: a flight that stops has gone u0²/(-2u'), with a mean of u'.
    """
    gap = clipped(during(y, n, begin, end)[1], 0.0, upper(y.width))
    push = _push(y, n, end)
    if not is_negative(push):
        return gap
    left = n.flight.gap - square(n.flight.speed) / (-2.0 * push)
    return clipped(gap, lower(left), upper(left))


@kernel
def _possible(y: Constants, n: Motion, w: Windows) -> int:
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
def branch(y: Constants, n: Motion, end: Moment, choice: int) -> int:
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
def _go_on(y: Constants, n: Motion, at: Moment) -> None:
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
def _strike(y: Constants, n: Motion, times: tuple[float, float], kind: int) -> None:
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
def _stop(y: Constants, n: Motion, times: tuple[float, float], kind: int) -> None:
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
def _pushed_since(y: Constants, sign: float, begin: float, end: float) -> float:
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
