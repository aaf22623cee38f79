"""How the motions of a set of states begin."""

import math

from cap.boxes.doubleton import Doubleton, box_of, set_base
from cap.boxes.flight import Constants, Moment, launch, seen
from cap.boxes.motion import FLY, REST, WALL, Motion, exact, lose, rebase, set_matrix
from cap.boxes.near import may_linger
from cap.boxes.rest import stay_near
from cap.boxes.union import chosen
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    clipped,
    is_finite,
    is_negative,
    is_positive,
    lower,
    magnitude,
    upper,
)

AHEAD, BACK, STILL, LEAN_R, LEAN_L = 1, 2, 4, 8, 16


@kernel
def begin(y: Constants, n: Motion, d: Doubleton, start: Moment, choice: int) -> int:
    """Begin the motions of a set, in the way of this number; return how many ways there may be.

    The states beyond the walls, which a box may have, are left out.
    """
    x, v = box_of(d)
    inside = clipped(x, -upper(y.width), 0.0)
    n.kind, n.ended, n.certain = FLY, 0, 1
    n.rising, n.bounced, n.words, n.maybe, n.itinerary = 0, 0, 0, 0, 0
    set_base(n.base, d)
    if not (is_finite(inside) and is_finite(v)):
        lose(n)
    elif d.kind == REST:
        n.kind = REST
        _start(y, n, 1.0, start, (inside, exact(d.x)), (exact(0.0), exact(0.0)))
        n.d = exact(0.0)
    elif d.kind == WALL:
        n.kind = WALL
        _start(y, n, d.side, start, (inside, exact(d.x)), (exact(0.0), exact(0.0)))
    elif is_positive(v) or is_negative(v):
        sign = 1.0 if is_positive(v) else -1.0
        _start(y, n, sign, start, (inside, exact(d.x)), (v, exact(d.v)))
    else:
        n.certain = 0
        if not (_near(y, n, 1.0, x, v, start) or _near(y, n, -1.0, x, v, start)):
            return _split(y, n, (inside, v), start, choice)
    return 1


@kernel
def _gap(y: Constants, sign: float, x: Interval) -> Interval:
    """Return the gap to the wall of a sign; x is measured from the right wall."""
    return -x if sign > 0 else y.width + x


@kernel
def _start(
    y: Constants,
    n: Motion,
    sign: float,
    start: Moment,
    x: tuple[Interval, Interval],
    v: tuple[Interval, Interval],
) -> None:
    """Write the flight, or rest, of the states (x, v) of a box, and that of its point m."""
    at, zero = seen(sign, start), exact(0.0)
    speed, own = (v[0], v[1]) if sign > 0 else (-v[0], -v[1])
    gap = clipped(_gap(y, sign, x[0]), 0.0, upper(y.width))
    launch(n.flight, sign, at, speed, gap)
    launch(n.centre, sign, at, own, _gap(y, sign, x[1]))
    set_matrix(n, exact(sign), zero, zero, exact(sign))


@kernel
def _near(y: Constants, n: Motion, side: float, x: Interval, v: Interval, start: Moment) -> bool:
    """Forget all but that the states of a box are near the wall of a side, if they are at it."""
    gap = _gap(y, side, x)
    if not lower(gap) <= 0:
        return False
    if not may_linger(y, side, start.t, upper(gap), magnitude(v)):
        return False
    stay_near(n, side, start.t, max(upper(gap), 0.0), magnitude(v))
    return True


@kernel
def _possible(y: Constants, x: Interval, v: Interval, start: Moment) -> int:
    """Return the bits of the ways in which the states of a box may begin, if v may be 0."""
    ahead, back = start.cos - y.alpha, start.cos + y.alpha
    bits = 0
    if upper(v) > 0 or not is_negative(ahead):
        bits |= AHEAD
    if lower(v) < 0 or not is_positive(back):
        bits |= BACK
    if not (is_positive(ahead) or is_negative(back)):
        bits |= STILL
    if not is_negative(back) and lower(_gap(y, 1.0, x)) <= 0:
        bits |= LEAN_R
    if not is_positive(ahead) and lower(_gap(y, -1.0, x)) <= 0:
        bits |= LEAN_L
    return bits


@kernel
def _split(
    y: Constants, n: Motion, box: tuple[Interval, Interval], start: Moment, choice: int
) -> int:
    """Begin the states of a box of one sign, or those with v = 0; return how many ways there are.

    Those of one sign are a box of their own, the base of what follows.
    """
    x, v = box
    count, kind = chosen(_possible(y, x, v, start), choice)
    zero = exact(0.0)
    if kind in (STILL, LEAN_R, LEAN_L):
        n.kind = REST if kind == STILL else WALL
        sign = -1.0 if kind == LEAN_L else 1.0
        _start(y, n, sign, start, (x, exact(x.mid)), (zero, zero))
        rebase(n, x.rad, 0.0)
        return count
    half = clipped(v, 0.0, math.inf) if kind == AHEAD else clipped(v, -math.inf, 0.0)
    sign = 1.0 if kind == AHEAD else -1.0
    _start(y, n, sign, start, (x, exact(x.mid)), (half, exact(half.mid)))
    n.flight.speed = clipped(n.flight.speed, 0.0, math.inf)
    n.rising = 1 if is_positive(n.flight.cos - y.alpha) else 0
    rebase(n, x.rad, half.rad)
    return count
