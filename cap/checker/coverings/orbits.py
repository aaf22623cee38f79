"""Periodic orbits along closed paths of coverings: a box with exactly one point of each.

Let N_(i_0) -> N_(i_1) -> .. -> N_(i_n), i_n = i_0, be a closed path of coverings, B a box of states
with the midpoint m and half the widths r.  g is continuously differentiable on the sets.

*Lemma* (Krawczyk).  Let g^n be defined on B, C a matrix, d = C (g^n(m) - m), M a matrix of
intervals with 1 - C (Dg^n(z) - 1) for all z in B, and for both components

    |d_1| + |M_11| r_1 + |M_12| r_2 < r_1,       |d_2| + |M_21| r_1 + |M_22| r_2 < r_2.

Then g^n has exactly one fixed point in B, and it lies within |d| + |M| r of m.  *Proof.*  T(z) = z
- C (g^n(z) - z) has the derivative 1 - C (Dg^n(z) - 1).  By the mean value theorem |T(z) - m| <=
|d| + |M| r < r in each component.  As |M| r < r, T is a contraction in the norm max(|x|/r_1,
|y|/r_2), so it has exactly one fixed point; and all matrices in 1 - M are regular, of which C (Dg^n
- 1) is one: so C is regular, and the fixed points of T are those of g^n.

If the images of B under g^k lie in N_(i_k) for k = 0, .., n - 1, the orbit of the fixed point runs
along the path, for ever: it lies in Lambda (`graph`).  If they are disjoint from B for 0 < k < n,
its least period is n.  Two orbits of one period are different if no image of the box of one of them
meets the box of the other.

*How images are carried.*  z_k = m_k + D_k (z_0 - m_0) + e_k, m_0 = m, m_(k+1) a point near g(m_k),

    D_(k+1) = J D_k,    e_(k+1) = J e_k + (g(m_k) - m_(k+1)),    D_0 = 1,  e_0 = 0,

with J = Dg over the box of all these z_k, which contains m_k (e_k contains 0), by the mean value
theorem.  D_n contains Dg^n, and m_n + e_n the image of m.

*Saddles.*  The multipliers are the zeros of s^2 - t s + D, t the trace of Dg^n, D its determinant.
One of them is within the unit circle, the other beyond it, if and only if this polynomial has
different signs at 1 and -1: (1 + D)^2 < t^2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.coverings.covering import Parallelogram
from cap.checker.coverings.planar import Matrix, Planar, Row, applied, product
from cap.checker.kernel.doubles import Double, between, enclosing
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure

LONGEST, MOST_ORBITS = 12, 64


class Round(NamedTuple):
    """The images of a box under g, g^2, .., g^n; that of its midpoint, and the derivative on it."""

    boxes: list[Row]
    middle: Row
    derivative: Matrix

    @property
    def period(self) -> int:
        """Return n."""
        return len(self.boxes) - 1


def confirm_orbits(
    g: Planar, sets: list[list[Fraction]], edges: list[list[int]], orbits: Sequence[Any]
) -> None:
    """Check all orbits claimed: paths and boxes."""
    found = [confirm_orbit(g, sets, edges, orbit["path"], orbit["box"]) for orbit in orbits]
    for k, one in enumerate(found):
        for other in found[:k]:
            need(one.period != other.period or _misses(other.boxes, one.boxes[0]),
                 "two periodic orbits may be the same")  # fmt: skip


def confirm_orbit(
    g: Planar,
    sets: list[list[Fraction]],
    edges: list[list[int]],
    path: list[int],
    box: list[Enclosure],
) -> Round:
    """Check that one periodic orbit, a saddle with this least period, runs along a path."""
    need(max(path) < len(sets), "a path leads to no set")
    steps = zip(path, path[1:] + path[:1], strict=True)
    need(all(j in edges[i] for i, j in steps), "a path has a step that is no covering")
    x, y = _interval(box[0]), _interval(box[1])
    round_ = images(g, path, (x, y))
    for i, (u, v) in zip(path, round_.boxes[:-1], strict=True):
        inside = all(q.magnitude <= 1 for q in Parallelogram(sets[i]).coordinates(u, v))
        need(inside, "a periodic orbit may leave its sets")
    need(_misses(round_.boxes[1:-1], (x, y)), "the period of an orbit may not be its least")
    (a, b), (c, d) = round_.derivative
    det, trace = a * d - b * c, a + d
    beyond = trace * trace - (det + 1.0) * (det + 1.0)
    need(beyond.is_positive(), "a periodic orbit may not be a saddle")
    near = nearness((x, y), round_)
    for side, q, reach in zip(box, (x, y), near, strict=True):
        m = Fraction(q.mid)
        need(reach < min(side.upper - m, m - side.lower), "a box may not have one fixed point")
    return round_


def images(g: Planar, path: Sequence[int], box: Row) -> Round:
    """Return the images of a box along a path."""
    one, zero = Double(1.0), Double(0.0)
    D: Matrix = (one, zero), (zero, one)
    m, e, w = (box[0].mid, box[1].mid), (zero, zero), _around(box)
    boxes = [box]
    for i in path:
        middle, J = g.on(i).image(Double(m[0]), Double(m[1])), g.on(i).image(*boxes[-1]).derivative
        m = middle.x.mid, middle.y.mid
        e = _plus(applied(J, e), (middle.x - m[0], middle.y - m[1]))
        D = product(J, D)
        u, v = _plus(applied(D, w), e)
        boxes.append((u + m[0], v + m[1]))
    return Round(boxes, (e[0] + m[0], e[1] + m[1]), D)


def nearness(box: Row, round_: Round) -> list[float]:
    """Return |d| + |M| r of the lemma; C is nearly the inverse of Dg^n - 1 at the midpoint."""
    d = round_.middle[0] - box[0].mid, round_.middle[1] - box[1].mid
    (p, q), (r, s) = round_.derivative
    turn = (p - 1.0, q), (r, s - 1.0)
    det = turn[0][0].mid * turn[1][1].mid - q.mid * r.mid
    need(det != 0, "the fixed point may be degenerate")
    C = (
        (Double(turn[1][1].mid / det), Double(-q.mid / det)),
        (Double(-r.mid / det), Double(turn[0][0].mid / det)),
    )
    (a, b), (c, e) = product(C, turn)
    M = (a - 1.0, b), (c, e - 1.0)
    found = []
    for away, row in zip(applied(C, d), M, strict=True):
        reach = Double(away.magnitude)
        for entry, side in zip(row, box, strict=True):
            reach = reach + Double(entry.magnitude) * side.rad
        found.append(reach.upper)
    return found


def _around(box: Row) -> Row:
    """Return the differences of the points of a box from its midpoint."""
    return Double(0.0, box[0].rad), Double(0.0, box[1].rad)


def _plus(u: Row, v: Row) -> Row:
    return u[0] + v[0], u[1] + v[1]


def _interval(side: Enclosure) -> Double:
    """Return an interval of doubles that contains a side of a box."""
    low, high = enclosing(side.lower), enclosing(side.upper)
    return between(low.lower, high.upper)


def _misses(boxes: Sequence[Row], box: Row) -> bool:
    """Return whether a box is certainly disjoint from all of these."""
    return not any(all(_meet(p, q) for p, q in zip(other, box, strict=True)) for other in boxes)


def _meet(p: Double, q: Double) -> bool:
    """Return whether two intervals may have a common point."""
    return not (abs(p.mid - q.mid) > (p.rad + q.rad) * (1 + 2.0**-40) + 2.0**-1000)
