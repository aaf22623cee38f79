"""A mass between elastic walls with dry friction: x'' = F cos(w t) - f sgn x', l < x < r.

*Flights.*  While the velocity has the sign s = +-1, x'' = F cos wt - s f, hence

    x(t) = B + A t - (F/w^2) cos wt - s f t^2/2,      v(t) = A + (F/w) sin wt - s f t.

At t = 0 this means A = v, B = x + F/w^2.

*Reflection* at a wall at the time t: x is the wall, v becomes -v, s becomes -s.  From A + (F/w) sin
wt - s f t = v = -(A' + (F/w) sin wt + s f t) and from the new x(t) = wall,

    A' = -A - 2 (F/w) sin wt,      B' = wall - A' t + (F/w^2) cos wt - s f t^2/2.

*The least speed of a flight.*  The speed u = s v > 0 has u' = s F cos wt - f and u'' = -s w F sin
wt.  Since f < F, u' and u'' have no common zero: a local minimum has s cos wt = f/F and s sin wt <
0.  In [0, T], T = 2 pi/w, that is one time, t = (2 pi - theta)/w for s = 1 and (pi - theta)/w for s
= -1, where theta = arccos(f/F).  So the least speed on [a, b] in [0, T] is attained at a, at b, or
at this time if it lies between them.

*Itinerary.*  Let [a, b] contain the end of the last event and the end of the time window W of the
next hit, a < W.  If the least speed on [a, b] is positive for every orbit from the box, x is
monotone there, and if moreover s (x - wall) is negative at the beginning of W and positive at its
end, then every orbit reaches the wall exactly once in [a, b], inside W, with a speed that is not
zero, and touches nothing before. If after the last hit the least speed on [a, T] is positive and
x(T) lies between the walls, there are no more hits.  In all this, no orbit from the box turns or
sticks.

*Hit times as jets.*  Let g(t) = x(t) - wall, t_0 the hit time at a point of the box and t_<k the
jet of the hit time below degree k.  As g(t_<k + h) = g(t_<k) + v(t_0) h + ... and g of the hit time
is zero, the terms of degree k of the hit time are -1/v(t_0) times those of g(t_<k).  At first t_0
is only known to lie in W: at the centre, the interval Newton operator mid - g(mid)/v(t) narrows it;
over the box, the mean value form does.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple, TypeVar

from cap.checker.elementary import arccos, cos_sin, pi
from cap.checker.interval import Interval
from cap.checker.jet import Centred, Jet, RealJet, cos_sin_jet, lift, tightened
from cap.checker.rejection import need

N = TypeVar("N", Interval, RealJet)


class Parameters(NamedTuple):
    """The exact parameters of x'' = F cos(omega t) - f sgn x' between the walls l < r."""

    F: Fraction
    omega: Fraction
    f: Fraction
    l: Fraction
    r: Fraction


class Moment(NamedTuple):
    """A time t with cos wt and sin wt, for every orbit from the box."""

    t: Centred
    cos: Centred
    sin: Centred


class Flight(NamedTuple):
    """A flight of direction s, from the moment start."""

    s: int
    A: Centred
    B: Centred
    start: Moment


class Hit(NamedTuple):
    """A hit: its moment, the speed there, and the flight that it ends."""

    moment: Moment
    speed: Centred
    flight: Flight


class Passage(NamedTuple):
    """The orbits from a box over one period: the hits, the least speed, the state at T."""

    hits: list[Hit]
    least_speed: Interval
    x: Centred
    v: Centred


class Mechanics:
    """The mechanics at given parameters, over a box of initial states with a centre m.

    Every method holds for all orbits from the box, and rejects if it does not succeed.
    """

    def __init__(
        self, p: Parameters, box: Sequence[Interval], m: Sequence[Interval], order: int
    ) -> None:
        self.bits = box[0].bits
        self.omega, self.f = self.number(p.omega), self.number(p.f)
        self.speed_scale = self.number(p.F / p.omega)  # F/w
        self.length_scale = self.number(p.F / p.omega**2)  # F/w^2
        self.walls = {1: self.number(p.r), -1: self.number(p.l)}
        self.period = pi(self.bits) * 2 / self.omega
        theta = arccos(self.number(p.f / p.F))
        self.minima = {
            1: (pi(self.bits) * 2 - theta) / self.omega,
            -1: (pi(self.bits) - theta) / self.omega,
        }
        self.order, self.offsets = order, (box[0] - m[0], box[1] - m[1])
        self.x, self.v = (
            self.centred(
                Jet(order, {(0, 0): c, d: c.integer(1)}), Jet(order, {(0, 0): b, d: b.integer(1)})
            )
            for c, b, d in zip(m, box, ((1, 0), (0, 1)), strict=True)
        )

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number."""
        return Interval.enclosing(q, q, self.bits)

    def centred(self, centre: RealJet, box: RealJet) -> Centred:
        """Return the pair of jets, the one at the centre cut to the order that is used."""
        return Centred(centre.truncated(self.order - 1), box, self.offsets)

    def constant(self, c: Interval) -> Centred:
        """Return a quantity that is the same for all orbits."""
        return self.centred(Jet(self.order, {(0, 0): c}), Jet(self.order, {(0, 0): c}))

    def moment(self, t: Centred) -> Moment:
        """Return the moment at the time t."""
        pairs = [cos_sin_jet(jet * self.omega) for jet in (t.centre, t.box)]
        cos, sin = (self.centred(*jets) for jets in zip(*pairs, strict=True))
        return Moment(t, cos, sin)

    def position(self, s: int, A: N, B: N, t: N, cos: N) -> N:
        """Return x(t) on a flight."""
        return B + A * t - cos * self.length_scale - t * t * (self.f * s / 2)

    def velocity(self, s: int, A: N, t: N, sin: N) -> N:
        """Return v(t) on a flight."""
        return A + sin * self.speed_scale - t * (self.f * s)

    def passage(self, windows: Sequence[tuple[Fraction, Fraction]]) -> Passage:
        """Prove the itinerary that hits the walls once in each window, and follow it to T.

        On return, every orbit from the box makes exactly these hits in [0, T], alternately at the
        two walls, turns and sticks nowhere, and is strictly between the walls at T.
        """
        flight, hits = self.launch(), list[Hit]()
        for window in windows:
            hits.append(self.hit(flight, window))
            flight = self.reflected(hits[-1])
        one, zero = self.period.integer(1), self.period.integer(0)
        end = Moment(self.constant(self.period), self.constant(one), self.constant(zero))
        slowest = [self.least_speed(h.flight, h.moment) for h in hits] + [
            self.least_speed(flight, end)
        ]
        need(slowest[-1].is_positive(), "the velocity may vanish between the last hit and T")
        x, v = self.place(flight, end), self.speed(flight, end)
        need(self.is_between_walls(x[0, 0]), "x(T) is not certainly between the walls")
        return Passage(hits, _least(slowest), x, lift(lambda u: u * flight.s, v))

    def launch(self) -> Flight:
        """Return the first flight; the box must lie between the walls and away from v = 0."""
        need(self.is_between_walls(self.x[0, 0]), "the box is not certainly between the walls")
        need(not self.v[0, 0].contains_zero(), "the velocity vanishes in the box")
        one = self.period.integer(1)
        shift = self.constant(self.length_scale)
        start = Moment(*(self.constant(one * n) for n in (0, 1, 0)))
        return Flight(
            1 if self.v[0, 0].is_positive() else -1,
            self.v,
            lift(lambda x, d: x + d, self.x, shift),
            start,
        )

    def is_between_walls(self, x: Interval) -> bool:
        """Return whether x certainly lies strictly between the walls."""
        return self.walls[-1].is_before(x) and x.is_before(self.walls[1])

    def place(self, flight: Flight, at: Moment) -> Centred:
        """Return the position on a flight at a moment."""
        s = flight.s
        return lift(lambda *q: self.position(s, *q), flight.A, flight.B, at.t, at.cos)

    def speed(self, flight: Flight, at: Moment) -> Centred:
        """Return the speed s v on a flight at a moment."""
        s = flight.s
        return lift(lambda *q: self.velocity(s, *q) * s, flight.A, at.t, at.sin)

    def least_speed(self, flight: Flight, end: Moment) -> Interval:
        """Return an enclosure of the least values of s v from the start of a flight to the end."""
        ends = _least([self.speed(flight, m)[0, 0] for m in (flight.start, end)])
        a, b, t = flight.start.t[0, 0], end.t[0, 0], self.minima[flight.s]
        if t.is_before(a) or b.is_before(t):
            return ends
        inner = self.speed(flight, self.moment(self.constant(t)))[0, 0]
        if a.is_before(t) and t.is_before(b):
            return _least([ends, inner])
        return Interval(min(ends.lo, inner.lo), ends.hi, self.bits)  # it may be attained, or not

    def hit(self, flight: Flight, window: tuple[Fraction, Fraction]) -> Hit:
        """Prove that the flight ends with a hit in the window, its first event, and return it."""
        first, last = (self.moment(self.constant(self.number(t))) for t in window)
        s, wall = flight.s, self.walls[flight.s]
        need(
            flight.start.t[0, 0].is_before(first.t[0, 0]),
            "a window begins before the event before it",
        )
        need(last.t[0, 0].is_before(self.period), "a window ends after T")
        need(self.least_speed(flight, last).is_positive(), "the velocity may vanish before a hit")
        before, after = ((self.place(flight, m)[0, 0] - wall) * s for m in (first, last))
        need((-before).is_positive(), "the wall may be reached before a window begins")
        need(after.is_positive(), "the wall may not be reached when a window ends")
        t = self.hit_time(flight, Interval.enclosing(*window, self.bits))
        moment = self.moment(t)
        return Hit(moment, self.speed(flight, moment), flight)

    def reflected(self, hit: Hit) -> Flight:
        """Return the flight after a hit."""
        (s, A, _, _), m, wall = hit.flight, hit.moment, self.walls[hit.flight.s]
        friction = self.f * s / 2
        A = lift(lambda A, sin: -A - sin * (self.speed_scale * 2), A, m.sin)
        B = lift(
            lambda w, A, t, cos: w - A * t + cos * self.length_scale - t * t * friction,
            self.constant(wall),
            A,
            m.t,
            m.cos,
        )
        return Flight(-s, A, B, m)

    def hit_time(self, flight: Flight, window: Interval) -> Centred:
        """Return the time of the hit whose existence in the window is proved."""
        (s, A, B, _), t0 = flight, window
        at_centre = self.root_at_centre(flight, window)
        centre = self.implicit(s, A.centre, B.centre, at_centre)
        while True:
            coarse = self.implicit(s, A.box.truncated(1), B.box.truncated(1), t0)
            narrowed = tightened(coarse, centre, self.offsets).coefficients[0, 0]
            if 10 * narrowed.width >= 9 * t0.width:
                return Centred(centre, self.implicit(s, A.box, B.box, narrowed), self.offsets)
            t0 = narrowed

    def root_at_centre(self, flight: Flight, t: Interval) -> Interval:
        """Return an enclosure of the hit time of the orbit of m, which lies in t."""
        s, A, B = flight.s, *(jet.centre.coefficients[0, 0] for jet in (flight.A, flight.B))
        while True:
            mid = t.midpoint()
            gap = self.position(s, A, B, mid, cos_sin(mid * self.omega)[0]) - self.walls[s]
            v = self.velocity(s, A, t, cos_sin(t * self.omega)[1])
            narrowed = t.intersection(mid - gap / v)
            if 2 * narrowed.width >= t.width:
                return narrowed
            t = narrowed

    def implicit(self, s: int, A: RealJet, B: RealJet, t0: Interval) -> RealJet:
        """Return the jet of the hit time from an enclosure of its constant term."""
        v = self.velocity(s, A.coefficients[0, 0], t0, cos_sin(t0 * self.omega)[1])
        t = Jet(A.order, {(0, 0): t0})
        for k in range(1, A.order + 1):
            cos, _ = cos_sin_jet(t.truncated(k) * self.omega)
            x = self.position(s, A, B, t, cos).coefficients
            t = t + Jet(A.order, {power: -c / v for power, c in x.items() if sum(power) == k})
        return t


def _least(values: Sequence[Interval]) -> Interval:
    """Return an enclosure of the minimum of the numbers in the intervals."""
    return Interval(min(v.lo for v in values), min(v.hi for v in values), values[0].bits)
