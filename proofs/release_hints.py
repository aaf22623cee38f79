"""Cells and a box that the checker of theorem `attractor` can follow; Lemma 5 of that theorem.

The checker's arithmetic is looser than Taylor models: it is asked, and sets are made smaller until
it succeeds.  Nothing is proved by that.
"""

from dataclasses import astuple
from fractions import Fraction
from typing import Any, NamedTuple

from cap.certificate import writer as certificate
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Certificate
from cap.checker.system.walls import Parameters as Checked
from cap.checker.theorems.attractor import Attractor
from cap.errors import NotProved
from cap.flow.event import TAYLOR_MODELS
from cap.flow.model import Moment, Oscillator
from cap.flow.orbit import State
from cap.flow.windows import Itinerary, windows_for
from cap.proofs.fixed_point import Setting, inside
from cap.release.cell import Cell, slack
from cap.release.passage import arrival, foreseen_from
from cap.release.trap import Trap
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

ORDER = 3  # of the Taylor models over the box
MOST_CELLS = 500


def followable(checker: Attractor, osc: Oscillator[Any], cells: list[Cell]) -> list[Cell]:
    """Return cells, cut into pieces that the checker, in its looser arithmetic, can follow.

    Nothing is proved here: it finds hints.
    """

    def follows(piece: Cell) -> bool:
        windows = [interval.ends(e.window) for e in piece.windows()]
        try:
            found = checker.cell(piece.lower, piece.upper, windows)
        except Rejected:
            return False
        return bool(found.slope or (found.curve and piece.curve is not None))

    done: list[Cell] = []
    waiting = cells[::-1]
    while waiting:
        piece = waiting.pop()
        if follows(piece):
            done.append(piece)
        elif len(done) + len(waiting) > MOST_CELLS:
            raise NotProved("checker", "the cells are too many for the independent checker")
        else:
            waiting += piece.pieces(osc, 2)[::-1]
    return done


def checker_of(setting: Setting, trap: Trap, halves: int) -> Attractor:
    """Return the checker of this theorem, as far as hints are tried with it."""
    claims = {
        "itinerary": [event.word for event in trap.events],
        "half_periods": halves,
        "interval": Enclosure(trap.lower, trap.upper, ("", "")),
    }
    p, hints = Checked(*astuple(setting.parameters)), {"cell_bits": cell_bits(setting)}
    return Attractor(Certificate("attractor", p, setting.digits, claims, hints), lambda _: None)


def cell_bits(setting: Setting) -> int:
    """Return the precision at which the checker looks at cells."""
    return Setting(setting.parameters, setting.start, 6, guard=0).checker_bits


class Basin(NamedTuple):
    """A box of states at t = 0 from which the mass comes to be released in I."""

    sides: dict[str, certificate.Pair]
    windows: Itinerary


def lemma_5_basin(setting: Setting, osc: Oscillator[Any], trap: Trap, checker: Attractor) -> Basin:
    """*Statement.* All orbits from an explicit box come to be released in I.

    *Computed.* Their events, and where the last release is, as Taylor models.  The box is around
    the state after a release in the middle of I; the largest is looked for that the checker, too,
    can follow.
    """
    p = setting.parameters
    end = Moment(osc.T, Ball(0), Ball(1))
    flight = osc.launch(1, osc.slow(1, 0), interval.ball((trap.lower + trap.upper) / 2), Ball(0))
    state = osc.position(flight, end), osc.velocity(flight, end)
    x, v = (Fraction(float(z.mid())) for z in state)
    events = foreseen_from(p, (float(x), float(v)))

    def around(size: Fraction) -> Basin:
        sides = {"x": inside(x, size * p.R), "v": inside(v, size * p.R * p.omega)}
        found = Basin(sides, slack(released_in(osc, trap, sides, events)))
        windows = [interval.ends(event.window) for event in found.windows]
        box = [(Fraction(low), Fraction(high)) for low, high in sides.values()]
        try:
            checker.box(box, windows)
        except Rejected as reason:
            raise NotProved("checker", str(reason)) from None
        return found

    size = bisection.largest(around, Fraction(1, 16), 4)
    if size is None:
        raise NotProved("Lemma 5", "no box of states was found whose releases lie in I")
    return around(size)


def released_in(
    osc: Oscillator[Any], trap: Trap, sides: dict[str, certificate.Pair], events: Itinerary
) -> Itinerary:
    """Prove that all orbits from a box at t = 0 are released in I; return their events."""
    box = [interval.hull(*(interval.ball(Fraction(q)) for q in side)) for side in sides.values()]
    domain = Domain([z - interval.point(z) for z in box], ORDER)
    x, v = domain.variables([interval.point(z) for z in box])
    state = State(Moment(Ball(0), Ball(0), Ball(1)), x, v)

    def attempt(expected: Itinerary) -> Any:
        return arrival(osc, state, expected, TAYLOR_MODELS)

    _, found = windows_for(attempt, events, TAYLOR_MODELS.bound)
    where = TAYLOR_MODELS.bound(found.value)
    if not interval.ball(trap.lower) < where < interval.ball(trap.upper):
        raise NotProved("Lemma 5", "the releases may not lie in I", {"release": where})
    times: Itinerary = found.times(TAYLOR_MODELS.bound)
    return times
