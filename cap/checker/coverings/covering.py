"""Coverings: when the image of a parallelogram lies across another one.

A *set* is N = c + A [-1, 1]^2, A = (a, b) invertible; p and q are the coordinates of c + p a + q b.
Let g be continuously differentiable on N, (P, Q) the coordinates of g with respect to M.

    N covers M:   P < -1 for all points with p = -1 and P > 1 for all with p = 1, or vice versa;
                  at each point of N: P < -1, or P > 1, or |Q| < 1.

*Lemma 1.*  Along each bi-infinite path ... -> N_(-1) -> N_0 -> N_1 -> ... of coverings there is an
orbit z_k in N_k, g(z_k) = z_(k+1).  *Proof.*  Let a curve cross N: p runs on it from -1 to 1, |q|
<= 1.  If N covers M, P runs on its image from below -1 to above 1, or back; let t' be the first
time with P = 1 (or -1), s' the last time before with P = -1 (or 1).  Between them |P| <= 1, so |Q|
< 1: this part of the curve is in N, and its image crosses M.  Begin with a curve across N_(-n):
nested compact parts of it have a common point, with an orbit in N_(-n), N_(-n+1), ...  For n ->
infinity a diagonal sequence of these orbits converges, as the sets are compact and g is continuous
on them.

*Lemma 2.*  A closed path of n coverings has an orbit with g^n(z_0) = z_0.  *Proof.*  |Q| <= 1 - s,
s > 0, where |P| <= 1, by compactness; let Q~ be Q, clamped to [-1 + s, 1 - s].  Of the 2n functions
P(g(z_k)) - p_(k+1) and Q~(g(z_k)) - q_(k+1) of (p_k, q_k), k modulo n, the first have opposite
signs at p_k = -1 and p_k = 1, the second at q_(k+1) = -1 and q_(k+1) = 1.  By the theorem of
Poincare and Miranda they have a common zero.  There |P| = |p_(k+1)| <= 1, so Q~ = Q.

*How it is checked.*  On a box with the midpoint m, (P, Q) = A_M^-1 (g(m) - c_M) + B (p - m_p, q -
m_q) with B in A_M^-1 Dg(box) A_N, by the mean value theorem, for each of the two.  Boxes are halved
until all is decided; a set with more than ``MOST`` boxes is rejected.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.coverings.planar import Image, Planar, Row, applied
from cap.checker.kernel.doubles import Double, between, enclosing
from cap.checker.kernel.rejection import Rejected, need

MOST = 3000  # boxes for the coverings of one set
_LEFT, _RIGHT = -1, 1
_SMALL = 2.0**-8  # boxes on which g is not seen to be defined are halved down to this


class Box(NamedTuple):
    """Points with p in [p0, p1] and q in [q0, q1]."""

    p0: float
    p1: float
    q0: float
    q1: float


WHOLE = Box(-1.0, 1.0, -1.0, 1.0)
EDGES = Box(-1.0, -1.0, -1.0, 1.0), Box(1.0, 1.0, -1.0, 1.0)


class Parallelogram:
    """A set: its centre and axes exactly, and enclosures of them and of the inverse of A."""

    def __init__(self, numbers: Sequence[Fraction]) -> None:
        x, y, ax, ay, bx, by = self.numbers = tuple(numbers)
        determinant = ax * by - ay * bx
        need(determinant != 0, "the axes of a set are parallel")
        self.centre = enclosing(x), enclosing(y)
        self.axes = (enclosing(ax), enclosing(bx)), (enclosing(ay), enclosing(by))
        p, q, r, s = (enclosing(n / determinant) for n in (by, -bx, -ay, ax))
        self.inverse = (p, q), (r, s)

    def points(self, p: Double, q: Double) -> Row:
        """Return the least rectangle that is known to contain the points."""
        (ax, bx), (ay, by) = self.axes
        return self.centre[0] + ax * p + bx * q, self.centre[1] + ay * p + by * q

    def coordinates(self, x: Double, y: Double) -> Row:
        """Return p and q of points."""
        return applied(self.inverse, (x - self.centre[0], y - self.centre[1]))


class Seen(NamedTuple):
    """What is known of g on a box, before it is looked at from the targets."""

    middle: Image
    columns: tuple[Row, Row]  # of Dg A
    p: Double
    q: Double


def covers(g: Planar, source: Parallelogram, targets: Sequence[Parallelogram]) -> int:
    """Prove that a set covers others; return how many boxes were needed."""
    sides = [[_side(g, source, edge, target) for edge in EDGES] for target in targets]
    opposite = all(left == -right for (left, _), (right, _) in sides)
    need(opposite, "both edges of a set are mapped to the same side of another one")
    count = sum(boxes for both in sides for _, boxes in both)
    waiting = [(WHOLE, tuple(targets))]
    while waiting:
        count += 1
        need(count <= MOST, f"a set needs more than {MOST} boxes")
        box, open_ = waiting.pop()
        halves, left = _look(g, source, box, open_)
        if left:
            waiting += [(half, left) for half in halves]
    return count


def _side(g: Planar, source: Parallelogram, edge: Box, target: Parallelogram) -> tuple[int, int]:
    """Return on which side of a target the image of an edge lies, and the number of boxes."""
    waiting, found, count = [edge], set[int](), 0
    while waiting:
        count += 1
        need(count <= MOST, f"an edge needs more than {MOST} boxes")
        box = waiting.pop()
        try:
            side = _beyond(coordinates(seen(g, source, box), target)[0])
        except Rejected:
            need(box.q1 - box.q0 > _SMALL, "the map may not be defined on an edge")
            side = 0
        if side:
            found.add(side)
            need(len(found) == 1, "an edge is mapped to both sides of a set")
        else:
            waiting += halves(box, along_p=False)
    return found.pop(), count


def _look(
    g: Planar, source: Parallelogram, box: Box, targets: tuple[Parallelogram, ...]
) -> tuple[list[Box], tuple[Parallelogram, ...]]:
    """Return the halves of a box, and the targets for which it is not decided."""
    try:
        known = seen(g, source, box)
    except Rejected:
        need(min(box.p1 - box.p0, box.q1 - box.q0) > _SMALL, "the map may not be defined")
        wide = (box.p1 - box.p0) >= (box.q1 - box.q0)
        return halves(box, along_p=wide), targets
    left, along_p = list[Parallelogram](), True
    for target in targets:
        P, Q, by_p, by_q = coordinates(known, target)
        if not (_beyond(P) or Q.magnitude < 1):
            along_p = by_p >= by_q if not left else along_p
            left.append(target)
    return halves(box, along_p=along_p), tuple(left)


def seen(g: Planar, source: Parallelogram, box: Box) -> Seen:
    """Return what is known of g on a box of a set."""
    p, q = between(box.p0, box.p1), between(box.q0, box.q1)
    middle = g.image(*source.points(Double(p.mid), Double(q.mid)))
    (a, b), (c, d) = g.image(*source.points(p, q)).derivative
    (ax, bx), (ay, by) = source.axes
    columns = (a * ax + b * ay, c * ax + d * ay), (a * bx + b * by, c * bx + d * by)
    return Seen(middle, columns, p - p.mid, q - q.mid)


def coordinates(known: Seen, target: Parallelogram) -> tuple[Double, Double, float, float]:
    """Return P and Q on a box, and how much of their widths are due to p and to q."""
    x, y = known.middle.x - target.centre[0], known.middle.y - target.centre[1]
    found, widths = list[Double](), [0.0, 0.0]
    for m, n in target.inverse:
        by_p, by_q = (
            (m * u + n * w) * d for (u, w), d in zip(known.columns, known[2:], strict=True)
        )
        found.append(m * x + n * y + by_p + by_q)
        widths = [widths[0] + by_p.rad, widths[1] + by_q.rad]
    return found[0], found[1], widths[0], widths[1]


def _beyond(P: Double) -> int:
    """Return 1 if P > 1, -1 if P < -1, 0 if that is not certain."""
    if (P - 1.0).is_positive():
        return _RIGHT
    return _LEFT if (-P - 1.0).is_positive() else 0


def halves(box: Box, *, along_p: bool) -> list[Box]:
    """Return the halves of a box."""
    p0, p1, q0, q1 = box
    if along_p:
        return [Box(p0, (p0 + p1) / 2, q0, q1), Box((p0 + p1) / 2, p1, q0, q1)]
    return [Box(p0, p1, q0, (q0 + q1) / 2), Box(p0, p1, (q0 + q1) / 2, q1)]
