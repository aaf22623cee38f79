"""Persistence: the fixed point continues analytically into a range of losses, and attracts there.

A grid of rectangles covers the range of (epsilon, mu), e = 1 - epsilon.  For each, with its box Z:

1. K(Z), formed with all (epsilon, mu) of the rectangle at once, lies in the interior of Z, and all
   orbits from Z have the itinerary.  So for each (epsilon, mu) of the rectangle Phi has exactly one
   fixed point P in Z; it lies in K(Z).
2. Over K(Z), |trace| < 1 + det, det = exp(-mu T) (1 - epsilon)^(2 hits).  As there are hits, det <
1
   but at (0, 0), where det = 1: P attracts (cf. ``periodic``) but at (0, 0), where it is elliptic.

*One function.*  If rectangles share an edge, K(Z) of one lies in the box Z' of the other: so on the
edge its P is the only fixed point in Z', the other P.  Hence P is well defined on the range; at a
corner, go around it by edges.

*Analytic.*  Near a fixed point with this itinerary Phi is analytic in x, v, e and mu
(``itinerary``), also for mu < 0, and det(1 - Phi') = 1 - trace + det > 0: by the implicit function
theorem an analytic function of (epsilon, mu) goes through it, of fixed points.  Near the given
(epsilon, mu) its values lie in the interior of the box of each rectangle that contains this point,
hence are P in each of them.

*P* is P there*: it is a fixed point in the box of a rectangle that contains its (epsilon, mu).
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product

from cap.checker.flow.fixed_point import Point, ends, krawczyk
from cap.checker.flow.itinerary import Passage, PeriodMap, determinant
from cap.checker.flow.mechanics import Ends, Losses
from cap.checker.kernel.rejection import need
from cap.checker.theorems.periodic import Periodic

_BITS = 64  # a rectangle is much wider than 2^-64
_ORDER = 3


class Persistence(Periodic):
    """An orbit of hits, and its continuation into a range of losses."""

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:
        """Prove the theorem for P*, then the continuation."""
        words, kind = self.claims["itinerary"], self.claims["type"]
        need(self.claims["period"] == 1, "the period is not 1")
        need(all(w.startswith("hit") for w in words), "an event of the itinerary is not a hit")
        attracts = kind == "elliptic" or kind.startswith("sink")
        need(attracts, "the type is neither a sink nor elliptic")
        super().conclude(fixed_point, orbit)
        self.continuation(fixed_point)

    def continuation(self, fixed_point: Point) -> None:
        """Prove the claims about the range."""
        sides = [self.intervals(name) for name in ("epsilon", "mu")]
        need(sides[0][-1][1] < 1, "epsilon is not below 1")
        rectangles = list(product(sides[0], sides[1]))
        boxes = [[ends(box[z]) for z in ("x", "v")] for box in self.claims["range"]["boxes"]]
        images = [self.rectangle(n, q, boxes[n]) for n, q in enumerate(rectangles)]
        self.step(f"{len(images)} rectangles: in each one fixed point, |trace| < 1 + determinant")
        width = len(sides[1])
        for n in range(len(images)):
            right = [n + 1] if (n + 1) % width else []
            for m in [*right, *([n + width] if n + width < len(images) else [])]:
                joined = _lies_in(images[n], boxes[m]) or _lies_in(images[m], boxes[n])
                need(joined, "two fixed points on a common edge of two rectangles may differ")
        self.step("the fixed points agree on all edges")
        here = (1 - self.p.e, self.p.mu)
        around = [
            boxes[n]
            for n, q in enumerate(rectangles)
            if all(low <= z <= high for z, (low, high) in zip(here, q, strict=True))
        ]
        need(len(around) > 0, "e and mu are not in the range")
        need(any(_lies_in(fixed_point, box) for box in around), "P* may not be the one continued")
        self.step("P* is one of them")

    def intervals(self, name: str) -> list[Ends]:
        """Return the intervals between the numbers on one side of the grid."""
        marks = self.claims["range"][name]
        need(marks[0] == 0, f"{name} does not begin with 0")
        need(all(a < b for a, b in pairwise(marks)), f"{name} does not increase")
        return list(pairwise(marks))

    def rectangle(self, n: int, losses: tuple[Ends, Ends], box: list[Ends]) -> Point:
        """Return an enclosure of the fixed points for one rectangle of losses; they attract."""
        cell, (epsilon, mu) = self.hints["cells"][n], losses
        e = 1 - epsilon[1], 1 - epsilon[0]
        windows = [ends(w) for w in cell["events"]]
        phi = PeriodMap(self.p, self.claims["itinerary"], windows, 1, Losses(e, mu))
        K = krawczyk(phi, box, cell, _BITS, _ORDER)
        orbit = phi.over(K, [z.midpoint() for z in K], _ORDER)
        trace = (orbit.x.slope(0) + orbit.v.slope(1)).magnitude()
        attracts = trace.is_before(determinant(orbit) + 1)
        need(attracts, "|trace| < 1 + determinant may fail in a rectangle")
        return K


def _lies_in(point: Point, box: list[tuple[Fraction, Fraction]]) -> bool:
    """Return whether an enclosure of a point lies in a box."""
    return all(z.lies_in(*side) for z, side in zip(point, box, strict=True))
