"""Launches that stop before they reach the other wall.

Notation as in `cap.checker.strips.arc`.  Let v(T) < 0 at a time T; then there is a stop or a hit
before.  Let v > 0 until a time B, and v >= -m from B to T, m >= 0.  After a hit x would fall by m
(T - B) at most: so x(T) + m (T - B) < R excludes it.  (B may be the time of the launch.)

That T is after the launch is looked at for s = 0.  Then it is after all launches of the arc: v(T) <
0 for all of them, and v > 0 at a launch.  It is after B, as v > 0 from the launch to B.
"""

from __future__ import annotations

import math

from cap.checker.kernel.doubles import Double
from cap.checker.strips.arc import SPAN, Launches, least, negative
from cap.checker.system.flight import velocity

LATE = (1e-5, 1e-4, 1e-3, 1e-2)  # before and after a stop, v > 0 and v < 0 are tried


def stops(launches: Launches) -> bool:
    """Return whether all launches of an arc certainly stop."""
    return any(stops_by(launches, *times) for times in _late(launches))


def _late(launches: Launches) -> list[tuple[Double, Double]]:
    """Return times B and T at which v > 0 and v < 0 are likely."""
    t, u, f = launches.near.t.mid, launches.near.u.mid, launches.f.mid

    def v(T: float) -> float:
        return velocity(u - math.sin(t), T - t, f, math.sin(T))

    for T in launches.minima(t, t + SPAN):
        if T.mid > t and v(T.mid) < 0:
            early, late = t, T.mid
            for _ in range(40):
                middle = (early + late) / 2
                early, late = (middle, late) if v(middle) > 0 else (early, middle)
            around = [(Double(early - w), Double(late + w)) for w in LATE]
            return [(launches.all.t, T), *around]
    return []


def stops_by(launches: Launches, B: Double, T: Double) -> bool:
    """Return whether all stop before T, by what is known of them at B and T."""
    begin = launches.all.t
    if not (T - launches.near.t).is_positive():
        return False
    if B is not begin:
        flies = launches.moves(B.upper) and least(launches.velocity(B)) > 0
        if not (begin.upper < B.lower and flies):
            return False
    lows = [*launches.minima(B.lower, T.upper), T]
    slowest = [least(launches.velocity(low)) for low in lows]
    if not all(v > -math.inf for v in slowest):  # `max` would pass over NaN
        return False
    depth = max(0.0, *(-v for v in slowest))
    fallen = least(negative(launches.velocity(T))) > 0
    most = -least(negative(launches.place(T)))
    return fallen and (launches.R - (T - B) * depth - most).is_positive()
