"""Two masses, the second one anywhere in an interval below the first: the same for all of them.

With q the second mass, al = 2 q/(m + q) = 2 - 2 m/(m + q), a collision is

    v_1 -> (1 - al) v_1 + al v_2,      v_2 -> (2 - al) v_1 + (al - 1) v_2,

so by q both change at the rate -al' (v_1 - v_2), al' = 2 m/(m + q)^2.  The second mass gets from
the forces, on a flight, what is proportional to 1/q: of A/q the derivative is -(A/q)/q.

*The zeros* z(q) of G in a box move with q: 0 = G_z z' + G_q, so for any matrix C

    z' = -C G_q - R z',      R = C G_z - 1,      |z'| <= |C G_q| / (1 - |R|)     (largest entries).

*A velocity* v_i at a fixed time on the flight after a contact at t_k moves with them at the rate

    (C v')_i + (dC/dq v)_i - a_i(t_k) t_k' - (what the forces give to v_i, if i = 2)/q.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.existence import (
    SIZE,
    Ends,
    Moved,
    Row,
    arrivals,
    defects,
    dot,
    slopes,
    times,
)
from cap.checker.particles.mechanics import Contact, Mechanics, contacts
from cap.checker.particles.orbit import Moment
from cap.checker.system.masses import MassParameters


def with_second(p: MassParameters, mass: Fraction) -> MassParameters:
    """Return the parameters with this second mass."""
    return p._replace(masses=(p.masses[0], mass))


class Family(Mechanics):
    """All systems whose second mass lies in an interval."""

    def __init__(self, p: MassParameters, second: Ends, bits: int) -> None:
        lower, upper = second
        need(0 < lower <= upper < p.masses[0], "the second mass may not be below the first")
        super().__init__(with_second(p, upper), bits)
        m, q = self.m[0], Interval.enclosing(lower, upper, bits)
        self.m[1] = q
        self.swing[1] = self.F / self.omega / q
        self.drag[1] = self.f / q
        self.alpha = -(m * 2 / (m + q)) + 2

    def rule(self, word: str) -> list[list[Interval]]:
        """Return C."""
        if word != "meet 1 2":
            return super().rule(word)
        return [[-self.alpha + 1, self.alpha], [-self.alpha + 2, self.alpha - 1]]

    def by_mass(self, orbit: Sequence[Contact]) -> Row:
        """Return the derivative of G by the second mass."""
        result, q = Row(), self.m[1]
        for contact, end in zip(orbit, arrivals(orbit, self), strict=True):
            flight, d = self.flight(contact), end.at.t - contact.at.t
            push = self.push(contact)
            way = self.place(1, flight, end.at) - flight.x[1] - flight.v[1] * d
            gain = self.velocity(1, flight, end.at) - flight.v[1]
            result += [push * d, push * d - way / q, push, push - gain / q]
        return result

    def push(self, contact: Contact) -> Interval:
        """Return the derivative, by the second mass, of both velocities after a contact."""
        if contact.word != "meet 1 2":
            return self.number(0)
        m, q = self.m
        return -(m * 2 / (m + q).square()) * (contact.v[0] - contact.v[1])

    def rates(self, orbit: Sequence[Contact], preconditioner: Sequence[Sequence[Fraction]]) -> Row:
        """Return z' for all the zeros of the family that lie in the data of an orbit."""
        pairs = zip(orbit, arrivals(orbit, self), strict=True)
        parts, by_mass = [slopes(self, *pair) for pair in pairs], self.by_mass(orbit)
        forced, residuals, sizes = Row(), list[Row](), list[int]()
        for i, given in enumerate(preconditioner):
            row = [self.number(c) for c in given]
            residual = times(row, parts)
            residual[i] = residual[i] - 1
            residuals.append(residual)
            forced.append(-dot(row, by_mass))
            sizes.append(sum(r.magnitude().hi for r in residual))
        rest = self.number(1) - Interval(max(sizes), max(sizes), self.bits)
        need(rest.is_positive(), "the zeros of a family may not move smoothly")
        largest = max(f.magnitude().hi for f in forced)
        bound = (Interval(largest, largest, self.bits) / rest).hi
        result = [Interval(-bound, bound, self.bits)] * len(forced)
        for _ in range(2):
            pairs_of = zip(forced, residuals, strict=True)
            result = [f - dot(residual, result) for f, residual in pairs_of]
        return result

    def speed_rates(self, orbit: Sequence[Contact], z: Row, moments: Sequence[Moment]) -> Row:
        """Return the rates of s_i v_i at some moments of the flights, from z'."""
        result = Row()
        for k, i, at in moments:
            contact, (t, _, *v) = orbit[k], z[SIZE * k : SIZE * k + SIZE]
            flight = self.flight(contact)
            rate = dot(self.rule(contact.word)[i], v) + self.push(contact)
            rate = rate - self.acceleration(i, flight.signs[i], contact.at) * t
            if i == 1:
                rate = rate - (self.velocity(i, flight, at) - flight.v[i]) / self.m[1]
            result.append(rate * flight.signs[i])
        return result


def moved(p: MassParameters, second: Ends, itinerary: Sequence[str], c: Row, bits: int) -> Moved:
    """Return G(c) for all second masses of an interval, in mean value form around its middle."""
    family, middle = Family(p, second, bits), (second[0] + second[1]) / 2
    at = Mechanics(with_second(p, middle), bits)
    by = family.m[1] - family.number(middle)
    G = defects(at, contacts(at, itinerary, c))
    return Moved(G, family.by_mass(contacts(family, itinerary, c)), by)
