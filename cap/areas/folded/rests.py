"""Compiled: rests of a mass near a wall, after a slow hit.

Two lemmas, for all hits of some times, modulo 2 pi, and of a speed of u at most.

*Captures.*  Let b_1 <= cos t <= b_2 from the hit to t_d, b_1 > a, rise = b_1 + a, fall = b_2 - a, g
= b_1 - a, k = sqrt(fall/rise) < 1 and u² < 2 rise W.  If (1/rise + 1/sqrt(rise g)) u/(1 - k) is at
most the time until t_d, the mass rests at the wall from then on: the speeds of its hits decrease by
a factor k at least, from one to the next.

*Coming to rest near the wall*, after a hit at t >= 0.  Until t_e <= pi/2 cos t >= 0 falls: so a
mass that comes back is not faster than before, and never higher than u²/(2 a).  After t_1 > theta
it does not begin to fall, and falling it brakes at D = a - cos t_1 at least.  So if t_1 + u/D + u/a
<= t_e, it rests from then on until its release.
"""

import math

from cap.areas.folded.backward import TURN, TURN_ERROR, Constants, Pair
from cap.areas.folded.polynomials import UP
from cap.sets.circular import sin_cos_of_double
from cap.sets.compiled import kernel

SLOW, LOW = 0.35, 0.001  # speeds for which a capture is tried; heights that count as none
MARGIN = 2e-12  # more than the errors of cosines here
LATER, LATEST = 0.2, 1.5  # t_1 - theta, and t_1 at most
END = 1.57  # less than pi/2


@kernel
def height(y: Constants, ends: Pair, speed: float) -> float:
    """Return how far from the wall the mass may rest after a slow hit, or -1."""
    if not speed <= SLOW:
        return -1.0
    k = round(0.5 * (ends[0] + ends[1]) / TURN)
    e = abs(k) * TURN_ERROR + MARGIN
    begin, latest = ends[0] - TURN * k - e, ends[1] - TURN * k + e
    for n in range(1, 5):
        if _captures(y, begin, latest, speed, latest + 2.0**n * speed):
            return 0.0
    low = speed * speed / (2 * y.a) * UP
    return low if low < LOW and _settles(y, begin, latest, speed) else -1.0


@kernel
def _captures(y: Constants, begin: float, latest: float, speed: float, until: float) -> bool:
    """Return whether a capture follows until a time."""
    theta = y.theta - y.theta_error - MARGIN
    if not (-theta < begin and until < theta):
        return False
    first, last = sin_cos_of_double(begin)[1], sin_cos_of_double(until)[1]
    least = min(first, last) - MARGIN
    most = 1.0 if begin <= 0 <= until else max(first, last) + MARGIN
    rise, fall, g = least + y.a - MARGIN, most - y.a + MARGIN, least - y.a - MARGIN
    if not (g > 0 and fall < rise and speed * speed < rise * y.width):
        return False
    bounces = (1 / rise + 1 / math.sqrt(rise * g)) / (1 - math.sqrt(fall / rise)) * speed
    return latest + bounces * (1 + 1e-8) <= until


@kernel
def _settles(y: Constants, begin: float, latest: float, speed: float) -> bool:
    """Return whether the mass comes to rest near the wall."""
    late = max(latest, y.theta) + LATER
    if begin < 0 or late > LATEST:
        return False
    drag = y.a - sin_cos_of_double(late)[1] - MARGIN
    return drag > 0 and late + (speed / drag + speed / y.a) * (1 + 1e-8) <= END
