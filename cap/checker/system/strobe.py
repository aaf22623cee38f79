"""The map over a round, from a time s between two contacts, with its derivatives to some order.

Let s lie between the last contact of a round and the first one of the next.  Phi maps the state at
s, in the mode in which the round begins and ends, to that p periods later, after the K contacts.

*Flights.*  With y = (z - P, 1)(t_0) and d = t_1 - t_0 the state at t_1 is P(t_1) + exp(N d) y
(``legs``); for jets t_0, z, t_1 it is that with d = d_0 + h, h without constant term, where

    exp(N d) = exp(N d_0) (1 + N h + N^2 h^2/2 + ...).

*Contacts.*  The time t of a contact is a jet with h(z(t), t) = 0 for the guard h.  If t is right
below degree k, the terms of degree k of h(z(t), t) are those at the right t, which are 0, less L h
times those that t lacks: t - (the terms)/(L h) has them, where L h < 0 as for the return map
(``contacts``).  Times and states at the contacts of the orbit are known: they are the
constant terms.

*Area.*  If ``product_of_two`` is 1, it is the determinant of Phi' wherever motions have these
contacts: its formulas are identities for all states and times.  So Phi preserves dx^dy there, and
it is real analytic where L h < 0 at each contact.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, Power, RealJet, cos_sin_jet, raised
from cap.checker.kernel.rejection import need
from cap.checker.system.contacts import Equations
from cap.checker.system.evaluation import evaluate
from cap.checker.system.legs import Flights, Leg, flights
from cap.checker.system.model import CLOCK, PI
from cap.checker.system.passage import Step
from cap.checker.system.polynomial import Polynomial, variable


class Strobe:
    """Phi around the orbit whose contacts lie in a box; ``point`` encloses its state at s."""

    def __init__(
        self, equations: Equations, zero: Sequence[Interval], steps: Sequence[Step], s: Interval
    ) -> None:
        self.equations, self.zero, self.s = equations, zero, s
        self.model, self.n = equations.model, equations.n
        orbit, count = equations.orbit, len(equations.orbit.contacts)
        self.round = equations.period * orbit.periods
        before = equations.start(zero, count - 1) - self.round
        inside = before.is_before(s) and s.is_before(equations.start(zero, 0))
        need(inside, "the phase is not certainly between the last contact and the first one")
        last = orbit.contacts[-1].to
        after = dict(zip(self.model.state, steps[-1].after, strict=True))
        flight = Leg(self.model, last, before, after)
        self.point = [flight.over(variable(z), s) for z in self.model.state]

    def jet(self, order: int) -> list[RealJet]:
        """Return Phi(point + dz) as jets in dz."""
        origin: Power = (0,) * self.n
        one = self.s.integer(1)
        z = [
            Jet(order, {origin: x, power: one})
            for x, power in zip(self.point, raised(origin), strict=True)
        ]
        t, contacts = Jet(order, {origin: self.s}), self.equations.orbit.contacts
        for k, contact in enumerate(contacts):
            moves = flights(self.model, contact.mode, self.s.bits)
            t, z = self._contact(k, moves, t, z)
            z = self._after(k, t, z)
        end = Jet(order, {origin: self.s + self.round})
        return flown(flights(self.model, contacts[-1].to, self.s.bits), t, z, end)

    def _contact(
        self, k: int, moves: Flights, start: RealJet, z: Sequence[RealJet]
    ) -> tuple[RealJet, list[RealJet]]:
        """Return the time of a contact, and the state just before it."""
        contact, here = self.equations.orbit.contacts[k], self.equations.places(k)[0]
        guard = self.equations.orbit.guard(k).value
        known, state = self.zero[here], self.zero[here + 1 : here + self.n + 1]
        t = Jet(start.order, {start.origin: known})
        at = [Jet(0, {start.origin: q}) for q in state]
        lie = self.model.lie(contact.mode, guard)
        rate = self._value(lie, Jet(0, {start.origin: known}), at).constant
        for degree in range(1, start.order + 1):
            h = self._value(guard, t, flown(moves, start, z, t))
            t = t - part(h, degree) * (rate.integer(1) / rate)
        arrived = [part(q, 1, start.order) for q in flown(moves, start, z, t)]
        return t, [Jet(t.order, {t.origin: q}) + x for q, x in zip(state, arrived, strict=True)]

    def _after(self, k: int, t: RealJet, z: Sequence[RealJet]) -> list[RealJet]:
        """Return the state just after a contact."""
        known = dict(zip(self.model.state, z, strict=True))
        reset = self.equations.orbit.guard(k).reset
        new = {y: self._value(q, t, z) for y, q in reset.items()}
        return [new.get(y, known[y]) for y in self.model.state]

    def _value(self, q: Polynomial, t: RealJet, z: Sequence[RealJet]) -> RealJet:
        """Return a polynomial in the state and the clock."""
        clock = cos_sin_jet(t * self.equations.omega)
        pi = Jet(t.order, {t.origin: self.equations.pi})
        return evaluate(
            q, {**dict(zip((*self.model.state, *CLOCK), (*z, *clock), strict=True)), PI: pi}
        )


def flown(moves: Flights, start: RealJet, z: Sequence[RealJet], end: RealJet) -> list[RealJet]:
    """Return the state at a time, on the flight from a state at another one."""
    order, origin = start.order, start.origin

    def constant(x: Interval) -> RealJet:
        return Jet(order, {origin: x})

    clocks = [cos_sin_jet(t * moves.omega) for t in (start, end)]
    y, P = moves.begin(z, clocks[0], constant), moves.particular(*clocks[1], constant)
    d = end - start
    powers = [constant(d.constant.integer(1))]  # h^k
    for _ in range(order):
        powers.append(powers[-1] * part(d, 1, order))
    found = list[RealJet]()
    for i, total in enumerate(P):
        rates = moves.exponential.over(i, d.constant, order)
        for k, (power, row) in enumerate(zip(powers, rates, strict=True)):
            for x, entry in zip(y, row, strict=True):
                total = total + x * power * (entry / factorial(k))  # noqa: PLW2901
        found.append(total)
    return found


def part(jet: RealJet, least: int, most: int | None = None) -> RealJet:
    """Return the terms of degree ``least``, or of degrees from this one to ``most``."""
    degrees = range(least, (least if most is None else most) + 1)
    return Jet(jet.order, {p: c for p, c in jet.coefficients.items() if sum(p) in degrees})
