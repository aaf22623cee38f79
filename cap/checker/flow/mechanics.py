"""The flights of a mass between two walls: x'' = F cos wt - s f, in the direction s = +-1.

*Flights.*  x and v are those of ``flight``, with s f.

*The sign of the velocity.*  p(t) = s v(t) has p' = s F cos wt - f; with viscosity (``losses``) what
is said here of p holds for p = e^(mu t) s v(t), p' = e^(mu t) (s F cos wt - f).  Since f < F, p'
has simple zeros, and p its local minima at those with s sin wt < 0: at the times (2 pi k - theta)/w
for s = 1 and (2 pi k + pi - theta)/w for s = -1, where theta = arccos(f/F).  So s v > 0 on [a, b]
if it is so at a, at b, and at those of these times that lie in (a, b).  If mu = 0, the least speed
on [a, b] is the least of those at a, at b, and at the times max(a, min(t, b)) for all these times
t: such a time is one of a local minimum in [a, b], or it is a, or b.

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
from cap.checker.kernel.elementary import cos_sin
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


class Flight(NamedTuple):
    """A flight of direction s from the moment start, at rest there or not.

    ``arc`` determines x and v on it: both less their responses at the start, its time, and more
    with losses; ``minima`` are times of local minima of p, with all those after the start.
    """

    s: int
    arc: Sequence[Centred]
    start: Moment
    minima: list[Moment]
    at_rest: bool = False


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

    def _minima(self, ratio: Fraction, periods: int) -> dict[int, list[Moment]]:
        """Return the moments in [0, horizon] at which p has its local minima, for each sign s.

        The ratio is f/F.
        """
        half_turn, theta = pi(self.bits), arccos(self.number(ratio))
        times = [(half_turn * k - theta) / self.omega for k in range(1, 2 * periods + 1)]
        return {s: [self.at(t) for t in times[n::2]] for s, n in ((-1, 0), (1, 1))}

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

    def moment(self, t: Centred) -> Moment:
        """Return the moment at the time t."""
        pairs = [cos_sin_jet(jet * self.omega) for jet in (t.centre, t.box)]
        return Moment(t, *(self.centred(*jets) for jets in zip(*pairs, strict=True)))

    def at(self, t: Interval) -> Moment:
        """Return the moment of a time that is the same for all orbits."""
        return Moment(*map(self.constant, (t, *cos_sin(t * self.omega))))

    def course(self, s: int) -> tuple[Formula, Formula]:
        """Return the formulas of x and v on the flights of a direction.

        They take jets: the ``arc`` of a flight, and t, cos wt, sin wt.
        """

        f = self.f * s
        return (
            lambda arc, at: place(arc[0], arc[1], at[0] - arc[2], f / 2, at[1] * self.sway),
            lambda arc, at: velocity(arc[1], at[0] - arc[2], f, at[2] * self.swing),
        )

    # flights over the box

    def flight(self, s: int, start: Moment, x: Centred, v: Centred) -> Flight:
        """Return the flight of direction s that starts at a moment from (x, v)."""
        rest_x = lift(lambda x, cos: x + cos * self.sway, x, start.cos)
        rest_v = lift(lambda v, sin: v - sin * self.swing, v, start.sin)
        return Flight(s, (rest_x, rest_v, start.t), start, self.minima[s])

    def launch(self) -> Flight:
        """Return the first flight; the box must lie between the walls and away from v = 0."""
        x, v = self.variables[:2]
        need(self.is_between_walls(x.value), "the box is not certainly between the walls")
        need(not v.value.contains_zero(), "the velocity vanishes in the box")
        s = 1 if v.value.is_positive() else -1
        return self.flight(s, self.at(self.period.integer(0)), x, v)

    def is_between_walls(self, x: Interval) -> bool:
        """Return whether x certainly lies strictly between the walls."""
        return self.walls[-1].is_before(x) and x.is_before(self.walls[1])

    def value(self, flight: Flight, formula: Formula, at: Moment) -> Centred:
        """Return the value of a formula on a flight at a moment."""
        return lift(lambda *q: formula(q[:-3], q[-3:]), *flight.arc, *at)

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
        slow = [end] if flight.at_rest else [flight.start, end]
        a, b = flight.start.t.value, end.t.value
        for t in (minimum.t.value for minimum in flight.minima):
            if not (t.is_before(a) or b.is_before(t)):
                lo, hi = (max(p, min(q, r)) for p, q, r in ((a.lo, t.lo, b.lo), (a.hi, t.hi, b.hi)))
                slow.append(self.at(Interval(lo, hi, self.bits)))
        return least([self.speed(flight, moment).value for moment in slow])


def least(values: Sequence[Interval]) -> Interval:
    """Return an enclosure of the minimum of the numbers in the intervals."""
    return Interval(min(v.lo for v in values), min(v.hi for v in values), values[0].bits)
