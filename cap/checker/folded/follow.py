"""What becomes of the orbits from a box, up to their release after a stick.

Where it is undecided for the box what happens next, both possibilities are followed: a box is
``Cut`` into halves, or its orbits are of two kinds (``Split``).  Nothing is dropped: an orbit of
which nothing is known has the end None.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from cap.checker.folded.flights import ARCS, Flight, Path, System, halved
from cap.checker.folded.grazes import slow_hits
from cap.checker.folded.hits import hit
from cap.checker.folded.numbers import Pair, zero
from cap.checker.folded.stops import Chance, Halt, chance, halt, merged, stop
from cap.checker.folded.table import Table
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.rejection import Rejected, need

_MOST, _KINDS = 40, 4  # events; splits one after the other
_COARSE = 0.02  # range of a speed, for which orbits that stop are told from those that do not
WIDE = 0.02  # range of a distance to the wall
SMALL, LARGE = 1e-6, 1e-5  # errors of a flight that may be cut, or must be

Strobe = tuple[Model, Model]


class Slow(NamedTuple):
    """Orbits that hit the wall slowly: u^2/2 is between g and G times the level of the split.

    Of them ``seen`` is seen, with X from u = 0 to u = ``fastest``.
    """

    g: float
    G: float
    fastest: float
    seen: Seen


class Sliced(NamedTuple):
    """Orbits that hit the wall slowly, with a table of their fates by speed."""

    slow: Slow
    table: Table


class Split(NamedTuple):
    """Orbits of two kinds: those with a level <= 0, and those with a level >= 0."""

    level: Model
    below: Seen
    above: Seen | Slow | Sliced


class Cut(NamedTuple):
    """The orbits from the halves of a box, X <= 0 and X >= 0, or Y if ``along`` is 1."""

    along: int
    lower: Seen
    upper: Seen


class Seen(NamedTuple):
    """What is seen of orbits.

    ``strobes`` are pairs (p, s) at times that are multiples of 2 pi; ``end``: the distance -p to
    the wall ahead at a release after a stick; or what the end depends on; or None.  ``stops``: all
    stop at least once before.
    """

    strobes: list[Strobe]
    end: Model | Split | Cut | None
    stops: bool


class Box(NamedTuple):
    """How a box is followed: how often it may be cut, and split; ``stops`` as in `Seen`."""

    cuts: int
    kinds: int = _KINDS
    stops: bool = False


def follow(y: System, f: Flight, box: Box) -> Seen:
    """Follow the orbits of a box up to their release."""
    strobes, stops = list[Strobe](), box.stops
    anchor = f, 0, stops  # where the box is cut, if it must be: as late as the errors are small
    for _ in range(_MOST):
        if max(f.errors) < SMALL:
            anchor = f, len(strobes), stops
        try:
            until, found, stopped = event(y, f, box._replace(stops=stops))
            large = isinstance(found, Flight) and max(found.errors) > LARGE
            need(not (box.cuts and large), "the errors are large")
        except Rejected:
            if not box.cuts:
                return Seen(strobes, None, stops)
            f, count, stops = anchor
            return Seen(strobes[:count], cut(y, f, box._replace(stops=stops)), stops)
        strobes += passed(y, f, until)
        stops = stops or stopped
        if not isinstance(found, Flight):
            return Seen(strobes, found, stops)
        f = found
    return Seen(strobes, None, stops)


def event(y: System, f: Flight, box: Box) -> tuple[float, Flight | Model | Split, bool]:
    """Return the earliest time of the next event, what follows, and whether it is a stop."""
    kind, near, k = scout(y, f)
    j = undecided(y, f, near)
    if j is not None:
        c = chance(y, f, j)
        low, high = q.ends(c.s_all)
        until = y.slows[j][0] - 1
        if box.kinds and high > 0 and high - low > _COARSE:
            return until, perhaps_stopped(y, f, c, box), False
        return until, merged(y, f, c, stuck=False), False
    if kind == "hit":
        try:
            until, found = hit(y, f, near)
        except Rejected:
            need(q.ends(y.at_slow(f, k)[1])[1] < 0, "the time of a hit is not certain")
            near = without_wall(y, f, near, k)
        else:
            return until, found, not isinstance(found, Flight)
    h = halt(y, f, near, k)
    low, high = q.ends(h.p_all)
    if high < 0:
        return h.ends[0], stop(y, f, h), True
    need(low <= 0 and not (box.cuts and high - low > WIDE), "the time of a hit is not certain")
    need(box.kinds > 0, "there are too many cases")
    return before_hits(y, f, h.ends[0] - 1), grazed(y, f, h, box), False


def before_hits(y: System, f: Flight, t: float) -> float:
    """Return a time until which nothing happens: t, if no orbit has reached the wall then."""
    ahead = q.ends(y.seen(f, (t, 0.0), *q.cos_sin(t))[0])[1]
    return t if ahead < 0 else f.begun[0]


def perhaps_stopped(y: System, f: Flight, c: Chance, box: Box) -> Split:
    """Return what is seen of orbits that stop just before a slow time, and of the others."""
    box = box._replace(kinds=box.kinds - 1)
    at = y.slows[c.k][0]
    below = follow(y, merged(y, f, c, stuck=True), box._replace(stops=True))
    above = follow(y, f._replace(slow=c.k + 1, begun=(at, at + 1e-12)), box)
    return Split(c.s_all, below, above)


def grazed(y: System, f: Flight, h: Halt, box: Box) -> Split:
    """Return what is seen of orbits that stop, and of those that hit the wall slowly before."""
    box = box._replace(kinds=box.kinds - 1)
    below, above = Seen([], None, box.stops), Seen([], None, box.stops)
    slow: Seen | Slow = above
    try:
        found = stop(y, f, h)
        stopped = box._replace(stops=True)
        below = follow(y, found, stopped) if isinstance(found, Flight) else Seen([], found, True)
    except Rejected:
        pass
    try:
        (g, G), fastest, bounced = slow_hits(y, h)
        slow = Slow(g, G, fastest, follow(y, bounced, box))
    except Rejected:
        pass
    return Split(h.p_all, below, slow)


def cut(y: System, f: Flight, box: Box) -> Cut:
    """Follow the halves of a box."""
    x, v = abs(f.A[1]) + abs(f.B[1]), abs(f.A[2]) + abs(f.B[2])
    along = int(v > x)
    halves = (halved(f, along, side) for side in (-1.0, 1.0))
    box = box._replace(cuts=box.cuts - 1)
    lower, upper = (follow(y, half, box) for half in halves)
    return Cut(along, lower, upper)


def scout(y: System, f: Flight | Path) -> tuple[str, float, int]:
    """Return what comes next in the middle of the box, when, and in which arc: it steers."""
    a, A, B, ref = y.a, f.A[0], f.B[0], f.ref

    def s(t: float) -> float:
        return math.sin(t) - a * (t - ref) + A

    def ahead(t: float) -> float:
        d = t - ref
        return math.cos(t) - d * (A - a * d / 2) - B

    low = (f.begun[0] + f.begun[1]) / 2
    for k in range(f.slow, ARCS):
        slow = y.slows[k][0]
        if slow <= low:
            continue
        high, kind = slow, "hit"
        if s(slow) <= 0:
            high, kind = zero(s, max(low, slow - 2 * math.pi + 2 * y.theta[0]), slow), "stop"
        if ahead(high) <= 0:
            return "hit", zero(ahead, low, high), k
        if kind == "stop":
            return kind, high, k
        low = slow
    raise Rejected("a flight is too long")


def without_wall(y: System, f: Flight, near: float, k: int) -> float:
    """Return where the middle would stop in this arc, were there no wall: it steers."""
    slow = y.slows[k][0]
    low = max(near, slow - 2 * math.pi + 2 * y.theta[0])
    return zero(lambda t: math.sin(t) - y.a * (t - f.ref) + f.A[0], low, slow)


def undecided(y: System, f: Flight, near: float) -> int | None:
    """Return the number of the next slow time, if there s may be positive or not: it steers."""
    for k in range(f.slow, ARCS):
        if y.slows[k][0] > near + 0.5:
            return None
        low, high = q.ends(y.at_slow(f, k)[1])
        if low <= 0:
            return k if high > -0.05 * (high - low) else None
    return None


def passed(y: System, f: Flight, until: float) -> list[Strobe]:
    """Return (p, s) at the multiples of 2 pi that the flight passes before a time."""
    times = [y.turns[k] for k in range(4)]
    passes = [t for t in times if f.begun[1] < t[0] - t[1] and t[0] + t[1] < until]
    return [y.seen(f, t, 1.0, 0.0) for t in passes]


def slowest(end: Slow, level: Pair) -> Pair:
    """Return bounds of u for a level between these."""
    low = math.sqrt(2 * end.g * max(level[0], 0.0)) * (1 - 1e-9)
    return low, min(math.sqrt(2 * end.G * max(level[1], 0.0)) * (1 + 1e-9), end.fastest)
