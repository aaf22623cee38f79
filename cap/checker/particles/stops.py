"""Orbits of two masses that turn and stick: their events, equations, derivative, and what happens.

*Events* are contacts, and of each mass i

    turn i right (left)     v_i = 0, from the other sign, where F cos wt > f (< -f): it moves on
    stick i                 v_i = 0, where |F cos wt| < f: it rests
    release i right (left)  it has rested, and F cos wt increases through f (decreases through -f)

A mass rests from a stick on until it is released, or hit.

*The unknowns* of a contact are t, xi, v_1, v_2, those of another event of the mass i t, x_1, x_2
and the velocity of the other mass, just before.  v_i = 0 there.  G_k says as in ``existence`` that
the flight after the event k arrives at the event k + 1, with places and velocities that do not
change while a mass rests; if that event is the release of i, the equation 0 = 0 for v_i is
replaced by t_(k+1) = (theta + 2 pi n)/w, theta = -arccos(f/F) (right) or arccos(-f/F) (left).

*A derivative.*  At a turn dv_i is multiplied by a+/a-, the accelerations after and before; at a
stick it becomes 0, and stays 0 at the release, which is at a fixed time.  Places do not notice.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.existence import SIZE, Equations, Matrix, Row
from cap.checker.particles.mechanics import (
    NORMALS,
    Flight,
    Instant,
    Mechanics,
    Pair,
    Signs,
    sign,
)

SIDES = {"right": 1, "left": -1}
WORDS = (
    *NORMALS,
    *(f"{kind} {i} {side}" for kind in ("turn", "release") for i in "12" for side in SIDES),
    *(f"stick {i}" for i in "12"),
)
INVOLVED = {"hit l": (0,), "hit r": (1,), "meet 1 2": (0, 1)}


class Occurrence(NamedTuple):
    """An event: its word, when, places and velocities just before, and the signs of the flights."""

    word: str
    at: Instant
    x: Pair
    v: Pair
    before: Signs
    after: Signs

    @property
    def kind(self) -> str:
        """Return hit, meet, turn, stick or release."""
        return self.word.split()[0]

    @property
    def mass(self) -> int:
        """Return the mass that turns, sticks or is released."""
        return int(self.word.split()[1]) - 1

    @property
    def contact(self) -> bool:
        """Return whether something is hit."""
        return self.word in NORMALS


def involved(word: str) -> tuple[int, ...]:
    """Return the masses of which an event is one."""
    return INVOLVED.get(word) or (int(word.split()[1]) - 1,)


def resting(itinerary: Sequence[str]) -> list[tuple[bool, bool]]:
    """Return for the flight after each event whether each mass rests: its last event is a stick."""
    result = list[tuple[bool, bool]]()
    for k in range(len(itinerary)):
        cycle = [*itinerary[: k + 1][::-1], *itinerary[k + 1 :][::-1]]
        last = [next((w for w in cycle if i in involved(w)), "") for i in (0, 1)]
        result.append((last[0].startswith("stick"), last[1].startswith("stick")))
    return result


def events(M: Mechanics, itinerary: Sequence[str], data: Sequence[Interval]) -> list[Occurrence]:
    """Return the events with these unknowns; signs that are not those of words must be certain."""
    rests, found = resting(itinerary), list[Occurrence]()
    for k, word in enumerate(itinerary):
        t, *rest = data[SIZE * k : SIZE * k + SIZE]
        at = M.instant(t)
        if word in NORMALS:
            xi, *v = rest
            x = M.places(word, xi)
        else:
            x, v = (rest[0], rest[1]), [rest[2]]
            v.insert(involved(word)[0], M.number(0))
        found.append(Occurrence(word, at, x, (v[0], v[1]), (0, 0), (0, 0)))
    after = [signs(M, event, rests[k]) for k, event in enumerate(found)]
    return [e._replace(before=after[k - 1], after=after[k]) for k, e in enumerate(found)]


def signs(M: Mechanics, event: Occurrence, rests: tuple[bool, bool]) -> Signs:
    """Return the signs of the velocities after an event, 0 at rest."""
    moving = M.after(event.word, event.v) if event.contact else event.v
    turned = event.word.split()[-1] if event.kind in ("turn", "release") else ""

    def of(i: int) -> int:
        if rests[i]:
            return 0
        if turned and i == event.mass:
            return SIDES[turned]
        return sign(moving[i])

    return of(0), of(1)


def flight(M: Mechanics, event: Occurrence) -> Flight:
    """Return the flights after an event; a mass that rests has the velocity 0."""
    v = M.after(event.word, event.v) if event.contact else event.v
    u = [v[i] if event.after[i] else M.number(0) for i in (0, 1)]
    return Flight(event.after, event.at, event.x, (u[0], u[1]))


def place(M: Mechanics, i: int, g: Flight, at: Instant) -> Interval:
    """Return x_i."""
    return M.place(i, g, at) if g.signs[i] else g.x[i]


def velocity(M: Mechanics, i: int, g: Flight, at: Instant) -> Interval:
    """Return v_i."""
    return M.velocity(i, g, at) if g.signs[i] else M.number(0)


def pull(M: Mechanics, i: int, s: int, at: Instant) -> Interval:
    """Return v_i' of a mass that moves with the sign s, or rests."""
    return M.acceleration(i, s, at) if s else M.number(0)


def release_time(M: Mechanics, event: Occurrence) -> Interval:
    """Return the time of a release: of those possible the one that is within T/2."""
    right = event.word.endswith("right")
    theta = -M.theta[1] if right else M.theta[-1]
    turns = (event.at.t * M.omega - theta) / M.two_pi
    n = round((turns.lower + turns.upper) / 2)
    near = (turns - n).lies_inside(Fraction(-1, 2), Fraction(1, 2))
    need(near, "which release is meant is not certain")
    return (theta + M.two_pi * n) / M.omega


# the equations


def legs(
    M: Mechanics, orbit: Sequence[Occurrence], periods: int
) -> list[tuple[Occurrence, Occurrence]]:
    """Return each event with the next one, after the last the first, so many periods later."""
    first = orbit[0]
    again = first._replace(at=first.at._replace(t=first.at.t + M.period * periods))
    return list(zip(orbit, [*orbit[1:], again], strict=True))


def of_events(M: Mechanics, itinerary: Sequence[str], periods: int) -> Equations:
    """Return the equations of an itinerary."""

    def found(data: Sequence[Interval]) -> list[tuple[Occurrence, Occurrence]]:
        return legs(M, events(M, itinerary, data), periods)

    def value(data: Sequence[Interval]) -> list[Interval]:
        orbit = found(data)
        return [g for start, end in orbit for g in _defects(M, start, end)]

    return Equations(value, lambda data: [_slopes(M, *leg) for leg in found(data)])


def _defects(M: Mechanics, start: Occurrence, end: Occurrence) -> list[Interval]:
    """Return G_k."""
    g = flight(M, start)
    places = [place(M, i, g, end.at) - end.x[i] for i in (0, 1)]
    speeds = [velocity(M, i, g, end.at) - end.v[i] for i in (0, 1)]
    if end.kind == "release":
        speeds[end.mass] = end.at.t - release_time(M, end)
    return places + speeds


def _slopes(M: Mechanics, start: Occurrence, end: Occurrence) -> tuple[Matrix, Matrix]:
    """Return the derivatives of G_k in the unknowns of its event, and in those of its end."""
    g, d, one = flight(M, start), end.at.t - start.at.t, M.number(1)
    rows: list[list[Row]] = [[], [], [], []]  # places and speeds, in the start and in the end
    for i, s in enumerate(g.signs):
        begun, ended = pull(M, i, s, start.at), pull(M, i, s, end.at)
        moved, sped = _place_row(M, start, i), _speed_row(M, start, i)
        way = [-(g.v[i] + d * begun), M.number(0), M.number(0), M.number(0)]
        rows[0].append([a + b + d * c for a, b, c in zip(way, moved, sped, strict=True)])
        rows[1].append([-begun, *sped[1:]])
        arrived = [-c for c in _place_row(M, end, i)]
        rows[2].append([velocity(M, i, g, end.at), *arrived[1:]])
        rows[3].append([ended, *(-c for c in _unknown_speed(M, end, i)[1:])])
    if end.kind == "release":
        release_time(M, end)  # the same one in all of a box
        none = M.number(0)
        rows[1][end.mass] = [none] * SIZE
        rows[3][end.mass] = [one, none, none, none]
    return rows[0] + rows[1], rows[2] + rows[3]


def _unit(M: Mechanics, j: int | None) -> Row:
    """Return a row of an identity, or zeros."""
    return [M.number(int(k == j)) for k in range(SIZE)]


def _place_row(M: Mechanics, event: Occurrence, i: int) -> Row:
    """Return the derivative of x_i at an event in its unknowns."""
    if event.contact:
        fixed = (event.word, i) in (("hit l", 0), ("hit r", 1))
        return _unit(M, None if fixed else 1)
    return _unit(M, 1 + i)


def _unknown_speed(M: Mechanics, event: Occurrence, i: int) -> Row:
    """Return the derivative of v_i just before an event in its unknowns."""
    if event.contact:
        return _unit(M, 2 + i)
    return _unit(M, None if i == event.mass else 3)


def _speed_row(M: Mechanics, event: Occurrence, i: int) -> Row:
    """Return the derivative of the velocity of a mass after an event; 0 if it rests."""
    if not event.after[i]:
        return _unit(M, None)
    if not event.contact:
        return _unknown_speed(M, event, i)
    C = M.rule(event.word)[i]
    return [M.number(0), M.number(0), C[0], C[1]]
