"""Cells and pieces of strips of f that the checker of theorem `entropies` can follow.

The checker's arithmetic is looser than Taylor models: it is asked, and sets are made smaller until
it succeeds.  Nothing is proved by that.
"""

from collections.abc import Callable
from dataclasses import asdict, astuple
from fractions import Fraction
from functools import partial
from typing import Any

from cap.certificate.writer import window
from cap.checker.flow.driven import phases
from cap.checker.flow.sheared import Line, Near, Passage
from cap.checker.flow.strip import Strip
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Parameters as Checked
from cap.errors import NotProved
from cap.maps.fixed_point import Itinerary
from cap.release import piece
from cap.release.family import Family
from cap.release.passage import words
from cap.release.strip import Core
from cap.sets import interval

CHECKED = 96  # bits


class Referee:
    """The checker of this theorem, which is asked what it can follow: nothing is proved by that."""

    def __init__(self, found: Core) -> None:
        self.found, family = found, found.family
        p = Checked(*astuple(family.p))._replace(f=Fraction(0))
        theta = phases(p, (family.low, family.high), CHECKED)
        self.claim = {"interval": _enclosure((found.lower, found.upper))}
        self.make: Callable[..., Strip] = partial(Strip, p, theta)
        self.strip = self.made(1)
        self.known = dict[tuple[Fraction, Fraction], Any]()

    def made(self, turn: int) -> Strip:
        """Return a strip of the checker."""
        hint = {"shear": self.found.family.shear}
        return self.make(turn, self.halves(), self.claim, hint)

    def halves(self) -> int:
        """Return how many half-periods the map takes at the critical point."""
        found = self.found
        events = found.expected((found.critical,) * 2, (found.family.p.f,) * 2)
        image = found.family.part(found.family.p.f, found.family.p.f)
        (theta,) = image.variables()
        y = interval.ball(Fraction(found.critical))
        return image.image(y, theta, events).half_periods

    def follows(self, lower: Fraction, upper: Fraction, events: Itinerary) -> bool:
        """Return whether a cell has a sign of H' or H''."""
        try:
            cell = self.strip.cell(lower, upper, passage_of(events))
        except Rejected:
            return False
        self.known[lower, upper] = cell
        return bool(cell.slope or cell.curve)

    def begin(self, cells: list[Any], turn: int) -> None:
        """Take note of all cells; raise `NotProved` if the checker does not."""
        self.strip = self.made(turn)
        try:
            self.strip.cells = [self.known[c.lower, c.upper] for c in cells]
            self.strip.unimodal()
            self.strip.boundary()
        except Rejected as reason:
            raise NotProved("checker", str(reason)) from None

    def length(self, part: Family, sequence: str, near: piece.Line) -> int:
        """Return how many symbols are followed on a piece; raise `NotProved` if none is."""
        H, length = self.strip.on((part.low, part.high)), 0
        try:
            c, value = self.strip.critical(H, Line(near.at, near.rate), near.reach)
            for _ in self.strip.images(H, sequence, c, value):
                length += 1
        except Rejected as reason:
            if not length:
                raise NotProved("checker", str(reason)) from None
        return length

    def contracts(self, part: Family, cycle: piece.Attracting) -> bool:
        """Return whether J is contracted, and an image of c lies there, on a piece."""
        strip = self.strip
        here = Near(Line(cycle.at, cycle.rate), Interval(0, 0, CHECKED))
        try:
            strip.cycle(strip.on((part.low, part.high)), asdict(cycle) | {"image": 1}, [here])
        except Rejected:
            return False
        return True


def passage_of(events: Itinerary) -> Passage:
    """Return events for the checker, with their windows as the certificate has them."""
    pairs = [window(event.window) for event in events]
    return Passage(list(words(events)), [(Fraction(a), Fraction(b)) for a, b in pairs])


def _enclosure(ends: tuple[Fraction, Fraction]) -> Enclosure:
    return Enclosure(*ends, ("", ""))
