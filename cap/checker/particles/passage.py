"""What an orbit with turns and sticks must satisfy, and what it attracts.

*A flight of the sign s* may begin with the velocity 0, at a turn or a release, and end with it, at
a turn or a stick.  Between critical times |v| is monotone; so it is positive inside if it is where
it is not 0 at the ends, at all critical times inside, of which there is one if it is 0 at both
ends; and if it grows from 0: at a turn the force is beyond friction on that side, at a release it
becomes so, since F cos wt goes through s f.  It is transversal to 0 at the end: s v' < 0.

*A rest* lasts while |F cos wt| < f: so it does at its first time, and as long as cos wt does not
become f/F or -f/F: only at the end of a flight that ends with the release, on the side to which the
force then pulls.  At the time of a release a flight of the other mass may be critical, too.

*The gap* (cf. ``orbit``) is monotone if only one mass moves, or if the two have opposite signs.

*Attraction.*  Let D be the derivative of the map over a whole period at its fixed point P, in the
coordinates x/R, v/(R w).  If some power D^n has a maximum of the sums of the absolute values in a
row below 1, all eigenvalues of D are below 1 in size, and P attracts all points near it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.existence import Matrix
from cap.checker.particles.mechanics import NORMALS, Contact, Instant, Mechanics
from cap.checker.particles.monodromy import product, shear
from cap.checker.particles.orbit import approach, together
from cap.checker.particles.stops import Occurrence, flight, legs, pull, velocity


def follows(M: Mechanics, orbit: Sequence[Occurrence], periods: int) -> None:
    """Prove that the zero of the equations is an orbit with these events and no others."""
    times = [M.number(0), *(event.at.t for event in orbit), M.period * periods]
    ordered = all(s.is_before(t) for s, t in pairwise(times))
    need(ordered, "the events are not in order in (0, nT)")
    for event in orbit:
        placed(M, event)
        happens(M, event)
    for start, end in legs(M, orbit, periods):
        moves(M, start, end)


def placed(M: Mechanics, event: Occurrence) -> None:
    """Prove that no two masses, and no mass and a wall, are together but in a contact."""
    places = [M.walls[0], *event.x, M.walls[1]]
    closed = {"hit l": 0, "meet 1 2": 1, "hit r": 2}.get(event.word)
    pairs = enumerate(pairwise(places))
    apart = all(k == closed or x.is_before(y) for k, (x, y) in pairs)
    need(apart, "a mass may be at a wall, or at the other one, without a contact")


def happens(M: Mechanics, event: Occurrence) -> None:
    """Prove that an event is what its word says, and transversal."""
    force, f = M.F * event.at.cos, M.f
    if event.contact:
        need(closing(M, event).is_positive(), "a contact may not be approached")
        return
    i = event.mass
    if event.kind == "release":
        need(event.before[i] == 0, "a mass is released that does not rest")
        return
    s = event.before[i]
    need(s != 0, "a mass stops that rests")
    need((pull(M, i, s, event.at) * -s).is_positive(), "a stop may not be transversal")
    if event.kind == "turn":
        side = event.after[i]
        need(side == -s, "a mass turns to the side from which it does not come")
        need((force * side - f).is_positive(), "the force may not turn a mass")
    else:
        need((f - force.magnitude()).is_positive(), "the force may not let a mass stick")


def closing(M: Mechanics, event: Occurrence) -> Interval:
    """Return the speed at which a contact is approached."""
    return approach(M, Contact(event.word, event.at, event.x[0], event.v))


def critical(M: Mechanics, s: int, start: Occurrence, end: Occurrence) -> list[Instant]:
    """Return the critical times inside a flight; that of a release is at its end.

    A release right is where F cos wt increases through f, one left where it decreases through -f.
    """
    found, release = list[Instant](), {1: (None, "right"), -1: ("left", None)}[s]
    for k in range(-1, 2 * _MOST + 1):
        for angle, side in zip((M.theta[s], -M.theta[s] + M.two_pi), release, strict=True):
            t = (angle + M.two_pi * k) / M.omega
            if t.is_before(start.at.t) or end.at.t.is_before(t):
                continue
            if start.at.t.is_before(t) and t.is_before(end.at.t):
                found.append(M.instant(t))
                continue
            near = [e for e in (start, end) if not (e.at.t.is_before(t) or t.is_before(e.at.t))]
            its_own = all((e.kind, e.word.split()[-1]) == ("release", side) for e in near)
            need(its_own, "a velocity may be critical at an event")
    return found


_MOST = 16  # periods


def moves(M: Mechanics, start: Occurrence, end: Occurrence) -> None:
    """Prove that both masses go from an event to the next one as the equations say."""
    g = flight(M, start)
    for i, s in enumerate(g.signs):
        if s:
            keeps(M, i, start, end)
        else:
            need(not [*critical(M, 1, start, end), *critical(M, -1, start, end)], _MOVES)
            t = (start.at.t.hi + end.at.t.lo) >> 1
            middle = M.instant(Interval(t, t, M.bits))
            need((M.f - (M.F * middle.cos).magnitude()).is_positive(), _MOVES)
    if g.signs[0] and g.signs[0] == g.signs[1]:
        inside = critical(M, g.signs[0], start, end)
        met = start.word == "meet 1 2", end.word == "meet 1 2"
        together(M, g, [start.at, *inside, end.at], met)


_MOVES = "a mass may begin to move before its release"


def keeps(M: Mechanics, i: int, start: Occurrence, end: Occurrence) -> None:
    """Prove that the velocity of a mass keeps its sign inside a flight."""
    g = flight(M, start)
    s = g.signs[i]
    from_rest = not start.contact and start.mass == i
    to_rest = not end.contact and end.mass == i
    inside = [velocity(M, i, g, at) * s for at in critical(M, s, start, end)]
    ends = [v * s for v, zero in ((g.v[i], from_rest), (end.v[i], to_rest)) if not zero]
    need(bool(inside or ends), "a mass begins and ends a flight with the velocity 0")
    need(all(v.is_positive() for v in (*inside, *ends)), "a mass may stop where no event says so")


# the derivative


def derivative(M: Mechanics, orbit: Sequence[Occurrence], periods: int) -> Matrix:
    """Return D over the whole period, from t = 0."""
    D = shear(M, orbit[0].at.t)
    ends = [*(event.at.t for event in orbit[1:]), M.period * periods]
    for event, end in zip(orbit, ends, strict=True):
        D = product(shear(M, end - event.at.t), product(jump(M, event), D))
    return D


def jump(M: Mechanics, event: Occurrence) -> Matrix:
    """Return the derivative of an event."""
    zero, rows = M.number(0), shear(M, M.number(0))
    a, b = ([pull(M, i, s[i], event.at) for i in (0, 1)] for s in (event.before, event.after))
    if event.contact:
        C, n = M.rule(event.word), NORMALS[event.word]
        speed = event.v[0] * n[0] + event.v[1] * n[1]
        reflected = [row[0] * a[0] + row[1] * a[1] for row in C]
        K = [[(b[i] - reflected[i]) / speed * n[j] for j in (0, 1)] for i in (0, 1)]
        low = [k + row for k, row in zip(K, C, strict=True)]
        rests = [[zero] * 4 if not event.after[i] else low[i] for i in (0, 1)]
        return [[*row, zero, zero] for row in C] + rests
    i = event.mass
    if event.kind == "turn":
        rows[2 + i][2 + i] = b[i] / a[i]
    elif event.kind == "stick":
        rows[2 + i][2 + i] = zero
    return rows


def row_sums(M: Mechanics, D: Matrix, power: int) -> Interval:
    """Return an interval of which the upper end bounds the row sums of D^power, scaled."""
    speed = M.number(M.p.omega)
    scaled = [
        [D[i][j] * speed if i < 2 <= j else D[i][j] / speed if j < 2 <= i else D[i][j]
         for j in range(4)] for i in range(4)
    ]  # fmt: skip
    result = scaled
    for _ in range(power - 1):
        result = product(scaled, result)
    sums = [row[0].magnitude() + row[1].magnitude() + row[2].magnitude() + row[3].magnitude()
            for row in result]  # fmt: skip
    return Interval(max(q.lo for q in sums), max(q.hi for q in sums), M.bits)
