"""The flights of a mass between two walls: x'' = F cos wt - s f, in the direction s = +-1.

*Flights.*  x and v are those of ``flight``, with s f.

*The sign of the velocity.*  p(t) = s v(t) has p' = s F cos wt - f; with viscosity (``losses``) what
is said here of p holds for p = e^(mu t) s v(t), p' = e^(mu t) (s F cos wt - f).  Since f < F, p'
has simple zeros, and p its local minima at those with s sin wt < 0: at the times (2 pi k - theta)/w
for s = 1 and (2 pi k + pi - theta)/w for s = -1, where theta = arccos(f/F).  So s v > 0 on [a, b]
if it is so at a, at b, and at those of these times that lie in (a, b).

*A flight that begins with v = 0*, after a turn or a release: s F cos wt > f just after its
beginning, for at a turn this holds, and a release is at one of these times.  So p increases from
zero, its infimum on (a, b] is a limit at a or attained at b or at a local minimum in (a, b): s v >
0 on (a, b] if it is so at b and at those times in (a, b).  The time of the release itself is not
one of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, cos_sin_jet, lift, raised
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import place, velocity
from cap.checker.system.walls import Parameters

Ends = tuple[Fraction, Fraction]
Box = Sequence[Interval]
Formula = Callable[[Sequence[RealJet], Sequence[RealJet]], RealJet]


class Moment(NamedTuple):
    """A time t with cos wt and sin wt, for every orbit from the box."""

    t: Centred
    cos: Centred
    sin: Centred


Minima = list[Moment]


class Flight(NamedTuple):
    """A flight of direction s, from the moment start, with x and v less their responses there.

    Starts at rest, or not; ``minima`` are the later times of local minima of p.
    """

    s: int
    x: Centred
    v: Centred
    start: Moment
    at_rest: bool
    minima: Minima


class Mechanics:
    """The mechanics at given parameters, over a box of initial states with a centre m.

    Every method holds for all orbits from the box, and rejects if it does not succeed.  Here
    all constants are numbers, and mu = 0.
    """

    def __init__(self, p: Parameters, box: Box, m: Box, order: int, periods: int = 1) -> None:
        self.bits, self.order = box[0].bits, order
        self.offsets = [z - c for z, c in zip(box, m, strict=True)]
        self.variables = [self._variable(n, *q) for n, q in enumerate(zip(box, m, strict=True))]
        self.constants(p)
        self.period = pi(self.bits) * 2 / self.omega
        self.horizon = self.period * periods
        self.minima = self._minima(p.f / p.F, periods)

    def constants(self, p: Parameters) -> None:
        """Set the constants of the flights and of the walls."""
        need(p.mu == 0, "mu = 0 does not hold")
        self.omega, self.F, self.f = map(self.number, (p.omega, p.F, p.f))
        self.swing, self.sway = self.number(p.F / p.omega), self.number(p.F / p.omega**2)
        self.walls = {1: self.number(p.r), -1: self.number(p.l)}
        self.e = self.constant(self.number(p.e))

    def _variable(self, n: int, box: Interval, m: Interval) -> Centred:
        """Return the n-th variable."""
        origin = (0,) * len(self.offsets)
        unit = raised(origin)[n]
        jets = (Jet(self.order, {origin: z, unit: z.integer(1)}) for z in (m, box))
        return self.centred(*jets)

    def _minima(self, ratio: Fraction, periods: int) -> dict[int, Minima]:
        """Return the moments in [0, horizon] at which p has its local minima, for each sign s.

        The ratio is f/F.
        """
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
        return Moment(t, *(self.centred(*jets) for jets in zip(*pairs, strict=True)))

    def full_turns(self, t: Interval) -> Moment:
        """Return the moment of a time that is a multiple of the period."""
        return self.instant(t, t.integer(1), t.integer(0))

    def course(self, s: int) -> tuple[Formula, Formula]:
        """Return the formulas of x and v on the flights of a direction.

        They take jets: what determines a flight (``arc``), and t, cos wt, sin wt.
        """

        f = self.f * s
        return (
            lambda arc, at: place(arc[0], arc[1], at[0] - arc[2], f / 2, at[1] * self.sway),
            lambda arc, at: velocity(arc[1], at[0] - arc[2], f, at[2] * self.swing),
        )

    def arc(self, flight: Flight) -> tuple[Centred, ...]:
        """Return what determines the state on a flight."""
        return flight.x, flight.v, flight.start.t

    # flights over the box

    def flight(
        self, s: int, start: Moment, x: Centred, v: Centred, minima: Minima, at_rest: bool = False
    ) -> Flight:
        """Return the flight of direction s that starts at a moment from (x, v)."""
        rest_x = lift(lambda x, cos: x + cos * self.sway, x, start.cos)
        rest_v = lift(lambda v, sin: v - sin * self.swing, v, start.sin)
        return Flight(s, rest_x, rest_v, start, at_rest, minima)

    def launch(self) -> Flight:
        """Return the first flight; the box must lie between the walls and away from v = 0."""
        x, v = self.variables[:2]
        need(self.is_between_walls(x.value), "the box is not certainly between the walls")
        need(not v.value.contains_zero(), "the velocity vanishes in the box")
        s = 1 if v.value.is_positive() else -1
        return self.flight(s, self.full_turns(self.period.integer(0)), x, v, self.minima[s])

    def is_between_walls(self, x: Interval) -> bool:
        """Return whether x certainly lies strictly between the walls."""
        return self.walls[-1].is_before(x) and x.is_before(self.walls[1])

    def value(self, flight: Flight, formula: Formula, at: Moment) -> Centred:
        """Return the value of a formula on a flight at a moment."""
        return lift(lambda *q: formula(q[:-3], q[-3:]), *self.arc(flight), *at)

    def place(self, flight: Flight, at: Moment) -> Centred:
        """Return the position on a flight at a moment."""
        return self.value(flight, self.course(flight.s)[0], at)

    def speed(self, flight: Flight, at: Moment) -> Centred:
        """Return the speed s v on a flight at a moment."""
        return lift(lambda v: v * flight.s, self.value(flight, self.course(flight.s)[1], at))

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
                attained = a.is_before(t) and t.is_before(b)  # or maybe not
                high = min(slowest.hi, inner.hi) if attained else slowest.hi
                slowest = Interval(min(slowest.lo, inner.lo), high, self.bits)
        return slowest


def least(values: Sequence[Interval]) -> Interval:
    """Return an enclosure of the minimum of the numbers in the intervals."""
    return Interval(min(v.lo for v in values), min(v.hi for v in values), values[0].bits)
