"""Where a curve of periodic orbits ends as the speed at a contact goes to zero: it is lost.

The zeros of F go on beyond it.  On one more cell, the *piece*, let u be L h of the guard h of a
contact just before it.  By identities of polynomials the reset leaves the state as it is where u =
0, and L h after it is -c u; let c > 0 on the piece.  So where u <= 0 nothing else happens if L^2 h
> 0 just before the contact and just after it, and the guards are positive elsewhere.  Where du/ds
does not vanish, u = 0 for at most one s: enclosed in a *short* cell, at whose ends u has two signs.
There h touches zero, and the contact does nothing.
"""

from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.ahead import Ahead, Begin
from cap.orbits.branch import Follower
from cap.orbits.cells import Cell
from cap.orbits.periodic import Prover
from cap.orbits.points import FINE
from cap.orbits.quiet import Reason
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.polynomial import COS, PI, SIN, Polynomial, Quotient, variable


class Lost(NamedTuple):
    """A piece that goes on from the cell of a number; all of the statement of this module."""

    inside: int
    piece: Cell
    contact: int
    reasons: list[Reason]
    short: Cell
    time: Ball


class LostContacts:
    """Looks for contacts that are lost at the ends of a curve."""

    def __init__(self, follower: Follower[Any], prover: Prover) -> None:
        self.follower, self.prover, self.ahead = follower, prover, Ahead(follower, "lost contact")

    def lost(self, cells: list[Cell], *, last: bool) -> Lost:
        """Return the contact that is lost beyond the first or the last cell of a curve.

        It is the slowest one; raise `NotProved` if it is not seen to be lost.
        """
        end = tuple(map(Ball, self.ahead.end(cells, last=last)))
        contacts = range(len(self.prover.itinerary.contacts))
        each = [Speed(self.follower, k) for k in contacts]
        slowest = min(each, key=lambda speed: abs(speed(end)))
        slowest.confirm()
        begins = self.ahead.begins(cells, last=last)
        proved = partial(self._proved, speed=slowest)
        return self.ahead.first(begins, proved, "no speed goes to zero")

    def _proved(self, begin: Begin, speed: "Speed") -> Lost:
        """Prove that the contact is lost on a piece."""
        piece = self.ahead.piece(begin, speed)
        box = tuple(speed.curve.expanded(piece.wider))
        speed.turns(piece.wider)
        reasons = self.prover.reasons(box, lost=speed.contact)
        rates = self.follower.cells.rates(piece.box, piece.line.along)
        if speed.change(piece.box, rates).contains(0):
            raise NotProved("lost contact", "its speed may not be monotone")
        with interval.workprec(FINE):
            short = self.ahead.short(piece, speed)
            u, v = (speed.over(short.at(s)) for s in short.line.ends)
            if not ((u < 0 and v > 0) or (u > 0 and v < 0)):
                raise NotProved("lost contact", "its speed is not certain to change its sign")
            return Lost(begin.number, piece, speed.contact, reasons, short, speed.time(short.box))


class Speed:
    """L h of the guard of a contact just before it, and what its reset makes of it."""

    def __init__(self, follower: Follower[Any], contact: int) -> None:
        self.contact, self.cells = contact, follower.cells
        self.curve = follower.cells.curve
        self.equations, self.itinerary = self.curve.equations, self.curve.equations.itinerary
        self.mode, self.guard, self.to = self.itinerary.contacts[contact]
        system = self.itinerary.system
        self.rate = system.lie(self.mode, system.guard(self.mode, self.guard).value)
        self.state, self.omega = system.state, system.omega
        self.factor = Quotient.of(-1)  # of L h after the contact

    def __call__(self, w: Box) -> Fraction:
        """Return it at a point; a guess."""
        return interval.midpoint(self.over(w).mid())

    def over(self, w: Box) -> Ball:
        """Return an enclosure of it."""
        return self._of(w, self.rate)

    def confirm(self) -> None:
        """Prove the identities of the reset; raise `NotProved` if they are not found."""
        if self.itinerary.is_moved(self.contact) or self.to != self.mode:
            raise NotProved("lost contact", "another mode follows, or a symmetry moves the flight")
        if not self.itinerary.zeros_in(self.contact, self.to, self.guard):
            raise NotProved("lost contact", "the guard may not vanish after it")
        reset = self.itinerary.system.reset(self.mode, self.guard)
        moved = [(reset[z] - variable(z)).numerator for z in self.state]
        if any(q.divided(self.rate) is None for q in moved):
            raise NotProved("lost contact", "where its speed is 0 it may move the state")
        named = {z: Quotient.of(variable(z)) for z in self.rate.variables} | dict(reset)
        after = Quotient.of(self.rate.evaluated(named, Quotient.of, Quotient.of(variable(PI))))
        factor = after.numerator.divided(self.rate)
        if factor is None:
            raise NotProved("lost contact", "the speed after it may be no multiple of that before")
        self.factor = Quotient(factor, after.denominator)

    def turns(self, w: Box) -> None:
        """Prove that the contact turns the speed, over a box of zeros, or makes it 0."""
        above, below = self.factor.numerator, self.factor.denominator
        if above and not self._of(w, above) * self._of(w, below) < 0:
            raise NotProved("lost contact", "it may not turn the speed")

    def change(self, w: Box, rates: list[Ball]) -> Ball:
        """Return an enclosure of the derivative along the curve, ``rates`` that of w."""
        q = self.rate
        by_time = q.derivative(SIN) * variable(COS) - q.derivative(COS) * variable(SIN)
        gradient = [by_time * self.omega, *(q.derivative(z) for z in self.state)]
        here = self.equations.places[self.contact].here
        by = self.curve.expanded(rates)[here : here + len(gradient)]
        return interval.total([self._of(w, g) * x for g, x in zip(gradient, by, strict=True)])

    def time(self, w: Box) -> Ball:
        """Return an enclosure of the time of the contact."""
        place = self.equations.places[self.contact]
        found: Ball = self.equations.time(self.curve.expanded(w), place)
        return found

    def _of(self, w: Box, q: Polynomial) -> Ball:
        """Return an enclosure of a polynomial just before the contact."""
        of, here = self.cells.balls, self.equations.places[self.contact].here
        state = self.curve.expanded(w)[here + 1 : here + self.equations.n + 1]
        cos, sin = of.clock(self.time(w))
        known = {**dict(zip(self.state, state, strict=True)), COS: cos, SIN: sin}
        value: Ball = q.evaluated(known, interval.ball, interval.pi())
        return value
