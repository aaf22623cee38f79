"""Theorem (contacts_branch).  Let a system be given as data (`cap.system.model`) that depends on a
parameter p, which stands in guards, resets and constant forces.  Let an orbit be given by its
contacts, with a guess.  If the lemmas below succeed, then

 (i)   there is a connected curve of periodic orbits with these contacts, in analytic pieces, on
       which p takes all values of an explicit interval; in boxes around the pieces there are no
       others with these contacts, for each value of one unknown;
 (ii)  nothing else happens on them; on pieces of which it is said, so many multipliers are outside
       the unit circle, and none on it;
 (iii) on explicit short pieces a multiplier passes -1, or two that are not real pass the unit
       circle, or p turns back and a multiplier is 1: a function changes its sign there.  That such
       a point is a bifurcation of a certain type is not claimed;
 (iv)  where an end is proved to be a graze: the curve goes on to an orbit of which one leg touches
       the zero of a guard at one time, and nothing else happens until there;
 (v)   where a contact is proved to be lost at an end: the curve goes on to where the speed at the
       contact is 0, so that the guard only touches zero, and nothing else happens until there.

Proof.  `cap.orbits.cells` (i), `cap.orbits.quiet` (ii), `cap.orbits.points` (iii),
`cap.orbits.graze` (iv), `cap.orbits.lost_contact` (v).
"""

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple

from cap.certificate.writer import Rounding
from cap.errors import BadInput, NotProved
from cap.orbits.branch import Branch, Follower, Shown
from cap.orbits.cells import SHIFT, Cell, Cells, wider
from cap.orbits.curve import Curve
from cap.orbits.graze import Graze, Grazer
from cap.orbits.itinerary import Itinerary
from cap.orbits.lost_contact import Lost, LostContacts
from cap.orbits.periodic import Prover
from cap.orbits.points import FINE, Point, Tell
from cap.proofs import contacts
from cap.proofs.certified import assembled
from cap.proofs.contacts import Cuts as Legs
from cap.sets import interval
from cap.sets.interval import exact_decimal as _decimal
from cap.system.symmetry import Symmetry

BITS, DIGITS = 96, 20
PLACES = 9  # of what is said of the parameter


def prove(
    itinerary: Itinerary,
    guess: Sequence[float],
    ends: tuple[Fraction, Fraction],
    tell: Tell = lambda _words, _part: None,
) -> tuple[dict[str, Any], tuple[str, str]]:
    """Return a certificate of the curve through an orbit, and why it ends (nothing: the range).

    The system has the parameter as its last variable (`cap.system.moving`); ``guess`` has the time
    and the state just before each contact, and the parameter at the end.
    """
    parameters = contacts.as_parameters(itinerary.system)
    with interval.workprec(BITS):
        curve = Curve(itinerary)
        prover = Prover(curve.equations, pieces=True)

        def quiet(box: Sequence[Any]) -> Legs:
            around = tuple(curve.expanded(box))
            return contacts.legs(prover, around, prover.reasons(around))

        follower = Follower(Cells(curve), ends, quiet, tell)
        found = follower.branch(guess)
        beyond, why = _beyond(Grazer(follower, prover), LostContacts(follower, prover), found)
        content = claims(itinerary, found, beyond), hints(found, beyond)
        certificate = assembled("contacts_branch", parameters, DIGITS, content, BITS)
        tell("checking", None)
        cuts = [leg for shown in found.cells for leg in shown.legs]
        told = [*content[1]["grazes"], *content[1].get("lost", ())]
        for end, hint in zip(beyond.every, told, strict=True):
            box = tuple(curve.expanded(end.piece.wider))
            hint["cuts"] = contacts.shown(contacts.legs(prover, box, end.reasons))
        return contacts.checked(certificate, cuts, contacts.grouped(len(itinerary.contacts))), why


class Beyond(NamedTuple):
    """What is proved of the ends of a curve."""

    grazes: list[Graze]
    lost: list[Lost]

    @property
    def every(self) -> list[Graze | Lost]:
        """All of them: the grazes first."""
        return [*self.grazes, *self.lost]


def _beyond(
    grazer: Grazer, contacts: LostContacts, found: Branch[Legs]
) -> tuple[Beyond, tuple[str, str]]:
    """Return the grazes and the lost contacts at the ends, and why it ends where it has none."""
    beyond, why = Beyond([], []), list(found.ends)
    cells = [shown.cell for shown in found.cells]
    for side in (0, 1):
        if why[side]:
            with suppress(NotProved):
                beyond.grazes.append(grazer.graze(cells, last=side == 1))
                why[side] = ""
                continue
            with suppress(NotProved):
                beyond.lost.append(contacts.lost(cells, last=side == 1))
                why[side] = ""
    return beyond, (why[0], why[1])


def claims(itinerary: Itinerary, found: Branch[Legs], beyond: Beyond) -> dict[str, Any]:
    """Return what is claimed of a curve."""
    values = [_parameter(shown.cell, s) for shown in found.cells for s in shown.cell.line.ends]
    turns = [interval.outward(p.cell.box[-1], DIGITS) for p in found.points if p.kind == "fold"]
    ends = [end.short.box[-1] for end in beyond.every]
    reached = [interval.outward(wider(x), PLACES) for x in ends]
    values += [(Fraction(lower), Fraction(upper)) for lower, upper in (*turns, *reached)]
    low, high = min(upper for _, upper in values), max(lower for lower, _ in values)
    if not low < high:
        raise BadInput("the curve that is proved is too short: the parameter hardly moves on it")
    return {
        "contacts": [contact._asdict() for contact in itinerary.contacts],
        "periods": str(itinerary.periods),
        **_symmetry(itinerary.symmetry),
        "range": [_decimal(low), _decimal(high)],
        "cells": [_cell(*each) for each in zip(found.cells, found.counts, strict=True)],
        "points": [_point(point) for point in found.points],
        "grazes": [_graze(graze) for graze in beyond.grazes],
        **({"lost": [_lost(end) for end in beyond.lost]} if beyond.lost else {}),
    }


def _symmetry(found: Symmetry | None) -> dict[str, Any]:
    """Return what is claimed of a symmetry, if the orbits have one."""
    if found is None:
        return {}
    return {"symmetry": {"signs": [str(s) for s in found.signs], "modes": dict(found.modes)}}


def _parameter(cell: Cell, s: Fraction) -> tuple[Fraction, Fraction]:
    """Return bounds of the parameter at an end of a cell, with room for the checker's."""
    if cell.line.along == len(cell.line.centre) - 1:
        return s, s
    lower, upper = interval.outward(wider(cell.at(s)[-1]), PLACES)
    return Fraction(lower), Fraction(upper)


def _shape(cell: Cell) -> dict[str, Any]:
    line = cell.line
    return {
        "along": str(line.along),
        "ends": [_decimal(s) for s in line.ends],
        "centre": [_decimal(q) for q in line.centre],
        "slope": [_decimal(q) for q in line.slope],
        "reach": [_decimal(q) for q in cell.reach],
    }


def _cell(shown: Shown[Legs], count: int | None) -> dict[str, Any]:
    return {**_shape(shown.cell), **({} if count is None else {"outside": str(count)})}


def _point(point: Point) -> dict[str, Any]:
    shown = {
        "kind": point.kind,
        "cell": str(point.inside),
        "short": _shape(point.cell),
        "at": Rounding(DIGITS).pair(point.cell.box[-1]),
    }
    clear = None not in point.outside
    return {**shown, "outside": [str(n) for n in point.outside]} if clear else shown


def _graze(graze: Graze) -> dict[str, Any]:
    rounding, (a, b) = Rounding(DIGITS), graze.time
    with interval.workprec(FINE):
        time = interval.around((a + b) / 2, (b - a) / 2)
    return {
        "cell": str(graze.inside),
        "piece": _shape(graze.piece),
        "leg": str(graze.leg + 1),
        "guard": graze.guard,
        "window": [_decimal(t) for t in map(contacts.decimal_of, graze.window)],
        "short": _shape(graze.short),
        "at": rounding.pair(graze.short.box[-1]),
        "time": rounding.pair(time),
    }


def _lost(end: Lost) -> dict[str, Any]:
    rounding = Rounding(DIGITS)
    with interval.workprec(FINE):
        time = rounding.pair(end.time)
    return {
        "cell": str(end.inside),
        "piece": _shape(end.piece),
        "contact": str(end.contact + 1),
        "short": _shape(end.short),
        "at": rounding.pair(end.short.box[-1]),
        "time": time,
    }


def hints(found: Branch[Legs], beyond: Beyond) -> dict[str, Any]:
    """Return what the checker need not search, but the cuts."""
    lost = [
        {"piece": _matrix(end.piece), "cuts": [], "short": _matrix(end.short)}
        for end in beyond.lost
    ]
    return {
        "bits": str(BITS),
        "fine": str(FINE),
        "preconditioners": [_matrix(shown.cell) for shown in found.cells],
        "cuts": [],
        "points": [_matrix(point.cell) for point in found.points],
        "grazes": [
            {
                "piece": _matrix(graze.piece),
                "cuts": [],
                "short": _matrix(graze.short),
                "narrow": [_decimal(t) for t in graze.time],
            }
            for graze in beyond.grazes
        ],
        **({"lost": lost} if lost else {}),
    }


def _matrix(cell: Cell) -> list[list[str]]:
    return [[str(round(q * 2**SHIFT)) for q in row] for row in cell.line.matrix]
