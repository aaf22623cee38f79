"""The map from one contact of a system to the next, and its derivative.

The state of the system has two variables, and the clock occurs.  A guard h = c q + r of a mode, c a
number, r of the clock, names this mode as one in which the system goes on.  Just before a contact,
where h comes to zero, q = -r/c: a contact is given by its time t and the other variable p.

*g(t, p)* is (t', p') of the next contact, if there the same guard comes to zero, L h < 0, and until
then all guards of the mode have been positive.  Its time is taken modulo the period T of the clock:
g is a map of a cylinder.  This is cut open: the map is looked at for |t - m| < T/2, and is not
defined where t' is m + T/2 modulo T.  An orbit that stays where it is defined is one of the map of
the cylinder; so a compact invariant set of the one is one of the other, with the same entropy.

*Flights* are polynomial in time but for the response P to the clock (`system.legs`): with d = s - t

    z(s) = P(s) + sum of N_k y d^k,      y = (z - P, 1)(t) after the reset,      N_k = N^k/k!.

*First contact.*  The contacts are in a box.  Let T contain times; if Newton's operator s - h(s)/L
h(T) lies inside T, each flight has exactly one zero of h in T, and L h < 0 there.  After the reset
h = 0 by an identity of polynomials.  If L^2 h < 0 for all times, h is strictly concave: it is
positive between two zeros.  Else, and for the other guards of the mode, Lemma B of `system.quiet`
shows that they are positive, with pieces that are halved until all is decided.

*Derivative.*  At a fixed time s, z(s) has by p the derivative sum N_k y_p d^k, and by t the
derivative sum N_k y_t d^k - (the rate of the sum): y_p and y_t are those of y, and q = -r/c varies
with t.  If D is one of both at s = t', then dt' = -c Dq/L h, and dp' = Dp + (dp/ds) dt'.

*Times.*  For each of the sets a bound of t' - t is given; on a set, what may be longer is rejected.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from copy import copy
from fractions import Fraction
from typing import NamedTuple

from cap.checker.coverings.planar import Image, Planar
from cap.checker.coverings.sums import Sum
from cap.checker.kernel.doubles import GROWTH, PI, TINY, UNIT, Double, cos_sin, enclosing
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.legs import Leg, flights
from cap.checker.system.model import CLOCK, COS, SIN, Model
from cap.checker.system.model import PI as NUMBER
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.quiet import halved, vanishing, watched

BITS = 80  # of intervals of integers
PARTS, MOST, STEPS = 24, 2000, 6  # of a period; of a flight; of a search
SLACK, LEAST = 1.25, 2.0**-44  # of the interval T, around a guess
PIECES, MOST_PIECES = 1 << 12, 200  # of the flights from a set; of one flight, for each guard
FAR = 2.0**30
Row = list[tuple[int, Double]]  # columns that are not zero, with their entries


class Section:
    """A guard as above, and what it is where a motion comes to it."""

    def __init__(self, model: Model, mode: str, guard: str) -> None:
        need(len(model.state) == 2, "the state has not two variables")
        need(not model.autonomous, "the clock occurs nowhere")
        known = mode in model.modes and guard in model.modes[mode].guards
        need(known, f"there is no guard {guard} of a mode {mode}")
        self.model, self.mode, self.key = model, mode, guard
        given = model.modes[mode].guards[guard]
        need(mode in given.to, f"{guard} does not lead to the mode {mode}")
        names = sorted(given.value.variables - {*CLOCK, NUMBER})
        need(len(names) == 1, f"{guard} is not of one variable of the state")
        rate = given.value.derivative(names[0])
        need(rate.terms.keys() == {()}, f"{guard} is not of degree 1 in {names[0]}")
        self.zeros = vanishing(model, mode, guard, mode)
        need(self.zeros[guard] == 1, f"{guard} does not come to zero alone after the reset")
        self.q = names[0]
        self.p = next(z for z in model.state if z != self.q)
        self.c, self.rest = rate.number, given.value.without(names)
        self.place = self.rest * (-1 / self.c)
        here, free = {self.q: self.place}, given.reset.get(self.p, variable(self.p))
        jumps = self.p in given.reset
        self.over = given.divisor.substituted(here) if jumps else Polynomial.of(1)
        self.after = free.substituted(here)

    def by_time(self, q: Polynomial) -> Polynomial:
        """Return the derivative by the time on which the clock depends."""
        w, cos, sin = self.model.frequency, variable(COS), variable(SIN)
        return q.derivative(SIN) * cos * w - q.derivative(COS) * sin * w


class Flown(NamedTuple):
    """Flights: for q and p the sums N_k y by powers of d, and those with the derivatives of y.

    They end at times, after durations, with the speed L h.
    """

    sums: list[list[Double]]
    by_t: list[list[Double]]
    by_p: list[list[Double]]
    time: Double
    duration: Double
    speed: Double


class ContactMap(Planar):
    """g, for phases within half a period of m; ``times`` bound the flights from each of the sets.

    On one set no more than ``budget`` pieces of flights are looked at.
    """

    def __init__(
        self, section: Section, middle: Fraction, times: Sequence[Fraction], budget: int = PIECES
    ) -> None:
        self.section, self.model, state = section, section.model, section.model.state
        motion = flights(self.model, section.mode, BITS)
        exponential = motion.exponential
        need(exponential.is_polynomial, "the flights are not polynomial in time")
        self.order = [state.index(section.q), state.index(section.p)]
        rows = [exponential.polynomials(i, 0) for i in self.order]
        columns = [[row[j] for j in (*self.order, 2)] for row in rows]
        degree = max(len(c) for row in columns for c in row) - 1
        self.powers = [_by_power(row, degree) for row in columns]
        self.omega = double(motion.omega)
        self.period = PI * 2.0 / self.omega
        none = Double(0.0), Double(0.0)
        response = [(double(U), double(V)) for U, V in motion.response or ()] or [none, none]
        self.response = [response[i] for i in self.order]
        self.middle, self.times, self.left = enclosing(middle), times, budget
        self.longest = enclosing(max(times))
        self.count = min(MOST, math.ceil(float(max(times)) * PARTS / self.period.mid) + 2)
        self._write(section)

    def _write(self, section: Section) -> None:
        """Write the formulas, in p, the clock and pi."""
        names, rest = (section.p, COS, SIN, NUMBER), section.rest
        rate = section.by_time(rest)
        self.c = enclosing(section.c)
        self.rest, self.rest_rate = Sum(rest, names), Sum(rate, names)
        bend = Sum(section.by_time(rate), names).bound((0.0, 1.0, 1.0, PI.magnitude))
        U, V = self.response[0]
        swing = self.omega * self.omega * self.c * Double(0.0, U.magnitude + V.magnitude)
        self.bend = (swing.magnitude + bend) * (1 + 2.0**-40)
        self.seen = [(self.c.mid * U.mid, 1, 0), (self.c.mid * V.mid, 0, 1)]
        for m, k in rest.terms.items():
            number = float(k) * math.pi ** m.count(NUMBER)
            self.seen.append((number, m.count(COS), m.count(SIN)))
        self.seen = [term for term in self.seen if term[0]]
        self.place = [Sum(q, names) for q in (section.place, section.by_time(section.place))]
        self.new = [
            Sum(part, names)
            for q in (section.after, section.over)
            for part in (q, section.by_time(q), q.derivative(section.p))
        ]
        guards = watched(self.model, section.mode)
        self.own = guards[section.key]
        self.others = [
            (h, (section.zeros[key], 0)) for key, h in guards.items() if key != section.key
        ]

    def on(self, i: int) -> ContactMap:
        """Return the map on the i-th set."""
        found = copy(self)
        found.longest = enclosing(self.times[i])
        return found

    def image(self, x: Double, y: Double) -> Image:
        """Enclose g and Dg over a rectangle of (t, p); reject what may not be as above."""
        flown = self.flown(x, y)
        need((self.longest - flown.duration).lower >= 0, "a flight may last longer than claimed")
        d, cos_, sin_ = flown.duration, *cos_sin(flown.time * self.omega)
        (U, V), free = self.response[1], flown.sums[1]
        arrival = _horner(free, d) + U * cos_ + V * sin_
        speed = _slope(free, d) + self.omega * (V * cos_ - U * sin_)
        by = -self.c / flown.speed
        first = [_horner(c, d) - _slope(s, d) for c, s in zip(flown.by_t, flown.sums, strict=True)]
        second = [_horner(c, d) for c in flown.by_p]
        t_t, t_p = by * first[0], by * second[0]
        rows = (t_t, t_p), (first[1] + speed * t_t, second[1] + speed * t_p)
        return Image(self._reduced(flown.time), arrival, rows)

    def flown(self, t: Double, p: Double) -> Flown:
        """Return the flights from contacts at times t, with p, to the next ones."""
        self._within(t)
        cos, sin = cos_sin(t * self.omega)
        known = p, cos, sin, PI
        place, place_t = (value.at(known) for value in self.place)
        top, top_t, top_p, under, under_t, under_p = (value.at(known) for value in self.new)
        new = top / under
        new_t, new_p = (top_t - new * under_t) / under, (top_p - new * under_p) / under
        P = [U * cos + V * sin for U, V in self.response]
        rate = [self.omega * (V * cos - U * sin) for U, V in self.response]
        y, one, zero = (place - P[0], new - P[1]), Double(1.0), Double(0.0)
        by_t = place_t - rate[0], new_t - rate[1]
        sums = self._sums((*y, one))
        duration, speed = self._first(t, sums)
        at = t + duration
        self._quiet(t, (place, new), at, sums[0])
        columns = self._sums((*by_t, zero)), self._sums((zero, new_p, zero))
        return Flown(sums, *columns, at, duration, speed)

    def _sums(self, y: Sequence[Double]) -> list[list[Double]]:
        """Return the coefficients of the powers of d, for q and p."""
        return [[_dot(row, y) for row in rows] for rows in self.powers]

    def _first(self, t: Double, sums: Sequence[list[Double]]) -> tuple[Double, Double]:
        """Return how long after t the guard comes to zero near a guess, and L h then."""
        near = self._guess(t.mid, [a.mid for a in sums[0]])
        at = Double(near)
        h, speed = self._height(sums[0], t + at, at), self._speed(sums[0], t + at, at)
        need((-speed).is_positive(), "a guard may not be crossed")
        reach = h.magnitude / -speed.upper * SLACK + LEAST
        need(reach * (1 + 2.0**-40) < near, "a flight that may have no length")
        T = Double(near, reach)
        step = -h / self._speed(sums[0], t + T, T)
        need(step.magnitude < reach, "no certain contact")
        duration = at + step
        return duration, self._speed(sums[0], t + duration, duration)

    def _height(self, sums: Sequence[Double], s: Double, d: Double) -> Double:
        """Return h at the time s, d after the contact."""
        cos, sin = cos_sin(s * self.omega)
        U, V = self.response[0]
        q = _horner(sums, d) + U * cos + V * sin
        return self.c * q + self.rest.at((d, cos, sin, PI))

    def _speed(self, sums: Sequence[Double], s: Double, d: Double) -> Double:
        """Return L h at the time s, d after the contact."""
        cos, sin = cos_sin(s * self.omega)
        U, V = self.response[0]
        q = _slope(sums, d) + self.omega * (V * cos - U * sin)
        return self.c * q + self.rest_rate.at((d, cos, sin, PI))

    def _quiet(
        self, t: Double, state: tuple[Double, Double], end: Double, sums: Sequence[Double]
    ) -> None:
        """Prove that the guards are positive on flights, from a state after the contact."""
        watched = list(self.others)
        curve = self.c * sums[2] * 2.0 if len(sums) > 2 else Double(0.0)
        if not curve.upper + self.bend < 0:
            watched.append((self.own, (1, 1)))
        if watched:
            names = self.section.q, self.section.p
            start = dict(zip(names, map(interval, state), strict=True))
            leg = Leg(self.model, self.section.mode, interval(t), start)
            for guard, zeros in watched:
                most = min(self.left, MOST_PIECES)
                self.left -= halved(leg, guard, interval(end), zeros, most)

    def _guess(self, t: float, a: Sequence[float]) -> float:
        """Return a time after which the guard seems to come to zero; it needs no trust."""
        step, before = self.period.mid / PARTS, 0.0
        for k in range(1, self.count):
            h = self._seen(t, a, k * step)
            if not h > 0:
                need(k > 1, "a contact too soon after another one")
                low, high = (k - 1) * step, k * step
                d, last = low + step * before / (before - h), high
                for _ in range(STEPS):  # the secant method
                    here = self._seen(t, a, d)
                    if here == h or d == last:
                        break
                    d, last, h = d - here * (d - last) / (here - h), d, here
                return min(max(d, low), high)
            before = h
        raise Rejected("no contact is seen")

    def _seen(self, t: float, a: Sequence[float], d: float) -> float:
        """Return h, up to a positive factor, d after a contact at t."""
        angle = self.omega.mid * (t + d)
        c, s, q, total = math.cos(angle), math.sin(angle), 0.0, 0.0
        for x in reversed(a):
            q = q * d + x
        for number, i, j in self.seen:
            total += number * c**i * s**j
        return self.c.mid * q + total

    def _within(self, t: Double) -> None:
        """Reject phases that may not be within half a period of m."""
        half = self.period * 0.5
        near = t - self.middle
        inside = (half - near).is_positive() and (half + near).is_positive()
        need(inside, "a phase that may be at the cut")

    def _reduced(self, t: Double) -> Double:
        """Return a time modulo the period, within half a period of m."""
        turns = math.floor((t.mid - self.middle.mid) / self.period.mid + 0.5)
        phase = t - self.period * float(turns)
        self._within(phase)
        return phase


def _by_power(row: Sequence[Sequence[Interval]], degree: int) -> list[Row]:
    """Return for each power of d the coefficients in a row; they come with the highest first."""
    found = [Row() for _ in range(degree + 1)]
    for j, column in enumerate(row):
        for k, c in enumerate(reversed(column)):
            if c.lo or c.hi:
                found[k].append((j, double(c)))
    return found


def _dot(row: Row, y: Sequence[Double]) -> Double:
    """Return the sum of products."""
    total = Double(0.0)
    for k, a in row:
        total = total + (y[k] if a.mid == 1 and not a.rad else a * y[k])
    return total


def _horner(sums: Sequence[Double], d: Double) -> Double:
    """Return the sum of sums_k d^k."""
    total = sums[-1]
    for a in reversed(sums[:-1]):
        total = total * d + a
    return total


def _slope(sums: Sequence[Double], d: Double) -> Double:
    """Return its derivative."""
    last = len(sums) - 1
    total = sums[last] * float(last)
    for k in range(last - 1, 0, -1):
        total = total * d + sums[k] * float(k)
    return total


def interval(x: Double) -> Interval:
    """Return an interval of integers that contains the points."""
    need(abs(x.mid) + x.rad < FAR, "a state too far away")
    lower, upper = math.ldexp(x.lower, BITS), math.ldexp(x.upper, BITS)
    return Interval(math.floor(lower), math.ceil(upper), BITS)


def double(x: Interval) -> Double:
    """Return an interval of doubles that contains the points."""
    need(x.magnitude().hi < int(FAR) << BITS, "a number too large")
    mid = math.ldexp(float(x.lo + x.hi), -BITS - 1)
    rad = math.ldexp(float(x.hi - x.lo), -BITS - 1)
    return Double(mid, (rad + UNIT * abs(mid)) * GROWTH + TINY)
