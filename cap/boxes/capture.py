"""The lemma of `cap.flow.capture` in intervals of doubles: hits that accumulate, and then rest."""

import math
from typing import NamedTuple

from cap.boxes.flight import Constants, cosines
from cap.sets.circular import sin_cos
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    is_finite,
    is_positive,
    lower,
    sqrt,
    square,
    upper,
)


class Rest(NamedTuple):
    """Whether the lemma holds, and by when the mass is at rest."""

    proved: bool
    until: float


@kernel
def _nothing() -> Rest:
    return Rest(False, 0.0)


@kernel
def capture(
    y: Constants, side: float, time: Interval, far: float, fast: float, leaving: bool
) -> Rest:
    """Apply the lemma to a mass within ``far`` of the wall of a side, with |v| <= ``fast``.

    ``leaving``: it has just left the wall.  As the window of the lemma is tried a multiple of what
    the hits would take under the force at the beginning.
    """
    begin = lower(time)
    cosine = sin_cos(time)[1]
    force = side * cosine.mid
    if not force > y.alpha.mid:
        return _nothing()
    press, hold = force + y.alpha.mid, force - y.alpha.mid
    ratio = y.e.mid * math.sqrt(hold / press)
    if not ratio < 1:
        return _nothing()
    arrival = math.sqrt(fast * fast + 2 * hold * far)
    first = (
        0.0 if leaving else fast / press + math.sqrt(2 * (far + fast * fast / (2 * press)) / hold)
    )
    again = fast if leaving else y.e.mid * arrival
    estimate = first + again * (1 / press + 1 / math.sqrt(press * hold)) / (1 - ratio)
    if not estimate < 1:
        return _nothing()
    window = 1.1
    for _ in range(6):
        end = upper(time) + window * estimate + 1e-12
        found = _lemma(y, side, (begin, upper(time), end), far, fast, leaving)
        if found.proved:
            return found
        window *= 1.25
    return _nothing()


@kernel
def _lemma(
    y: Constants,
    side: float,
    times: tuple[float, float, float],
    far: float,
    fast: float,
    leaving: bool,
) -> Rest:
    """Verify the lemma for a mass that enters between two times, to be at rest at the third."""
    begin, entered, end = times
    if not end - begin < 1:
        return _nothing()
    b = cosines(side, begin, end)
    least, most = Interval(lower(b), 0.0), Interval(upper(b), 0.0)
    press, hold, hardest = least + y.alpha, least - y.alpha, most - y.alpha
    if not is_positive(hold):
        return _nothing()
    u, distance = Interval(fast, 0.0), Interval(far, 0.0)
    gain = hardest / press
    ratio = y.e * sqrt(gain)
    larger = Interval(max(upper(gain), 1.0), 0.0)
    speeds = square(u) * larger + 2.0 * (hardest * distance)
    if leaving:
        speeds = square(u / y.e)
    height = distance + square(u) / (2.0 * press)
    arrival = Interval(_root(upper(speeds)), 0.0)
    g = hold - y.mu * arrival
    room = is_positive(y.width - height) and is_positive(2.0 * (press * y.width) - speeds)
    if not (is_positive(g) and is_positive(1.0 - ratio) and room):
        return _nothing()
    bounce = 1.0 / press + 1.0 / sqrt(press * g)
    last = bounce * (y.e * arrival) / (1.0 - ratio)
    if not leaving:
        last = last + u / press + Interval(_root(upper(2.0 * (height / g))), 0.0)
    until = upper(Interval(entered, 0.0) + last)
    if not (is_finite(last) and until <= end):
        return _nothing()
    return Rest(True, until)


@kernel
def _root(x: float) -> float:
    """Return an upper bound of sqrt(x), which may be 0."""
    return 0.0 if x == 0 else upper(sqrt(Interval(x, 0.0)))
