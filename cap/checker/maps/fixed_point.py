"""What the theorems about a fixed point share: it exists, and the claims contain what is computed.

Here Phi is the map of the theorem: over one period, or over n of them.

1. *Existence.*  For a point m of a box Z and a matrix C, with Phi' enclosed over Z, let

       K(Z) = m - C (Phi(m) - m) + (1 - C (Phi'(Z) - 1)) (Z - m).

   If K(Z) lies in the interior of Z, Phi has exactly one fixed point in Z, and it lies in K(Z)
   [Krawczyk].  C need not be close to anything: the inclusion proves that it is regular.  The
   rows of G = 1 - C (Phi - 1) are put in mean value form: what their terms have in common cancels,
   and K is G(m) + G'(Z) (Z - m).  If Phi depends on parameters in intervals, they are variables of
   G: for all their values q, G(m; q) lies in G(m; q_0) + (the derivatives in q) (q - q_0).
2. *Localisation.*  The same for a small rectangle S = m +- radius (R, R omega) in the box, where
   R = r - l: the fixed point in S is the one of the box.
3. *The orbit* of the fixed point P* in K(S): each claim contains the enclosure computed here, and
   is as narrow as the digits that it claims.
4. *The conclusion* is drawn from the numbers claimed, which contain the true ones.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from operator import sub
from typing import Any, ClassVar

from cap.checker.flow.hits import Hit
from cap.checker.flow.itinerary import MAX_EVENTS, Passage, PeriodMap
from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.citation import NEUMAIER, Citation, cite
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import lift, mean_value
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, enclosure, region
from cap.checker.kernel.theorem import BITS
from cap.checker.system.walls import BetweenWalls

STATE = {"x": region, "v": region}
WINDOWS = Many(enclosure, 1, MAX_EVENTS)
CENTRE, INVERSE = [number] * 2, [[number] * 2] * 2
Point = tuple[Interval, Interval]

KRAWCZYK_ORDER = 4  # of the jets over the box: the higher, the larger the box may be


def krawczyk_theorem(smooth: str, inclusion: str, by: str = "box") -> Citation:
    """Return the citation of Krawczyk's theorem."""
    hypotheses = ("smooth", smooth, by), ("inclusion", inclusion, by)
    return cite("Krawczyk", NEUMAIER, *hypotheses)


def krawczyk(
    phi: PeriodMap, region: Sequence[Ends], hints: dict[str, Any], bits: int, order: int
) -> tuple[Passage, Point]:
    """Return the orbits from a region, which contains the centre m, and K of it.

    K lies in the interior of the region, and every orbit has the itinerary of the map.
    """
    inside = zip(region, hints["centre"], strict=True)
    need(all(z[0] <= m <= z[1] for z, m in inside), "the centre is not in the box")
    box = [Interval.enclosing(*z, bits) for z in region]
    centre = [Interval.enclosing(m, m, bits) for m in hints["centre"]]
    image = phi.over(box, centre, order)
    start, K = image.mechanics.variables[:2], list[Interval]()
    moved = [lift(sub, w, z) for w, z in zip((image.x, image.v), start, strict=True)]
    for row, z, side in zip(hints["preconditioner"], start, region, strict=True):
        p, q = (Interval.enclosing(entry, entry, bits) for entry in row)
        G = lift(lambda x, v, z, p=p, q=q: z - x * p - v * q, *moved, z)  # z - C (Phi - 1)
        K.append(mean_value(G.box.origin, G.box.coefficients, G.centre, G.offsets))
        need(K[-1].lies_inside(*side), "K does not lie in the interior of its box")
    return image, (K[0], K[1])


class FixedPoint(BetweenWalls):
    """A theorem about a fixed point."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("centre", CENTRE, "", "m", "a point near P*, in the box"),
        Field("radius", number, "", "", "S = m +- radius (R, R omega): P* lies in K(S)"),
        Field("preconditioner", INVERSE, "", "C", "near (Phi'(m) - 1)^-1"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("box", STATE, "", "", "a set that contains exactly one fixed point P* of Phi"),
        Field("x", Quantity("R"), "x", "x", "P*"),
        Field("v", Quantity("R omega"), "v", "v", "P*"),
        Field("hit_speeds", Many(Quantity("R omega"), 0, MAX_EVENTS), "hit speed", "|v_k|",
              "|v| before each hit"),
        Field("jacobian", [[Quantity(), Quantity("omega^-1")], [Quantity("omega"), Quantity()]],
              "Jacobian", r"D\Phi(P^*)", "rows of Phi'(P*), column order (x, v)"),
        Field("trace", Quantity(), "trace", r"\operatorname{tr} D\Phi(P^*)", "of Phi'(P*)"),
        Field("determinant", Quantity(), "determinant", r"\det D\Phi(P^*)", "of Phi'(P*)"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        self.existence()
        fixed_point = self.localisation()
        orbit = self.near(fixed_point, fixed_point, 2)  # the Jacobian is in mean value form then
        self.orbit(fixed_point, orbit)
        self.conclude(fixed_point, orbit)

    def orbit(self, fixed_point: Point, orbit: Passage) -> None:
        """Compare the claims about P* and its orbit with what is computed."""
        self.confirm(x=fixed_point[0], v=fixed_point[1], jacobian=orbit.jacobian)
        self.confirm(hit_speeds=[e.speed.value for e in orbit.events if isinstance(e, Hit)])
        self.confirm(trace=orbit.x[1, 0] + orbit.v[0, 1])

    @property
    @abstractmethod
    def phi(self) -> PeriodMap:
        """The map, with its itinerary and time windows."""

    @abstractmethod
    def conclude(self, fixed_point: Point, orbit: Passage) -> None:
        """Prove what the theorem says about the fixed point and its orbit."""

    @property
    def box(self) -> list[Ends]:
        """The box claimed."""
        return [self.claims["box"][z][:2] for z in ("x", "v")]

    def existence(self) -> None:
        """Prove that Phi has exactly one fixed point in the box claimed."""
        orbits, _ = krawczyk(self.phi, self.box, self.hints, self.hints["bits"], KRAWCZYK_ORDER)
        words = ", ".join(event.word for event in orbits.events)
        self.step(f"all orbits from the box have the itinerary: {words}")
        self.step("K(box) lies in the interior of the box: exactly one fixed point")

    def localisation(self) -> Point:
        """Return K(S), which contains the fixed point."""
        sides = [self.hints["radius"] * scale for scale in (self.R, self.R * self.omega)]
        small = [(m - a, m + a) for m, a in zip(self.hints["centre"], sides, strict=True)]
        S = [Interval.enclosing(*side, self.hints["bits"]) for side in small]
        need(self.is_in_the_box(S), "S is not in the box")
        _, K = krawczyk(self.phi, small, self.hints, self.hints["bits"], KRAWCZYK_ORDER)
        self.step("K(S) lies in the interior of S, which lies in the box: K(S) contains P*")
        return K

    def is_in_the_box(self, rectangle: Sequence[Interval]) -> bool:
        """Return whether a rectangle lies in the box claimed."""
        return all(z.lies_in(*side) for z, side in zip(rectangle, self.box, strict=True))

    def near(self, box: Sequence[Interval], point: Point, order: int) -> Passage:
        """Return the orbits of a box around an enclosure of a point."""
        return self.phi.over(box, [z.midpoint() for z in point], order)
