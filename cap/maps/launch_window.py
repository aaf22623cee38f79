"""Windows for the hits of a set of launches, looked for in floats and proved in balls."""

import math
from collections.abc import Callable

from cap.maps.launch_set import (
    UNIT,
    Constants,
    LaunchSet,
    Window,
    flown,
    no_hit_before,
    over_by,
    phase_of,
)
from cap.sets.interval import Ball

WIDE = 0.4  # of a half window: above, its ends are looked for one by one
HALVINGS = 10
AHEAD = 7.0  # more than a period


def window(system: Constants, launches: LaunchSet, cap: Ball) -> Window | None:
    """Return a window, proved, or None: no hit before a, and all by b or after ``cap``."""
    m = round(UNIT * _centre(system, launches))
    values = launches.at(system, phase_of(m))
    slowest = float(values.w.lower())
    if slowest > 0:
        half = float(values.y.rad()) / slowest
        for factor in (1.1, 1.6):
            far = math.ceil(UNIT * factor * half) + 1
            if not (factor * half < WIDE and m >= far):
                break
            before = no_hit_before(system, launches, m - far)
            if before and over_by(system, launches, m + far, cap):
                return Window(m - far, m + far, m)
    return _searched(system, launches, m, cap)


def _searched(system: Constants, launches: LaunchSet, m: int, cap: Ball) -> Window | None:
    """Return a window whose ends are found by bisection."""
    begin = max(0, math.floor(UNIT * float(launches.begin)))
    limit = math.ceil(UNIT * float(cap.upper())) + 1
    b = max(m, begin)
    step = UNIT // 50
    while b < limit and not over_by(system, launches, b, cap):
        b, step = min(b + step, limit), step * 3 // 2
    if not over_by(system, launches, b, cap):
        return None
    b = _edge(lambda x: over_by(system, launches, x, cap), b, begin)
    if no_hit_before(system, launches, b):
        return Window(b, b, b)
    if not no_hit_before(system, launches, begin):
        return None
    a = _edge(lambda x: no_hit_before(system, launches, x), begin, b)
    return Window(a, b, m if a <= m <= b else (a + b) // 2)


def _edge(holds: Callable[[int], bool], good: int, bad: int) -> int:
    """Return a phase at which a condition holds, from one at which it does towards another."""
    for _ in range(HALVINGS):
        middle = (good + bad) // 2
        if holds(middle):
            good = middle
        else:
            bad = middle
    return good


def _centre(system: Constants, launches: LaunchSet) -> float:
    """Return when the launch in the centre hits or stops, in floats."""
    flight = _Flight(system, float(launches.centre.x.mid()), float(launches.speed.mid()))
    low, turn = flight.t, 2 * math.pi
    slow = -flight.arc + turn * math.ceil((low + flight.arc) / turn)
    while slow < flight.t + AHEAD:
        fast = slow - turn + 2 * flight.arc
        if fast > low and flight.beyond(fast):
            return _root(flight.beyond, low, fast)
        begin = max(low, fast)
        if flight.stopped(slow):
            last = _root(flight.stopped, begin, slow)
            return _root(flight.beyond, begin, last) if flight.beyond(last) else last
        if flight.beyond(slow):
            return _root(flight.beyond, begin, slow)
        low, slow = slow, slow + turn
    return low


class _Flight:
    """A flight in floats."""

    def __init__(self, system: Constants, t: float, u: float) -> None:
        self.t, self.launch = t, (_phase(t), u)
        self.alpha, self.width = float(system.alpha.mid()), float(system.width.mid())
        self.arc = float(system.arc.mid())

    def stopped(self, x: float) -> bool:
        """Return whether the speed at a phase is negative."""
        return bool(flown(self.alpha, self.launch, _phase(x))[1] <= 0)

    def beyond(self, x: float) -> bool:
        """Return whether the way at a phase is as long as the gap."""
        return bool(flown(self.alpha, self.launch, _phase(x))[0] >= self.width)


def _phase(x: float) -> tuple[float, float, float]:
    return x, math.sin(x), math.cos(x)


def _root(late: Callable[[float], bool], low: float, high: float) -> float:
    """Return where a condition that holds at the end of an interval begins to hold."""
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (low, middle) if late(middle) else (middle, high)
    return high
