"""The map from one contact of a system to the next, and its derivative.

The state of the system has two variables, and the clock occurs.  A guard h = c q + r of a mode, c a
number, r of the clock, names this mode as one in which the system goes on.  Just before a contact,
where h comes to zero, q = -r/c: a contact is given by its time t and the other variable p.

*g(t, p)* is (t', p') of the next contact, if there the same guard comes to zero, L h < 0, and until
then all guards of the mode have been positive.  Its time is taken modulo the period T of the clock:
g is a map of a cylinder.  This is cut open: the map is looked at for |t - m| < T/2, and is not
defined where t' is m + T/2 modulo T.  An orbit that stays where it is defined is one of the map of
the cylinder; so a compact invariant set of the one is one of the other, with the same entropy.

*First contact.*  Let the contacts be in a box.  Over it the flights after the reset are known
(`system.legs`).  T contains the times near that of the midpoint; if Newton's operator s - h(s)/L
h(T) lies inside T, each of them has exactly one zero of h in T, and L h < 0 there.  After the reset
h = 0 by an identity of polynomials, and that h > 0 from there to the zero, and the other guards
are positive, is Lemma B of `system.quiet`, with pieces that are halved until all is decided.

*Derivative.*  Let D be the derivative of the state on arrival at a fixed time t' by t or p, where
dq/dt = -h_t/c before the contact.  Then dt' = -c Dq/L h, and dp' = Dp + (dp/dt') dt'.

*Times.*  For each of the sets a bound of t' - t is given; on a set, what may be longer is rejected.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from fractions import Fraction
from typing import NamedTuple

from cap.checker.coverings.planar import Image, Planar
from cap.checker.kernel.doubles import GROWTH, TINY, UNIT, Double
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.evaluation import Values
from cap.checker.system.legs import Flights, Leg
from cap.checker.system.model import CLOCK, COS, PI, SIN, Model
from cap.checker.system.passage import Contact, passage
from cap.checker.system.program import Program, Tape
from cap.checker.system.quiet import halved, vanishing, watched

BITS = 80
HALF, LEAST = 1 << BITS - 1, 1 << BITS - 60
STEPS = 3  # of Newton's method, in the middle
PIECES, MOST_PIECES = 1 << 12, 200  # of the flights from a set; of one flight, for each guard
PARTS, MOST = 32, 2000  # steps of a period; of a flight
FAR = 2.0**40


class Section:
    """A guard, as above."""

    def __init__(self, model: Model, mode: str, guard: str) -> None:
        need(len(model.state) == 2, "the state has not two variables")  # noqa: PLR2004
        need(not model.autonomous, "the clock occurs nowhere")
        known = mode in model.modes and guard in model.modes[mode].guards
        need(known, f"there is no guard {guard} of a mode {mode}")
        self.model, self.mode, self.key = model, mode, guard
        self.guard = model.modes[mode].guards[guard]
        need(mode in self.guard.to, f"{guard} does not lead to the mode {mode}")
        names = sorted(self.guard.value.variables - {*CLOCK, PI})
        need(len(names) == 1, f"{guard} is not of one variable of the state")
        self.q = model.state.index(names[0])
        rate = self.guard.value.derivative(names[0])
        need(rate.terms.keys() == {()}, f"{guard} is not of degree 1 in {names[0]}")
        self.c = rate.number
        self.place = (self.guard.value.without(names)) * (-1 / self.c)
        self.zeros = vanishing(model, mode, guard, mode)
        need(self.zeros[guard] == 1, f"{guard} does not come to zero alone after the reset")
        self.others = [key for key in model.modes[mode].guards if key != guard]

    @property
    def names(self) -> tuple[str, str]:
        """The variable that a contact's time gives, and the other one."""
        q = self.model.state[self.q]
        return q, self.model.state[1 - self.q]


class Flown(NamedTuple):
    """Flights: from contacts at times t, the state before them, to times T, and L h there."""

    t: Interval
    before: list[Interval]
    T: Interval
    rate: Interval


class ContactMap(Planar):
    """g, for phases within half a period of m; ``times`` bound the flights from each of the sets.

    On one set no more than ``budget`` pieces of flights are looked at.
    """

    def __init__(
        self, section: Section, middle: Fraction, times: Sequence[Fraction], budget: int = PIECES
    ) -> None:
        self.section, self.model = section, section.model
        self.passage = passage(self.model, Contact(section.mode, section.key, section.mode), BITS)
        self.flights = self.passage.flights
        guards = watched(self.model, section.mode)
        self.own = guards[section.key]
        self.others = [(guards[key], (section.zeros[key], 0)) for key in section.others]
        self.period = self.flights.pi * 2 / self.flights.omega
        self.middle = _number(middle)
        self.times, self.longest, self.left = times, _number(max(times)), budget
        self.contact = self._written()
        self.scout = Scout(section, self.flights, float(max(times)))

    def on(self, i: int) -> ContactMap:
        """Return the map on the i-th set."""
        found = copy(self)
        found.longest = _number(self.times[i])
        return found

    def _written(self) -> Program:
        """Return the formulas of q and of the state after the contact, in the clock and p."""
        tape, section = Tape(BITS), self.section
        cos, sin, p = tape.inputs(3)
        one, q, other = p.integer(1), *section.names
        known = {COS: cos, SIN: sin, PI: tape.constant(self.flights.pi), other: p}
        known[q] = place = Values(known, one).of(section.place)
        values, guard, after = Values(known, one), section.guard, dict(known)
        divisor = values.of(guard.divisor)
        for z, new in guard.reset.items():
            after[z] = values.of(new) / divisor
        return Program(tape.given, [place, *(after[z] for z in self.model.state)])

    def image(self, x: Double, y: Double) -> Image:
        """Enclose g and Dg over a rectangle of (t, p); reject what may not be as above."""
        q, free = self.section.q, 1 - self.section.q
        t, before, T, rate = self.flown(interval(x), interval(y))
        need((self.longest + t - T).lo >= 0, "a flight may last longer than is claimed")
        clocks = self.flights.clock(t), self.flights.clock(T)
        step = self.passage.step(clocks[0], before, clocks[1], T - t)
        place_t = -step.guard.by[0] / step.guard.by[1 + q]
        by = [arrival.derivatives(4) for arrival in step.arrival]
        columns = [[row[0] + row[1 + q] * place_t for row in by], [row[1 + free] for row in by]]
        minus = step.guard.by[1 + q] / -rate
        times = [minus * column[q] for column in columns]
        rows = times, [c[free] + by[free][3] * s for c, s in zip(columns, times, strict=True)]
        (a, b), (c, d) = (map(double, row) for row in rows)
        arrival = double(step.arrival[free].value)
        return Image(double(self._reduced(T)), arrival, ((a, b), (c, d)))

    def flown(self, t: Interval, p: Interval) -> Flown:
        """Return the flights from contacts to the next ones, of times t and with p."""
        self._within(t)
        place, *after = self.contact.run([*self.flights.clock(t), p])
        leg = Leg(self.model, self.section.mode, t, dict(zip(self.model.state, after, strict=True)))
        before = [place, p] if self.section.q == 0 else [p, place]
        return Flown(t, before, *self.first(leg))

    def first(self, leg: Leg) -> tuple[Interval, Interval]:
        """Return the times of the first contacts after the start of flights, and L h there."""
        at = self.scout.met(leg)
        for _ in range(STEPS):
            at = _middle(at - leg.over(self.own.h, at) / leg.over(self.own.rate, at))
        h, rate = leg.over(self.own.h, at), leg.over(self.own.rate, at)
        need((-rate).is_positive(), "a guard may not be crossed")
        reach = (h.magnitude() / -rate).hi * 5 // 4 + LEAST
        T = Interval(at.lo - reach, at.hi + reach, BITS)
        new = at - h / leg.over(self.own.rate, T)
        need(T.lo < new.lo and new.hi < T.hi, "no certain contact")
        need(leg.start.is_before(new), "a flight that may have no length")
        for guard, zeros in ((self.own, (1, 1)), *self.others):
            self.left -= halved(leg, guard, new, zeros, min(self.left, MOST_PIECES))
        return new, leg.over(self.own.rate, new)

    def _within(self, t: Interval) -> None:
        """Reject phases that may not be within half a period of m."""
        near = (t - self.middle).magnitude() * 2
        need(near.is_before(self.period), "a phase that may be at the cut")

    def _reduced(self, t: Interval) -> Interval:
        """Return a time modulo the period, within half a period of m."""
        turns = ((t - self.middle).midpoint() / self.period).midpoint() + Interval(HALF, HALF, BITS)
        phase = t - self.period * (turns.lo >> BITS)
        self._within(phase)
        return phase


class Scout:
    """Where a contact may be, in floats: needs no trust."""

    def __init__(self, section: Section, flights: Flights, longest: float) -> None:
        self.sign = 1 if section.c > 0 else -1
        self.omega, self.pi = _float(flights.omega), math.pi
        self.step = 2 * math.pi / self.omega / PARTS
        count = min(MOST, math.ceil(longest / self.step) + 2)
        exponential = flights.exponential
        times = (Interval.enclosing(s := Fraction(k * self.step), s, BITS) for k in range(count))
        self.rows = [[_float(x) for x in exponential.over(section.q, d)[0]] for d in times]
        self.response = [(_float(U), _float(V)) for U, V in flights.response or ()]
        U, V = self.response[section.q] if self.response else (0.0, 0.0)
        terms = section.place.terms.items()
        self.place = [(float(c), m.count(COS), m.count(SIN), m.count(PI)) for m, c in terms]
        self.U, self.V = U, V

    def met(self, leg: Leg) -> Interval:
        """Return a time after the start of a flight, at which the guard seems to be zero."""
        y, start = [_float(x) for x in leg.begin], _float(leg.start)
        before = 1.0
        for k, row in enumerate(self.rows[1:], start=1):
            h = self._height(y, row, start + k * self.step)
            if h <= 0:
                need(k > 1, "no contact is seen")
                at = Fraction(start + (k - h / (h - before)) * self.step)
                return Interval.enclosing(at, at, BITS)
            before = h
        need(found=False, why="no contact is seen")
        return leg.start

    def _height(self, y: list[float], row: list[float], t: float) -> float:
        """Return the guard, up to a factor."""
        c, s = math.cos(self.omega * t), math.sin(self.omega * t)
        q = sum(a * b for a, b in zip(y, row, strict=True)) + self.U * c + self.V * s
        place = sum(n * c**i * s**j * math.pi**k for n, i, j, k in self.place)
        return self.sign * (q - place)


def interval(x: Double) -> Interval:
    """Return an interval of integers that contains the points."""
    need(abs(x.mid) + x.rad < FAR, "a state too far away")
    lower, upper = math.ldexp(x.lower, BITS), math.ldexp(x.upper, BITS)
    return Interval(math.floor(lower), math.ceil(upper), BITS)


def double(x: Interval) -> Double:
    """Return an interval of doubles that contains the points."""
    need(x.magnitude().hi < FAR * FAR * (1 << BITS), "a number too large")
    mid = math.ldexp(float(x.lo + x.hi), -BITS - 1)
    rad = math.ldexp(float(x.hi - x.lo), -BITS - 1)
    return Double(mid, (rad + UNIT * abs(mid)) * GROWTH + TINY)


def _float(x: Interval) -> float:
    """Return a double near the middle."""
    return math.ldexp(float(x.lo + x.hi), -x.bits - 1)


def _number(q: Fraction) -> Interval:
    """Return an enclosure of a rational number."""
    return Interval.enclosing(q, q, BITS)


def _middle(x: Interval) -> Interval:
    return x.midpoint()
