"""The theorem about homoclinic points: a saddle whose unstable and stable curves cross transversely
at points from which orbits never stop, forwards and backwards in time.

The proof is in ``maps.cones`` and ``maps.homoclinic``: the curves near the saddle, and far from it.
"""

from __future__ import annotations

from itertools import combinations
from typing import Any

from cap.checker.flow.itinerary import MAX_WORK, Passage
from cap.checker.kernel.citation import cite
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Whole, enclosure
from cap.checker.maps.cones import Cones
from cap.checker.maps.fixed_point import WINDOWS, Point
from cap.checker.maps.homoclinic import Orbit
from cap.checker.theorems.saddle import Saddle

MAX_POINTS, MAX_PERIODS = 8, 256
BASE = 256  # a flight at 0 bits takes as long as is added at so many bits
POINT = {"x": Quantity("R"), "v": Quantity("R omega"), "angle": Quantity()}
ORBIT = {
    "start": enclosure,
    "hit_times": Many(WINDOWS, 2, MAX_PERIODS),
    "periods": Whole(1, MAX_PERIODS),
}
SMALE = (
    "Smale-Birkhoff",
    "Katok and Hasselblatt, Introduction to the Modern Theory of Dynamical Systems, 1995, "
    "Theorem 6.5.5",
)


class Homoclinic(Saddle):
    """The curves of the saddle cross."""

    # fmt: off
    HINTS = (
        *Saddle.HINTS,
        Field("frame", [[number] * 2] * 2, "", "A", "its columns: near the directions of the "
              "unstable and the stable curve at P*"),
        Field("reach", number, "", "r", "the curves are graphs over |p| <= r, |q| <= r"),
        Field("slope", number, "", "L", "with slopes of at most L"),
        Field("orbits", Many(ORBIT, 1, MAX_POINTS), "", "", "for each point: p- and p+; windows of "
              "the hits in each period; the point is reached after so many periods"),
    )
    CLAIMS = (
        *Saddle.CLAIMS,
        Field("points", Many(POINT, 1, MAX_POINTS), "homoclinic point", "q_k", "points at which "
              "the unstable and the stable curve of P* cross, not P*, one from each of these "
              "boxes; the angle in degrees, in the plane in which R and R omega have the length 1"),
    )
    CITES = (
        *Saddle.CITES,
        cite(
            *SMALE,
            ("embedding", "Phi maps the states from which orbits never stop for a period, an open "
             "set, analytically, with Jacobian 1, and injectively: backwards in time such an orbit "
             "is determined by its end", "hit_speeds, least_speed"),
            ("hyperbolic", "P* is such a state, and a hyperbolic fixed point", "multipliers"),
            ("transverse", "the unstable and the stable curve of P* in this set cross transversely "
             "at a point that is not P*", "points"),
        ),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        super().limit(hints, claims)
        periods = [period for orbit in hints["orbits"] for period in orbit["hit_times"]]
        work = sum(len(hits) + 1 for hits in periods) * (hints["bits"] + BASE)
        need(work <= MAX_WORK, f"bits and orbits are too much: {work} > {MAX_WORK}")

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:
        """Prove that the saddle is one, where its curves are near it, and that they cross."""
        super().conclude(fixed_point, orbit)
        hints, points = self.hints, self.claims["points"]
        need(len(hints["orbits"]) == len(points), "not every point has its orbit")
        (a, b), (c, d) = ([self.number(entry) for entry in row] for row in hints["frame"])
        cones = Cones(fixed_point, ((a, b), (c, d)), hints["reach"], hints["slope"])
        cones.prove(self.phi)
        self.step("near P* its unstable and its stable curve are graphs with small slopes")
        for n, hint in enumerate(hints["orbits"]):
            self.crossing(n, cones, hint)
        self.apart(fixed_point)

    def crossing(self, n: int, cones: Cones, hint: dict[str, Any]) -> None:
        """Prove that the curves cross at one of the points."""
        k = hint["periods"]
        need(k < len(hint["hit_times"]), f"orbits[{n}] ends before its point")
        orbit = self.followed(cones, hint)
        orbit.crosses()
        x, v = orbit.places[k].box
        found = {"x": x, "v": v, "angle": orbit.angle(k, self.omega)}
        self.compare(f"points[{n}]", self.claims["points"][n], found)
        self.step(f"point {n + 1}: the curves cross transversely, and no orbit stops")

    def followed(self, cones: Cones, hint: dict[str, Any]) -> Orbit:
        """Return an orbit, with its hits proved."""
        windows = [[window[:2] for window in period] for period in hint["hit_times"]]
        return Orbit(cones, self.p, hint["start"][:2], windows)

    def apart(self, fixed_point: Point) -> None:
        """Check that the points are not P*, and that no two are the same."""
        boxes = [[point[z][:2] for z in ("x", "v")] for point in self.claims["points"]]
        saddle = [(z.lower, z.upper) for z in fixed_point]
        for one, other in combinations([saddle, *boxes], 2):
            apart = any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one, other, strict=True))
            need(apart, "a point may be P*, or another point")
        self.step("the points are not P*, and differ from each other")

    def words(self) -> str:
        """Return the theorem in one line."""
        outer, inner = self.claims["multipliers"]
        shown = "".join(_POINT.format_map(point) for point in self.claims["points"])
        return self.statement(_SADDLE + shown + _HENCE, outer=outer, inner=inner)


_SADDLE = (
    "the fixed point is a hyperbolic saddle with multipliers in {outer} and {inner}, and its "
    "unstable and its stable curve cross transversely at points that are not the fixed point, from "
    "which orbits never turn or stick, forwards and backwards in time:"
)
_POINT = " one with x in {x}, v in {v}, at an angle in {angle} degrees;"
_HENCE = (
    " hence (Smale-Birkhoff) some iterate of Phi has a horseshoe: a compact hyperbolic invariant "
    "set, of states from which orbits never turn or stick, on which it is conjugate to the full "
    "shift on two symbols"
)

THEOREM = Homoclinic
