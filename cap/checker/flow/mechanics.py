"""A mass between two walls: x'' = F cos wt - f sgn x', l < x < r, and elastic hits: v -> -v.

*Flights.*  While the velocity has the sign s = +-1, x'' = F cos wt - s f.  A solution of x'' = F
cos wt is, with P = F/w^2,

    x_p(t) = -P cos wt,      v_p(t) = P w sin wt.

The flight that starts at t_0 from (x_0, v_0) is, with d = t - t_0, A = v_0 - v_p(t_0), X = x_0 -
x_p(t_0), C = s f,

    x(t) = x_p(t) + X + A d - C d^2/2,      v(t) = v_p(t) + A - C d.

With losses (``losses``) there is viscosity -mu x' besides, and d^2/2 and d become other functions.

*The sign of the velocity.*  p(t) = e^(mu t) s v(t), here mu = 0, has p' = e^(mu t) (s F cos wt -
f).  Since f < F, p' has simple zeros, and p its local minima at those with s sin wt < 0: at the
times (2 pi k - theta)/w for s = 1 and (2 pi k + pi - theta)/w for s = -1, where theta =
arccos(f/F).  So s v > 0 on [a, b] if it is so at a, at b, and at those of these times that lie in
(a, b).

*A flight that begins with v = 0*, after a turn or a release: s F cos wt > f just after its
beginning, for at a turn this holds, and a release is at one of these times.  So p increases from
zero, its infimum on (a, b] is a limit at a or attained at b or at a local minimum in (a, b): s v >
0 on (a, b] if it is so at b and at those times in (a, b).  The time of the release itself is not
one of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.elementary import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, cos_sin_jet, lift, raised
from cap.checker.kernel.rejection import need
from cap.checker.kernel.theorem import Parameters

Ends = tuple[Fraction, Fraction]
Box = Sequence[Interval]


class Moment(NamedTuple):
    """A time t with cos wt and sin wt, for every orbit from the box."""

    t: Centred
    cos: Centred
    sin: Centred


Minima = list[Moment]


class Flight(NamedTuple):
    """A flight of direction s, from the moment start.

    Starts at rest, or not; ``minima`` are the later times of local minima of p.
    """

    s: int
    A: Centred
    X: Centred
    C: Centred
    start: Moment
    at_rest: bool
    minima: Minima


class Mechanics:
    """The mechanics at given parameters, over a box of initial states with a centre m.

    Every method holds for all orbits from the box, and rejects if it does not succeed.
    """

    def __init__(self, p: Parameters, box: Box, m: Box, order: int, periods: int = 1) -> None:
        self.bits = box[0].bits
        self.omega, self.f, self.F = (self.number(q) for q in (p.omega, p.f, p.F))
        self.walls = {1: self.number(p.r), -1: self.number(p.l)}
        self.period = pi(self.bits) * 2 / self.omega
        self.horizon = self.period * periods
        self.order = order
        self.offsets = [z - c for z, c in zip(box, m, strict=True)]
        self.variables = [self._variable(n, *q) for n, q in enumerate(zip(box, m, strict=True))]
        self.x, self.v = (*self.variables, self.constant(self.number(Fraction(0))))[:2]
        self.P = self.number(p.F / p.omega**2)
        self.minima = self._minima(p.f / p.F, periods)

    def _variable(self, n: int, box: Interval, m: Interval) -> Centred:
        """Return the n-th variable."""
        origin = (0,) * len(self.offsets)
        unit = raised(origin)[n]
        jets = (Jet(self.order, {origin: z, unit: z.integer(1)}) for z in (m, box))
        return self.centred(*jets)

    def _minima(self, ratio: Fraction, periods: int) -> dict[int, Minima]:
        """Return the moments in [0, horizon] at which p has its local minima, for each sign s."""
        cos, half_turn = self.number(ratio), pi(self.bits)
        sin, theta = self.number(1 - ratio**2).sqrt(), arccos(cos)

        def minimum(k: int, s: int) -> Moment:
            return self.instant((half_turn * k - theta) / self.omega, cos * s, sin * -s)

        rising = [minimum(2 * k, 1) for k in range(1, periods + 1)]
        return {1: rising, -1: [minimum(2 * k + 1, -1) for k in range(periods)]}

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number."""
        return Interval.enclosing(q, q, self.bits)

    def centred(self, centre: RealJet, box: RealJet) -> Centred:
        """Return the pair of jets, the one at the centre cut to the order that is used."""
        return Centred(centre.truncated(self.order - 1), box, self.offsets)

    def constant(self, c: Interval) -> Centred:
        """Return a quantity that is the same for all orbits."""
        jet = Jet(self.order, {(0,) * len(self.offsets): c})
        return self.centred(jet, jet)

    def instant(self, t: Interval, cos: Interval, sin: Interval) -> Moment:
        """Return a moment that is the same for all orbits."""
        return Moment(self.constant(t), self.constant(cos), self.constant(sin))

    def moment(self, t: Centred) -> Moment:
        """Return the moment at the time t."""
        pairs = [cos_sin_jet(jet * self.omega) for jet in (t.centre, t.box)]
        cos, sin = (self.centred(*jets) for jets in zip(*pairs, strict=True))
        return Moment(t, cos, sin)

    def full_turns(self, t: Interval) -> Moment:
        """Return the moment of a time that is a multiple of the period."""
        return self.instant(t, t.integer(1), t.integer(0))

    # formulas for jets; ``losses`` are what they depend on with losses: nothing here

    @property
    def losses(self) -> tuple[Centred, ...]:
        """What the formulas depend on besides the flight and the time."""
        return ()

    def x_p(self, cos: RealJet, sin: RealJet, *losses: RealJet) -> RealJet:  # noqa: ARG002
        """Return x_p(t)."""
        return cos * -self.P

    def v_p(self, cos: RealJet, sin: RealJet, *losses: RealJet) -> RealJet:  # noqa: ARG002
        """Return v_p(t)."""
        return sin * (self.P * self.omega)

    def integral(self, n: int, d: RealJet, *losses: RealJet) -> RealJet:  # noqa: ARG002
        """Return d for n = 1, d^2/2 for n = 2."""
        return d if n == 1 else d * d * self.number(Fraction(1, 2))

    def position(self, arc: Sequence[RealJet], when: Sequence[RealJet]) -> RealJet:
        """Return x(t) on a flight A, X, C, t_0; ``when`` is t, cos wt, sin wt."""
        (A, X, C, start, *losses), (t, cos, sin) = arc, when
        d = t - start
        return X + A * d - C * self.integral(2, d, *losses) + self.x_p(cos, sin, *losses)

    def velocity(self, arc: Sequence[RealJet], when: Sequence[RealJet]) -> RealJet:
        """Return v(t) on a flight."""
        (A, _, C, start, *losses), (t, cos, sin) = arc, when
        return A - C * self.integral(1, t - start, *losses) + self.v_p(cos, sin, *losses)

    def drag(self, A: Centred, s: int) -> Centred:  # noqa: ARG002
        """Return C on a flight."""
        return self.constant(self.f * s)

    def reflected(self, speed: Centred, s: int) -> Centred:
        """Return the velocity after a hit, from the speed before it."""
        return lift(lambda u: u * -s, speed)

    # flights over the box

    def flight(
        self, s: int, start: Moment, x: Centred, v: Centred, minima: Minima, at_rest: bool = False
    ) -> Flight:
        """Return the flight of direction s that starts at a moment from (x, v)."""
        at = start.cos, start.sin, *self.losses
        A = lift(lambda v, *q: v - self.v_p(*q), v, *at)
        X = lift(lambda x, *q: x - self.x_p(*q), x, *at)
        return Flight(s, A, X, self.drag(A, s), start, at_rest, minima)

    def arc(self, flight: Flight) -> tuple[Centred, ...]:
        """Return what determines x(t) on a flight."""
        return flight.A, flight.X, flight.C, flight.start.t, *self.losses

    def launch(self) -> Flight:
        """Return the first flight; the box must lie between the walls and away from v = 0."""
        need(self.is_between_walls(self.x.value), "the box is not certainly between the walls")
        need(not self.v.value.contains_zero(), "the velocity vanishes in the box")
        s = 1 if self.v.value.is_positive() else -1
        start = self.full_turns(self.period.integer(0))
        return self.flight(s, start, self.x, self.v, self.minima[s])

    def is_between_walls(self, x: Interval) -> bool:
        """Return whether x certainly lies strictly between the walls."""
        return self.walls[-1].is_before(x) and x.is_before(self.walls[1])

    def place(self, flight: Flight, at: Moment) -> Centred:
        """Return the position on a flight at a moment."""
        return lift(lambda *q: self.position(q[:-3], q[-3:]), *self.arc(flight), *at)

    def speed(self, flight: Flight, at: Moment) -> Centred:
        """Return the speed s v on a flight at a moment."""
        s = flight.s
        return lift(lambda *q: self.velocity(q[:-3], q[-3:]) * s, *self.arc(flight), *at)

    def least_speed(self, flight: Flight, end: Moment) -> Interval:
        """Return an enclosure of the least of s v at the start, the end, and the minima of p.

        If it is positive, s v > 0 from the start (if that is at rest: after it) to the end; if mu =
        0 and the start is not at rest, it is the least speed there.
        """
        ends = [end] if flight.at_rest else [flight.start, end]
        slowest = least([self.speed(flight, m).value for m in ends])
        a, b = flight.start.t.value, end.t.value
        for minimum in flight.minima:
            t = minimum.t.value
            if not (t.is_before(a) or b.is_before(t)):
                inner = self.speed(flight, minimum).value
                if a.is_before(t) and t.is_before(b):
                    slowest = least([slowest, inner])
                else:  # it may be attained, or not
                    slowest = Interval(min(slowest.lo, inner.lo), slowest.hi, self.bits)
        return slowest


def least(values: Sequence[Interval]) -> Interval:
    """Return an enclosure of the minimum of the numbers in the intervals."""
    return Interval(min(v.lo for v in values), min(v.hi for v in values), values[0].bits)
