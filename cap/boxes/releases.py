"""Compiled: from one release to the next, over intervals of places (see `cap.release.passage`).

A set of masses rests between the walls at 3T/4, where F cos ωt = 0, before it is released to the
right.  It is followed, a period at a time, as long as all have the same events, up to the next
release.  A mass that a wall has captured is released from that wall: then its place is exact.
"""

import math
from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from cap.boxes.begin import begin
from cap.boxes.doubleton import Doubleton, clear, derivative, frame_box, image, set_box
from cap.boxes.flight import Moment
from cap.boxes.follow import Derivative, Memory, chain, doubleton
from cap.boxes.motion import CAPTURE_L, CAPTURE_R, FLY, LOST, REST, WALL, Motion
from cap.boxes.period import MOST_EVENTS, World, pass_event
from cap.boxes.results import MOVING, RELEASED, SETTLED, UNDECIDED
from cap.boxes.units import inner_box, place
from cap.sets.compiled import compiled, kernel, rounds_to_nearest
from cap.sets.doubles import Interval, is_finite, lower, upper
from cap.sets.records import assign

Floats = NDArray[np.float64]

START = Fraction(3, 4)  # of a period
LONGEST = 96  # words


class Rows(NamedTuple):
    """What is written of N cells; see `cap.boxes.results.Passages`."""

    verdict: NDArray[np.int8]
    half_periods: NDArray[np.int64]
    events: NDArray[np.int8]
    maybe: NDArray[np.int64]
    value: Floats
    slope: Floats


Pass = Callable[[World, Floats, int, Memory, Rows], bool]


@kernel
def _begin(world: World, box: Floats, source: Doubleton, m: Derivative) -> bool:
    """Write the set of a cell at rest, and the derivative 1; return whether it is bounded."""
    x, v = inner_box(world.units, (box[0], box[1]), (0.0, 0.0))
    set_box(source, REST, 0.0, x, v)
    source.surely, source.possibly = 0, 0
    m.a, m.b, m.c, m.d = 1.0, 0.0, 0.0, 0.0
    clear(m.first)
    clear(m.second)
    return bool(is_finite(x))


@kernel
def _note(n: Motion, words: NDArray[np.int8], count: int) -> int:
    """Write the events noted by a motion, which then forgets them; return how many there are.

    -1 if there is no room.
    """
    told, n.itinerary = n.itinerary, 0
    if told <= 0:
        return count if told == 0 else -1
    power = 1
    while told >= 16 * power:
        power *= 16
    while power > 0 and count < len(words):
        words[count] = told // power % 16
        power //= 16
        count += 1
    return count if power == 0 else -1


@kernel
def _span(
    world: World, source: Doubleton, n: Motion, words: NDArray[np.int8], count: int
) -> tuple[int, int]:
    """Follow all motions of a set, if there is one way, to a release or the end of a period.

    Return the verdict, and how many words there are.  If ``count`` is -1, they begin with the
    first release, which is not one of them.
    """
    moment = Moment(world.start.t, world.start.sin, world.start.cos)
    ways = begin(world.system, n, source, moment, 0)
    for _ in range(MOST_EVENTS):
        if ways != 1 or n.kind == LOST or n.ended != 0:
            break
        rested, fresh = n.kind in (REST, WALL), count < 0
        ways = pass_event(world, n, 0)
        if fresh and n.kind == FLY:
            n.itinerary, count = 0, 0
            continue
        count = _note(n, words, count)
        if count < 0:
            break
        if ways == 1 and rested and n.kind == FLY:
            return RELEASED, count
    known = ways == 1 and n.ended != 0 and n.kind != LOST and count >= 0
    return MOVING if known else UNDECIDED, count


@kernel
def _verdict(verdict: int, words: NDArray[np.int8], count: int, smooth: bool, maybe: int) -> int:
    """Return the verdict on a set whose motions may, or may not, be known to be ``smooth``."""
    if verdict == RELEASED and not smooth:
        captured = count > 1 and words[count - 2] in (CAPTURE_R + 1, CAPTURE_L + 1)
        return RELEASED if captured and maybe == 0 else SETTLED if maybe != 0 else UNDECIDED
    return UNDECIDED if verdict == MOVING and not smooth else verdict


@kernel
def _write(world: World, n: Motion, m: Derivative, value: Floats, slope: Floats) -> None:
    """Write G and G' after a release: the gap ahead is that of the mirror image if it is to the
    left."""
    (p, r), gap = frame_box(m.first), n.flight.gap
    G = place(world.units, -gap)
    rate = n.a * Interval(m.a, p) + n.b * Interval(m.c, r)
    value[0], value[1] = lower(G), upper(G)
    slope[0], slope[1] = lower(rate), upper(rate)


def _compiled() -> Pass:
    @compiled
    def pass_on(world, cells, periods, memory, out):  # type: ignore[no-untyped-def]
        """Follow cells to the next release; see `PASS_ON`."""
        room, cell, probe = memory
        n, m, source = cell.motion, cell.derivative, doubleton(room.now, 0)
        if not rounds_to_nearest(probe):
            return False
        for i in range(len(cells)):
            verdict = MOVING if _begin(world, cells[i], source, m) else UNDECIDED
            k, count, smooth, maybe = 0, -1, True, 0
            while k < periods and verdict == MOVING:
                verdict, count = _span(world, source, n, out.events[i], count)
                smooth, maybe = smooth and n.certain != 0, maybe | n.maybe
                if verdict == MOVING:
                    chain(m, derivative(n))
                    image(n, world.system, source, cell.image)
                    assign(source, cell.image)
                k += 1
            out.verdict[i] = _verdict(verdict, out.events[i], count, smooth, maybe)
            out.maybe[i] = maybe
            if verdict == RELEASED:
                out.half_periods[i] = 2 * (k - 1) + (1 if n.flight.sign < 0 else 0)
                _write(world, n, m, out.value[i], out.slope[i])
                if out.verdict[i] == SETTLED:
                    out.slope[i] = math.nan
        return True

    return cast(Pass, pass_on)


PASS_ON = _compiled()
"""Follow the masses that rest in the ``cells`` (N, 2), rows (x low, x high), for some periods.

(world, cells, periods, memory, out) -> whether the processor rounds as it should.
"""
