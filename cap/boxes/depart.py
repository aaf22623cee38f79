"""A mass near a wall when the force away from it comes to exceed friction: it leaves.

Let y >= 0 be the distance from a wall, w = y', b the force towards the wall, as in
`cap.boxes.near`.

*Lemma.*  Let b_1 <= b <= b_2 < f on a time interval [t_1, t_2], let b fall through -f at t_s < t_2,
and be below -f from then to t_2.  Let y <= δ and |w| <= u at a time of [t_1, t_0].  Put L = t_2 -
t_1 and c = max(0, -b_1 - f).  If t_2 > t_0 + u/(f - b_2) and H = δ + L (u + cL) < R, then at t_2

    0 < w <= u + cL,      y <= H,

and the mass has not hit the other wall.

*Proof.*  While w > 0, w' = -b - f <= c; while w < 0, |w|' = b - f <= b_2 - f < 0; a hit turns |w|
to e |w| or less, away from the wall; a mass at rest stays so, or leaves with w' <= c.  So |w| <= u
+ cL and y <= H.  A mass with w < 0 stops, or hits, within u/(f - b_2); one with w >= 0 does not
come back, as that needs b > f.  So w >= 0 at the end; and w = 0 only if it rests, or stops, where b
< -f: it does not."""

import math

from cap.boxes.flight import Constants, Moment, cosines, launch, moment, slow
from cap.boxes.motion import (
    FLY,
    RELEASE_L,
    RELEASE_R,
    TURN_LEFT,
    TURN_RIGHT,
    Motion,
    exact,
    rebase,
    set_matrix,
)
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    between,
    clipped,
    is_finite,
    is_positive,
    lower,
    magnitude,
    upper,
)

LONGEST = 0.5  # L, in units of 1/ω: above, it is better to follow the flights


@kernel
def departure(
    y: Constants, side: float, since: Interval, far: float, fast: float
) -> tuple[float, float, float]:
    """Return t_2 of the lemma, H, and the bound of w; infinity for the first if it does not hold.

    The mass is within ``far`` of the wall of a side, with |w| <= ``fast``, at a time of ``since``.
    """
    for k in range(4):
        leave = slow(y, -side, k).t
        if upper(leave) < lower(since) - LONGEST:
            continue
        until = _late_enough(y, side, since, upper(leave), fast)
        before_fall = lower(leave + 2.0 * y.arc)
        if not (until - lower(since) < LONGEST and upper(leave) < until < before_fall):
            break
        b = cosines(side, lower(since), until)
        rest = y.alpha - b
        wait = exact(fast) / exact(lower(rest))
        if not (is_positive(rest) and until > upper(exact(upper(since)) + wait)):
            break
        length = exact(until) - exact(lower(since))
        push = exact(max(upper(-b - y.alpha), 0.0))
        speed = exact(fast) + push * length
        high = exact(far) + length * speed
        if is_finite(high) and is_positive(y.width - high):
            return until, magnitude(high), magnitude(speed)
        break
    return math.inf, math.inf, math.inf


@kernel
def _late_enough(y: Constants, side: float, since: Interval, leave: float, fast: float) -> float:
    """Return a time by which the mass may have left.  Any number will do."""
    soonest = max(upper(since), leave)
    rest = y.alpha.mid - cosines(side, lower(since), soonest).mid
    wait = 2 * fast / rest if rest > 0 else math.inf
    return max(soonest, upper(since) + wait) + fast + 1e-9


@kernel
def depart(y: Constants, n: Motion, end: Moment, far: float, fast: float) -> bool:
    """Let motions near a wall leave it, if the lemma says that all do."""
    side = n.flight.sign
    until, high, most = departure(y, side, n.flight.t, far, fast)
    if not until < lower(end.t):
        return False
    sign, zero = -side, exact(0.0)
    at = moment(sign, exact(until))
    if not is_positive(at.cos - y.alpha):
        return False
    speed = between(0.0, most)
    gap = clipped(y.width - between(0.0, high), 0.0, upper(y.width))
    launch(n.flight, sign, at, speed, gap)
    launch(n.centre, sign, at, exact(speed.mid), exact(gap.mid))
    rebase(n, gap.rad, speed.rad)
    set_matrix(n, exact(-1.0), zero, zero, exact(1.0))
    n.kind, n.certain, n.rising, n.bounced = FLY, 0, 1, 0
    left = 1 << TURN_LEFT | 1 << RELEASE_L
    n.maybe = n.maybe | (left if side > 0 else 1 << TURN_RIGHT | 1 << RELEASE_R)
    return True
