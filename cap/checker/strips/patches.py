"""Patches: launches between two arcs over the same times, and where all of them land.

Notation as in `cap.checker.strips.arc`.  A *patch* is the set of the launches (t, E) with t = t_0 +
t_1 s and E between the values of two arcs, ``low`` and ``high``, at the same s in [-1, 1].

*All of it reaches the wall* if the launches of ``low`` do: at one time t, of two launches the
faster is ahead in place and in speed as long as both fly; it hits first.  Each launch of the patch
is on an arc whose coefficients are between those of the two.  What is known of all these arcs (T is
at s = 0 between the times of the two) holds for it.

*Where it lands.*  At one time t let the speed u of a launch grow from ``low`` to ``high``.  Then

    dT/du = -d/V < 0,      dV/du = 1 - A d/V,      d(V^2/2)/du = V - A d,

so T falls, in all by at most ``wait``, the largest d/(V u) times the largest difference in E.  For
an edge q and Z = V^2/2 - q(T),

    V dZ/du = V^2 - A d V + d q'(T).

Let dZ/dT have one sign, and be at least ``gain`` > 0 in size, for an edge below a target, in a
column and up to ``wait`` beyond its lines, where the edge is continued as a parabola.  Then all of
the patch that lands in the column is above the edge, if

- Z grows with u, ``low`` is above the edge whenever it lands in the column, and Z + gain (T - T_1)
  >= 0 whenever it lands less than ``wait`` later than the line T_1: what lands in the column began
  there, or so much later at most, and on the way to the line has gained what was missing;
- or Z falls with u, ``high`` is above the edge whenever it lands in the column, and Z + gain (T_1 -
  T) >= 0 whenever it lands less than ``wait`` earlier than the line T_1.

In the same way it is below an edge above a target, with ``low`` and ``high`` exchanged.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.doubles import Double, between
from cap.checker.kernel.parabolas import Edge
from cap.checker.kernel.rejection import need
from cap.checker.strips.arc import Arc, Launches, everywhere, negative
from cap.checker.strips.images import Bends, Image, image
from cap.checker.strips.landing import MORE, Place, Target

ROOM = 1e-12  # more than the rounding of a time


class Patch(NamedTuple):
    """The launches between two arcs over the same times."""

    low: Arc
    high: Arc

    @property
    def arcs(self) -> Arc:
        """All arcs between the two, as one with intervals of coefficients."""
        e, e1, e2 = (_hull(p, q) for p, q in zip(self.low[2:], self.high[2:], strict=True))
        return Arc(self.low.t, self.low.dt, e, e1, e2)

    @property
    def height(self) -> float:
        """A number above all differences of E at one time."""
        rest = (q.mid - p.mid for p, q in zip(self.low[2:], self.high[2:], strict=True))  # exact
        a, b, c = map(abs, rest)
        return (a + b + c) * MORE


class Spread:
    """The image of a patch all of whose flights reach the other wall."""

    low: Image
    high: Image

    def __init__(self, patch: Patch, f: Double, R: Double) -> None:
        whole = everywhere(patch.arcs)
        low = Launches(patch.low, f, R, whole)
        high = Launches(patch.high, f, R, whole, low.hit.T.mid)
        bends = Bends(low, _hull(low.hit.T, high.hit.T), low.hit.T1)
        need(low.moves(bends.T.upper), "a flight may stop")
        self.launches, self.bends = (low, high), bends
        d, V = bends.d, bends.V
        self.rate = (V / d - bends.A) * V
        self.wait = (d / (V * whole.u) * patch.height).magnitude + ROOM

    def roughly(self, shift: Double) -> Spread:
        """Find where both arcs land, with all times moved, by what is known of all of the patch."""
        self.low, self.high = (Image(each, self.bends).move(shift) for each in self.launches)
        return self

    def sharply(self, shift: Double) -> Spread:
        """Find it by what is known of each arc alone."""
        self.low, self.high = (image(each.alone()).move(shift) for each in self.launches)
        return self

    @property
    def times(self) -> Double:
        """All times of the hits."""
        return between(self.high.times.lower, self.low.times.upper)

    def places(self, between: tuple[float, float]) -> tuple[Place, Place]:
        """Return where both arcs land, in a column and near it.

        If one of them has no part there, the patch has none in the column.
        """
        return Place(self.low, between, self.wait), Place(self.high, between, -self.wait)

    def lands(self, low: Place, high: Place, target: Target) -> bool:
        """Return whether all that lands in a column is in a target, from where both arcs land."""
        return self.above(target.lower, low, high) and self.below(target.upper, low, high)

    def above(self, edge: Edge | None, low: Place, high: Place) -> bool:
        """Return whether all that lands in a column is certainly above an edge."""
        if edge is None:
            return True
        gain = self.gain(edge, low)
        place = low if gain < 0 else high
        return place.clears(place.gap(edge), abs(gain))

    def below(self, edge: Edge | None, low: Place, high: Place) -> bool:
        """Return whether all that lands in a column is certainly below an edge."""
        if edge is None:
            return True
        gain = self.gain(edge, low)
        place = high if gain < 0 else low
        return place.clears(negative(place.gap(edge)), abs(gain))

    def gain(self, edge: Edge, place: Place) -> float:
        """Return dZ/dT for an edge or, of its values, the one nearest to 0; it is not 0."""
        _, b, c = place.parabola(edge)
        slope = Double(b, abs(c) * (2 * self.wait + place.width) * MORE)
        gain = -(self.rate + slope)
        need(gain.lower > 0 or gain.upper < 0, "an edge may be met along a patch")
        return gain.lower if gain.lower > 0 else gain.upper


def _hull(p: Double, q: Double) -> Double:
    """Return an interval that contains two."""
    return between(min(p.lower, q.lower), max(p.upper, q.upper))
