"""Cones along coverings: one orbit for each path, and hyperbolicity.

For a covering N_i -> N_j let S be a rectangle of p and q that contains all points of N_i with an
image in N_j.  In each set two directions are chosen, (1, sigma) and (tau, 1) in its coordinates p
and q; C_i has them as columns, and (a, b) = C_i^-1 (p, q).  Let B be a matrix of intervals that
contains (A_j C_j)^-1 Dg(z) A_i C_i for every z in S.  Each set has a slope L_i > 0 and units u_i,
w_i > 0, of a and of b (1 where none are given).  Let for all coverings and all matrices in B

    |B21| + L_i |B22| < L_j (|B11| - L_i |B12|),

    (|B11| - L_i |B12|) u_i/u_j >= s > 1,        (|B22| + |B21|/L_i) w_i/w_j <= c < 1.

*Lemma 1.*  Let (a', b') = B (a, b).  If |b| <= L_i |a|, then |b'| <= L_j |a'|, with < if a != 0,
and |a'|/u_j >= s |a|/u_i.  If |b'| >= L_j |a'|, then |b| >= L_i |a|, and |b'|/w_j <= c |b|/w_i.
*Proof.*  In the first case |b'| <= (|B21| + L_i |B22|) |a| and |a'| >= (|B11| - L_i |B12|) |a|.
The second is its contraposition; then |b'| <= |B21| |b|/L_i + |B22| |b|.

*Lemma 2.*  Along each bi-infinite path of coverings there is exactly one orbit.  *Proof.*  There is
one (`covering`).  Let there be two.  At each time both lie in S, which is convex; so the difference
(a_k, b_k) of their coordinates is carried by a matrix in B, the mean of those on the segment
between them.  If it is not 0 and in the cone |b| <= L_i |a| at some time, it is so later, and |a|,
in the units of the sets, grows at least by the factor s each time; but it is bounded.  If it is
outside of the cone at all times until it is 0, |b| shrinks likewise at least by the factor c each
time, so it was larger than any bound before.

*Lemma 3.*  Let det Dg != 0 on all S.  Then Lambda is hyperbolic: along each orbit in it the tangent
planes split into two lines, which Dg carries on; forwards, vectors of the first shrink like c^n or
faster, those of the second grow like s^n or faster, up to factors that are the same everywhere.
*Proof.*  The coordinates of finitely many sets differ from the true ones by bounded factors.  The
vectors with |b| >= L_i |a| at all times from now on shrink like c^n.  Those that have it up to the
time n are a closed set, contain a line (Lemma 1: those with a = 0 then), and decrease with n: so
some line has it for ever.  Only one: else all vectors would shrink, also those of the cone.  The
vectors with |b| <= L_i |a| at all earlier times have grown like s^n; they contain a line likewise,
and only one: else all would have grown, also those of the first line.

*How it is checked.*  S is found by interval Newton steps for |P| <= 1, on pieces of N_i; B is the
hull of the matrices on parts of S.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.coverings.covering import WHOLE, Box, Parallelogram, halves, seen
from cap.checker.coverings.planar import Matrix, Planar, inverse, product
from cap.checker.kernel.doubles import Double, between, enclosing
from cap.checker.kernel.rejection import Rejected, need

MOST = 200  # pieces for one covering
PARTS = 4  # of S along each of its sides
_SMALL, _HIGH = 2.0**-8, 0.25  # sides of pieces, at least and at most
_WORTH = 0.9  # a piece is looked at again if it becomes so much narrower
ONE, ALL = Double(1.0), Double(0.0, 1.0)
UNITS = Fraction(1), Fraction(1), Fraction(1)


class Cone(NamedTuple):
    """C of a set, the slope of its cone |b| <= L |a|, and the units of a and b."""

    axes: Matrix
    slope: Double
    u: Double
    w: Double


class Rates(NamedTuple):
    """s and c: by how much at least vectors of the cones are stretched, and the others shrunk."""

    stretch: float
    shrink: float


def carried(g: Planar, source: Parallelogram, targets: Sequence[Parallelogram]) -> list[Matrix]:
    """Return for each target all matrices A_j^-1 Dg A_i on S; Dg is regular there."""
    found = []
    for target in targets:
        S = strip(g, source, target)
        found.append(_hull(_turned(g, source, target, box) for box in _cut(S)))
    return found


def cone(leaning: Sequence[Fraction], slope: Fraction, units: Sequence[Fraction] = UNITS) -> Cone:
    """Return the cone of a set; `units` are L_i/slope, u_i and w_i."""
    (sigma, tau), (steeper, u, w) = map(enclosing, leaning), map(enclosing, units)
    return Cone(((ONE, tau), (sigma, ONE)), enclosing(slope) * steeper, u, w)


def rates(A: Matrix, here: Cone, there: Cone) -> Rates:
    """Check the three inequalities for B = C_j^-1 A C_i; return s and c."""
    (b11, b12), (b21, b22) = product(inverse(there.axes), product(A, here.axes))
    along = b11 if b11.is_positive() else -b11
    p12, p21, p22 = (Double(x.magnitude) for x in (b12, b21, b22))
    grown, left = along - here.slope * p12, p22 + p21 / here.slope
    into = there.slope * grown - p21 - here.slope * p22
    need(into.is_positive(), "a cone may not be mapped into a cone")
    stretch, shrink = grown * here.u / there.u, left * here.w / there.w
    need((stretch - 1.0).is_positive(), "a cone may not be stretched")
    need((ONE - shrink).is_positive(), "what is outside of a cone may not be shrunk")
    return Rates(stretch.lower, shrink.upper)


def strip(g: Planar, source: Parallelogram, target: Parallelogram) -> Box:
    """Return a rectangle of p and q that contains all points that are mapped into a target."""
    waiting, kept, count = [WHOLE], list[Box](), 0
    while waiting:
        count += 1
        need(count <= MOST, f"cones need more than {MOST} boxes")
        box = waiting.pop()
        wide, high = box.p1 - box.p0, box.q1 - box.q0
        try:
            less = _narrowed(g, source, target, box)
        except Rejected:
            need(max(wide, high) > _SMALL, "the map may not be defined, or has a fold")
            waiting += halves(box, along_p=wide >= high)
            continue
        if less is None:
            continue
        if less.p1 - less.p0 < _WORTH * wide:
            waiting.append(less)
        elif high > _HIGH:
            waiting += halves(less, along_p=False)
        else:
            kept.append(less)
    need(len(kept) > 0, "no point of a set is mapped into a set that it covers")
    p0, p1, q0, q1 = zip(*kept, strict=True)
    return Box(min(p0), max(p1), min(q0), max(q1))


def _narrowed(g: Planar, source: Parallelogram, target: Parallelogram, box: Box) -> Box | None:
    """Return a part of a box with all its points where |P| <= 1; none if there are none."""
    known = seen(g, source, box)
    m, n = target.inverse[0]
    by_p, by_q = (m * u + n * w for u, w in known.columns)
    x, y = known.middle.x - target.centre[0], known.middle.y - target.centre[1]
    rest = m * x + n * y + by_q * known.q  # P = rest + by_p (p - m_p)
    P = rest + by_p * known.p
    if (P - 1.0).is_positive() or (-P - 1.0).is_positive():
        return None
    p = (ALL - rest) / by_p + 0.5 * (box.p0 + box.p1)
    p0, p1 = max(p.lower, box.p0), min(p.upper, box.p1)
    return box._replace(p0=p0, p1=p1) if p0 <= p1 else None


def _cut(S: Box) -> Iterator[Box]:
    """Cut a rectangle into parts that cover it."""
    p = [S.p0 + (S.p1 - S.p0) * n / PARTS for n in range(PARTS)] + [S.p1]
    q = [S.q0 + (S.q1 - S.q0) * n / PARTS for n in range(PARTS)] + [S.q1]
    for k in range(PARTS):
        for n in range(PARTS):
            yield Box(p[k], p[k + 1], q[n], q[n + 1])


def _turned(g: Planar, source: Parallelogram, target: Parallelogram, box: Box) -> Matrix:
    """Enclose A_j^-1 Dg A_i on a box."""
    p, q = between(box.p0, box.p1), between(box.q0, box.q1)
    derivative = g.image(*source.points(p, q)).derivative
    (a, b), (c, d) = derivative
    det = a * d - b * c
    need(det.is_positive() or (-det).is_positive(), "the derivative may not be regular")
    return product(target.inverse, product(derivative, source.axes))


def _hull(matrices: Iterator[Matrix]) -> Matrix:
    """Return a matrix of intervals that contains all of these."""
    entries = list(zip(*((a, b, c, d) for (a, b), (c, d) in matrices), strict=True))
    a, b, c, d = (between(min(x.lower for x in e), max(x.upper for x in e)) for e in entries)
    return (a, b), (c, d)
