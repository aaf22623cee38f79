"""Two masses between two walls: flights, contacts, and what a contact does to velocities.

    m_i x_i'' = F cos wt - f s_i,   s_i = sgn x_i',   l <= x_1 <= x_2 <= r,      i = 1, 2.

*A flight* from the time a on which v_i = x_i' keeps the sign s_i, with p_i = F/(m_i w) and d = t -
a:

    v_i(t) = v_i(a) + p_i (sin wt - sin wa) - s_i f d/m_i
    x_i(t) = x_i(a) + (v_i(a) - p_i sin wa) d - (p_i/w) (cos wt - cos wa) - s_i f d^2/(2 m_i)

*A contact* has a normal n: (1, 0) if the first mass hits l, (0, 1) if the second one hits r, (1,
-1) if they meet.  An elastic one keeps the kinetic energy, reverses n.v, and acts along M^-1 n:

    v -> C v,      C = 1 - 2 M^-1 n n^T/(n^T M^-1 n),      M = diag(m_1, m_2).

*Critical times.*  v_i' = (F cos wt - s_i f)/m_i vanishes where wt = +-theta_s + 2 pi k, theta_s =
arccos(s_i f/F): between these times v_i is monotone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import place, velocity
from cap.checker.system.masses import MassParameters

NORMALS = {"hit l": (1, 0), "hit r": (0, 1), "meet 1 2": (1, -1)}
Pair = tuple[Interval, Interval]
Signs = tuple[int, int]


class Instant(NamedTuple):
    """A time, with the cosine and the sine of the angle wt."""

    t: Interval
    cos: Interval
    sin: Interval


class Contact(NamedTuple):
    """A contact: its word, when, the free coordinate there, and the velocities just before."""

    word: str
    at: Instant
    xi: Interval
    v: Pair


class Flight(NamedTuple):
    """A flight: the signs of the velocities, when it begins, and with what."""

    signs: Signs
    start: Instant
    x: Pair
    v: Pair


class Mechanics:
    """The system in intervals."""

    def __init__(self, p: MassParameters, bits: int) -> None:
        self.p, self.bits = p, bits
        self.F, self.omega, self.f = (self.number(q) for q in (p.F, p.omega, p.f))
        self.m = [self.number(m) for m in p.masses]
        self.swing = [self.number(p.F / (m * p.omega)) for m in p.masses]  # p_i
        self.drag = [self.number(p.f / m) for m in p.masses]
        self.walls = self.number(p.l), self.number(p.r)
        self.two_pi = pi(bits) * 2
        self.period = self.two_pi / self.omega
        self.theta = {s: arccos(self.number(s * p.f / p.F)) for s in (1, -1)}

    def number(self, q: Fraction | int) -> Interval:
        """Return an enclosure of a rational number."""
        return Interval.enclosing(q, q, self.bits)

    def instant(self, t: Interval) -> Instant:
        """Return a time with its cosine and sine."""
        return Instant(t, *cos_sin(t * self.omega))

    def later(self, instant: Instant) -> Instant:
        """Return the same one period later."""
        return instant._replace(t=instant.t + self.period)

    # flights

    def acceleration(self, i: int, s: int, at: Instant) -> Interval:
        """Return v_i' where the sign of v_i is s."""
        return (self.F * at.cos - self.f * s) / self.m[i]

    def velocity(self, i: int, flight: Flight, at: Instant) -> Interval:
        """Return v_i on a flight."""
        p, d, f = self.swing[i], at.t - flight.start.t, self.drag[i] * flight.signs[i]
        return velocity(flight.v[i] - flight.start.sin * p, d, f, at.sin * p)

    def place(self, i: int, flight: Flight, at: Instant) -> Interval:
        """Return x_i on a flight."""
        (t, cos, sin), p, f = flight.start, self.swing[i], self.drag[i] * flight.signs[i]
        c = p / self.omega
        return place(flight.x[i] + cos * c, flight.v[i] - sin * p, at.t - t, f / 2, at.cos * c)

    def may_be_critical(self, s: int, start: Interval, end: Interval) -> Iterator[Instant]:
        """Give the critical times that may be between two times of [0, 2T], in their order."""
        theta = self.theta[s]
        for k in (0, 1):
            for angle in (theta, -theta + self.two_pi):
                t = (angle + self.two_pi * k) / self.omega
                if not (t.is_before(start) or end.is_before(t)):
                    yield self.instant(t)

    def critical(self, s: int, start: Interval, end: Interval) -> Iterator[Instant]:
        """Give the critical times between two times; one that may be at an end rejects."""
        for at in self.may_be_critical(s, start, end):
            inside = start.is_before(at.t) and at.t.is_before(end)
            need(inside, "a velocity may be critical at a contact")
            yield at

    # contacts

    def places(self, word: str, xi: Interval) -> Pair:
        """Return where the masses are at a contact."""
        l, r = self.walls
        return {"hit l": (l, xi), "hit r": (xi, r), "meet 1 2": (xi, xi)}[word]

    def rule(self, word: str) -> list[list[Interval]]:
        """Return C."""
        n, light = NORMALS[word], [1 / m for m in self.p.masses]
        norm = sum(n[i] ** 2 * light[i] for i in range(2))
        rows = [[int(i == j) - 2 * light[i] * n[i] * n[j] / norm for j in (0, 1)] for i in (0, 1)]
        return [[self.number(entry) for entry in row] for row in rows]

    def after(self, word: str, v: Pair) -> Pair:
        """Return the velocities after a contact."""
        (a, b), (c, d) = self.rule(word)
        return a * v[0] + b * v[1], c * v[0] + d * v[1]

    def closing(self, contact: Contact) -> Interval:
        """Return the speed n.v with which a contact is approached, or its opposite at l."""
        n = NORMALS[contact.word]
        return contact.v[0] * n[0] + contact.v[1] * n[1]

    def flight(self, contact: Contact) -> Flight:
        """Return the flight after a contact; the signs of its velocities must be certain."""
        v = self.after(contact.word, contact.v)
        x = self.places(contact.word, contact.xi)
        return Flight((sign(v[0]), sign(v[1])), contact.at, x, v)


def sign(v: Interval) -> int:
    """Return the sign of a velocity; it must be certain."""
    need(
        v.is_positive() or (-v).is_positive(), "the sign of a velocity at a contact is not certain"
    )
    return 1 if v.is_positive() else -1


def contacts(M: Mechanics, itinerary: Sequence[str], data: Sequence[Interval]) -> list[Contact]:
    """Return the contacts with these times, free coordinates and velocities, four for each."""
    result = list[Contact]()
    for k, word in enumerate(itinerary):
        t, xi, v1, v2 = data[4 * k : 4 * k + 4]
        result.append(Contact(word, M.instant(t), xi, (v1, v2)))
    return result
