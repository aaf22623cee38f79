"""Verification of a periodic orbit of N masses: nothing happens but its events, and nobody stops.

On a flight of sign s the speed s v of a mass has its minima at the ends and at the slow moments of
`cap.flow.model`; where it is positive, x is monotone, so the first and the last mass meet no wall
between the events.  Two neighbours meet only if their gap closes:

    signs (-, +), (+, -)    the gap grows, or shrinks, all the time: it is positive between its ends
    the same sign s         it has the second derivative (F cos ωt - s f)(1/m_right - 1/m_left),
                            whose sign changes only where cos ωt = s f/F

Between two of these moments, p and q = p + d, the slope of the gap g is monotone.  Let g(p) and
g(q) be at least 0.  If g'(p) > 0, then g > 0 on (p, q): it is increasing, or first increases and
then decreases to g(q).  The same if g'(q) < 0.  If g'(p) = -a < 0 < b = g'(q), then g is convex,
and above the point where its tangents at p and q meet, (b g(p) + a g(q) - a b d)/(a + b).  Where
this is not positive, the middle of [p, q] is tried as well.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from cap.errors import NotProved
from cap.flow.event import flies, slow_numbers
from cap.flow.model import Moment
from cap.particles.model import Event, Leg, Model, legs_of, sign
from cap.sets import interval
from cap.sets.interval import Ball

BISECTIONS = 40


class Knot(NamedTuple):
    """A gap at a time: its value and slope."""

    t: Ball
    value: Ball
    slope: Ball


def least_speeds(model: Model, events: Sequence[Event]) -> list[Ball]:
    """Prove that the orbit has these events and no others; return the least speed of each mass.

    ``events`` enclose a zero of the equations.  Raises `NotProved`.
    """
    no_other_contacts(model, events)
    return [_least(legs_of(model, events), i) for i in range(model.n)]


def no_other_contacts(model: Model, events: Sequence[Event]) -> None:
    """Prove that the contacts are these, if no mass stops between them.

    Verified are: 0 < t_1 < .. < t_K < T, positions that increase from wall to wall, but for the
    contact, and no contact between the events.
    """
    _in_order(model, events)
    for event in events:
        _apart(model, event)
    for number, leg in enumerate(legs_of(model, events), start=1):
        for i in range(model.n - 1):
            _stay_apart(leg, i, number)


class Critical(NamedTuple):
    """A moment with cos ωt = s f/F in the ``leg`` of this number, or continued; the mass i."""

    leg: Leg
    number: int
    i: int
    at: Moment[Ball]

    @property
    def speed(self) -> Ball:
        """Return s v there, of any sign."""
        o, s = self.leg.model.oscillators[self.i], self.leg.signs[self.i]
        return Ball(s * o.velocity(self.leg.flights[self.i], self.at))


def possible_moments(model: Model, events: Sequence[Event]) -> list[Critical]:
    """Return the critical moments that may be inside of flights: s v is monotone between them.

    One that an event passes, as the mass changes, is among those of the flights before and after.
    """
    return [
        Critical(leg, number, i, at)
        for number, leg in enumerate(legs_of(model, events))
        for i, s in enumerate(leg.signs)
        for at in list(_inflections(leg, s))[1:-1]
    ]


def critical_moments(model: Model, events: Sequence[Event]) -> list[Critical]:
    """Return the critical moments inside of flights.

    Raises `NotProved` if one may be at an event.
    """
    found = possible_moments(model, events)
    for leg, _, _, at in found:
        if not leg.start.at.t < at.t < leg.arrival.t:
            sets = {"critical": at.t, "flight from": leg.start.at.t, "to": leg.arrival.t}
            raise NotProved("flight", "a speed may be critical at an event", sets)
    return found


def speeds_at_events(model: Model, events: Sequence[Event]) -> None:
    """Prove that all velocities have the signs of their flights at the ends of these."""
    for leg in legs_of(model, events):
        for s, v in zip(leg.signs, leg.end.before, strict=True):
            if not s * v > 0:
                raise NotProved("flight", "a mass may stop", {"v at its end": v})


def closing_speed(model: Model, event: Event) -> Ball:
    """Return the rate at which the gap closes, proved positive."""
    normal = model.normal(event.contact)
    rate = -interval.total(k * v for k, v in zip(normal, event.before, strict=True))
    if not rate > 0:
        sets = {"time": event.at.t, "closing speed": rate}
        raise NotProved("contact", "an event may not be transverse", sets)
    return rate


def signs_are_conserved(model: Model, events: Sequence[Event]) -> None:
    """Prove that no collision changes the sum of the signs of the velocities.

    Then, as friction forces are equal, the period map preserves Σ m_i dv_i ∧ dx_i.
    """
    for event in events:
        if event.contact in (0, model.n):
            continue
        before, after = (sum(map(sign, v)) for v in (event.before, event.after))
        if before != after:
            sets = {"time": event.at.t, "before": event.before[0], "after": event.after[0]}
            raise NotProved("collision", "it changes the sum of the signs of velocities", sets)


def _in_order(model: Model, events: Sequence[Event]) -> None:
    times = [interval.ZERO, *(event.at.t for event in events), model.first.T]
    for t, following in pairwise(times):
        if not t < following:
            raise NotProved("events", "they may be out of order", {"t": t, "next": following})


def _apart(model: Model, event: Event) -> None:
    """Prove that the masses of an event are apart, but for the contact."""
    closing_speed(model, event)
    places = [model.first.l, *event.x, model.first.r]
    for k, (x, y) in enumerate(pairwise(places)):
        if k != event.contact and not x < y:
            sets = {"time": event.at.t, "left": x, "right": y}
            raise NotProved("events", "two contacts may be simultaneous", sets)


def _least(legs: Sequence[Leg], i: int) -> Ball:
    """Prove that a mass never stops; return its least speed."""
    least = None
    for leg in legs:
        s, o = leg.signs[i], leg.model.oscillators[i]
        ends = s * leg.start.after[i], s * leg.end.before[i]
        if not (ends[0] > 0 and ends[1] > 0):
            raise NotProved("flight", "a mass may stop", {"v": ends[0], "then": ends[1]})
        between = flies(o, leg.flights[i], (leg.start.at.t, leg.arrival.t), lambda q: q)
        for speed in (*ends, between):
            if speed is not None:
                least = speed if least is None else interval.least(least, speed)
    if least is None:
        raise NotProved("flight", "there is no flight", {})
    return least


def _stay_apart(leg: Leg, i: int, number: int) -> None:
    """Prove that the masses i and i + 1 do not meet between the events of a leg."""
    s, other = leg.signs[i : i + 2]
    if s != other:
        return
    knots = [_gap(leg, i, at) for at in _inflections(leg, s)]
    for p, q in pairwise(knots):
        if not p.t < q.t:
            why = "an event may be at an inflection of a gap: such orbits are not followed"
            raise NotProved("gap", why, {"t": p.t, "then": q.t})
        _positive(leg, i, (p, q), number)


def _inflections(leg: Leg, s: int) -> Iterator[Moment[Ball]]:
    """Give the moments of a leg at which cos ωt = s f/F, and its ends."""
    o, start, end = leg.model.first, leg.start.at, leg.arrival
    slow = [o.slow(s, k) for k in slow_numbers(o, s, start.t, end.t)]
    # at -t if t is slow: cos ωt = s f/F, and s sin ωt > 0
    fast = [o.slow(s, k) for k in slow_numbers(o, s, -end.t, -start.t)]
    moments = [*slow, *(Moment(-at.t, -at.sin, at.cos) for at in fast)]
    moments.sort(key=lambda at: interval.midpoint(at.t))
    yield start
    for at in moments:
        if not (at.t < start.t or at.t > end.t):
            yield at
    yield end


def _gap(leg: Leg, i: int, at: Moment[Ball]) -> Knot:
    """Return the gap between the masses i and i + 1, at an end of the leg as the event has it."""
    if at is leg.start.at:
        x, v = leg.start.x, leg.start.after
    elif at is leg.arrival:
        x, v = leg.end.x, leg.end.before
    else:
        pairs = list(zip(leg.model.oscillators, leg.flights, strict=True))
        x = tuple(o.position(g, at) for o, g in pairs)
        v = tuple(o.velocity(g, at) for o, g in pairs)
    value = x[i + 1] - x[i]
    event = leg.start if at is leg.start.at else leg.end if at is leg.arrival else None
    if event and event.contact == i + 1:
        value = interval.ZERO
    elif not value > 0:
        raise NotProved("gap", "two masses may meet between events", {"t": at.t, "gap": value})
    return Knot(at.t, value, v[i + 1] - v[i])


def _positive(leg: Leg, i: int, ends: tuple[Knot, Knot], number: int) -> None:
    """Prove that the gap is positive between two knots, between which its slope is monotone."""
    p, q = ends
    for _ in range(BISECTIONS):
        if p.slope > 0 or q.slope < 0:
            return
        if not (p.slope < 0 and q.slope > 0):
            break
        a, b = -p.slope, q.slope
        if (b * p.value + a * q.value - a * b * (q.t - p.t)) > 0:
            return
        middle = _gap(leg, i, leg.model.first.moment(interval.point((p.t + q.t) / 2)))
        p, q = (middle, q) if middle.slope < 0 else (p, middle)
    sets = {"from": p.t, "to": q.t, "slopes": p.slope, "and": q.slope}
    raise NotProved(f"flight {number}", f"masses {i + 1} and {i + 2} may meet", sets)
