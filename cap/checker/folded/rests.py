"""Rests of a mass near a wall, after a slow hit: lemmas for all hits of some times and speeds.

*Captures* are as in ``cap.checker.flow.capture``, e = 1, mu = 0: if b_1 <= cos t <= b_2 from the
hit, with a speed of at most u, to the time t_d, b_1 > a, rise = b_1 + a, fall = b_2 - a, g = b_1 -
a, k = sqrt(fall/rise) < 1, u^2 < 2 rise W, and (1/rise + 1/sqrt(rise g)) u/(1 - k) is at most the
time until t_d, then the mass rests at the wall from then on, until it is released from there at pi
- theta in the other direction: folded, from p = -W.

*Coming to rest near the wall.*  Let a hit be at the time t >= 0, with a speed of at most u, and
until the time t_e <= pi/2 let nothing be required.  Until then cos t decreases and is >= 0.  So
while the mass rises from the wall, its speed decreases at the rate cos t + a >= a, and while it
falls, it grows, if at all, at a smaller rate than it decreased before at the same height: it comes
back with at most the speed u, and is never higher than u^2/(2 a).  After t_1 > theta, it does not
begin to fall, and falling it loses speed at the rate D = a - cos t_1 at least: so it stops, or hits
the wall, within u/D, and then stops within u/a.  If t_1 + u/D + u/a <= t_e, it rests from then on
until its release at pi - theta, u^2/(2 a) at most from the wall.
"""

from __future__ import annotations

import math

from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import UP, Pair
from cap.checker.kernel.angles import cos_sin

_SLOW, _LOW = 0.35, 0.001  # speeds for which a capture is tried; heights that count as none
_WAITS = (2.0, 4.0, 8.0, 16.0)


def height(y: Direction, ends: Pair, speed: float) -> float | None:
    """Return how far from the wall the mass may rest after a slow hit, or None."""
    if speed > _SLOW:
        return None
    turn, e = y.multiple(2 * round((ends[0] + ends[1]) / (4 * math.pi)))
    begin, latest = ends[0] - turn - e - 1e-13, ends[1] - turn + e + 1e-13
    if captures(y, (begin, latest), speed):
        return 0.0
    low = speed * speed / (2 * -y.a) * UP
    return low if low < _LOW and settles(y, (begin, latest), speed) else None


def captures(y: Direction, ends: Pair, speed: float) -> bool:
    """Return whether a capture follows a hit at a time between these, modulo 2 pi."""
    theta, a = y.rest[0] - y.rest[1], -y.a
    for wait in _WAITS:
        until = ends[1] + wait * speed
        if not (-theta < ends[0] and until < theta):
            return False
        ahead = [cos_sin(t)[0] for t in (ends[0], until)]
        least, most = min(ahead) - 1e-12, 1.0 if ends[0] <= 0 <= until else max(ahead) + 1e-12
        rise, fall, g = least + a - 1e-12, most - a + 1e-12, least - a - 1e-12
        if g > 0 and fall < rise and speed * speed < rise * y.width[0]:
            bounces = (1 / rise + 1 / math.sqrt(rise * g)) / (1 - math.sqrt(fall / rise)) * speed
            if ends[1] + bounces * (1 + 1e-9) <= until:
                return True
    return False


def settles(y: Direction, ends: Pair, speed: float) -> bool:
    """Return whether the mass comes to rest near the wall after a hit, by the second lemma."""
    late = max(ends[1], y.rest[0]) + 0.2
    if ends[0] < 0 or late > 1.5:
        return False
    drag = -y.a - cos_sin(late)[0] - 1e-12
    return drag > 0 and late + (speed / drag + speed / -y.a) * (1 + 1e-9) <= 1.57
