"""The first hits of a wall, from a box of states: one after the other, each in a window of times.

The flights are those of the one mode D in which h falls and rises (``legs``).  If on a window [a,
b] h' < 0, h(a) > 0 > h(b), and h > 0 from the start to its zero there, the motions of the box have
their next hit in this window; the other guards are positive until then (``quiet``, in pieces that
are halved).  After it h = 0, h' is -e times what it was, and the other variables are the same.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.capture import HEIGHT, RATE, Known, Numbers
from cap.checker.system.legs import Leg
from cap.checker.system.polynomial import variable
from cap.checker.system.quiet import halved, watched


class Hit(NamedTuple):
    """When a hit is, h' just before it, the other variables; and pieces of flights looked at."""

    time: Interval
    rate: Interval
    others: Known
    pieces: int


def first_hits(
    numbers: Numbers,
    start: Fraction,
    state: Known,
    e: Fraction,
    windows: Iterable[tuple[Fraction, Fraction]],
    most: int,
) -> Hit:
    """Return the last of these hits, of which there is one at least; all are proved.

    At most so many pieces of flights are looked at.
    """
    wall, bits = numbers.wall, numbers.bits
    mode, guard, rising = wall.modes
    need(rising == mode and wall.event.to == (mode,), "hits are followed in one mode alone")
    guards = watched(wall.model, mode)
    hit, pieces = None, 0
    begin = Interval.enclosing(start, start, bits)
    for a, b in windows:
        leg, end = Leg(wall.model, mode, begin, state), Interval.enclosing(a, b, bits)
        need(begin.is_before(end), "the windows of hits are not in order")
        first, last = (Interval.enclosing(t, t, bits) for t in (a, b))
        rate = leg.over(wall.rate, end)
        crossed = leg.over(wall.h, first).is_positive() and (-leg.over(wall.h, last)).is_positive()
        need(crossed and (-rate).is_positive(), "a hit is not certain to be in its window")
        for key, h in guards.items():
            zeros = (int(hit is not None), 1) if key == guard else (0, 0)
            pieces += halved(leg, h, end, zeros, most - pieces)
        hit = Hit(end, rate, {z: leg.over(variable(z), end) for z in wall.others}, pieces)
        begin, state = end, _after(numbers, hit, e, (a, b))
    if hit is None:
        raise Rejected("there is no hit")
    return hit


def _after(numbers: Numbers, hit: Hit, e: Fraction, when: tuple[Fraction, Fraction]) -> Known:
    """Return the state just after a hit."""
    known = {HEIGHT: numbers.one.integer(0), RATE: hit.rate * -e}
    values = numbers.values({**known, **hit.others, **numbers.clock(when)})
    return {**hit.others, **{z: values.of(q) for z, q in numbers.wall.state.items()}}
