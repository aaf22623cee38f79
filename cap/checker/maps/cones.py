"""The unstable and the stable curve of a saddle P* of Phi, near it: graphs in the cones of a frame.

Let A be a regular matrix, and write z = P* + A (p, q).  Let N = {|p| <= r, |q| <= r}, let Phi be
continuously differentiable on N, and let b be a matrix of intervals with A^-1 Phi'(z) A for every z
in N.  Let 0 < L < 1, and let for all matrices in b

    (u)  |b21| + L |b22| < L (|b11| - L |b12|),    |b11| - L |b12| > 1,
    (s)  |b12| + L |b22| < L (|b11| - L |b21|),    |b22| + L |b21| < 1.

*Lemma.*  Then the unstable curve W^u of P* contains a graph q = w(p), |p| <= r, and its stable
curve W^s a graph p = w(q), |q| <= r; both w are continuously differentiable, with w(0) = 0 and
|w'| <= L.

*Proof for W^u.*  By (u), Phi'(z) maps the closed cone |q| <= L |p| into its interior (and 0), and
makes |p| longer there, at least by the factor k = min (|b11| - L |b12|) > 1.  So the unstable
direction lies in the interior of the cone, and a short piece of W^u at P* [Hadamard-Perron] is a
graph over |p| <= a with slopes of at most L.  With L < 1 it lies in N.  The image of such a graph
is a curve in W^u through P* with tangents in the cone: a graph with slopes of at most L, at least
over |p| <= min(k a, r).  Repeat until this is r.

*Proof for W^s.*  By (s), the inverse of Phi'(z) maps the closed cone |p| <= L |q| into its interior
(and 0).  So the stable direction lies there, and a short piece of W^s is a graph p = w(q) over
|q| <= a with slopes of at most L.  Let k = max (|b22| + L |b21|) < 1, and |q| <= min(a/k, r).  For
|p| <= L |q| let (P, Q) be the image of (p, q).  By the mean value theorem, from P* on, |Q| <= k |q|
<= a; so H(p) = P - w(Q) is defined.  |H'| >= |b11| - L |b21| > 0, and H has different signs at
p = L |q| and at p = -L |q|, as L |b11| - |b12| - L (L |b21| + |b22|) > 0 by (s).  So there is one p
for which the image lies on the graph, and (p, q) on W^s.  By the implicit function theorem it
depends on q with the derivative -(b12 - w' b22)/(b11 - w' b21), at most L in size by (s).  So W^s
contains a graph over |q| <= min(a/k, r).  Repeat until this is r.

The orbits of the first graph backwards in time, and those of the second one forwards, stay in N.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from cap.checker.flow.itinerary import PeriodMap
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.maps.plane import Matrix, Vector, applied, inverse, midpoint, plus, product

ORDER = 2  # of the jets over N


class Cones(NamedTuple):
    """An enclosure of P*, the frame A, the reach r and the slope L of the lemma."""

    saddle: Vector
    frame: Matrix
    reach: Fraction
    slope: Fraction

    def prove(self, phi: PeriodMap) -> None:
        """Prove the hypotheses of the lemma; all orbits from N have the itinerary of the map."""
        need(self.reach > 0, "the reach is not positive")
        need(0 < self.slope < 1, "the slope is not between 0 and 1")
        side = self.between(-self.reach, self.reach)
        N = plus(self.saddle, applied(self.frame, (side, side)))
        orbit = phi.over(N, midpoint(self.saddle), ORDER)
        jacobian = (orbit.x[1, 0], orbit.x[0, 1]), (orbit.v[1, 0], orbit.v[0, 1])
        b = product(inverse(self.frame), product(jacobian, self.frame))
        (b11, b12), (b21, b22) = ([entry.magnitude() for entry in row] for row in b)
        L, one = self.between(self.slope, self.slope), self.between(1, 1)
        longer, unstable = b11 - L * b12, (b21 + L * b22, L * (b11 - L * b12))
        shorter, stable = b22 + L * b21, (b12 + L * b22, L * (b11 - L * b21))
        need(unstable[0].is_before(unstable[1]), "the unstable cone may not be mapped into itself")
        need(one.is_before(longer), "the unstable cone may not be stretched")
        need(stable[0].is_before(stable[1]), "the stable cone may not be pulled back into itself")
        need(shorter.is_before(one), "the stable cone may not be contracted")

    def between(self, lower: Fraction | int, upper: Fraction | int) -> Interval:
        """Return an interval that contains these numbers."""
        return Interval.enclosing(lower, upper, self.saddle[0].bits)

    @property
    def slopes(self) -> Interval:
        """Return [-L, L]."""
        return self.between(-self.slope, self.slope)
