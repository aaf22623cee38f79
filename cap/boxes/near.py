"""A mass near a wall, moving or at rest, of which no more is known than how far and how fast.

Let y >= 0 be the distance from a wall, w = y', and b the force towards the wall, as in
`cap.flow.capture`.

*Lemma.*  Let b_1 <= b <= b_2 on a time interval, b_1 > -f, e² (b_2 - f) <= b_1 + f, and let y <= δ,
|w| <= u at a time of it.  Put c = max(b_2 - f, 0),

    H = δ + u²/(2 (b_1 + f)),      q² = 2 c δ + u² max(1, c/(b_1 + f)).

If H < R, then y <= H and |w| <= q until its end.  If |b| < f on the interval and the integral of
f - |b| from that time on exceeds u, the mass has come to rest in it, and is at rest at its end.

*Proof.*  While w > 0, w' <= -(b_1 + f), while w < 0, |w|' <= c.  So the mass rises to H at most, at
first, and falls with |w| <= q.  It leaves the wall with a speed of at most e q, rises to
e² q²/(2 (b_1 + f)) <= H, because e² c <= b_1 + f, and comes back with e q sqrt(c/(b_1 + f)) <= q at
most; and so on.  If it rests between and is pushed to the wall, it falls with w² <= 2 c H <= q².
Where |b| < f, |w|' <= |b| - f while it is not 0, and a hit does not add to it; a mass at rest is
held.
"""

import math

from cap.boxes.capture import capture
from cap.boxes.depart import depart, departure
from cap.boxes.flight import Constants, Moment, cosines, moment
from cap.boxes.motion import (
    CAPTURE_L,
    CAPTURE_R,
    HIT_L,
    HIT_R,
    REST,
    STICK,
    STOPPED,
    TURN_LEFT,
    TURN_RIGHT,
    WALL,
    Motion,
    exact,
    lose,
)
from cap.boxes.rest import lean, stay_near
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    between,
    is_positive,
    lower,
    magnitude,
    sqrt,
    square,
    upper,
)

HIGHEST = 0.05  # H, in units of F/ω²: above, it is better to follow the flights
HALVINGS = 6
VAGUE = 1.0  # a relative uncertainty of speeds and gaps


@kernel
def _reach(
    y: Constants, side: float, times: tuple[float, float], far: float, fast: float
) -> tuple[float, float]:
    """Return H and q of the lemma for δ = far, u = fast between two times; NaN if it fails."""
    begin, end = times
    if not (begin <= end and end - begin < 3):
        return math.nan, math.nan
    b = cosines(side, begin, end)
    press = exact(lower(b)) + y.alpha
    most = exact(max(upper(exact(upper(b)) - y.alpha), 0.0))
    slack = press - square(y.e) * most
    if not (is_positive(press) and is_positive(slack)):
        return math.nan, math.nan
    u, gain = exact(fast), most / press
    height = exact(far) + square(u) / (2.0 * press)
    larger = exact(max(upper(gain), 1.0))
    speeds = 2.0 * (most * exact(far)) + square(u) * larger
    if not is_positive(y.width - height):
        return math.nan, math.nan
    return magnitude(height), upper(sqrt(exact(upper(speeds)))) if fast > 0 or far > 0 else 0.0


@kernel
def approach(y: Constants, n: Motion, end: Moment) -> bool:
    """Forget all but that the motions are near a wall, if no more is known of them anyway."""
    f = n.flight
    if f.speed.rad < VAGUE * f.speed.mid or (n.bounced == 0 and f.gap.rad < VAGUE * f.gap.mid):
        return False
    for side in (f.sign, -f.sign):
        far = upper(f.gap) if side == f.sign else upper(y.width - f.gap)
        fast, since = magnitude(f.speed), f.t
        if upper(since) < lower(end.t) and may_linger(y, side, since, far, fast):
            stay_near(n, side, since, max(far, 0.0), fast)
            return True
    return False


@kernel
def may_linger(y: Constants, side: float, since: Interval, far: float, fast: float) -> bool:
    """Return whether this lemma holds at once, or that of `cap.boxes.depart`, with a small H."""
    high, _ = _reach(y, side, (lower(since), upper(since)), max(far, 0.0), fast)
    return high <= HIGHEST or departure(y, side, since, max(far, 0.0), fast)[1] <= HIGHEST


@kernel
def linger(y: Constants, n: Motion, end: Moment, choice: int) -> int:
    """Follow motions near a wall: to rest, or until a later time.

    Return how many ways there may be; what is done is that of this number.
    """
    side, since = n.flight.sign, n.flight.t
    far, fast = max(upper(n.flight.gap), 0.0), magnitude(n.flight.speed)
    found = capture(y, side, since, far, fast, False)
    if found.proved and found.until < lower(end.t):
        lean(n, side, between(lower(since), found.until))
        return 1
    _note(n, side)
    rest = _settled(y, side, since, fast)
    if rest < lower(end.t):
        return _settle(y, n, rest, (far, fast), choice)
    if depart(y, n, end, far, fast):
        return 1
    goal = min(_goal(y, side, upper(since)), upper(end.t))
    for _ in range(HALVINGS):
        high, most = _reach(y, side, (lower(since), goal), far, fast)
        if high < math.inf and most < math.inf:
            break
        goal = upper(since) + 0.5 * (goal - upper(since))
    if not (high < math.inf and most < math.inf and goal > upper(since)):
        lose(n)
        return 1
    stay_near(n, side, exact(goal), high, most)
    n.ended = 1 if goal >= upper(end.t) else 0
    return 1


@kernel
def _note(n: Motion, side: float) -> None:
    """Note what may happen near a wall."""
    right = 1 << HIT_R | 1 << TURN_RIGHT | 1 << CAPTURE_R
    left = 1 << HIT_L | 1 << TURN_LEFT | 1 << CAPTURE_L
    n.maybe = n.maybe | 1 << STICK | 1 << STOPPED | (right if side > 0 else left)


@kernel
def _goal(y: Constants, side: float, t: float) -> float:
    """Return a time until which a mass may linger: when the force towards the wall falls to f.

    If it is less already, soon.  Any number will do.
    """
    phase = t if side > 0 else t - math.pi
    phase -= 2 * math.pi * math.floor(phase / (2 * math.pi) + 0.5)
    left = y.arc.mid - phase
    return t + (left + 1e-9 if left > 0 else 0.1)


@kernel
def _settled(y: Constants, side: float, since: Interval, fast: float) -> float:
    """Return a time by which friction has brought the mass to rest; infinity if there is none."""
    begun, until = upper(since), upper(since)
    for _ in range(40):
        until = until + 0.02
        b = cosines(side, lower(since), until)
        if not (is_positive(y.alpha - b) and is_positive(y.alpha + b)):
            break
        if _drop(y, side, begun, until) > fast:
            return until
    return math.inf


@kernel
def _drop(y: Constants, side: float, begin: float, end: float) -> float:
    """Return a lower bound of the integral of f - |b|, between times in an arc where |b| < f.

    The integral of |cos| is |sin - sin| if the cosine has one sign, else 2 - |sin| - |sin|.
    """
    first, last = moment(side, exact(begin)), moment(side, exact(end))
    lasts = y.alpha * (exact(end) - exact(begin))
    one_sign = (first.cos.mid > 0) == (last.cos.mid > 0)
    sines = magnitude(first.sin - last.sin)
    if not one_sign:
        sines = magnitude(2.0 - (_size(first.sin) + _size(last.sin)))
    return lower(lasts - exact(sines))


@kernel
def _size(x: Interval) -> Interval:
    return -x if x.mid < 0 else x


@kernel
def _settle(y: Constants, n: Motion, until: float, size: tuple[float, float], choice: int) -> int:
    """Let the motions come to rest by a time, at the wall or before it.

    If the release that follows is away from the wall, it does not matter which.
    """
    side, begin = n.flight.sign, lower(n.flight.t)
    high, _ = _reach(y, side, (begin, until), size[0], size[1])
    if not high < math.inf:
        lose(n)
        return 1
    falls = is_positive(moment(side, between(begin, until)).sin)
    stay_near(n, side, between(begin, until), high, 0.0)
    n.words, n.kind = n.words | 1 << STOPPED, REST
    n.flight.speed, n.centre.speed = exact(0.0), exact(0.0)
    n.base.w, n.d = 0.0, exact(0.0)
    if falls:
        return 1
    if choice == 1:
        n.kind = WALL
    return 2
