"""What becomes of the turns of a region, forwards, and how many have not a fate.

The region is followed (`cap.checker.folded.motion`) to the next stick of all its orbits, at places
p.  Let x be the distance to the wall ahead at the release after it, p up to a constant and a sign.
If |dx/dq| >= c > 0 over a part of the times, x is one-to-one in q at each of them: so x is in a set
of places of the measure m for q of the measure m/c at most, and the area of these turns, of (a +
cos t) dq dt, is at most m/c max (a + cos t) times the length of the part.  There are `PARTS` equal
parts of Y; in each, m is that of the places without the fate within the bounds of x there.

*A stop* at T lies in an arc around an odd multiple M of pi.  Let a = f/F, theta = arccos a; x is
the distance to the wall ahead at the release.

    cos T > -a, T < M     it sticks, x = W + p
    cos T > -a, T > M     it sticks, x = -p
    cos T < -a            it turns

*Neither for certain, T < M.*  What is lost is bounded as if all stuck, with x = W + p, and added;
and all are followed on as if all turned.  The formulas hold for what does turn, and are about all
numbers A, B of the region, whether there are such orbits or not.

*Neither for certain, T > M.*  What turns at T in (b - z, b], b = M + theta, z < 1/20, is driven
back by -cos t - a <= sin theta sin(b - t) <= b - t until b, and from then on slowed by a + cos t >=
sin theta sin(t - b): so its speed is at most z^2/2, and it stops within z from b, and sticks; it
goes at most z^3 < 1/100, so it does not hit if the wall behind is farther.  So x is in -p + [0,
z^3], and x + p depends on T; its derivative is at most 2 z^2, the force at T times the time that
passes, and |dT| = |dA|/(a - cos T) <= |dA|/(2 a), as cos T <= -a.

*A slow hit* may end in a rest near the wall (`cap.checker.folded.rests`): then all of the turns
have the fate, or nothing is known of them.

*Basins.*  If all states are in a part of a basin (`cap.checker.folded.basins`) at a multiple of pi
that is passed, all have its fate.  What goes to the segment is looked for between two stops.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from cap.checker.folded.basins import Basins
from cap.checker.folded.events import Event, after, event
from cap.checker.folded.flights import Flight
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import TURN, UP, Pair
from cap.checker.folded.regions import Region
from cap.checker.folded.rests import height
from cap.checker.folded.slopes import BEGIN, Slopes, of_place
from cap.checker.folded.slopes import after as slopes_after
from cap.checker.folded.stops import turns
from cap.checker.folded.table import FATES
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.polynomials import Model
from cap.checker.kernel.rejection import Rejected, need

EVENTS = 32
PARTS = 4  # of Y
_PURE = 0, 1, 3, 6, 10  # the monomials 1, Y, ..., Y^4
_NEAR, _FAR = 0.05, 0.01  # z, and the wall behind


class Outlook(NamedTuple):
    """The flow forwards, and what is known of places and states."""

    y: Direction
    fates: Places
    basins: Basins


class Found(NamedTuple):
    """A lower bound of the area of stops, and for each fate an upper one of what has it not."""

    area: float
    missing: tuple[float, ...]


def found(o: Outlook, region: Region) -> Found:
    """Return what is found of the turns of a region."""
    start = turns(o.y, region)
    area, total = q.integral(start.density), [0.0] * len(FATES)
    try:
        for lost in losses(o, start.flight):
            total = [(m + more * start.rate) * UP for m, more in zip(total, lost, strict=True)]
    except Rejected:
        return Found(area, (math.inf,) * len(FATES))
    return Found(area, tuple(total))


def losses(o: Outlook, f: Flight) -> Iterator[Sequence[float]]:
    """Give what together bounds the area without the fate, for each fate; infinity if unknown.

    It is to be multiplied by max (a + cos t) |dt/dY|.
    """
    y, g, rested = o.y, BEGIN, True
    for _ in range(EVENTS):
        e = event(y, f)
        if known := seen(o, f, e, rested=rested):
            yield [0.0 if known & wanted else math.inf for wanted in FATES]
            return
        if e.p is None:
            low, rested = height(y, e.ends, q.ends(e.s)[1]), False
            if low is not None:
                yield at_wall(o, low)
                return
        else:
            cos, rested = q.widened(e.cos, e.e_all), True
            some, every = sticking(y, e, q.ends(cos))
            if some:
                yield stuck(o, e, e.p[1], g)
            if every:
                return
        f, g = after(y, f, e), slopes_after(y, g, e)
    raise Rejected("there is no stick for long")


def sticking(y: Direction, e: Event, cos: Pair) -> tuple[bool, bool]:
    """Return whether some may stick at a stop, and whether all do, at once or soon."""
    low, high = cos
    some, every = high >= y.a - y.a_error, low > y.a + y.a_error
    return some, every or (some and e.ends[0] > middle_of(e))


def middle_of(e: Event) -> float:
    """Return the middle M of the arc of a stop."""
    return math.pi * (2 * math.floor(e.ends[0] / (2 * math.pi)) + 1)


def at_wall(o: Outlook, low: float) -> list[float]:
    """Return what is lost if all rest at the wall, or so near to it."""
    W, e = o.y.width
    fate = o.fates.fate((W - low - 2 * e - W * TURN, W + 2 * e + W * TURN))
    return [0.0 if fate & wanted else math.inf for wanted in FATES]


def stuck(o: Outlook, e: Event, p: Model, g: Slopes) -> list[float]:
    """Return what is lost of those that stick at a stop at the places p."""
    M, z = middle_of(e), 0.0
    if e.ends[1] < M - _NEAR:
        x = q.moved(p, *o.y.width)
    else:
        need(e.ends[0] > M + _NEAR, "a stick in which arc")
        z = delay(o.y, e, M)
        x = q.moved(q.scaled(p, -1.0), z * z * z / 2, z * z * z / 2 * UP)
        need(z == 0 or q.ends(x)[1] < o.y.width[0] - _FAR, "a mass may hit before it sticks")
    less = z * z * q.size(g.A) / -o.y.a * UP
    total = [0.0] * len(FATES)
    for places, (low, high) in zip(over(x), over(of_place(g, e)), strict=True):
        c = max(low, -high) - less
        for k, fate in enumerate(FATES):
            total[k] += over_places(o.fates.missing(places, fate), c)
    return total


def over_places(m: float, c: float) -> float:
    """Return the length of a part times m/c, or infinity; 0 if m is."""
    return 2 / PARTS * m / c * UP if m and c > 0 else math.inf if m else 0.0


def over(x: Model) -> Iterator[Pair]:
    """Give bounds of a model over the `PARTS` of -1 <= Y <= 1.

    A polynomial in Y differs from its tangent at the middle of a part by at most half the bound of
    its second derivative times the square of the distance.
    """
    a, b, c, d, e = (x[k] for k in _PURE)
    bend = abs(c) + 3 * abs(d) + 6 * abs(e)
    rest = sum(abs(z) for k, z in enumerate(x) if k not in _PURE)
    half, more = 1 / PARTS, 16 * TURN * q.size(x)
    for k in range(PARTS):
        Y = half * (2 * k + 1) - 1
        value = a + Y * (b + Y * (c + Y * (d + Y * e)))
        steep = abs(b + Y * (2 * c + Y * (3 * d + Y * 4 * e)))
        far = (steep * half + bend * half * half + rest) * UP + more
        yield value - far, value + far


def delay(y: Direction, e: Event, M: float) -> float:
    """Return z, if some may turn in (b - z, b] and stick soon, or 0."""
    b = M + y.rest[0] + y.rest[1] + 16 * TURN * (abs(M) + 1)
    z = max(0.0, b - e.ends[0]) * UP
    need(z < min(_NEAR, y.pi[0] - 2 * y.rest[0] - 1e-9), "a stick or a turn")
    return z


def seen(o: Outlook, f: Flight, e: Event, *, rested: bool) -> int:
    """Return the fate of all states, if it is known at a multiple of pi before an event."""
    between = rested and e.p is not None
    basins = o.basins if between else o.basins._replace(strips=())
    return basins.seen(o.y, f, e.ends[0])
