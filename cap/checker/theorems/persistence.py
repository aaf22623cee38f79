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
from typing import Any

from cap.checker.flow.events import CELL_WORK, LossyMap, determinant
from cap.checker.flow.itinerary import MAX_WORK, Passage
from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many
from cap.checker.maps.fixed_point import (
    CENTRE,
    INVERSE,
    STATE,
    WINDOWS,
    Point,
    krawczyk,
    krawczyk_theorem,
)
from cap.checker.theorems.periodic import Periodic

_BITS = 64  # a rectangle is much wider than 2^-64
_ORDER = 3
MAX_CELLS = MAX_WORK // CELL_WORK
CELL = {"centre": CENTRE, "preconditioner": INVERSE, "events": WINDOWS}
MARKS = Many(number, 2, MAX_CELLS + 1)


class Persistence(Periodic):
    """An orbit of hits, and its continuation into a range of losses."""

    # fmt: off
    HINTS = (
        *Periodic.HINTS,
        Field("cells", Many(CELL, 1, MAX_CELLS), "", "", "the same, for each box of the range"),
    )
    CLAIMS = (
        *Periodic.CLAIMS,
        Field("range", {"epsilon": MARKS, "mu": MARKS, "boxes": Many(STATE, 1, MAX_CELLS)}, "", "",
              "two increasing lists from 0 on, epsilon below 1, and a box for each rectangle of "
              "the grid, mu changing fastest"),
    )
    # fmt: on
    CITES = (
        krawczyk_theorem(
            "Phi is continuously differentiable on box, and on each box of range for all its "
            "epsilon and mu: all hits are transverse and no velocity vanishes",
            "K(box) lies in the interior of the box, and so does K of each box of range, formed "
            "with all its epsilon and mu",
            "box, range",
        ),
    )

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: the grid has as many rectangles as there are boxes and cells."""
        super().limit(hints, claims)
        grid = claims["range"]
        rectangles = (len(grid["epsilon"]) - 1) * (len(grid["mu"]) - 1)
        for cells in (grid["boxes"], hints["cells"]):
            need(len(cells) == rectangles, "the grid has not as many rectangles as cells")
        for cell in hints["cells"]:
            events = len(hints["events"])
            need(len(cell["events"]) == events, f"events of a cell are not a list of {events}")

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
        boxes = [[box[z][:2] for z in ("x", "v")] for box in self.claims["range"]["boxes"]]
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
        windows = [w[:2] for w in cell["events"]]
        phi = LossyMap(self.p, windows, self.claims["itinerary"], 1, {"e": e, "mu": mu})
        _, K = krawczyk(phi, box, cell, _BITS, _ORDER)
        orbit = phi.over(K, [z.midpoint() for z in K], _ORDER)
        trace = (orbit.x[1, 0, 0, 0] + orbit.v[0, 1, 0, 0]).magnitude()
        attracts = trace.is_before(determinant(orbit) + 1)
        need(attracts, "|trace| < 1 + determinant may fail in a rectangle")
        return K

    def words(self) -> str:
        """Return the theorem in one line."""
        marks = self.claims["range"]
        return super().words() + self.told(
            _PERSISTENCE,
            epsilon=marks["epsilon"][-1],
            most=marks["mu"][-1],
            degree=2 * len(self.claims["itinerary"]),
        )


def _lies_in(point: Point, box: list[tuple[Fraction, Fraction]]) -> bool:
    """Return whether an enclosure of a point lies in a box."""
    return all(z.lies_in(*side) for z, side in zip(point, box, strict=True))


_PERSISTENCE = (
    "; moreover, for all 0 <= epsilon <= {epsilon} and 0 <= mu <= {most} in the place of 1 - e and "
    "mu, Phi has one and only one fixed point P(epsilon, mu) in the box that the certificate gives "
    "for (epsilon, mu), with the same itinerary; P is one real analytic function of (epsilon, mu), "
    "with the value P* at the parameters above; its determinant is exp(-mu T) (1 - "
    "epsilon)^{degree}, and |trace| < 1 + determinant: so P(epsilon, mu) is asymptotically stable "
    "for all (epsilon, mu) but (0, 0), and elliptic there"
)

THEOREM = Persistence
