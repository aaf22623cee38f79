"""The theorem about a curve of periodic orbits over a parameter of the system that is given.

The last variable of the state is the parameter p: nothing moves it, so the system is one for each
p.  The orbits are given by their contacts, as in ``contacts``; so is what is meant by F, a leg, and
its guards.

*With a symmetry* (``symmetry``), which is confirmed by algebra, the contacts are those of half a
round, and F is that of symmetric orbits: p/2 periods later their states are the images of what they
were.  The multipliers are those of the map to half a round later, followed by S; those of the orbit
are their squares.

1. *Cells.*  On each of them F has one zero for each value of one unknown, in an explicit box around
   a line, and those of a cell and of the next one are one curve (``curve``).
2. *Nothing else happens*: over all zeros of a cell each leg is quiet, as in ``contacts``.  So all
   zeros of F on the cells are periodic orbits.  p takes on the curve, which is connected, all
   values between any two.
3. *Multipliers.*  How many are outside the unit circle on a cell, if none is on it
   (``curve_multipliers``).
4. *Points.*  On a short cell that lies on one of the cells a multiplier is -1, or two are on the
   unit circle, or p has an extremum (``curve_multipliers``).
5. *Grazes.*  One more cell, which has a point in common with one of the cells.  On it a guard h of
   a leg has one least value m in a window of times, monotone along the cell, and is positive on the
   leg outside of the window; all else is quiet (``graze``).  m vanishes for one s, between the ends
   of a short cell.  The common point is an orbit: m > 0 there, and so between it and the graze.  So
   all zeros of F from it on are orbits, until at that s the flight touches h = 0 at one time, where
   L h = 0 < L^2 h; beyond it h < 0 in the leg, and they are none.
6. *Contacts that are lost.*  One more cell, as before.  On it the speed u = L h before a contact
   is monotone, and where u <= 0 nothing else happens (``lost_contact``).  u vanishes for one s,
   between the ends of a short cell.  At the common point u < 0, and so between it and that s.  So
   all zeros of F from it on are orbits, until at that s the contact does nothing, and h touches
   zero there: L h = 0 < L^2 h; beyond it h rises through zero at the contact, and they are none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, ClassVar

from cap.checker.kernel.citation import NEUMAIER, cite
from cap.checker.kernel.integers import Integer
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, Whole, Word
from cap.checker.kernel.theorem import BITS
from cap.checker.system.contacts import Equations, Round
from cap.checker.system.curve import Cell, Curve, Line
from cap.checker.system.curve_multipliers import counts, happens
from cap.checker.system.curve_sentence import Sentence
from cap.checker.system.given import GUARDS, MODES, STATES
from cap.checker.system.graze import Graze
from cap.checker.system.lost_contact import LostContact
from cap.checker.system.passage import Contact
from cap.checker.system.symmetry import Symmetry
from cap.checker.theorems.contacts import (
    CONTACTS,
    CUTS,
    MOST_BITS,
    PERIODS,
    UNKNOWNS,
    Contacts,
    Cuts,
)

CELLS, POINTS, GRAZES = 5000, 100, 2
WORK, EQUATIONS = 1 << 24, 1 << 24

_ROW = Many(number, 3, UNKNOWNS + 1)
_CELL = {
    "along": Whole(0, UNKNOWNS),
    "ends": [number, number],
    "centre": _ROW,
    "slope": _ROW,
    "reach": _ROW,
    "outside": Maybe(Whole(0, STATES)),
}
_SHORT = {key: shape for key, shape in _CELL.items() if key != "outside"}
_POINT = {
    "kind": Word(("flip", "pair", "fold")),
    "cell": Whole(0, CELLS),
    "short": _SHORT,
    "at": Quantity(),
    "outside": Maybe([Whole(0, STATES), Whole(0, STATES)]),
}
_MATRIX = Many(Many(Integer(40), 2, UNKNOWNS), 2, UNKNOWNS)
_LEGS = Many(Named(Many(number, 0, CUTS), GUARDS), 1, CONTACTS)
_FIRST = {"cell": Whole(0, CELLS), "piece": _SHORT}
_LAST = {"short": _SHORT, "at": Quantity(), "time": Quantity()}
_LEG = {"leg": Whole(1, CONTACTS), "guard": name, "window": [number, number]}
_GRAZE = {**_FIRST, **_LEG, **_LAST}
_LOST = {**_FIRST, "contact": Whole(1, CONTACTS), **_LAST}


End = Graze | LostContact
ENDS: dict[str, tuple[type[End], str]] = {
    "grazes": (Graze, "at a graze the guard touches zero, and until there nothing else happens"),
    "lost": (LostContact, "a contact is lost where its speed is 0, and until there nothing else "
                          "happens"),
}  # fmt: skip


class ContactsBranch(Contacts):
    """A curve of periodic orbits with these contacts."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("fine", Whole(64, MOST_BITS), "", "", "precision of the short cells"),
        Field("preconditioners", Many(_MATRIX, 1, CELLS), "", "C",
              "of each cell, in units 2^-48"),
        Field("cuts", Many(_LEGS, 1, CELLS), "", "", "of each cell, as those of an orbit"),
        Field("points", Many(_MATRIX, 0, POINTS), "", "",
              "the preconditioner of the short cell of each point"),
        Field("grazes", Many({"piece": _MATRIX, "cuts": _LEGS, "short": _MATRIX,
                              "narrow": [number, number]}, 0, GRAZES), "", "",
              "of each graze: the preconditioner of its piece, the cuts on it, two of which are "
              "the ends of the window, the preconditioner of its short cell, and between what "
              "times the guard is least on this"),
        Field("lost", Maybe(Many({"piece": _MATRIX, "cuts": _LEGS, "short": _MATRIX}, 1, GRAZES)),
              "", "",
              "of each contact that is lost: the preconditioner of its piece, the cuts on it, and "
              "the preconditioner of its short cell"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("contacts", Many({"mode": name, "guard": name, "to": name}, 1, CONTACTS), "", "",
              "the guards that come to zero in one round, in order, and the modes that follow; "
              "with a symmetry those of half a round"),
        Field("periods", Whole(1, PERIODS), "", "p", "the periods of the clock in one round"),
        Field("symmetry", Maybe({"signs": Many(Integer(1), 1, STATES),
                                 "modes": Named(name, MODES)}), "", "",
              "of the system: the sign of each variable, and the image of each mode; the states of "
              "the orbits p/2 periods later are the images of what they were"),
        Field("range", [number, number], "", "", "between these all values of the parameter occur"),
        Field("cells", Many(_CELL, 1, CELLS), "", "",
              "pieces of the curve, in order, of which only one unknown is free: times and states "
              "just before the contacts, and the parameter at the end; how many multipliers are "
              "outside the unit circle on all of it, none on it"),
        Field("points", Many(_POINT, 0, POINTS), "", "",
              "short pieces of the cell of this number, counted from 0, on which a multiplier is "
              "-1, or two are on the unit circle, or the parameter turns; where it is then; how "
              "many multipliers are outside at both ends"),
        Field("grazes", Many(_GRAZE, 0, GRAZES), "", "",
              "pieces that go on from the cell of this number to where the leg after a contact, "
              "counted from 1, touches the zero of a guard, in a window of times; a short part of "
              "the piece, the parameter and the time of the touch; with a symmetry the last leg is "
              "that after the image of the last contact, before the first one"),
        Field("lost", Maybe(Many(_LOST, 1, GRAZES)), "", "",
              "pieces that go on from the cell of this number to where the speed at a contact, "
              "counted from 1, goes to 0: the guard touches zero, and the contact does nothing; a "
              "short part of the piece, the parameter and the time of that contact"),
    )
    CITES = (
        cite("Krawczyk", NEUMAIER,
             ("smooth", "F is real analytic on the boxes: guards are polynomials, resets rational "
              "functions, flights exponentials", "cells"),
             ("inclusion", "K lies in the interior of the box of each cell", "cells")),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Reject what is not the same number everywhere, and too much work."""
        need(hints["bits"] <= MOST_BITS, f"more than {MOST_BITS} bits")
        count, cells, points = (len(claims[key]) for key in ("contacts", "cells", "points"))
        for key in ("preconditioners", "cuts"):
            need(len(hints[key]) == cells, f"hints.{key} is not a list of {cells}")
        need(len(hints["points"]) == points, f"hints.points is not a list of {points}")
        size = len(claims["cells"][0]["centre"])
        need(len(hints["grazes"]) == len(claims["grazes"]), "hints.grazes are not those of claims")
        lost = len(claims.get("lost", ()))
        need(len(hints.get("lost", ())) == lost, "hints.lost are not those of claims")
        ends = *hints["grazes"], *hints.get("lost", ())
        shown = [*hints["cuts"], *(end["cuts"] for end in ends)]
        need(all(len(legs) == count for legs in shown), "a cell has not a leg a contact")
        pieces = sum(len(at) + 1 for legs in shown for leg in legs for at in leg.values())
        work = hints["bits"] * (size // count + 3) * pieces
        need(work <= WORK, "bits x variables x pieces of legs are more than 2^24")
        entries = (cells + points + 2 * len(ends)) * size**2 * count
        need(entries <= EQUATIONS, "cells x unknowns^2 x contacts are more than 2^24")

    def prove(self) -> None:
        """Prove the theorem."""
        Curve.confirm(self.p)
        self.orbit = Round(self.p, [Contact(**c) for c in self.claims["contacts"]],
                           self.claims["periods"], self.symmetry())  # fmt: skip
        self.orbit.confirm()
        self.equations = Equations(self.orbit, self.hints["bits"])
        once = not self.equations.autonomous or self.claims["periods"] == 1
        need(once, "claims.periods is not 1, but the system has no clock")
        self.curve = Curve(self.equations)
        given = zip(self.claims["cells"], self.hints["preconditioners"], strict=True)
        self.cells = [self.curve.cell(Line.of(cell), C) for cell, C in given]
        self.step("K lies in the interior of the box of each cell: one zero of F for each s")
        joined = all(a.meets(b) for a, b in pairwise(self.cells))
        need(joined, "two cells are not certain to be one curve")
        self.step("each cell and the next have a point in common")
        e = [self.quiet(k, cell) for k, cell in enumerate(self.cells)]
        self.step("on each leg all guards of its mode are positive between the contacts")
        self.counted(e)
        self.fine = Curve(Equations(self.orbit, self.hints["fine"]))
        self.reaches(self.points(), [*self.ends("grazes"), *self.ends("lost")])

    def symmetry(self) -> Symmetry | None:
        """Return the symmetry that is claimed; it leaves the parameter as it is."""
        given = self.claims.get("symmetry")
        if given is None:
            return None
        need(all(abs(s) == 1 for s in given["signs"]), "a sign of the symmetry is none")
        need(given["signs"][-1] == 1, "the symmetry changes the parameter")
        return Symmetry(given["signs"], given["modes"])

    def reaches(self, short: list[Cell], beyond: list[tuple[Cell, Fraction]]) -> None:
        """Prove that the parameter takes all values of the range: there are ends beyond it."""
        low, high = self.claims["range"]
        need(low < high, "claims.range is not in order")
        every = [(cell, s) for cell in (*self.cells, *short) for s in cell.line.ends]
        ends = [(cell.line, s, cell.at(s)[-1]) for cell, s in (*every, *beyond)]
        last = self.curve.size
        least = any(s <= low if c.along == last else p.upper <= low for c, s, p in ends)
        most = any(s >= high if c.along == last else p.lower >= high for c, s, p in ends)
        need(least and most, "the parameter may not go through all of claims.range")
        self.step("the parameter takes all values of the range")

    def quiet(self, k: int, cell: Cell) -> list[Interval]:
        """Prove that the zeros of a cell are orbits; return the e_j of their multipliers."""
        box = cell.box
        steps, zeros = self.curve.steps(box), self.curve.expanded(box)
        for j, cuts in enumerate(self.hints["cuts"][k]):
            self.leg(zeros, steps[j], j, cuts)
        return self.curve.multipliers(steps)

    def counted(self, e: list[list[Interval]]) -> None:
        """Prove how many multipliers are outside the unit circle, where it is claimed."""
        counted = zip(self.claims["cells"], counts(self.cells, e), strict=True)
        for k, (cell, count) in enumerate(counted):
            certain = cell.get("outside", count) == count
            need(certain, f"cell {k}: so many multipliers are not certain to be outside")
        self.step("so many multipliers are outside the unit circle, and none on it")

    def points(self) -> list[Cell]:
        """Prove what happens at the points; return their short cells."""
        found = list[Cell]()
        given = zip(self.claims["points"], self.hints["points"], strict=True)
        for k, (point, C) in enumerate(given):
            need(point["cell"] < len(self.cells), f"point {k} is on no cell")
            short = self.fine.cell(Line.of(point["short"]), C)
            on = self.lies(short, self.cells[point["cell"]])
            need(on, f"point {k} is not certain to be on its cell")
            self.compare(f"points[{k}].at", point["at"], short.box[-1])
            happens(k, point, self.fine, short)
            found.append(short)
        self.step("each point lies on its cell, and what is claimed happens there")
        return found

    def lies(self, short: Cell, on: Cell) -> bool:
        """Return whether the zeros of a short cell are certainly on a cell.

        So it is at both ends, for all b of the short cell, and what is among the w of a cell is
        convex: all w of the short cell are, and so its zeros are those of the cell.
        """
        bits = self.hints["bits"]
        ends = [(s, [x.with_bits(bits) for x in short.at(s)]) for s in short.line.ends]
        return all(on.holds(short.line, s, w) for s, w in ends)

    def ends(self, key: str) -> Iterator[tuple[Cell, Fraction]]:
        """Prove where orbits graze, or a contact is lost.

        Give the short cells, with their ends that are orbits.
        """
        kind, told = ENDS[key]
        for k, end in enumerate(self.claims.get(key, ())):
            hints, where, last = self.hints[key][k], f"{key}[{k}]", kind.of(self.curve, end)
            need(end["cell"] < len(self.cells), f"{where} is on no cell")
            piece = self.curve.cell(Line.of(end["piece"]), hints["piece"])
            joined = self.cells[end["cell"]].meets(piece)
            need(joined, f"the piece of {where} is not certain to be one curve with its cell")
            self.approaches(where, last, piece, hints["cuts"])
            short = self.fine.cell(Line.of(end["short"]), hints["short"])
            fine = last.short(self.fine, hints)
            need(self.lies(short, piece), f"{where} is not certain to be on its piece")
            self.compare(f"{where}.at", end["at"], short.box[-1])
            self.compare(f"{where}.time", end["time"], fine.time(short.box))
            signs = [fine.sign(short.at(s)) for s in short.line.ends]
            need(sorted(signs) == [-1, 1], f"{where}: what comes to 0 may not change its sign")
            yield short, short.line.ends[signs.index(1)]
            self.step(told)

    def approaches(self, where: str, last: End, piece: Cell, cuts: Sequence[Cuts]) -> None:
        """Prove that on a piece nothing else happens, and what comes to 0 is monotone."""
        steps, zeros = self.curve.steps(piece.box), self.curve.expanded(piece.box)
        for j, each in enumerate(cuts):
            self.leg(zeros, steps[j], j, each, **last.given(j))
        last.confirm(piece.box)
        change = last.change(piece.box, self.curve.rates(steps, piece.line.along))
        need(not change.contains_zero(), f"{where}: what comes to 0 may not be monotone")

    def words(self) -> str:
        """Return the theorem in one line."""
        return Sentence(self.p, self.claims).whole()


THEOREM = ContactsBranch
