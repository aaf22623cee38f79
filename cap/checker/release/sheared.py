"""The release map for an interval of f, in a coordinate that moves with f.

With f = F cos theta, a number theta_0 (of which an enclosure is known, the origin), and a number s,
let y = x - s (theta - theta_0).  For each f let H(y) be G(x), less s (theta - theta_0): a translate
of G, with the same kneading sequence and the same entropy.  With s near the velocity, by theta, of
the orbits in view, H depends on theta much less than G does, so enclosures of it over wide
intervals of f are narrow.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, lift, raised
from cap.checker.kernel.rejection import need
from cap.checker.release.driven import Driven, DrivenMap
from cap.checker.release.releases import next_release
from cap.checker.system.walls import Parameters

_HORIZON = 17  # periods


class Passage(NamedTuple):
    """The events that are to be proved, with their time windows."""

    words: Sequence[str]
    windows: Sequence[Ends]


class Line(NamedTuple):
    """The places y = at + rate (theta - theta_0)."""

    at: Fraction
    rate: Fraction


class Near(NamedTuple):
    """A function of theta: on a line, plus a number of an interval for each theta."""

    line: Line
    rest: Interval


class Sheared(NamedTuple):
    """H for all theta of an interval, with s and theta_0."""

    p: Parameters
    theta: Interval
    shear: Fraction
    origin: Interval
    half_periods: int
    order: int = 4  # of the jets

    def over(self, y: Interval, passage: Passage) -> Centred:
        """Return H as a jet in y and theta, for all y of an interval."""
        phi, M = self._mechanics([y], passage)
        return self._image(phi, M, M.variables[0])

    def near(self, line: Line, u: Interval, passage: Passage) -> Centred:
        """Return H as a jet in u and theta, for y = line + u."""
        phi, M = self._mechanics([u], passage)
        return self._image(phi, M, lift(_sum, M.variables[0], self._on(M, line)))

    def places(self, line: Line) -> Interval:
        """Return all places on a line."""
        at, rate = (Interval.enclosing(q, q, self.theta.bits) for q in line)
        return at + rate * (self.theta - self.origin)

    def straightened(self, value: Centred) -> Near:
        """Return a line, and an interval, so that the line and a number of that are the value."""
        theta, centre, (*_, last) = self.theta, value.centre, raised(value.box.origin)
        rate = centre.coefficients.get(last, theta.integer(0)).midpoint().lower
        start = centre.constant.midpoint().lower
        line = Line(start - rate * (theta.midpoint() - self.origin).lower, rate)
        slope = Interval.enclosing(rate, rate, theta.bits)
        at_centre = self._replace(theta=theta.midpoint()).places(line)
        origin = value.box.origin
        box = Jet(value.box.order, {origin: self.places(line), last: slope})
        straight = Centred(Jet(centre.order, {origin: at_centre, last: slope}), box, value.offsets)
        return Near(line, lift(_difference, value, straight).value)

    def distance(self, near: Near, line: Line) -> Interval:
        """Return an enclosure of the difference of a function from a line."""
        (a, b), (c, d) = near.line, line
        return self.places(Line(a - c, b - d)) + near.rest

    def _mechanics(self, places: list[Interval], passage: Passage) -> tuple[DrivenMap, Driven]:
        phi = DrivenMap(self.p, passage.windows, passage.words, _HORIZON)
        box = [*places, self.theta]
        return phi, phi.mechanics(box, [z.midpoint() for z in box], self.order)

    def _from_origin(self, M: Driven) -> Centred:
        """Return theta - theta_0."""
        return lift(_difference, M.theta, M.constant(self.origin))

    def _on(self, M: Driven, line: Line) -> Centred:
        rate = M.number(line.rate)
        rise = lift(lambda t: t * rate, self._from_origin(M))
        return lift(_sum, M.constant(M.number(line.at)), rise)

    def _image(self, phi: DrivenMap, M: Driven, y: Centred) -> Centred:
        s, zero = M.number(self.shear), M.constant(self.theta.integer(0))
        moved = lift(lambda t: t * s, self._from_origin(M))
        first, *later = M.minima[1]
        x = lift(_sum, y, moved)
        need(M.is_between_walls(x.value), "a release is not between the walls")
        start = M.flight(1, first, x, zero)._replace(minima=later, at_rest=True)
        place, taken = next_release(M, phi, start)
        need(taken == self.half_periods, "the release map takes another time")
        return lift(_difference, place, moved)


def _sum(x: RealJet, y: RealJet) -> RealJet:
    return x + y


def _difference(x: RealJet, y: RealJet) -> RealJet:
    return x - y
