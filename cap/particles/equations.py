"""Periodic orbits of N masses as zeros of G, whose unknowns are the events of one period.

Of each event these are its time, the places, and the velocities just before it: 2N numbers.  The
flights from one event to the next, from the last to the first one a period later, give as many
equations: positions and velocities on arrival, less those of the next event.  A flight of duration
d from (t, x, v), with the acceleration a at its start, arrives with x and v whose derivatives are

    by t: -(v + a d), -a      by x: 1, 0      by v: d, 1      by the time of arrival: v', a'.

No flight is long, so nothing wraps as it does where a period is one map.
"""

from collections.abc import Sequence

from cap.particles.model import Leg, Model, events_of, legs_of
from cap.sets import interval
from cap.sets.interval import Ball

Rows = list[list[Ball]]


def value(model: Model, contacts: Sequence[int], z: Sequence[Ball]) -> list[Ball]:
    """Return an enclosure of G(z)."""
    result = list[Ball]()
    for leg in legs_of(model, events_of(model, contacts, z)):
        x, v = leg.reached()
        result += [a - b for a, b in zip(x, leg.end.x, strict=True)]
        result += [a - b for a, b in zip(v, leg.end.before, strict=True)]
    return result


def slope(model: Model, contacts: Sequence[int], z: Sequence[Ball]) -> Rows:
    """Return an enclosure of G'(z), by rows."""
    legs, size = legs_of(model, events_of(model, contacts, z)), 2 * model.n
    rows = [[interval.ZERO] * (size * len(legs)) for _ in range(size * len(legs))]
    for k, leg in enumerate(legs):
        following = (k + 1) % len(legs)
        for i, (left, right) in enumerate(zip(*_blocks(leg), strict=True)):
            row = rows[size * k + i]
            row[size * k : size * (k + 1)] = left
            row[size * following : size * (following + 1)] = right
    return rows


def _blocks(leg: Leg) -> tuple[Rows, Rows]:
    """Return the derivatives of the equations of a leg by the events at its start and its end."""
    return _by_start(leg), _by_end(leg)


def _by_start(leg: Leg) -> Rows:
    n, d, start = leg.model.n, leg.duration, leg.start
    a, rule = leg.accelerations(start.at), leg.model.rules[start.contact]
    place = leg.model.place_of(start.contact)
    positions = [
        [-(start.after[i] + a[i] * d), *_unit(place[i], n - 1, 1), *(d * c for c in rule[i])]
        for i in range(n)
    ]
    return positions + [[-a[i], *_unit(None, n - 1, 1), *rule[i]] for i in range(n)]


def _by_end(leg: Leg) -> Rows:
    n, a, (_, v) = leg.model.n, leg.accelerations(leg.arrival), leg.reached()
    place = leg.model.place_of(leg.end.contact)
    positions = [[v[i], *_unit(place[i], n - 1, -1), *_unit(None, n, -1)] for i in range(n)]
    return positions + [[a[i], *_unit(None, n - 1, -1), *_unit(i, n, -1)] for i in range(n)]


def _unit(index: int | None, size: int, entry: int) -> list[Ball]:
    """Return a row of zeros, with an entry at the index if there is one."""
    return [interval.ball(entry) if j == index else interval.ZERO for j in range(size)]


def by_second_mass(model: Model, contacts: Sequence[int], z: Sequence[Ball], q: Ball) -> list[Ball]:
    """Return an enclosure of the derivative of G by the second of two masses, for all of ``q``.

    Forces on the second mass are divided by q: so v' - v = A/q, and x' - x - v d = B/q, with the
    derivatives -A/q², -B/q².  A collision changes the velocities by C, with the derivative
    -2 m (v_1 - v_2)/(m + q)² of both.
    """
    result, m = list[Ball](), interval.ball(model.masses[0])
    for leg in legs_of(model, events_of(model, contacts, z)):
        start, d, o, flight = leg.start, leg.duration, leg.model.oscillators[1], leg.flights[1]
        push = interval.ZERO
        if 0 < start.contact < model.n:
            push = -2 * m * (start.before[0] - start.before[1]) / ((m + q) * (m + q))
        response = o.response_position(start.at), o.response_velocity(start.at)
        drag = o.drag(flight.s)
        gained = o.response_velocity(leg.arrival) - response[1] - drag * d
        moved = o.response_position(leg.arrival) - response[0] - (response[1] + drag * d / 2) * d
        result += [push * d, push * d - moved / q, push, push - gained / q]
    return result
