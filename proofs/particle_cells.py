"""The zeros of the equations of two masses, for all second masses between two, in cells."""

from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import NamedTuple

from cap.errors import NotProved
from cap.maps import zero
from cap.maps.zero import Hint, Problem
from cap.particles import equations
from cap.particles.family import Family
from cap.particles.model import Event, Model, events_of
from cap.proofs.fixed_point import Setting
from cap.proofs.particle_orbit import problem_of, units_of
from cap.sets import interval

WIDTHS = [Fraction(1, k) for k in (500, 800, 1250, 2000)]  # of cells, of the first mass
REACHES = Fraction(3, 2)  # half-width of the box of a cell, of its width
SPARE = Fraction(
    19, 20
)  # part of this box with which the proof succeeds, so the checker can follow
NODE = Fraction(1, 10**7)  # half-width of the box of a node


@dataclass(frozen=True)
class Solved:
    """The zero for one second mass: its hint and its events."""

    mass: Fraction
    hint: Hint
    model: Model
    events: list[Event]


@dataclass(frozen=True)
class Line:
    """The masses from ``above`` down to ``below``, with preconditioners for all of them."""

    above: Solved
    below: Solved

    @property
    def length(self) -> Fraction:
        """How many."""
        return self.above.mass - self.below.mass

    def preconditioner(self, mass: Fraction) -> tuple[tuple[Fraction, ...], ...]:
        """Return what is linear in the mass, and right at both ends."""
        part = (self.above.mass - mass) / self.length
        pairs = zip(self.above.hint.matrix, self.below.hint.matrix, strict=True)
        return tuple(
            tuple(a + (b - a) * part for a, b in zip(*rows, strict=True)) for rows in pairs
        )


class Nodes(NamedTuple):
    """Zeros for masses between two intervals, and half the width of the boxes of the cells."""

    nodes: list[Solved]
    reach: Fraction


def family(setting: Setting, line: Line) -> Nodes:
    """Prove that there is one zero for each mass of a line, all of one family.

    Zeros at nodes on the line, and one for each mass of the cells between nodes, in a box that
    contains those of both nodes.  The widest cells are taken that succeed.
    """
    *wide, last = WIDTHS
    for width in wide:
        try:
            return _divided(setting, line, width)
        except NotProved:
            continue
    return _divided(setting, line, last)


def _divided(setting: Setting, line: Line, width: Fraction) -> Nodes:
    """Prove that there is one zero for each mass of a line, in cells of a width."""
    m = line.above.model.masses[0]
    count, reach = -(-line.length // (m * width)), width * REACHES
    nodes = [line.above]
    for k in range(1, count):
        mass = round(line.above.mass - line.length * k / count, 8 - interval.decade(m))
        nodes.append(_node(setting, line, mass, nodes[-1]))
    for above, below in pairwise([*nodes, line.below]):
        _cell(setting, line, (above, below), reach)
    return Nodes(nodes[1:], reach)


def _node(setting: Setting, line: Line, mass: Fraction, near: Solved) -> Solved:
    """Prove that the equations have one zero within `NODE` of a hint, which has ten digits."""
    model = Model(setting.parameters, (near.model.masses[0], mass))
    contacts = tuple(event.contact for event in near.events)
    problem, units = problem_of(model, contacts), units_of(setting, len(near.hint.centre))
    places = [10 - interval.decade(unit) for unit in units]
    hint = zero.refined(problem, near.hint.centre, line.preconditioner(mass), places)
    box = problem.isolate(hint, [NODE * unit for unit in units])
    return Solved(mass, hint, model, events_of(model, contacts, box))


def _cell(setting: Setting, line: Line, nodes: tuple[Solved, Solved], reach: Fraction) -> None:
    """Prove that for each mass between two there is one zero in a box around both their zeros."""
    above, below = nodes
    p, m, contacts = setting.parameters, above.model.masses[0], [e.contact for e in above.events]
    middle = (above.mass + below.mass) / 2
    family = Family(p, m, (below.mass, above.mass))
    centre = Model(p, (m, middle))
    q = interval.hull(interval.ball(below.mass), interval.ball(above.mass))
    problem = Problem(
        partial(equations.value, centre, contacts),
        partial(equations.slope, family, contacts),
        lambda z: (
            q - interval.ball(middle),
            equations.by_second_mass(family, contacts, z, q),
        ),
    )
    ends = list(zip(above.hint.centre, below.hint.centre, strict=True))
    hint = Hint(tuple((a + b) / 2 for a, b in ends), line.preconditioner(middle))
    units = units_of(setting, len(ends))
    problem.isolate(hint, [SPARE * reach * unit for unit in units])
    for (a, b), unit in zip(ends, units, strict=True):
        if not abs(a - b) / 2 + NODE * unit < reach * unit:
            raise NotProved("Lemma 3", "the zeros at the ends of a cell may be others", {})
