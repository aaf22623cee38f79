"""What an orbit given by its contacts must satisfy: nobody stops, and nothing else happens.

*Nobody stops.*  On a flight v_i is monotone between critical times: |v_i| is least at an end, or at
one of these times.  Among the orbits of a family a contact may pass a critical time t of mass i,
which then lies in one flight before, in the next one after.  If the velocity is not 0 at t on both,
continued, nor at their ends, the mass stops on none of these orbits: what counts is among these.

*Walls.*  Where v_i does not change its sign, x_i lies between its values at the ends of the flight.
So if at each contact the mass that is not at a wall, or both that meet, lie strictly between the
walls, no wall is touched inside a flight.  (x_1 < x_2 keeps the others away.)

*The gap* g = x_2 - x_1.  For the signs (-1, 1) it increases, for (1, -1) it decreases; so inside
the flight it is larger than at one of the ends.  For equal signs s

    g'' = (1/m_2 - 1/m_1) (F cos wt - s f)

changes its sign at critical times only.  On a piece [a, b] between them, with g >= 0 at the ends:

- where g is concave, and not zero at both ends, or strictly concave, g > 0 inside;
- where g is convex, g' increases: g > 0 inside if g'(a) > 0 or g'(b) < 0, since then g is
  monotone; else if the larger one of its two tangents from the ends is positive, that is

      g(a) g'(b) - g(b) g'(a) + g'(a) g'(b) (b - a) > 0;

  if this fails, a piece is halved, some times.

*A collision* is transversal if v_1 > v_2 just before, and keeps the symplectic form if s_1 + s_2 is
the same before and after (`monodromy`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.existence import arrivals
from cap.checker.particles.mechanics import Contact, Flight, Instant, Mechanics, sign

Critical = Callable[[int, Interval, Interval], Iterable[Instant]]
_HALVINGS = 16
_MEET = "the masses may meet inside a flight"


class Moment(NamedTuple):
    """A time in the flight after the contact k, critical for the mass i."""

    k: int
    i: int
    at: Instant


def moments(M: Mechanics, orbit: Sequence[Contact], critical: Critical) -> list[Moment]:
    """Return the critical times of all flights that M.critical, or M.may_be_critical, gives."""
    return [
        Moment(k, i, at)
        for k, (contact, end) in enumerate(zip(orbit, arrivals(orbit, M), strict=True))
        for i, s in enumerate(M.flight(contact).signs)
        for at in critical(s, contact.at.t, end.at.t)
    ]


def speeds(M: Mechanics, orbit: Sequence[Contact], moments: Sequence[Moment]) -> list[Interval]:
    """Return s_i v_i at some moments of the flights, or of the flights continued."""
    flights = [M.flight(contact) for contact in orbit]
    return [M.velocity(i, flights[k], at) * flights[k].signs[i] for k, i, at in moments]


def least_speeds(M: Mechanics, orbit: Sequence[Contact]) -> list[Interval]:
    """Return the least |v_1| and |v_2| of an orbit, after having proved all that is above."""
    in_order(M, orbit)
    slowest: list[list[Interval]] = [[], []]
    for contact, end in zip(orbit, arrivals(orbit, M), strict=True):
        flight = M.flight(contact)
        admissible(M, contact, flight)
        for i, s in enumerate(flight.signs):
            inside = M.critical(s, contact.at.t, end.at.t)
            values = [flight.v[i], *(M.velocity(i, flight, at) for at in inside), end.v[i]]
            speeds = [v * s for v in values]
            need(all(v.is_positive() for v in speeds), "a mass may stop")
            slowest[i] += speeds
        apart(M, contact, end)
    return [least(speeds) for speeds in slowest]


def in_order(M: Mechanics, orbit: Sequence[Contact]) -> None:
    """Prove that the contacts follow each other in (0, T), strictly between the walls."""
    times = [M.number(0), *(contact.at.t for contact in orbit), M.period]
    need(all(s.is_before(t) for s, t in pairwise(times)), "the contacts are not in order in (0, T)")
    l, r = M.walls
    inside = all(l.is_before(contact.xi) and contact.xi.is_before(r) for contact in orbit)
    need(inside, "a mass may be at a wall while the other one has a contact")


def admissible(M: Mechanics, contact: Contact, after: Flight) -> None:
    """Prove that a contact is transversal, and that a collision keeps s_1 + s_2."""
    need(approach(M, contact).is_positive(), "a contact may not be approached")
    kept = sign(contact.v[0]) + sign(contact.v[1]) == sum(after.signs)
    need(kept or contact.word != "meet 1 2", "a collision does not keep s_1 + s_2")


def approach(M: Mechanics, contact: Contact) -> Interval:
    """Return |v_1| at l, |v_2| at r, v_1 - v_2 at a collision, just before."""
    closing = M.closing(contact)
    return -closing if contact.word == "hit l" else closing


def least(values: Sequence[Interval]) -> Interval:
    """Return an enclosure of the least of some numbers."""
    return Interval(min(v.lo for v in values), min(v.hi for v in values), values[0].bits)


# the gap


class Knot(NamedTuple):
    """A time, the gap and its derivative there; the gap is exactly zero where the masses meet."""

    at: Instant
    gap: Interval
    slope: Interval


def apart(M: Mechanics, contact: Contact, end: Contact) -> None:
    """Prove that the masses do not meet inside the flight from a contact to the next one."""
    flight = M.flight(contact)
    s, other = flight.signs
    if s == other:
        inside = M.critical(s, contact.at.t, end.at.t)
        met = contact.word == "meet 1 2", end.word == "meet 1 2"
        together(M, flight, [contact.at, *inside, end.at], met)


def together(
    M: Mechanics, flight: Flight, times: Sequence[Instant], met: tuple[bool, bool]
) -> None:
    """Prove the same for a flight in one direction, from its ends and the critical times inside.

    ``met``: whether the masses meet at its ends.
    """
    s, knots = flight.signs[0], [knot(M, flight, at) for at in times]
    for n in (0, -1):
        if met[n]:
            knots[n] = knots[n]._replace(gap=M.number(0))
    touching = [k for k in knots if not k.gap.is_positive()]
    ends = (knots[0], knots[-1])
    need(all(k in ends and k.gap.lo == k.gap.hi == 0 for k in touching), _MEET)
    for a, b in pairwise(knots):
        bend = bent(M, s, between(M, a, b))
        if bend > 0:
            convex(M, flight, (a, b), _HALVINGS)
        else:
            need(bend < 0 or a.gap.is_positive() or b.gap.is_positive(), _MEET)


def knot(M: Mechanics, flight: Flight, at: Instant) -> Knot:
    """Return the gap and its derivative at a time."""
    (x, y), (v, u) = ([of(i, flight, at) for i in (0, 1)] for of in (M.place, M.velocity))
    return Knot(at, y - x, u - v)


def between(M: Mechanics, a: Knot, b: Knot) -> Instant:
    """Return a time between two knots."""
    middle = (a.at.t.hi + b.at.t.lo) >> 1
    return M.instant(Interval(middle, middle, M.bits))


def bent(M: Mechanics, s: int, at: Instant) -> int:
    """Return the sign of g'' at a time where the velocities have the sign s."""
    lighter, force = 1 / M.p.masses[1] - 1 / M.p.masses[0], M.F * at.cos - M.f * s
    need(not force.contains_zero(), "the bend of a gap is not certain")
    return ((lighter > 0) - (lighter < 0)) * (1 if force.is_positive() else -1)


def convex(M: Mechanics, flight: Flight, piece: tuple[Knot, Knot], halvings: int) -> None:
    """Prove that the gap is positive inside a piece on which it is convex."""
    a, b = piece
    monotone = a.slope.is_positive() or (-b.slope).is_positive()
    tangents = a.gap * b.slope - b.gap * a.slope + a.slope * b.slope * (b.at.t - a.at.t)
    if not (monotone or tangents.is_positive()):
        need(halvings > 0, _MEET)
        middle = knot(M, flight, between(M, a, b))
        need(middle.gap.is_positive(), _MEET)
        for part in ((a, middle), (middle, b)):
            convex(M, flight, part, halvings - 1)
