"""Two masses, the second one anywhere in an interval below the first: the same for all of them.

With q the second mass, al = 2 q/(m + q) = 2 - 2 m/(m + q), a collision is

    v_1 -> (1 - al) v_1 + al v_2,      v_2 -> (2 - al) v_1 + (al - 1) v_2,

so by q both change at the rate -al' (v_1 - v_2), al' = 2 m/(m + q)^2.  The second mass gets from
the forces, on a flight, what is proportional to 1/q: of A/q the derivative is -(A/q)/q.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.theorem import Parameters
from cap.checker.particles.existence import Ends, Moved, Row, arrivals, defects
from cap.checker.particles.mechanics import Contact, Mechanics, contacts


def with_second(p: Parameters, mass: Fraction) -> Parameters:
    """Return the parameters with this second mass."""
    return p._replace(masses=(p.masses[0], mass))


class Family(Mechanics):
    """All systems whose second mass lies in an interval."""

    def __init__(self, p: Parameters, second: Ends, bits: int) -> None:
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
        result, (m, q) = Row(), self.m
        rate = m * 2 / (m + q).square()
        for contact, end in zip(orbit, arrivals(orbit, self), strict=True):
            flight, d = self.flight(contact), end.at.t - contact.at.t
            push = self.number(0)
            if contact.word == "meet 1 2":
                push = -rate * (contact.v[0] - contact.v[1])
            way = self.place(1, flight, end.at) - flight.x[1] - flight.v[1] * d
            gain = self.velocity(1, flight, end.at) - flight.v[1]
            result += [push * d, push * d - way / q, push, push - gain / q]
        return result


def moved(p: Parameters, second: Ends, itinerary: Sequence[str], c: Row, bits: int) -> Moved:
    """Return G(c) for all second masses of an interval, in mean value form around its middle."""
    family, middle = Family(p, second, bits), (second[0] + second[1]) / 2
    at = Mechanics(with_second(p, middle), bits)
    by = family.m[1] - family.number(middle)
    G = defects(at, contacts(at, itinerary, c))
    return Moved(G, family.by_mass(contacts(family, itinerary, c)), by)
