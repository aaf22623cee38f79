"""The orbits of two masses for all second masses q between two, in cells: nobody stops on them.

In a cell [a, b] of masses there is one zero z(q) of the equations for each q, and z' = dz/dq is
enclosed.  A velocity s v(t_s) at a critical moment t_s of a flight from the event k has, along the
family, the derivative

    s (-a_k t_k' + (C v_k')_i + (dC/dq v_k)_i - [i = 2] (gain by the forces)/q)

with a_k the acceleration at its start.  If the velocity is w > 0 for q = a, it is at
least w + (q - a) min w' for q in the cell.

An event may pass a critical moment as q changes.  Then the velocity there is asked to be positive
on all flights, continued, in which the moment may be.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from cap.checker.theorems.particles_limits import MOST_NODES, MOST_WORK, work
from cap.errors import NotProved
from cap.maps import zero
from cap.maps.zero import Hint, Problem
from cap.particles import equations, flights
from cap.particles.family import Family
from cap.particles.model import Event, Model, events_of, legs_of
from cap.proofs.fixed_point import Setting
from cap.proofs.particle_orbit import problem_of, units_of
from cap.sets import interval
from cap.sets.interval import Ball

WIDTH, NARROWEST = Fraction(1, 620), Fraction(1, 20000)  # of cells, of the first mass
REACH_OF_CELLS = Fraction(2)  # half-width of the box, of the width of the cell: see `_box`
SPARE = Fraction(19, 20)  # part of this box that suffices, so that the checker can follow
WIDER = Fraction(3, 2)  # by so much a rate of the checker's may be wider
NODE = Fraction(1, 10**8)  # half-width of the box of a node

Rows = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class Solved:
    """The zero for one second mass: its hint and its events."""

    mass: Fraction
    hint: Hint
    model: Model
    events: list[Event]


@dataclass(frozen=True)
class Line:
    """The masses from ``above`` down to ``below``, with a preconditioner for their middle."""

    above: Solved
    below: Solved
    middle: Rows

    @classmethod
    def between(cls, setting: Setting, above: Solved, below: Solved) -> "Line":
        """Return the line; a zero near the middle is found with the preconditioner of an end."""
        m, contacts = above.model.masses[0], tuple(event.contact for event in above.events)
        mass = round((above.mass + below.mass) / 2, 8 - interval.decade(m))
        problem = problem_of(Model(setting.parameters, (m, mass)), contacts)
        pairs = zip(above.hint.centre, below.hint.centre, strict=True)
        guess, places = [(a + b) / 2 for a, b in pairs], places_of(setting, len(above.hint.centre))
        near = zero.refined(problem, guess, above.hint.matrix, places)
        return cls(above, below, tuple(map(tuple, zero.inverse_of(problem.slope(near.point)))))

    def preconditioner(self, mass: Fraction) -> Rows:
        """Return what is quadratic in the mass, and right at both ends and in the middle."""
        t = (self.above.mass - mass) / (self.above.mass - self.below.mass)
        weights = (1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)
        matrices = self.above.hint.matrix, self.middle, self.below.hint.matrix
        return tuple(
            tuple(
                sum((w * q for w, q in zip(weights, entries, strict=True)), Fraction(0))
                for entries in zip(*rows, strict=True)
            )
            for rows in zip(*matrices, strict=True)
        )


def family(setting: Setting, line: Line) -> list[Solved]:
    """Prove that there is one orbit for each mass of a line, all of one family; nobody stops.

    Returns the nodes between the cells.  Cells are halved until they succeed.
    """
    m, length = line.above.model.masses[0], line.above.mass - line.below.mass
    most = _most_nodes(setting, len(line.above.events))
    count, nodes = -(-length // (m * WIDTH)), [line.above]
    for k in range(1, count + 1):
        mass = round(line.above.mass - length * k / count, 8 - interval.decade(m))
        below = line.below if k == count else _node(setting, line, mass, nodes[-1])
        nodes += _divided(setting, line, (nodes[-1], below))
        setting.progress(f"{len(nodes) - 1} cells of masses, down to {float(below.mass):.6g}")
        if len(nodes) - 2 > most:
            sets = {"reached": interval.ball(below.mass), "to": interval.ball(line.below.mass)}
            why = f"more than {most} nodes of masses are needed, as many as the checker reads"
            raise NotProved("Lemma 3", why, sets)
    return nodes[1:-1]


def _most_nodes(setting: Setting, contacts: int) -> int:
    """Return the number of nodes for which the checker has the time."""
    one = work(setting.checker_bits, contacts, 1) - work(setting.checker_bits, contacts, 0)
    room = MOST_WORK - work(setting.checker_bits, contacts, 0)
    return max(0, min(MOST_NODES, room // one))


def _divided(setting: Setting, line: Line, ends: tuple[Solved, Solved]) -> Iterator[Solved]:
    """Give the lower ends of the cells between two zeros."""
    above, below = ends
    m, width = above.model.masses[0], above.mass - below.mass
    try:
        _cell(setting, line, ends)
    except NotProved:
        if width < m * NARROWEST:
            raise
    else:
        yield below
        return
    middle = round((above.mass + below.mass) / 2, 8 - interval.decade(m))
    node = _node(setting, line, middle, above)
    yield from _divided(setting, line, (above, node))
    yield from _divided(setting, line, (node, below))


def _node(setting: Setting, line: Line, mass: Fraction, near: Solved) -> Solved:
    """Prove that the equations have one zero within `NODE` of a hint, which has ten digits."""
    model = Model(setting.parameters, (near.model.masses[0], mass))
    contacts = tuple(event.contact for event in near.events)
    problem, units = problem_of(model, contacts), units_of(setting, len(near.hint.centre))
    places = places_of(setting, len(units))
    hint = zero.refined(problem, near.hint.centre, line.preconditioner(mass), places)
    box = problem.isolate(hint, [NODE * unit for unit in units])
    return Solved(mass, hint, model, events_of(model, contacts, box))


def places_of(setting: Setting, size: int) -> list[int]:
    """Return the decimals of the hints of nodes."""
    return [10 - interval.decade(unit) for unit in units_of(setting, size)]


def _cell(setting: Setting, line: Line, ends: tuple[Solved, Solved]) -> None:
    """Prove that for each mass between two there is one zero in a box around both their zeros,
    and that it is an orbit on which no mass stops.
    """
    above, below = ends
    p, m, contacts = setting.parameters, above.model.masses[0], [e.contact for e in above.events]
    middle, width = (above.mass + below.mass) / 2, above.mass - below.mass
    all_of_them = Family(p, m, (below.mass, above.mass))
    q = interval.hull(interval.ball(below.mass), interval.ball(above.mass))
    problem = Problem(
        partial(equations.value, Model(p, (m, middle)), contacts),
        partial(equations.slope, all_of_them, contacts),
        q - interval.ball(middle),
        lambda z: equations.by_second_mass(all_of_them, contacts, z, q),
    )
    pairs = list(zip(above.hint.centre, below.hint.centre, strict=True))
    hint = Hint(tuple((a + b) / 2 for a, b in pairs), line.preconditioner(middle))
    reach = [REACH_OF_CELLS * width / m * unit for unit in units_of(setting, len(pairs))]
    K = problem.isolate(hint, [SPARE * each for each in reach])
    for (a, b), each in zip(pairs, reach, strict=True):
        if not abs(a - b) / 2 + 2 * NODE * each / width * m < each:
            raise NotProved("Lemma 3", "the zeros at the ends of a cell may be others", {})
    events = events_of(all_of_them, contacts, K)
    flights.no_other_contacts(all_of_them, events)
    flights.signs_are_conserved(all_of_them, events)
    flights.speeds_at_events(all_of_them, events)
    _nobody_stops(all_of_them, events, below, problem.velocity(hint, K), (q, width))


def _nobody_stops(
    model: Family,
    events: list[Event],
    below: Solved,
    moving: Sequence[Ball],
    masses: tuple[Ball, Fraction],
) -> None:
    """Prove that all velocities at critical moments are positive, from those at the lower end."""
    q, width = masses
    legs = legs_of(below.model, below.events)
    for each in flights.possible_moments(model, events):
        end = each._replace(leg=legs[each.number])
        rate = _wider(_rate(each, moving, q))
        if not (end.speed > 0 and (rate > 0 or end.speed + rate * interval.ball(width) > 0)):
            sets = {"speed": end.speed, "its derivative": rate}
            raise NotProved("Lemma 3", "a mass may stop for some mass of a cell", sets)


def _wider(rate: Ball) -> Ball:
    """Return a ball around a rate that contains also what the checker may find."""
    spare = interval.ball(WIDER - 1) * interval.point(rate.rad())
    return Ball(rate + interval.symmetric(spare))


def _rate(slow: flights.Critical, moving: Sequence[Ball], q: Ball) -> Ball:
    """Return the derivative of a velocity at a slow moment along the family."""
    leg, i, model = slow.leg, slow.i, slow.leg.model
    n, start, o = model.n, leg.start, model.oscillators[i]
    first = 2 * n * slow.number
    changes = moving[first + n : first + 2 * n]  # of the velocities before the event
    rate = -leg.accelerations(start.at)[i] * moving[first]
    rate = rate + interval.total(
        c * v for c, v in zip(model.rules[start.contact][i], changes, strict=True)
    )
    if 0 < start.contact < n:
        m = interval.ball(model.masses[0])
        rate = rate - 2 * m * (start.before[0] - start.before[1]) / ((m + q) * (m + q))
    if i == 1:
        gain = o.velocity(leg.flights[i], slow.at) - start.after[i]
        rate = rate - gain / q
    return Ball(leg.signs[i] * rate)
