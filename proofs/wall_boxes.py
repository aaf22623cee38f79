"""Boxes of states at a wall from which motions come to rest: the largest ones found.

Sizes only steer; what is claimed of a box is proved in `cap.proofs.contact_capture`.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from cap.errors import NotProved
from cap.orbits.capture import Boxes, Entry, Near, Start, captured, clock
from cap.orbits.wall import Wall
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.system.exponential import number

BITS = 128
LARGEST = Fraction(8)  # speed that is tried
PART = Fraction(9, 10)  # of the largest, which is claimed
PHASES = 24  # times of a period at which a box is looked for

Tell = Callable[[str, float | None], None]


def at_the_wall(place: Wall, time: Fraction | None, tell: Tell) -> tuple[Fraction, Boxes]:
    """Return a large box at the wall, for a state of two variables, and its time.

    The time is the one given, or that of the largest box found among some in a period.
    """
    if time is not None or place.system.autonomous:
        return time or Fraction(0), largest(place, time or Fraction(0))[1]
    with interval.workprec(BITS):
        period = interval.midpoint(2 * interval.pi() / number(place.system.omega))
    found: list[tuple[Fraction, Fraction, Boxes]] = []
    for k in range(PHASES):
        tell("a box at the wall is looked for", k / PHASES)
        phase = round(period * k / PHASES, 3)
        try:
            size, box = largest(place, phase)
        except NotProved as failure:
            reason = failure
        else:
            found.append((size, phase, box))
    if not found:
        raise reason
    _, phase, box = max(found, key=lambda each: each[0])
    return phase, box


def largest(place: Wall, time: Fraction) -> tuple[Fraction, Boxes]:
    """Return the largest u found, and a box around the states with h <= u²/(2a), |h'| <= u.

    Here a is -h'' where h = h' = 0; u is 0 if there is none.  For a state of two variables.
    """
    with interval.workprec(BITS):
        a = Near(place, time, Fraction(0), Fraction(0), {}).pull(time).least

        def at(u: Fraction) -> Entry:
            return _near(place, time, u, a).entry()

        size = bisection.largest(lambda u: captured(place, at(u), time), LARGEST, 5)
        if size is None:
            captured(place, at(LARGEST / 2**bisection.HALVINGS), time)
            raise NotProved("capture", "no box at the wall is captured")
        return size, _near(place, time, interval.short(size * PART), a).box


def _near(place: Wall, time: Fraction, u: Fraction, a: Ball) -> Start:
    """Return the box at the wall for a speed."""
    speed, height = interval.ball(u), interval.ball(u * u) / (2 * a)
    known = {"(h)": interval.hull(Ball(0), height), "(h')": interval.symmetric(speed)}
    known |= clock(place.system, interval.ball(time))
    box, places = {}, max(0, 3 - interval.decade(u * u if u < 1 else u))
    for z in place.system.state:
        side = place.solved[z].evaluated(known, interval.ball, interval.pi())
        low, high = map(Fraction, interval.outward(side, places))
        box[z] = low, high
    return Start(place, time, box)
