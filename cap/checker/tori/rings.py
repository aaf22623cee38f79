"""Rings: polygons around a point O, as seen from which their vertices go around once.

The vertices are O + w_i, w_i in units 10^-9.  Every w_i is followed by one that is turned by an
angle in (0, pi), anticlockwise; the angles add up to one turn: only the last vertex is below the
axis of y and followed by one that is not.  So the sectors between neighbours tile the plane, and
the polygon is simple and star-shaped; its inside is the union of the triangles O, w_i, w_(i+1).

*Outside.*  A convex set that lies in the cone from w_i to w_j, narrower than half a turn, can meet
only the edges of that cone.  It does not meet an edge if a line separates them: one along the edge,
or one along the axes of a rectangle that contains the set.  If one of its points is in none of the
triangles of the cone, and it meets none of the edges, it lies outside.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import need
from cap.checker.tori.segments import Segment, Vector

UNIT = Fraction(1, 10**9)
MAX_VERTICES = 20_000
VERTICES = re.compile("-?[0-9]{1,12} -?[0-9]{1,12}(,-?[0-9]{1,12} -?[0-9]{1,12})*")
Offset = tuple[int, int]


def offsets(words: str) -> list[Offset]:
    """Return the vertices of a ring, as integers."""
    need(VERTICES.fullmatch(words) is not None, "a ring is no list of vertices")
    need(words.count(",") < MAX_VERTICES, f"a ring has more than {MAX_VERTICES} vertices")
    pairs = [part.split(" ") for part in words.split(",")]
    return [(int(y), int(v)) for y, v in pairs]


class Ring:
    """A polygon around O."""

    def __init__(self, centre: tuple[Fraction, Fraction], w: Sequence[Offset]) -> None:
        following = [*zip(w, [*w[1:], w[0]], strict=True)]
        ahead = all(a * d > b * c for (a, b), (c, d) in following)
        need(ahead, "a vertex is not followed by one farther around")
        passed = [k for k, ((_, b), (_, d)) in enumerate(following) if b < 0 <= d]
        need(passed == [len(w) - 1], "the vertices do not go around once, from the axis")
        self.w = w
        self.origin = enclosing(centre[0]), enclosing(centre[1])
        self.angles = [math.atan2(b, a) % (2 * math.pi) for a, b in self.w]
        places = (tuple(z + n * UNIT for z, n in zip(centre, each, strict=True)) for each in self.w)
        self.states: list[Vector] = [(enclosing(y), enclosing(v)) for y, v in places]

    def edges(self) -> list[tuple[Vector, Vector]]:
        """Return all edges, in this order."""
        return [*pairwise([*self.states, self.states[0]])]

    @property
    def area(self) -> Fraction:
        """The area inside, exactly."""
        w = self.w
        twice = sum(a * d - b * c for (a, b), (c, d) in pairwise([*w, w[0]]))
        return twice * UNIT**2 / 2

    def surrounds(self, reach: Fraction) -> bool:
        """Return whether all points within so much of O, in y and in v, are inside.

        Then they are on the left side of all edges; a reach of less than a unit is one.
        """
        n = math.ceil(reach / UNIT)
        sides = pairwise([*self.w, self.w[0]])
        return all(a * d - b * c > n * (abs(c - a) + abs(d - b)) for (a, b), (c, d) in sides)

    def excludes(self, z: Segment, sign: float) -> bool:
        """Return whether all states of a segment, read in this sense, certainly lie outside."""
        m = Double(sign * z.y) - self.origin[0], Double(z.v) - self.origin[1]
        axes = _Axes(z, sign)
        cone = self._cone(axes, m)
        if not cone:
            return False
        corners = [self.states[i % len(self.w)] for i in cone]
        away = [axes.of(y - sign * z.y, v - z.v) for y, v in corners]
        if not all(axes.misses(p, q) for p, q in pairwise(away)):
            return False
        return all(self._beyond(i, m) for i in cone[:-1])

    def _cone(self, axes: _Axes, m: Vector) -> range:
        """Return the vertices from one ray to another between which all states certainly lie."""
        n, here = len(self.w), math.atan2(m[1].mid, m[0].mid)
        far = math.hypot(m[0].mid, m[1].mid)
        if not axes.radius < far:
            return range(0)
        wide = math.asin(axes.radius / far) + 1e-9
        first, last = (self._sector(here + side * wide) for side in (-1, 1))
        if last < first:
            last += n
        low, high = self.w[first % n], self.w[(last + 1) % n]
        if last - first >= n - 1 or low[0] * high[1] <= low[1] * high[0]:
            return range(0)
        left = _cross(low, m).lower > axes.reach(low)
        right = _cross(high, m).upper < -axes.reach(high)
        return range(first, last + 2) if left and right else range(0)

    def _sector(self, angle: float) -> int:
        """Return the number of the vertex before an angle; it only steers."""
        return (bisect_right(self.angles, angle % (2 * math.pi)) - 1) % len(self.w)

    def _beyond(self, i: int, m: Vector) -> bool:
        """Return whether m is certainly not in the triangle O, w_i, w_(i+1)."""
        low, high = self.w[i % len(self.w)], self.w[(i + 1) % len(self.w)]
        edge = high[0] - low[0], high[1] - low[1]
        area = float(UNIT) * (low[0] * high[1] - low[1] * high[0])
        outer = _cross(edge, m) + Double(area, 1e-15 * area)
        return _cross(low, m).upper < 0 or _cross(high, m).lower > 0 or outer.upper < 0


def _cross(w: Offset, m: Vector) -> Double:
    """Return det(w, m)."""
    return m[1] * float(w[0]) - m[0] * float(w[1])


class _Axes:
    """The axes along a segment and across; a rectangle there contains its states, around m."""

    def __init__(self, z: Segment, sign: float) -> None:
        self.z, self.sign = z, sign
        a, b = z.direction()
        a *= sign
        self.a, self.b = a, b
        self.long, self.wide = z.reach(sign * a, b), z.reach(-sign * b, a)
        self.radius = math.hypot(self.long, self.wide)

    def of(self, y: Double, v: Double) -> Vector:
        """Return (y, v) in these axes."""
        return y * self.a + v * self.b, v * self.a - y * self.b

    def reach(self, w: Offset) -> float:
        """Return a bound of |det(w, z - m)| over the states z."""
        return self.z.reach(-self.sign * w[1], float(w[0]))

    def misses(self, p: Vector, q: Vector) -> bool:
        """Return whether the rectangle certainly does not meet the edge from p to q."""
        for k, half in ((0, self.long), (1, self.wide)):
            if min(p[k].lower, q[k].lower) > half or max(p[k].upper, q[k].upper) < -half:
                return True
        side = p[0] * q[1] - p[1] * q[0]
        width = (q[1] - p[1]).magnitude * self.long + (q[0] - p[0]).magnitude * self.wide
        return abs(side.mid) - side.rad > width * (1 + 1e-12)
