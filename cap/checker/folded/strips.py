"""Areas of states at t = 0 that go to the segment without a stick, found backwards from a strip.

All states (p, s) of the strip at t = 0 go to the segment (`cap.checker.folded.strip`).  Consider
those that have been outside of it at the times -T, -2 T, ..., -n T: what they were then are
different states, for different states and different times, none of them in the strip, and they tend
to the segment as well.  They do not stick before they are in the strip, nor after that: so none is
counted for its first stick (`cap.checker.folded.sticks`).

*They do not stick* after they are in the strip: with v* the velocity on the segment and |v - v*| <
d from then on, a mass stops only where |v*| < d. It sticks only if |cos t| < a, for times modulo pi
in (theta, pi - theta); there |v*| decreases, so it is at least v* + sin theta - a (pi - theta), v*
taken at t = 0. That has to be more than d; and v* > d, so that all move to the right at t = 0.

Backwards, folded, a state of the strip begins at the time pi, with the distance q = x_l - x to the
wall ahead, and the density 1.  The strip |w| < d is in two halves: z is from -1 to 1 over w from -d
to 0, or from 0 to d, and the edges are those of q.
"""

from __future__ import annotations

from cap.checker.folded.backward import Flight, System
from cap.checker.folded.events import after, event
from cap.checker.folded.numbers import TURN, Pair
from cap.checker.folded.regions import CUT, UNIT, Leaf, Region
from cap.checker.folded.sticks import (
    Start,
    across,
    along,
    at_event,
    begun,
    flown,
    multiple,
)
from cap.checker.folded.strip import Strip
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.parabolas import ordered
from cap.checker.kernel.rejection import Rejected


def counts(y: System, strip: Strip) -> bool:
    """Return whether the states of a strip move, do not stick, and are not lost in rounding."""
    (edge, e), (W, r) = strip.edge, y.width
    far = abs(edge) + W + abs(strip.left) + abs(strip.right)
    late = strip.slow + y.sine[0] - y.a * (y.pi[0] - y.theta[0])
    return min(strip.slow, late) > strip.d + 1e-9 and far < 1000 and e + r < 2.0**-42


def half_strip(y: System, strip: Strip, *, fast: bool) -> tuple[Region, Pair]:
    """Return the region of half a strip, w <= 0 or w >= 0, and the speeds at its ends.

    With x in (left, right) and x + k w in (left, right): q is in (x_l - right + k w, x_l - left) if
    w >= 0, and in (x_l - right, x_l - left + k w) if w <= 0.
    """
    d = (strip.d - (strip.fast - strip.slow)) * (1 - TURN)
    bottom, top = (strip.edge[0] - y.width[0] - x for x in (strip.right, strip.left))
    slope, more = strip.k * d / 2, 4 * CUT  # 2^-38: more than all that is rounded
    steep = round(slope / UNIT / CUT) * CUT
    low = round((bottom + slope * fast) / UNIT / CUT) * CUT + more, steep * fast, 0
    high = round((top - slope * (not fast)) / UNIT / CUT) * CUT - more, steep * (not fast), 0
    ordered([low, high])
    return Region(low, high), (
        (strip.fast, strip.fast + d) if fast else (strip.slow - d, strip.slow)
    )


def strip_of(y: System, strip: Strip, region: Region, *, fast: bool) -> Start:
    """Return the flight backwards from a part of a strip."""
    place, wide = across(region)
    z, r = along(region)
    low, high = half_strip(y, strip, fast=fast)[1]
    mid, half = (low + high) / 2, (high - low) / 2
    ref, e = y.pi
    A = q.model(2 * e + 4 * TURN * (abs(low) + abs(high)), one=mid + half * z, Y=half * r)
    B = q.moved(place, -1.0, 8 * e)
    density = q.scaled(wide, half * r, TURN * (abs(low) + abs(high)))
    return Start(begun((ref - e, ref + e), ref, A, B, density), q.ends(wide)[0])


def strip_area(y: System, strip: Strip) -> float:
    """Return the area of a strip, from below."""
    halves = (half_strip(y, strip, fast=fast)[0] for fast in (False, True))
    starts = [strip_of(y, strip, half, fast=bool(k)).flight for k, half in enumerate(halves)]
    return sum(q.integral(f.density) for f in starts) * (1 - TURN)


def entered(y: System, strip: Strip, V: float, task: tuple[Leaf, bool]) -> float:
    """Return the area of what has entered a part of a strip, backwards, but for the part itself.

    Only as long as all states are certain to have been outside the strip.
    """
    leaf, fast = task
    f, area, last = strip_of(y, strip, leaf.region, fast=fast).flight, 0.0, 1
    for _ in range(leaf.flights):
        strobes = [(each, out(y, strip, f, each.number)) for each in flown(y, f)]
        try:
            e = event(y, f)
            found = at_event(y, f, e, len(strobes))
            strobes += [(each, other(strip, each.speeds)) for each in found]
        except Rejected:
            e = None
        for (k, _, most), outside in strobes:
            if k != last + 1 or (k % 2 and not outside):
                return area * (1 - 64 * TURN)
            area += q.integral_below(f.density, most, V) if k % 2 else 0.0
            last = k
        if e is None:
            break
        try:
            f = after(y, f, e)
        except Rejected:
            break
    return area * (1 - 64 * TURN)


def other(strip: Strip, speeds: Pair) -> bool:
    """Return whether speeds between these are outside a strip."""
    return speeds[1] < strip.slow - strip.d or speeds[0] > strip.fast + strip.d


def out(y: System, strip: Strip, f: Flight, k: int) -> bool:
    """Return whether all states of a flight are outside a strip at this multiple of pi."""
    t, error = multiple(y, k - f.passed)
    p, s = y.at(f, t, error)
    p, s = q.widened(p, y.influence(f, t, error)), q.widened(s, f.errors[0])
    if other(strip, q.ends(s)):
        return True
    edge = strip.edge[0] - y.width[0], strip.edge[1] + y.width[1]
    x = q.moved(q.scaled(p, -1.0), edge[0], edge[1] + TURN * (abs(edge[0]) + abs(strip.edge[0])))
    w = q.moved(s, -(strip.fast + strip.slow) / 2, strip.fast - strip.slow)
    both = q.ends(x), q.ends(q.total(x, q.scaled(w, strip.k)))
    return any(high < strip.left or low > strip.right for low, high in both)
