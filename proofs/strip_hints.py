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
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Enclosure
from cap.checker.release.sheared import Line, Near, Passage
from cap.checker.release.strip import Strip
from cap.checker.system.walls import Parameters as Checked
from cap.errors import NotProved
from cap.flow.windows import Itinerary
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
        claim = {
            "interval": _enclosure(found.lower, found.upper),
            "shear": family.shear,
            "pieces": [{"f": _enclosure(family.low, family.high)}],
        }
        self.make: Callable[..., Strip] = partial(Strip, p, CHECKED, claim=claim, hint={})
        self.strip = self.made(1)
        self.known = dict[tuple[Fraction, Fraction], Any]()

    def made(self, turn: int) -> Strip:
        """Return a strip of the checker."""
        return self.make(turn, self.halves())

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

    def images(self, part: Family, sequence: str, near: piece.Line) -> list[Near]:
        """Return the first images of c, which are followed; raise `NotProved` if none is."""
        H, known = self.strip.on((part.low, part.high)), list[Near]()
        try:
            c, value = self.strip.critical(H, Line(near.at, near.rate), near.reach)
            for image in self.strip.images(H, sequence, c, value):
                known.append(image)
        except Rejected as reason:
            if not known:
                raise NotProved("checker", str(reason)) from None
        return known

    def contracts(self, part: Family, images: list[Near], cycle: piece.Attracting) -> bool:
        """Return whether J is contracted, and an image of c lies there, on a piece."""
        strip = self.strip
        try:
            strip.cycle(strip.on((part.low, part.high)), asdict(cycle), images)
        except Rejected:
            return False
        return True


def passage_of(events: Itinerary) -> Passage:
    """Return events for the checker, with their windows as the certificate has them."""
    pairs = [window(event.window) for event in events]
    return Passage(list(words(events)), [(Fraction(a), Fraction(b)) for a, b in pairs])


def _enclosure(low: Fraction, high: Fraction) -> Enclosure:
    return Enclosure(low, high, ("", ""))
