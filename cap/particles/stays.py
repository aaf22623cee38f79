"""Verification of a periodic orbit of two masses that turn and stick; its derivative.

What `cap.particles.stopping` has found as a zero of equations is an orbit with these events and no
others, if on each flight the speed is positive but where the words say otherwise, the forcing does
at each stop what the word says, a rest is not ended by the forcing before its release, and gaps
close at collisions only.  All inequalities proved are strict, so orbits near it have these events,
too, and the map over nT is continuously differentiable there.
"""

from collections.abc import Sequence
from itertools import pairwise

from cap.errors import NotProved
from cap.flow.event import flies, slow_numbers
from cap.flow.model import Moment
from cap.particles.flights import BISECTIONS
from cap.particles.stopping import Equations, Happening, Stretch, certain_order
from cap.sets import interval
from cap.sets.interval import Ball

Rows = list[list[Ball]]


def verify(system: Equations, events: Sequence[Happening]) -> None:
    """Prove that a zero of the equations is an orbit with these events and no others."""
    certain_order(events, system.whole)
    stretches = system.stretches(events)
    for before, event in zip([stretches[-1], *stretches[:-1]], events, strict=True):
        _strictly_inside(system, event)
        _happens(system, before, event)
    for stretch in stretches:
        for i in (0, 1):
            if stretch.start.signs[i]:
                _moves(stretch, i)
            else:
                _rests(stretch)
        if stretch.start.signs in ((1, 1), (-1, -1)):
            _apart(stretch)


def _strictly_inside(system: Equations, event: Happening) -> None:
    o = system.model.first
    for k, (x, y) in enumerate(pairwise((o.l, *event.x, o.r))):
        if k != event.word.contact and not x < y:
            sets = {"time": event.at.t, "left": x, "right": y}
            raise NotProved("events", "two contacts may be simultaneous", sets)


def _happens(system: Equations, before: Stretch, event: Happening) -> None:
    """Prove that an event is what its word says."""
    word, o = event.word, system.model.first
    force = o.forcing(event.at)
    if word.contact >= 0:
        normal = system.model.normal(word.contact)
        holds = -(normal[0] * event.before[0] + normal[1] * event.before[1]) > 0
    elif word.kind == "release":
        holds = before.start.signs[word.mass] == 0
    else:
        s = before.start.signs[word.mass]
        slows = s != 0 and s * force < o.f
        if word.kind == "turn":
            holds = slows and word.side == -s and word.side * force > o.f
        else:
            holds = slows and abs(force) < o.f
    if not holds:
        raise NotProved("event", f"{word.word} is not certain", {"t": event.at.t, "force": force})


def _moves(stretch: Stretch, i: int) -> None:
    """Prove that a velocity keeps its sign between two events.

    From a stop it grows, and to a stop it falls (`_happens`), so there, too, its minima decide.
    """
    start, end, s = stretch.start, stretch.end, stretch.start.signs[i]
    begins, ends = start.word.mass != i, end.word.mass != i
    for moving, speed in ((begins, s * start.after[i]), (ends, s * end.before[i])):
        if moving and not speed > 0:
            raise NotProved("flight", "a mass may stop", {"t": start.at.t, "speed": speed})
    o, flight = stretch.model.oscillators[i], stretch.flights[i]
    released = start.word.number if not begins and start.word.kind == "release" else None
    if flight:
        flies(o, flight, (start.at.t, stretch.arrival.t), lambda q: q, released)


def _rests(stretch: Stretch) -> None:
    """Prove that the forcing stays below friction until the next event, or reaches it there."""
    o, (t, end) = stretch.model.first, (stretch.start.at.t, stretch.arrival.t)
    word, force = stretch.end.word, o.forcing(stretch.start.at)
    for s in (1, -1):
        for k in slow_numbers(o, s, t, end):
            slow = o.slow(s, k).t
            due = word.kind == "release" and word.side == s and slow.overlaps(end)
            if not (slow < t or slow > end or due):
                raise NotProved("rest", "the mass may be released", {"t": slow, "next": end})
    if not abs(force) < o.f:
        raise NotProved("rest", "the mass may not stay at rest", {"t": t, "force": force})


def _apart(stretch: Stretch) -> None:
    """Prove that two masses that go the same way do not meet between two events."""
    s = stretch.start.signs[0]
    moments = _bends(stretch, s)
    knots = [_gap(stretch, at) for at in (stretch.start.at, *moments, stretch.arrival)]
    for n, word in ((0, stretch.start.word), (-1, stretch.end.word)):
        if word.contact == 1:
            knots[n] = (knots[n][0], interval.ZERO, knots[n][2])
    for p, q in pairwise(knots):
        _positive(stretch, p, q)


Knot = tuple[Ball, Ball, Ball]


def _bends(stretch: Stretch, s: int) -> list[Moment[Ball]]:
    """Return the moments inside at which cos ωt = s f/F, in their order."""
    o, (start, end) = stretch.model.first, (stretch.start.at.t, stretch.arrival.t)
    slow = [o.slow(s, k) for k in slow_numbers(o, s, start, end)]
    mirrored = [o.slow(s, k) for k in slow_numbers(o, s, -end, -start)]
    moments = [*slow, *(Moment(-at.t, -at.sin, at.cos) for at in mirrored)]
    inside = [at for at in moments if not (at.t < start or at.t > end)]
    inside.sort(key=lambda at: interval.midpoint(at.t))
    for at in inside:
        if not start < at.t < end:
            raise NotProved("gap", "an event may be at an inflection", {"t": at.t})
    return inside


def _gap(stretch: Stretch, at: Moment[Ball]) -> Knot:
    x, v = stretch.reached(at)
    return at.t, x[1] - x[0], v[1] - v[0]


def _positive(stretch: Stretch, p: Knot, q: Knot) -> None:
    """Prove that a gap is positive where its slope is monotone: cf. `cap.particles.flights`."""
    for gap in (p[1], q[1]):
        if not (gap > 0 or gap == 0):
            raise NotProved("gap", "two masses may meet between events", {"gap": gap})
    for _ in range(BISECTIONS):
        a, b = -p[2], q[2]
        if a < 0 or b < 0:
            return
        if a > 0 and b > 0 and (b * p[1] + a * q[1] - a * b * (q[0] - p[0])) > 0:
            return
        middle = _gap(stretch, stretch.model.first.moment(interval.point((p[0] + q[0]) / 2)))
        if not middle[1] > 0:
            break
        p, q = (middle, q) if middle[2] < 0 else (p, middle)
    raise NotProved("gap", "two masses may meet between events", {"from": p[0], "to": q[0]})


def derivative(system: Equations, events: Sequence[Happening]) -> Rows:
    """Return the derivative of the map over nT at t = 0, order x_1, x_2, v_1, v_2.

    A deviation of an event by the time σ is put back to its nominal time: what moves on with v, and
    a before it, v' and a' after it, is off by (v - v')σ in place, and by (a - a')σ in velocity.
    """
    rows = [[interval.ball(i == j) for j in range(4)] for i in range(4)]
    stretches = system.stretches(events)
    _drift(rows, events[0].at.t)
    for before, stretch in zip([stretches[-1], *stretches[:-1]], stretches, strict=True):
        _event(system, before, stretch, rows)
        end = stretch.arrival.t if stretch is not stretches[-1] else system.whole
        _drift(rows, end - stretch.start.at.t)
    return rows


def _drift(rows: Rows, duration: Ball) -> None:
    for i in (0, 1):
        rows[i] = [x + duration * v for x, v in zip(rows[i], rows[2 + i], strict=True)]


def _pulls(system: Equations, stretch: Stretch, at: Moment[Ball]) -> list[Ball]:
    pairs = zip(system.model.oscillators, stretch.flights, strict=True)
    return [o.acceleration(g, at) if g else interval.ZERO for o, g in pairs]


def _event(system: Equations, before: Stretch, stretch: Stretch, rows: Rows) -> None:
    event = stretch.start
    word, model = event.word, system.model
    a, b = _pulls(system, before, event.at), _pulls(system, stretch, event.at)
    if word.contact < 0:
        i = 2 + word.mass
        if word.kind == "stick":
            rows[i] = [interval.ZERO] * 4
        elif word.kind == "turn":
            rows[i] = [q * b[word.mass] / a[word.mass] for q in rows[i]]
        return
    n, rule = model.normal(word.contact), model.rules[word.contact]
    rate = n[0] * event.before[0] + n[1] * event.before[1]
    sigma = [-(n[0] * x + n[1] * y) / rate for x, y in zip(rows[0], rows[1], strict=True)]
    hit = [[v + a[i] * t for v, t in zip(rows[2 + i], sigma, strict=True)] for i in (0, 1)]
    for i in (0, 1):
        jump = event.before[i] - (event.after[i] if stretch.flights[i] else interval.ZERO)
        rows[i] = [x + jump * t for x, t in zip(rows[i], sigma, strict=True)]
        moved = [rule[i][0] * p + rule[i][1] * q for p, q in zip(*hit, strict=True)]
        rows[2 + i] = [v - b[i] * t for v, t in zip(moved, sigma, strict=True)]
        if not stretch.flights[i]:
            rows[2 + i] = [interval.ZERO] * 4
