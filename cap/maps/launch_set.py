"""Sets of launches from a wall, and what becomes of those whose velocity never vanishes.

Units of 1/ω for time, F/ω² for length; α = f/F, elastic walls a distance G apart, no viscosity.  A
launch (t, u) leaves a wall at the phase t with the speed u; flights to the left are seen in their
mirror image, half a period later.  Until it hits the other wall

    w(x) = u + sin x - sin t - α (x - t),
    y(x) = (u - sin t)(x - t) - cos x + cos t - α (x - t)²/2

are the speed and the way at the phase x.  The next launch is (x + π, w(x)) where y(x) = G.

w falls from the phases p + 2 arccos α to the next of the *slow* phases p = -arccos α mod 2π, and
rises from there.  Let y(x), w(x) stand for all that the formulas give for the launches of a set.

*No hit before a.*  Of launches whose velocity never vanishes none hits before the phase a if

    y(x) + max(0, -w(x)) L(x) < G

at x = a and at all slow phases x of the flights before, L(x) being how long w has been falling at
x.  Proof.  Take the first of these x after a hit.  As long as w rises after a hit y grows beyond G.
Where w falls, y is concave: on that arc y <= y(x) + max(0, -w(x)) L(x).  So there was no hit since
w > 0 at the slow phase before, where there was none by the same argument.

*All have hit by b*, or their velocity has vanished, if b is after all launches, and y(b) >= G or
w(b) < 0: as long as they fly, y and w are what the formulas say, and w > 0.

So if b <= a the velocity of all vanishes.  Else those whose velocity does not, hit between a and b.
If y(b) >= G > y(a) for all of them, and w > 0 between, the formulas map the whole set smoothly, by
the implicit function theorem:

    ∂x = -∂y/w,    ∂w = ∂w|_x + (cos x - α) ∂x,
    ∂y = (-u - (cos t - α)(x - t), x - t),    ∂w|_x = (α - cos t, 1).
"""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, Self

from cap.flow.flight import place, velocity
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

UNIT = 2**13  # the phases of windows are multiples of 1/UNIT


class Constants(NamedTuple):
    """α and G; arccos α and its sine; π."""

    alpha: Ball
    width: Ball
    arc: Ball
    sine: Ball
    pi: Ball

    @classmethod
    def of(cls, alpha: Ball, width: Ball) -> Self:
        """Return the constants at the current precision."""
        return cls(alpha, width, alpha.acos(), (1 - alpha * alpha).sqrt(), interval.pi())

    def slow(self, k: int) -> Ball:
        """Return the k-th slow phase."""
        phase: Ball = 2 * k * self.pi - self.arc
        return phase


class Window(NamedTuple):
    """No hit before a, all by b; m is near the hit of the centre.  In units of 1/UNIT.

    If m is None, no more is known of the hits than this.
    """

    a: int
    b: int
    m: int | None


class Phase(NamedTuple):
    """A phase with its sine and cosine."""

    x: Ball
    sin: Ball
    cos: Ball

    @classmethod
    def at(cls, x: Ball) -> Self:
        """Return a phase, or all of a ball."""
        return cls(x, *x.sin_cos())


def flown(alpha: Any, launch: tuple[Any, Any], at: Any) -> tuple[Any, Any]:
    """Return (y, w) at a phase of a launch (phase, u), over any scalars; a phase is (x, sin, cos).

    The form is that of the checker, which may reject windows that are found with a narrower one,
    such as that of `cap.flow.formulas`.
    """
    ((t, sin, cos), u), (x, sin_x, cos_x) = launch, at
    d = x - t
    return place(cos, u - sin, d, alpha / 2, cos_x), velocity(u - sin, d, alpha, sin_x)


class Values(NamedTuple):
    """Way and speed at a phase: of the launch in the centre, and of all."""

    y_centre: Ball
    w_centre: Ball
    y: Ball
    w: Ball


@dataclass(frozen=True)
class LaunchSet:
    """Launches (t, u)(ε), smooth in ε, |ε| <= ``reach``; those of ε = 0 are in ``centre``.

    All are in ``hull``, and the derivative at any ε in ``matrix``.  ``own``: ε is the deviation of
    the first launch from the centre of its box; else that of a later one.
    """

    centre: Phase
    speed: Ball
    matrix: Matrix[Ball]
    reach: tuple[Ball, Ball]
    hull: tuple[Phase, Ball]
    own: bool

    @classmethod
    def of_box(cls, t: Ball, u: Ball, *, own: bool) -> Self:
        """Return all launches of a box."""
        zero, one = Ball(0), Ball(1)
        reach = interval.upper(t - interval.point(t)), interval.upper(u - interval.point(u))
        centre = Phase.at(interval.point(t))
        return cls(
            centre,
            interval.point(u),
            ((one, zero), (zero, one)),
            reach,
            (Phase.at(t), u),
            own,
        )

    def spread(self, first: Ball, second: Ball) -> Ball:
        """Return the ball of all ``first`` ε_0 + ``second`` ε_1."""
        return interval.symmetric(first * self.reach[0]) + interval.symmetric(
            second * self.reach[1]
        )

    def slopes(self, system: Constants, x: Ball) -> tuple[Ball, Ball]:
        """Return ∂y at the phases x, by ε."""
        (t, _, cos), u = self.hull
        (a, b), (c, d) = self.matrix
        by_t, by_u = -u - (cos - system.alpha) * (x - t), x - t
        return by_t * a + by_u * c, by_t * b + by_u * d

    def own_slopes(self, system: Constants) -> tuple[Ball, Ball]:
        """Return ∂w|_x by ε."""
        (a, b), (c, d) = self.matrix
        by_t = system.alpha - self.hull[0].cos
        return by_t * a + c, by_t * b + d

    def at(self, system: Constants, phase: Phase) -> Values:
        """Return way and speed at a phase, by the mean value theorem."""
        y, w = flown(system.alpha, (self.centre, self.speed), phase)
        return Values(
            y,
            w,
            y + self.spread(*self.slopes(system, phase.x)),
            w + self.spread(*self.own_slopes(system)),
        )

    @property
    def begin(self) -> Ball:
        """A lower bound of the phases."""
        return interval.lower(self.hull[0].x)


def phase_of(number: int) -> Phase:
    """Return a phase from its multiple of 1/UNIT."""
    return Phase.at(Ball(number) / UNIT)


def no_hit_before(system: Constants, launches: LaunchSet, a: int) -> bool:
    """Return whether no launch of a set, whose velocity never vanishes, hits before a phase."""
    at, begin = phase_of(a), launches.begin
    last = math.floor((a / UNIT + float(system.arc.mid())) / math.tau)
    if not (begin.is_finite() and system.slow(last) < at.x < system.slow(last + 1)):
        return False
    k = last
    while not system.slow(k) <= begin:
        slow = system.slow(k)
        fallen = interval.least(2 * (system.pi - system.arc), slow - begin)
        if not _short(system, launches, Phase(slow, -system.sine, system.alpha), fallen):
            return False
        k -= 1
    fallen = interval.least(at.x - system.slow(last) - 2 * system.arc, at.x - begin)
    return _short(system, launches, at, fallen)


def _short(system: Constants, launches: LaunchSet, at: Phase, fallen: Ball) -> bool:
    """Return whether y + max(0, -w) L < G at a phase; L is 0 where w rises."""
    values = launches.at(system, at)
    back, fall = interval.upper(-values.w), interval.upper(fallen)
    more = back * fall if back > 0 and fall > 0 else Ball(0)
    return bool(values.y + more < system.width)


def over_by(system: Constants, launches: LaunchSet, b: int, cap: Ball) -> bool:
    """Return whether all flights have ended by a phase, or do not matter: it is after ``cap``."""
    at = phase_of(b)
    if at.x >= cap:
        return True
    if not at.x >= launches.hull[0].x:
        return False
    values = launches.at(system, at)
    return bool(values.y >= system.width or values.w < 0)


def fly(system: Constants, launches: LaunchSet, window: Window) -> LaunchSet | None:
    """Return the next launches, given a window that has been proved; None if there are none.

    Where m is None they are a box.
    """
    a, b = phase_of(window.a), phase_of(window.b)
    m = phase_of((window.a + window.b) // 2 if window.m is None else window.m)
    span = Phase.at(interval.hull(a.x, b.x))
    middle = launches.at(system, m)
    speeds = middle.w + (span.cos - system.alpha) * (span.x - m.x)
    if window.m is not None:
        return _mapped(system, launches, (span, m), middle, speeds)
    if not interval.upper(speeds) > 0:
        return None
    low = interval.lower(speeds)
    u = interval.hull(low if low > 0 else Ball(0), interval.upper(speeds))
    return LaunchSet.of_box(span.x + system.pi, u, own=False)


def is_smooth(system: Constants, launches: LaunchSet, window: Window) -> bool:
    """Return whether all have one hit, transverse, in a window that has been proved."""
    a, b, m = (phase_of(number) for number in window if number is not None)
    span = Phase.at(interval.hull(a.x, b.x))
    speeds = launches.at(system, m).w + (span.cos - system.alpha) * (span.x - m.x)
    return bool(speeds > 0 and launches.at(system, b).y >= system.width)


def _mapped(
    system: Constants,
    launches: LaunchSet,
    phases: tuple[Phase, Phase],
    middle: Values,
    speeds: Ball,
) -> LaunchSet:
    """Return the smooth image of a set whose hits are in a window."""
    span, m = phases
    force = span.cos - system.alpha
    slope = middle.w_centre + force * (span.x - m.x)
    x = m.x - (middle.y_centre - system.width) / slope
    hit = Phase.at(interval.intersection(x, span.x))
    _, u = flown(system.alpha, (launches.centre, launches.speed), hit)
    p, q = (-s / speeds for s in launches.slopes(system, span.x))
    r, s = launches.own_slopes(system)
    r, s = r + force * p, s + force * q
    times = interval.intersection(hit.x + launches.spread(p, q), span.x)
    after = interval.intersection(u + launches.spread(r, s), speeds)
    mirrored = Phase(hit.x + system.pi, -hit.sin, -hit.cos)
    return LaunchSet(
        mirrored,
        u,
        ((p, q), (r, s)),
        launches.reach,
        (Phase.at(times + system.pi), after),
        launches.own,
    )
