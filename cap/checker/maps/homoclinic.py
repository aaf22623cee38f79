"""Homoclinic orbits: where the unstable curve of a saddle P* crosses the stable one.

With the frame A and the graphs w of ``cones``, let [p-, p+] in [-r, r] not contain 0.  The states
z_0(p) = P* + A (p, w(p)) lie on W^u, and so do their images z_k(p) = Phi^k(z_0(p)).  They are
carried as z_k = m_k + F_k (N_k c + E_k), m_k a point, F_k a regular point matrix:

    c = A^-1 (P* - m_0) + (p, w(p)),      F_0 = A,  N_0 = 1,  E_0 = 0,
    B_k = F_(k+1)^-1 Phi' F_k,    N_(k+1) = B_k N_k,
    E_(k+1) = B_k E_k + F_(k+1)^-1 (Phi(m_k) - m_(k+1)),

with Phi' over a convex box that contains m_k and z_k(p) for all p, by the mean value theorem.  The
first column of F_k is near the tangent of W^u, the second one perpendicular to it in natural units:
so B_k is nearly triangular, and its products do not grow beyond their true size.

*Crossing.*  Let P* + A (P(p), Q(p)) = z_n(p).  If |Q| <= r for all p, and P(p-) < -L |Q|, P(p+) >
L |Q|, or the other way round, then P - w(Q) vanishes for some p, so that z_n(p) lies on W^s: the
orbit of z_0(p) tends to P* forwards and backwards in time.  There the tangent of W^u is A (t_p,
t_q) = F_n N_n (1, w'), and that of W^s is A (w', 1): if |t_p| > L |t_q|, they differ.  As Phi is a
local diffeomorphism, the curves cross transversely at all points of the orbit; the tangent of W^s
at z_k is that at z_n, pulled back.

All states of the orbit have an itinerary of hits only: the z_k by this computation, the others as
they lie in N.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.flow.itinerary import PeriodMap
from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.maps.cones import Cones
from cap.checker.maps.plane import (
    Matrix,
    Vector,
    adjugate,
    applied,
    inverse,
    midpoint,
    minus,
    plus,
    product,
    symmetric,
)
from cap.checker.system.walls import Parameters


class Place(NamedTuple):
    """The states z_k(p): m_k, F_k, N_k, E_k, and a box that contains m_k and all of them."""

    point: Vector
    frame: Matrix
    carried: Matrix
    errors: Vector
    box: Vector


class Orbit:
    """The states z_0(p), .., z_n(p), for all p of the ``start``.

    ``windows`` are those of the hits in each period.
    """

    def __init__(
        self, cones: Cones, p: Parameters, start: Ends, windows: Sequence[Sequence[Ends]]
    ) -> None:
        need(0 < start[0] < start[1] or start[0] < start[1] < 0, "a start is empty or contains 0")
        need(max(map(abs, start)) <= cones.reach, "a start is beyond the reach")
        self.cones, self.p, self.start = cones, p, start
        zero, one = cones.between(0, 0), cones.between(1, 1)
        half_way = (start[0] + start[1]) / 2
        middle = cones.between(half_way, half_way)
        begin = midpoint(plus(cones.saddle, applied(cones.frame, (middle, zero))))
        self.inward = applied(inverse(cones.frame), minus(cones.saddle, begin))
        self.places = [self._place(begin, cones.frame, ((one, zero), (zero, one)), (zero, zero))]
        self.turned: list[Matrix] = []  # the matrices B_k
        for hits in windows:
            self._follow(hits)

    def _combinations(self, start: Ends) -> Vector:
        """Return c = A^-1 (P* - m_0) + (p, w(p)) for all p of an interval."""
        p = self.cones.between(*start)
        return plus(self.inward, (p, self.cones.slopes * symmetric(p)))

    def _place(self, point: Vector, frame: Matrix, carried: Matrix, errors: Vector) -> Place:
        """Return the states."""
        away = applied(frame, plus(applied(carried, self._combinations(self.start)), errors))
        need(all(d.contains_zero() for d in away), "a point is not among its states")
        return Place(point, frame, carried, errors, plus(point, away))

    def _follow(self, hits: Sequence[Ends]) -> None:
        """Prove the hits of the next period, and carry the states over it."""
        now = self.places[-1]
        orbit = PeriodMap(self.p, hits).over(now.box, now.point, 1)
        image = orbit.x.centre.constant, orbit.v.centre.constant
        moved = product(((orbit.x[1, 0], orbit.x[0, 1]), (orbit.v[1, 0], orbit.v[0, 1])), now.frame)
        frame = self._along(midpoint((moved[0][0], moved[1][0])))
        back, point = inverse(frame), midpoint(image)
        turned = product(back, moved)
        errors = plus(applied(turned, now.errors), applied(back, minus(image, point)))
        self.turned.append(turned)
        self.places.append(self._place(point, frame, product(turned, now.carried), errors))

    def _along(self, tangent: Vector) -> Matrix:
        """Return a frame of points, its first column near this direction, with a length near R."""
        (x, v), omega = tangent, self.cones.between(self.p.omega, self.p.omega)
        R = self.cones.between(self.p.r - self.p.l, self.p.r - self.p.l)
        length = (x.square() + (v / omega).square()).sqrt() / R
        x, v = midpoint((x / length, v / length))
        u, w = midpoint((-v / omega, x * omega))
        return (x, u), (v, w)

    def crosses(self) -> None:
        """Prove that for some p the last state lies on W^s, where W^u crosses it transversely."""
        cones, last = self.cones, self.places[-1]
        back = inverse(cones.frame)
        turn = product(back, last.frame)
        centre = plus(applied(back, minus(last.point, cones.saddle)), applied(turn, last.errors))
        carried = product(turn, last.carried)
        low, high, both = (
            plus(centre, applied(carried, self._combinations(part)))
            for part in ((self.start[0],) * 2, (self.start[1],) * 2, self.start)
        )
        Q = both[1].magnitude()
        need(Q.upper <= cones.reach, "the last state may be beyond the reach of the stable curve")
        L = cones.between(cones.slope, cones.slope)
        aside = Interval(0, (L * Q).hi, Q.bits)
        crossed = (low[0].is_before(-aside) and aside.is_before(high[0])) or (
            high[0].is_before(-aside) and aside.is_before(low[0])
        )
        need(crossed, "the unstable curve may not cross the stable one")
        along, across = applied(carried, (L.integer(1), cones.slopes))
        steep = (L * across.magnitude()).is_before(along.magnitude())
        need(steep, "the unstable curve may touch the stable one only")

    def angle(self, k: int, omega: Fraction) -> Interval:
        """Return the angle of the curves at z_k, in degrees, in the plane of x and v/omega."""
        one, here, last = self.cones.between(1, 1), self.places[k], self.places[-1]
        back = product(inverse(last.frame), self.cones.frame)
        stable = applied(back, (self.cones.slopes, one))
        for turned in reversed(self.turned[k:]):  # the vector (s, 1) has the direction of W^s
            stable = applied(adjugate(turned), (stable[0] / stable[1], one))
        unstable = applied(here.frame, applied(here.carried, (one, self.cones.slopes)))
        stable = applied(here.frame, stable)
        (a, b), (c, d) = ((x, v / self.cones.between(omega, omega)) for x, v in (unstable, stable))
        lengths = ((a.square() + b.square()) * (c.square() + d.square())).sqrt()
        cosine = (a * c + b * d).magnitude() / lengths
        return arccos(cosine) * 180 / pi(cosine.bits)
