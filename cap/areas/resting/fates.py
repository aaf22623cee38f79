"""The fate of a cell of states: all its motions rest before the end, or all fly at the end.

*A hit* at tau, in the window [a, b], makes h' to -e h'.  With r = -h' before it, q = (1 + e) P/r at
tau, the state at b and its derivative by the state (h, h') at T, u = tau - T, are

    h'(b) = e r - (I(b) - I(tau)),     h(b) = e r (b - tau) - (J(b) - J(tau) - I(tau) (b - tau)),

    dh'(b) = q dh + (q u - e) dh',     dh(b) = -e dh - e u dh' + (b - tau) dh'(b).

I and J are large, what is subtracted is small: with d = s - tau, s the end of some window of tau,

    I(b) - I(tau) = I(b) - I(s) + P d,
    J(b) - J(tau) - I(tau) (b - tau) = J(b) - J(s) - I(s) (b - s) + P d (b - s + d/2),

P between its bounds in that window.  If e r > P+ (b - tau)/2 there is no other hit until b, P+ the
largest pull.

*Mean values.*  The states at a time are in the box of all of them, and in c + D (x - x_c), where x
are the states of the cell, c the image of its middle x_c, D a product of enclosures of derivatives.

*Rest.*  As in `cap.orbits.capture`: if l <= P <= g, l > 0, a bounce with the speed v at its
beginning lasts 2 v/l at most, and the next begins with at most k v, k = e sqrt(g/l).  If k < 1, all
of them last 2 v/(l (1 - k)) at most.

A sum of doubles is below a double if what it is rounded to is.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.resting.flights import AWAY, HITS, Cell, Change, Hit, among, first_hit
from cap.areas.resting.pull import Floats, Pull, Table, extremes, sums
from cap.sets.compiled import compiled, kernel, rounds_to_nearest
from cap.sets.doubles import GROWTH, Interval, between, hull, lower, magnitude, upper, widened

RESTS, FLIES = 1, 2
MOST = 24  # hits followed
BOUNCES = 6  # bounded one by one
LONGER = 1.1, 1.3, 1.8  # times that are tried, by one that would do under other bounds
LATER = 1 + 2.0**-52  # a positive time by this is not before the double after it
ROOM = 1 + 2.0**-20  # what is asked for is more than what is needed: other arithmetics agree


@kernel
def landed(p: Pull, hit: Hit, b: float) -> tuple[Interval, Interval]:
    """Return (h, h') at a time b after the hits, which comes before any other hit."""
    s, away = hit.b, p.e * hit.speed
    at, last = sums(p, b), sums(p, s)
    d, left = s - between(hit.a, s), Interval(b, 0.0) - s
    lost = (at[0] - last[0]) + hit.pull * d
    fall = ((at[1] - last[1]) - last[0] * left) + hit.pull * (d * (left + 0.5 * d))
    return away * (left + d) - fall, away - lost


class Sides(NamedTuple):
    """h = ``h`` + x ``height``, h' = ``v`` + y ``width``: x, y in [0, 1] on the rectangle."""

    h: Interval
    height: Interval
    v: Interval
    width: Interval


@kernel
def change(p: Pull, hit: Hit, speed: Interval, T: float) -> Change:
    """Return the derivative of the state at the end of the window by that at a time before."""
    t = between(hit.a, hit.b)
    u, left, q = t - T, hit.b - t, (1.0 + p.e) * hit.pull / speed
    vv = q * u - p.e
    return Change(left * q - p.e, left * vv - p.e * u, q, vv)


@kernel
def after(m: Change, n: Change) -> Change:
    """Return the product m n."""
    return Change(
        m.hh * n.hh + m.hv * n.vh,
        m.hh * n.hv + m.hv * n.vv,
        m.vh * n.hh + m.vv * n.vh,
        m.vh * n.hv + m.vv * n.vv,
    )


@kernel
def _over(p: Pull, grid: Table, a: float, latest: float, v: float, tried: float) -> bool:
    """Return whether all bounces are over in a time tried; the first one has the speed v."""
    until = min((latest + tried) * LATER, p.early)
    low, high = extremes(grid, a, until)
    if not low > 0:
        return False
    k = upper(p.e) * math.sqrt(high / low) * ROOM
    return bool(k < 1 and latest + 2 * v / (low * (1 - k)) * ROOM < until)


@kernel
def rests(p: Pull, grid: Table, hit: Hit, speed: float) -> bool:
    """Return whether infinitely many hits follow those of a window, of at most a speed, in time."""
    e, fast, latest = upper(p.e), speed, hit.b
    for _ in range(BOUNCES):
        v = e * fast * ROOM
        low, high = extremes(grid, hit.a, latest)
        if not low > 0:
            break
        k = e * math.sqrt(high / low) * ROOM
        needed = 2 * v / (low * (1 - k)) if k < 1 else math.inf
        for longer in LONGER:
            if _over(p, grid, hit.a, latest, v, needed * longer):
                return True
        until = (latest + 2 * v / low * LONGER[0]) * LATER
        low, high = extremes(grid, hit.a, until)
        if not (low > 0 and latest + 2 * v / low * ROOM < until):
            break
        fast, latest = e * math.sqrt(high / low) * fast * ROOM, until
    return False


@kernel
def ends(c: Interval, a: Interval, half: float, b: Interval, wide: float) -> tuple[float, float]:
    """Return bounds of c + a x + b y, |x| <= half, |y| <= wide."""
    found = widened(c, (magnitude(a) * half + magnitude(b) * wide) * GROWTH)
    return lower(found), upper(found)


@kernel
def _speed(cell: Cell, hit: Hit, thin: Hit) -> Interval:
    """Return the speeds at the hits, by their mean values, too: dr = (P/r) (dh + u dh') - dh'."""
    steep, m = hit.pull / hit.speed, cell.change
    tilt = steep * (between(hit.a, hit.b) - cell.s) - 1.0
    first, second = steep * m.hh + tilt * m.vh, steep * m.hv + tilt * m.vv
    low, high = ends(thin.speed, first, cell.half, second, cell.wide)
    return between(max(lower(hit.speed), low), min(upper(hit.speed), high))


@kernel
def longer(p: Pull, cell: Cell) -> int:
    """Return across which side a cell is better halved: that whose ends go farther apart.

    A number that is not positive; it steers.
    """
    m, g = cell.change, max(p.mean.mid, 1e-3)
    y, v = max(0.0, cell.h.mid), cell.v.mid
    u = (abs(v) + math.sqrt(v * v + 2 * g * y)) / g
    first = (magnitude(m.hh + u * m.vh) + u * magnitude(m.vh)) * cell.half
    second = (magnitude(m.hv + u * m.vv) + u * magnitude(m.vv)) * cell.wide
    return 0 if first > second else -1


@kernel
def _begun(y: Interval, v: Interval) -> Cell:
    """Return a cell at s = 0."""
    one, none = Interval(1.0, 0.0), Interval(0.0, 0.0)
    same = Change(one, none, none, one)
    h, rate = Interval(y.mid, 0.0), Interval(v.mid, 0.0)
    return Cell(0.0, h, rate, same, y.rad, v.rad, lower(v), upper(v))


@kernel
def fate(p: Pull, grid: Table, y: Interval, v: Interval) -> int:
    """Return what becomes of all states with h in y, h' in v at s = 0.

    `RESTS` or `FLIES`; if neither is certain, - k for the side k across which to halve the cell.
    """
    cell = _begun(y, v)
    for _ in range(MOST):
        hit = first_hit(p, grid, cell)
        if hit.found == AWAY:
            return FLIES
        if hit.found != HITS:
            break
        middle = Cell(cell.s, cell.h, cell.v, cell.change, 0.0, 0.0, lower(cell.v), upper(cell.v))
        thin = among(p, middle, hit)
        if thin.found != HITS:
            break
        speed = _speed(cell, hit, thin)
        if rests(p, grid, hit, upper(speed)):
            return RESTS
        again = max(0.0, upper(hit.pull)) * (hit.b - hit.a) * ROOM
        if not (hit.b < p.late and lower(p.e * speed) > 0.5 * again):
            break
        center, D = landed(p, thin, hit.b), after(change(p, hit, speed, cell.s), cell.change)
        rate = p.e * speed - (sums(p, hit.b)[0] - hit.first)
        found = ends(center[1], D.vh, cell.half, D.vv, cell.wide)
        down, up = max(lower(rate), found[0]), min(upper(rate), found[1])
        cell = Cell(hit.b, center[0], center[1], D, cell.half, cell.wide, down, up)
    return longer(p, cell)


@compiled
def fates(
    p: Pull, grid: Table, probe: Floats, sides: Sides, places: Floats, found: NDArray[np.int8]
) -> bool:
    """Write the fates of cells, whose ``places`` (N, 4) are the ends of x, and of y.

    Return whether the processor rounds as it must.
    """
    for n in range(places.shape[0]):
        a, b, c, d = places[n]
        y = hull(sides.h + a * sides.height, sides.h + b * sides.height)
        v = hull(sides.v + c * sides.width, sides.v + d * sides.width)
        found[n] = fate(p, grid, y, v) if lower(y) >= 0 else longer(p, _begun(y, v))
    return rounds_to_nearest(probe)
