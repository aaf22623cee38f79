"""Compiled: what of a region that is followed forwards to a stop lies over places without a fate.

*The derivative* of the place in q at a fixed t, at a stop: let c be its least size over a part of
the region.  At each t different q of the part come to different places: those that come to places
of the measure m have, over times of the length h, the measure h max(cos t + |a|) m/c at most.

*Stops* at the phase T of an arc, T = 0 in its middle: with |T| < theta they are turns.  Before, the
mass sticks, and is released at the distance W + p to the wall ahead; after it at -p.

*Borders.*  If it may be a stick or a turn before the middle of an arc, what is missing of all, as
if all of it stuck, is missing, and the flight goes on, as if all of it turned.  After the middle, a
mass that turns when |T| = theta - delta at least, delta <= `LATE`, soon stops again: so it is
released within delta^3 of -p, if the wall behind is farther, and the derivative of the place is
less by 2 delta^2 |dT/dq| at most.
"""

import math
from typing import NamedTuple

from cap.areas.folded.backward import (
    ROUND,
    TURN,
    TURN_ERROR,
    Constants,
    Event,
    Flight,
    influence,
)
from cap.areas.folded.basins import Basins, anything, fate_of
from cap.areas.folded.missing import Known, all_have, missing
from cap.areas.folded.polynomials import UP, Model, bound, centred, ends, moved, scaled, widened
from cap.areas.folded.regions import first, passing
from cap.areas.folded.slopes import Slopes, by_place
from cap.checker.folded.table import ATTRACTOR, NONE
from cap.sets.compiled import kernel

PARTS = 4  # of Y, in which places are bounded
LATE = 0.05  # of delta
FAR = 0.01  # of the wall behind: more than delta^3
ROOM = 0.01  # of a range: the checker's bounds may be wider by so much

LOST, ENDS, TURNED = range(3)
_NONE, _EARLY, _LATE, _TURN, _EARLY_OR_TURN, _LATE_OR_TURN = range(6)


class Ahead(NamedTuple):
    """The flow forwards, with a < 0 and with a > 0, parts of basins, what is known."""

    flow: Constants
    rests: Constants
    basins: Basins
    known: Known


class Share(NamedTuple):
    """A measure ``mu``, and how much of it is missing for one of `PARTS` over places of measure 1.

    That is ``each`` divided by the derivative of the place.
    """

    mu: float
    each: float


class Missing(NamedTuple):
    """Upper bounds of the measures without each fate, and by what they may be too large."""

    attractor: float
    segment: float
    either: float
    excess: float


@kernel
def added(a: Missing, b: Missing) -> Missing:
    """Return the sum."""
    attractor, segment = a.attractor + b.attractor, a.segment + b.segment
    return Missing(attractor, segment, a.either + b.either, a.excess + b.excess)


class Phase(NamedTuple):
    """Bounds of the phase of a stop, 0 in the middle of its arc, and a bound of its errors."""

    low: float
    high: float
    more: float


@kernel
def _phase(y: Constants, event: Event) -> Phase:
    """Return the phase of a stop."""
    k = math.floor((event.near + y.theta) / TURN) + 1
    more = y.theta_error + abs(k) * TURN_ERROR + (abs(k) + 2) * TURN * ROUND
    mid = TURN * k - math.pi
    return Phase(event.ends[0] - mid - more, event.ends[1] - mid + more, more)


@kernel
def _kind(y: Constants, phase: Phase) -> int:
    """Return whether all stops in a range of phases are sticks or turns, early or late."""
    low, high, more = phase
    theta = y.theta + more
    if high < -theta:
        return _EARLY
    if low > theta:
        return _LATE
    if max(-low, high) < y.theta - more:
        return _TURN
    if high < 0:
        return _EARLY_OR_TURN
    if low > 0 and theta - low <= LATE:
        return _LATE_OR_TURN
    return _NONE


@kernel
def place_at_stop(f: Flight, event: Event) -> Model:
    """Return p at a stop, of all flights."""
    spread = bound(centred(event.D, 0.0)) + event.all
    return widened(event.place, influence(f, event.D[0], spread))


@kernel
def span(x: Model, k: int) -> tuple[float, float]:
    """Return bounds of a quantity over one of the `PARTS` of Y."""
    h = 1.0 / PARTS
    Y = h * (2 * k + 1) - 1
    value = x[0] + Y * (x[1] + Y * (x[3] + Y * (x[6] + Y * x[10])))
    slope = x[1] + Y * (2 * x[3] + Y * (3 * x[6] + Y * 4 * x[10]))
    bend, third = x[3] + Y * (3 * x[6] + Y * 6 * x[10]), x[6] + 4 * Y * x[10]
    far = h * (abs(slope) + h * (abs(bend) + h * (abs(third) + h * abs(x[10]))))
    far += abs(x[2]) + abs(x[4]) + abs(x[5]) + abs(x[7]) + abs(x[8]) + abs(x[9])
    far += abs(x[11]) + abs(x[12]) + abs(x[13]) + abs(x[14]) + x[15]
    far = far * UP + (abs(x[0]) + abs(x[1]) + abs(x[3]) + abs(x[6]) + abs(x[10])) * ROUND
    return value - far, value + far


@kernel
def _size(low: float, high: float) -> float:
    """Return the least size of numbers between two of them, or 0."""
    return max(low, -high, 0.0)


@kernel
def _less(y: Constants, g: Slopes, event: Event, delta: float) -> float:
    """Return by how much the derivative of the place is less where a mass turns before."""
    steep = -ends(widened(event.cos, event.all))[1] - y.a - y.a_error
    if not steep > 0:
        return math.inf
    return 2 * delta * delta * bound(g.A) / steep * UP


@kernel
def _over(known: Known, x: Model, beyond: float, w: Model, less: float, s: Share) -> Missing:
    """Return what is missing over the places x, and so much beyond.

    That is all where they may fold, but for a fate that all of them have.  Their derivative is w,
    or less than that by so much.
    """
    a, b, c, wide = 0.0, 0.0, 0.0, 0.0
    for k in range(PARTS):
        low, high = span(x, k)
        high += beyond
        slopes = span(w, k)
        slope = _size(slopes[0], slopes[1]) - less - ROOM * (slopes[1] - slopes[0])
        each = s.each / slope * UP if slope > 0 else math.inf
        a += _lost(known, 0, low, high, each)
        b += _lost(known, 1, low, high, each)
        c += _lost(known, 2, low, high, each)
        wide += each * (high - low)
    return Missing(a, b, c, c * max(0.0, 1 - s.mu / wide) if c < math.inf else c)


@kernel
def _lost(known: Known, fate: int, low: float, high: float, each: float) -> float:
    """Return a bound of the area without a fate, of releases from an interval of places.

    A unit of places without it stands for the area ``each``; if that is infinite, none may be.
    """
    if each == math.inf:
        room = ROOM * (high - low)
        return 0.0 if all_have(known, fate, low - room, high + room) else math.inf
    return each * missing(known, fate, low, high)


@kernel
def resting(known: Known, low: float, mu: float) -> Missing:
    """Return what is missing where the mass rests up to so far from the wall: all, or nothing."""
    wall = known.ends[-1]
    far = wall - low * UP - 1e-12
    a = 0.0 if all_have(known, 0, far, wall) else mu
    b = 0.0 if all_have(known, 1, far, wall) else mu
    return Missing(a, b, 0.0 if all_have(known, 2, far, wall) else mu, 0.0)


@kernel
def stopped(a: Ahead, f: Flight, g: Slopes, event: Event, share: Share) -> tuple[int, Missing]:
    """Return what follows a stop, and what is missing for it."""
    y, nothing = a.flow, Missing(0.0, 0.0, 0.0, 0.0)
    phase = _phase(y, event)
    kind = _kind(y, phase)
    if kind == _NONE:
        return LOST, nothing
    if kind == _TURN:
        return TURNED, nothing
    less, beyond = 0.0, 0.0
    if kind == _LATE_OR_TURN:
        delta = y.theta + phase.more - phase.low
        less, beyond = _less(y, g, event, delta), delta * delta * delta * UP
    p = place_at_stop(f, event)
    early = kind in (_EARLY, _EARLY_OR_TURN)
    x = moved(p, y.width, y.width_error) if early else scaled(p, -1.0, 0.0)
    if kind == _LATE_OR_TURN and not ends(x)[1] < y.width - y.width_error - FAR:
        return LOST, nothing
    found = _over(a.known, x, beyond, by_place(g, event), less, share)
    if not found.either < math.inf:
        return LOST, nothing
    return TURNED if kind == _EARLY_OR_TURN else ENDS, found


@kernel
def reached(a: Ahead, f: Flight, until: float, between: bool) -> int:
    """Return the fate of all flights, if they are in a basin at a multiple of pi before a time.

    What goes to the segment is looked for between two stops.
    """
    j, ellipses = first(f), len(a.basins.ellipses) + len(a.basins.odd)
    while (ellipses > 0 or between) and j * math.pi < until:
        if anything(a.basins, j):
            flying, p, s = passing(a.flow, f, j)
            if not flying:
                return NONE
            fate = fate_of(a.basins, j, between, p, s)
            if fate != NONE:
                return fate
        j += 1
    return NONE


@kernel
def without(fate: int, mu: float) -> Missing:
    """Return what is missing of a measure all of which has a fate."""
    if fate == ATTRACTOR:
        return Missing(0.0, mu, 0.0, 0.0)
    return Missing(mu, 0.0, 0.0, 0.0)
