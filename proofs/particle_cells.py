"""The orbits of two masses for all second masses q between two, in cells: nobody stops on them.

In a cell [a, b] of masses there is one zero z(q) of the equations for each q, and z' = dz/dq is
enclosed.  A velocity at a moment t_s is a function of the last contact's time and state, and of q:
its derivative along the family is that by these, which `cap.orbits.leg` has, times z', and that by
q.  If s v = w > 0 for q = a at a moment at which s v may be smallest, it is at least w + (q - a)
min (s v)' for q in the cell.

A contact may pass such a moment as q changes.  Then the velocity there is asked to be positive on
all flights, continued, in which the moment may be.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from cap.checker.theorems.particles_limits import MOST_NODES, MOST_WORK, work
from cap.errors import NotProved
from cap.maps import zero
from cap.maps.zero import Box, Hint, Problem
from cap.orbits.along import Along, Leg
from cap.orbits.equations import Equations
from cap.orbits.free import Free
from cap.orbits.numbers import Clock
from cap.orbits.periodic import Prover
from cap.particles import contacts
from cap.particles.family import rates, values
from cap.particles.guess import Guess
from cap.particles.itinerary import itinerary, unknowns
from cap.proofs.fixed_point import Setting
from cap.proofs.particle_orbit import units_of
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system import masses as models

WIDTH, NARROWEST = Fraction(1, 620), Fraction(1, 20000)  # of cells, of the first mass
REACH_OF_CELLS = Fraction(2)  # half-width of the box, of the width of the cell: see `_box`
SPARE = Fraction(19, 20)  # part of this box that suffices, so that the checker can follow
WIDER = Fraction(3, 2)  # by so much a rate of the checker's may be wider
NODE = Fraction(1, 10**8)  # half-width of the box of a node

Rows = tuple[tuple[Fraction, ...], ...]


@dataclass(frozen=True)
class Masses:
    """The masses m and q for all q, and the equations of an itinerary."""

    setting: Setting
    m: Fraction
    free: Free

    @classmethod
    def of(cls, setting: Setting, guess: Guess) -> "Masses":
        """Return those with the first mass and the itinerary of a guess."""
        contacts.never_rest(guess)
        p, m = setting.parameters, guess.masses[0]
        one = itinerary(models.masses(p, guess.masses), guess)
        equations = Equations(replace(one, system=models.second_mass(p, m)))
        return cls(setting, m, Free(equations, unknowns(guess)))

    @property
    def units(self) -> list[Fraction]:
        """The units of the unknowns."""
        return units_of(self.setting, self.free)

    def prover(self, q: Ball) -> Prover:
        """Return what proves orbits for all q of a set."""
        return Prover(self.free.equations, values=values(self.m, q))

    def problem(self, q: Fraction) -> Problem:
        """Return the equations for one q."""
        return self.free.problem(self.prover(interval.ball(q)).balls)

    def solved(self, q: Fraction, hint: Hint, box: Box) -> "Solved":
        """Return the zero for one q, the free unknowns of which lie in a box."""
        return Solved(q, hint, self.prover(interval.ball(q)), tuple(self.free.whole(box)))


@dataclass(frozen=True)
class Solved:
    """The zero for one second mass: its hint, and the times and states before contacts."""

    mass: Fraction
    hint: Hint
    prover: Prover
    box: Box

    @cached_property
    def legs(self) -> list[Leg]:
        """The legs between the contacts."""
        return self.prover.legs(self.box)


@dataclass(frozen=True)
class Line:
    """The masses from ``above`` down to ``below``, with a preconditioner for their middle."""

    masses: Masses
    above: Solved
    below: Solved
    middle: Rows

    @classmethod
    def between(cls, masses: Masses, above: Solved, below: Solved) -> "Line":
        """Return the line; a zero near the middle is found with the preconditioner of an end."""
        mass = round((above.mass + below.mass) / 2, 8 - interval.decade(masses.m))
        problem = masses.problem(mass)
        pairs = zip(above.hint.centre, below.hint.centre, strict=True)
        guess, places = [(a + b) / 2 for a, b in pairs], places_of(masses)
        near = zero.refined(problem, guess, above.hint.matrix, places)
        matrix = zero.inverse_of(problem.slope(near.point))
        return cls(masses, above, below, tuple(map(tuple, matrix)))

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


def family(line: Line) -> list[Solved]:
    """Prove that there is one orbit for each mass of a line, all of one family; nobody stops.

    Returns the nodes between the cells.  Cells are halved until they succeed.
    """
    m, length = line.masses.m, line.above.mass - line.below.mass
    setting, most = line.masses.setting, _most_nodes(line.masses.setting, len(line.above.legs))
    count, nodes = -(-length // (m * WIDTH)), [line.above]
    for k in range(1, count + 1):
        mass = round(line.above.mass - length * k / count, 8 - interval.decade(m))
        below = line.below if k == count else _node(line, mass, nodes[-1])
        nodes += _divided(line, (nodes[-1], below))
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


def _divided(line: Line, ends: tuple[Solved, Solved]) -> Iterator[Solved]:
    """Give the lower ends of the cells between two zeros."""
    above, below = ends
    m, width = line.masses.m, above.mass - below.mass
    try:
        _cell(line, ends)
    except NotProved:
        if width < m * NARROWEST:
            raise
    else:
        yield below
        return
    middle = round((above.mass + below.mass) / 2, 8 - interval.decade(m))
    node = _node(line, middle, above)
    yield from _divided(line, (above, node))
    yield from _divided(line, (node, below))


def _node(line: Line, mass: Fraction, near: Solved) -> Solved:
    """Prove that the equations have one zero within `NODE` of a hint, which has ten digits."""
    masses, matrix = line.masses, line.preconditioner(mass)
    problem = masses.problem(mass)
    hint = zero.refined(problem, near.hint.centre, matrix, places_of(masses))
    return masses.solved(mass, hint, problem.isolate(hint, [NODE * q for q in masses.units]))


def places_of(masses: Masses) -> list[int]:
    """Return the decimals of the hints of nodes."""
    return [10 - interval.decade(unit) for unit in masses.units]


def _cell(line: Line, ends: tuple[Solved, Solved]) -> None:
    """Prove that for each mass between two there is one zero in a box around both their zeros,
    and that it is an orbit on which no mass stops.
    """
    masses, (above, below) = line.masses, ends
    m, free, middle = masses.m, masses.free, (above.mass + below.mass) / 2
    width, q = above.mass - below.mass, interval.hull(*(interval.ball(e.mass) for e in ends))
    prover = masses.prover(q)
    problem = Problem(
        masses.problem(middle).value,
        lambda u: free.slope(u, prover.balls),
        q - interval.ball(middle),
        lambda u: free.by_parameters(u, prover.balls, rates(m, q)),
    )
    pairs = list(zip(above.hint.centre, below.hint.centre, strict=True))
    hint = Hint(tuple((a + b) / 2 for a, b in pairs), line.preconditioner(middle))
    reach = [REACH_OF_CELLS * width / m * unit for unit in masses.units]
    K = problem.isolate(hint, [SPARE * each for each in reach])
    for (a, b), each in zip(pairs, reach, strict=True):
        if not abs(a - b) / 2 + 2 * NODE * each / width * m < each:
            raise NotProved("Lemma 3", "the zeros at the ends of a cell may be others", {})
    box = tuple(free.whole(K))
    contacts.no_other_contacts(prover, box)
    contacts.speeds_at_contacts(prover, box)
    moving = free.moved(problem.velocity(hint, K))
    for name in contacts.stops(prover):
        for h, time, clock in prover.moments(box, name):
            rate = _wider(_rate(prover, box, h, (time, clock), moving, rates(m, q)))
            speed = below.prover.along(below.legs[h.leg.number], name).height(time, clock)
            if not (speed > 0 and (rate > 0 or speed + rate * interval.ball(width) > 0)):
                sets = {"speed": speed, "its derivative": rate}
                raise NotProved("Lemma 3", "a mass may stop for some mass of a cell", sets)


def _wider(rate: Ball) -> Ball:
    """Return a ball around a rate that contains also what the checker may find."""
    spare = interval.ball(WIDER - 1) * interval.point(rate.rad())
    return Ball(rate + interval.symmetric(spare))


def _rate(
    prover: Prover,
    box: Box,
    h: Along,
    at: tuple[Ball, Clock],
    moving: Sequence[Ball],
    by_q: dict[str, Ball],
) -> Ball:
    """Return the derivative of a speed at a moment along the family, where contacts are moving."""
    equations, (time, clock), n = prover.equations, at, prover.equations.n
    k, i = h.leg.number, n // 2 + int(h.name.split()[1]) - 1
    begin = h.leg.start
    before = box[(n + 1) * k + 1 : (n + 1) * (k + 1)]
    leg, of = equations.legs[k], prover.balls
    arguments = [begin.time, *begin.clock, *before, time, *clock]
    flat = of.of(leg.slope)(*arguments)
    row = flat[(n + 1) + (n + 2) * i :][: n + 1]
    rate = interval.total(a * b for a, b in zip(row, moving[(n + 1) * k :], strict=False))
    names = equations.itinerary.system.parameters
    own = of.of(leg.by_parameters)(*arguments)[len(names) * (i + 1) :]
    rate = rate + interval.total(q * by_q[p] for p, q in zip(names, own, strict=False))
    return rate if prover.itinerary.flown(k)[i - n // 2] == "+" else -rate
