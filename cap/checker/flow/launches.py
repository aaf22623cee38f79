"""Boxes of launches from which no T-periodic orbit that never stops begins, slowest launch first.

Units 1/omega, F/omega^2; alpha = f/F, gap rho, elastic walls, no viscosity.  An orbit whose
velocity never vanishes goes from wall to wall.  Seen from the wall that it leaves, in the mirror
image where that is the right one, with time shifted by pi, each flight begins with a launch: a
phase t and a speed u > 0.  At the phase x the flight has the speed w and has gone the way y,

    w(x) = u + sin x - sin t - alpha (x - t),
    y(x) = (u - sin t)(x - t) - (cos x - cos t) - alpha (x - t)^2/2,

as long as it has not hit.  It hits where y = rho; that is the launch (x + pi, w(x)).

*A chain.*  Let (t_k, u_k) be the launch after k flights.  m hits of each wall in a period are 2m
flights, t_2m = t_0 + 2m pi + 2 pi, u_2m = u_0, and if u_0 is the least of the speeds, u_k >= u_0
and t_k - t_0 - k pi <= 2 pi for all k.  For all orbits from a box with 2m >= 4 one of these fails
if after some k flights

    t_k - t_0 - k pi > 2 pi    or    u_k < u_0    or    there is no orbit without a stop left,

and for no even number of flights from 4 to k the orbit can close.

*Windows.*  w' = cos x - alpha is negative from x = arccos alpha to x = 2 pi - arccos alpha (mod 2
pi): there w falls.  Let p be such an end of a fall.  No launch of a set hits before a if

    y(x) + max(0, -w(x)) d < rho,    d the time for which w has fallen before x, in the flight,

for x = a and for each x = p that may be between a launch and a.  For suppose it hits at h < a, and
let x be the first of these points after h.  If w rises from h to x, then w(x) > 0 and y(x) > rho,
as the formulas have it.  If w falls from some time in [h, x], or from before h, to x, then let q >=
h be the later of h and the beginning of the fall: y(q) >= rho, and y is concave on [q, x], so y(q)
<= y(x) - w(x)(x - q) <= y(x) + max(0, -w(x)) d.

By b each has hit, if it never stops, provided all launch before b, and y(b) >= rho or w(b) < 0.
Hits after t_0 + 2 pi + k pi are too late.  So if b <= a none is left.

*Maps.*  Let the launches of a set depend smoothly on e = (e_0, e_1), |e_i| <= r_i.  If y(b) >= rho
and w > 0 on [a, b] for all of them, as the formulas have it, then y(x) = rho has one solution x(e)
in [a, b], for y(a) < rho; by the implicit function theorem

    dx = -dy/w,     dy = -(u + (cos t - alpha)(x - t)) dt + (x - t) du,
    du = w_e + (cos x - alpha) dx,     w_e = (alpha - cos t) dt + du.

Values at all e follow from those at e = 0 by the mean value theorem; at e = 0, x = m - (y(m) -
rho)/w([a, b]) is Newton's method.  Or else no more is told of the hits than that they are in [a,
b], with u in w([a, b]), u > 0.  As w([a, b]) comes from w(m), or from that at the middle, by the
mean value theorem, m lies in [a, b].

*Closing.*  With g(e) = (t_k - t_0 - k pi - 2 pi, u_k - u_0), its derivative J, and any matrix C, a
zero e of g lies in -C g(0) + (1 - C J) e.  If no e of the box can, there is none.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.flight import place, velocity

Row = tuple[Interval, Interval]


class Gap:
    """The constants, and the numbers that follow from them."""

    def __init__(self, alpha: Interval, rho: Interval) -> None:
        self.alpha, self.half, self.rho, self.pi = alpha, alpha / 2, rho, pi(rho.bits)
        self.arc, self.sine = arccos(alpha), (-alpha.square() + 1).sqrt()
        self.turn, self.fall = self.pi * 2, (self.pi - self.arc) * 2

    def slow(self, k: int) -> Phase:
        """Return the end of a fall."""
        return Phase(self.turn * k - self.arc, self.alpha, -self.sine)


class Phase(NamedTuple):
    """A phase with its cosine and sine."""

    x: Interval
    cos: Interval
    sin: Interval


def phase(x: Interval) -> Phase:
    """Return a phase."""
    return Phase(x, *cos_sin(x))


class Window(NamedTuple):
    """No hit before a, all by b.  m, in [a, b] if it is there, tells that all hit in between."""

    a: Phase
    b: Phase
    m: Phase | None


class Launches(NamedTuple):
    """Launches t(e), u(e): those of e = 0 in ``centre`` and ``speed``; all in ``all_t``, ``all_u``.

    ``dt`` and ``du`` enclose the derivatives at all e, |e_i| <= reach[i].  ``first``: e is the
    deviation of the first launch from its centre.
    """

    centre: Phase
    speed: Interval
    dt: Row
    du: Row
    reach: Row
    all_t: Phase
    all_u: Interval
    first: bool


def box(t: Interval, u: Interval, *, first: bool) -> Launches:
    """Return the launches of a box."""
    one, zero, m, s = t.integer(1), t.integer(0), t.midpoint(), u.midpoint()
    reach = (t - m).magnitude(), (u - s).magnitude()
    return Launches(phase(m), s, (one, zero), (zero, one), reach, phase(t), u, first)


def within(launches: Launches, row: Row) -> Interval:
    """Return all values of a linear form."""
    far = sum(max(abs(c.lo), abs(c.hi)) * r.hi for c, r in zip(row, launches.reach, strict=True))
    far = -(-far >> launches.speed.bits)
    return Interval(-far, far, launches.speed.bits)


def way(gap: Gap, n: Launches, at: Phase) -> tuple[Interval, Interval]:
    """Return y at a phase: at e = 0, and at all e."""
    d = at.x - n.centre.x
    y = place(n.centre.cos, n.speed - n.centre.sin, d, gap.half, at.cos)
    return y, y + within(n, way_slopes(gap, n, at.x))


def way_slopes(gap: Gap, n: Launches, x: Interval) -> Row:
    """Return dy at all phases of an interval."""
    d = x - n.all_t.x
    by_t = -(n.all_u + (n.all_t.cos - gap.alpha) * d)
    (a, b), (c, e) = n.dt, n.du
    return by_t * a + d * c, by_t * b + d * e


def speed(gap: Gap, n: Launches, at: Phase) -> tuple[Interval, Interval]:
    """Return w at a phase: at e = 0, and at all e."""
    w = velocity(n.speed - n.centre.sin, at.x - n.centre.x, gap.alpha, at.sin)
    return w, w + within(n, speed_slopes(gap, n))


def speed_slopes(gap: Gap, n: Launches) -> Row:
    """Return w_e."""
    by_t = gap.alpha - n.all_t.cos
    (a, b), (c, e) = n.dt, n.du
    return by_t * a + c, by_t * b + e


def none_before(gap: Gap, n: Launches, a: Phase) -> bool:
    """Return whether none hits before a."""
    k = (a.x.lo + gap.arc.lo) // gap.turn.hi
    need(gap.slow(k).x.is_before(a.x) and a.x.is_before(gap.slow(k + 1).x), "a fall may end at a")
    fallen = a.x - gap.slow(k).x - gap.arc * 2
    if not short(gap, n, a, fallen):
        return False
    while gap.slow(k).x.hi > n.all_t.x.lo:
        if not short(gap, n, gap.slow(k), gap.fall):
            return False
        k -= 1
    return True


def short(gap: Gap, n: Launches, at: Phase, fallen: Interval) -> bool:
    """Return whether y + max(0, -w) d < rho."""
    longest = min(fallen.hi, (at.x - n.all_t.x).hi)
    back = -speed(gap, n, at)[1].lo
    y = way(gap, n, at)[1]
    more = back * longest if back > 0 and longest > 0 else 0
    return y.hi - (-more >> y.bits) < gap.rho.lo


def over(gap: Gap, n: Launches, b: Phase) -> bool:
    """Return whether by b each has hit, or stopped."""
    if n.all_t.x.hi > b.x.lo:
        return False
    return way(gap, n, b)[1].lo >= gap.rho.hi or speed(gap, n, b)[1].hi < 0


def flown(gap: Gap, n: Launches, window: Window) -> Launches | None:
    """Return the launches after the flights, or None if there are none."""
    a, b, m = window
    inside = Interval(a.x.lo, b.x.hi, a.x.bits)
    span, at = phase(inside), m or phase(inside.midpoint())
    own, every = speed(gap, n, at)
    change = (span.cos - gap.alpha) * (span.x - at.x)
    w = every + change
    if m is not None:
        need(a.x.lo <= m.x.lo and m.x.hi <= b.x.hi, "the middle of a window is not in it")
        need(way(gap, n, b)[1].lo >= gap.rho.hi, "not all may hit in a window")
        need(w.is_positive(), "a hit may not be transverse")
        return mapped(gap, n, (m, span), own + change, w)
    if w.hi <= 0:
        return None
    return box(span.x + gap.pi, Interval(max(w.lo, 0), w.hi, w.bits), first=False)


def mapped(
    gap: Gap, n: Launches, at: tuple[Phase, Phase], slope: Interval, w: Interval
) -> Launches:
    """Return the smooth image."""
    m, span = at
    hit = phase((m.x - (way(gap, n, m)[0] - gap.rho) / slope).intersection(span.x))
    u = speed(gap, n, hit)[0]
    dt = tuple(-(q / w) for q in way_slopes(gap, n, span.x))
    force = span.cos - gap.alpha
    du = tuple(q + force * p for p, q in zip(dt, speed_slopes(gap, n), strict=True))
    dt, du = (dt[0], dt[1]), (du[0], du[1])
    t = (hit.x + within(n, dt)).intersection(span.x)
    return Launches(
        Phase(hit.x + gap.pi, -hit.cos, -hit.sin),
        u,
        dt,
        du,
        n.reach,
        phase(t + gap.pi),
        (u + within(n, du)).intersection(w),
        n.first,
    )


def empty(gap: Gap, t: Interval, u: Interval, windows: Iterable[Window]) -> None:
    """Prove that no orbit begins in a box, with a window for each of some flights."""
    first = now = box(t, u, first=True)
    for k, window in enumerate(windows, start=1):
        late = (window.b.x - t - gap.pi * (k + 1)).lo >= 0
        need(late or over(gap, now, window.b), "a hit may come after its window")
        need(none_before(gap, now, window.a), "a hit may come before its window")
        after = None if window.b.x.hi <= window.a.x.lo else flown(gap, now, window)
        if after is None:
            return
        now = after
        passed, faster = since(gap, first, now, k)
        if gap.turn.hi < passed.lo or faster.hi < 0:
            return
        if k % 2 == 0 and k >= 4:
            need(apart(gap, first, now, (passed, faster), k), "an orbit may close")
    raise Rejected("it is not proved that a box of launches is empty")


def since(gap: Gap, first: Launches, now: Launches, k: int) -> Row:
    """Return the time that has passed, and the gain of speed."""
    passed = now.all_t.x - first.all_t.x - gap.pi * k
    faster = now.all_u - first.all_u
    if now.first:
        (a, b), (c, d) = now.dt, now.du
        one = now.centre.x - first.centre.x - gap.pi * k + within(now, (a - 1, b))
        other = now.speed - first.speed + within(now, (c, d - 1))
        return passed.intersection(one), faster.intersection(other)
    return passed, faster


def apart(gap: Gap, first: Launches, now: Launches, changes: Row, k: int) -> bool:
    """Return whether no orbit closes after k flights."""
    passed, faster = changes
    if not ((passed - gap.turn).contains_zero() and faster.contains_zero()):
        return True
    if not now.first:
        return False
    g = now.centre.x - first.centre.x - gap.pi * (k + 2), now.speed - first.speed
    (a, b), (c, d) = now.dt, now.du
    return excluded(((a - 1, b), (c, d - 1)), g, now.reach)


def excluded(J: Sequence[Row], g: Row, reach: Row) -> bool:
    """Return whether g + J e is not 0 for |e_i| <= reach[i], C near the inverse of J."""
    (a, b), (c, d) = J
    (p, q), (r, s) = (tuple(x.midpoint() for x in row) for row in J)
    det = (p * s - q * r).midpoint()
    if det.contains_zero():
        return False
    C = [[(x / det).midpoint() for x in row] for row in ((s, -q), (-r, p))]
    for (x, y), own, i in zip(C, reach, (0, 1), strict=True):
        row = [x * a + y * c, x * b + y * d]
        row[i] = row[i] - 1
        sides = [Interval(-e.hi, e.hi, e.bits) for e in reach]
        image = -(x * g[0] + y * g[1]) - row[0] * sides[0] - row[1] * sides[1]
        if image.hi < -own.hi or own.hi < image.lo:
            return True
    return False
