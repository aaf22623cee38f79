"""What both theorems share: the fixed point exists, and the orbit has the numbers claimed.

1. *Existence.*  For a point m of a box Z and a matrix C, with Phi' enclosed over Z, let

       K(Z) = m - C (Phi(m) - m) + (1 - C (Phi'(Z) - 1)) (Z - m).

   If K(Z) lies in the interior of Z, Phi has exactly one fixed point in Z, and it lies in K(Z)
   [Krawczyk].  C need not be close to anything: the inclusion proves that it is regular.  The
   rows of C Phi are put in mean value form once more: what their terms have in common cancels.
2. *Localisation.*  The same for a small rectangle S = m +- radius (R, R omega) in the box, where
   R = r - l: the fixed point in S is the one of the box.
3. *The orbit* of the fixed point P* in K(S): each claim contains the enclosure computed here, and
   is as narrow as the digits that it claims.
4. *The conclusion* is drawn from the numbers claimed, which contain the true ones.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from cap.checker.certificate import Certificate, Enclosure
from cap.checker.elementary import pi
from cap.checker.interval import Interval
from cap.checker.jet import lift
from cap.checker.mechanics import Mechanics, Passage
from cap.checker.rejection import need

Point = tuple[Interval, Interval]

_KRAWCZYK_ORDER = 4  # of the jets over the box: the higher, the larger the box may be


class FixedPoint(ABC):
    """The proof of one certificate.  Each step either succeeds or rejects, and is then reported."""

    orbit_order = 2  # of the jets at P*: the Jacobian in mean value form

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        self.certificate, self.step = certificate, step
        self.claims, self.hints = certificate.claims, certificate.hints
        p = certificate.parameters
        self.R, self.omega = p.r - p.l, p.omega
        self.m = tuple(self.number(q) for q in self.hints["centre"])

    def prove(self) -> None:
        """Prove the theorem."""
        self.existence()
        fixed_point = self.localisation()
        orbit = self.passage(fixed_point, [z.midpoint() for z in fixed_point], self.orbit_order)
        self.orbit(fixed_point, orbit)
        self.conclusion_of_both()
        self.conclude(fixed_point, orbit)

    @abstractmethod
    def conclude(self, fixed_point: Point, orbit: Passage) -> None:
        """Prove what the theorem says about the fixed point and its orbit."""

    def existence(self) -> None:
        """Prove that Phi has exactly one fixed point in the box claimed.

        The itinerary begins with: the box lies strictly between the walls and away from v = 0.
        """
        box = [self.claims["box"][z] for z in ("x", "v")]
        centre = zip(box, self.hints["centre"], strict=True)
        need(all(z.lower <= m <= z.upper for z, m in centre), "the centre is not in the box")
        self.krawczyk([(z.lower, z.upper) for z in box])
        hits = len(self.hints["hit_times"])
        self.step(f"all orbits from the box: {hits} transverse hits, no turning, no sticking")
        self.step("K(box) lies in the interior of the box: exactly one fixed point")

    def localisation(self) -> Point:
        """Return K(S), which contains the fixed point."""
        radius, scales = self.hints["radius"], (self.R, self.R * self.omega)
        centre = zip(self.hints["centre"], scales, strict=True)
        small = [(m - radius * scale, m + radius * scale) for m, scale in centre]
        for (low, high), name in zip(small, ("x", "v"), strict=True):
            box = self.claims["box"][name]
            need(box.lower <= low and high <= box.upper, "S is not in the box")
        result = self.krawczyk(small)
        self.step("K(S) lies in the interior of S, which lies in the box: K(S) contains P*")
        return result

    def krawczyk(self, region: Sequence[tuple[Fraction, Fraction]]) -> Point:
        """Return K(region) if it lies in the interior of the region, which contains m."""
        box = [Interval.enclosing(*z, self.hints["bits"]) for z in region]
        image = self.passage(box, self.m, _KRAWCZYK_ORDER)
        offset = [z - m for z, m in zip(box, self.m, strict=True)]
        K = list[Interval]()
        for i, row in enumerate(self.hints["preconditioner"]):
            p, q = (self.number(entry) for entry in row)
            phi = lift(lambda x, v, p=p, q=q: x * p + v * q, image.x, image.v)  # a row of C Phi
            defect = phi.centre.coefficients[0, 0] - (p * self.m[0] + q * self.m[1])
            left, right = p - phi[1, 0] + int(i == 0), q - phi[0, 1] + int(i == 1)
            K.append(self.m[i] - defect + left * offset[0] + right * offset[1])
            need(K[i].lies_inside(*region[i]), "K does not lie in the interior of its box")
        return K[0], K[1]

    def orbit(self, fixed_point: Point, orbit: Passage) -> None:
        """Compare the claims of both theorems about P* with what is computed."""
        p, R, omega, one = self.certificate.parameters, self.R, self.omega, Fraction(1)
        (a, b), (c, d) = ([w[1, 0], w[0, 1]] for w in (orbit.x, orbit.v))
        self.confirm("x", fixed_point[0], R)
        self.confirm("v", fixed_point[1], R * omega)
        self.confirm("hit_times", [h.moment.t[0, 0] for h in orbit.hits], 1 / omega)
        self.confirm("hit_speeds", [h.speed[0, 0] for h in orbit.hits], R * omega)
        forces = [(h.moment.cos[0, 0] * self.number(p.F)).magnitude() for h in orbit.hits]
        self.confirm("hit_forcing", [force - self.number(p.f) for force in forces], p.F)
        self.confirm("least_speed", orbit.least_speed, R * omega)
        self.confirm("jacobian", [[a, b], [c, d]], [[one, 1 / omega], [omega, one]])
        self.confirm("trace", a + d, one)
        self.confirm("determinant", a * d - b * c, one)
        self.step("the claims about the orbit of P* contain what is computed")

    def conclusion_of_both(self) -> None:
        """Check what the numbers claimed must satisfy in both theorems."""
        claims, times = self.claims, self.claims["hit_times"]
        need(times[0].lower > 0, "the first hit time is not positive")
        increasing = all(s.upper < t.lower for s, t in pairwise(times))
        need(increasing, "the hit times are not increasing")
        need(times[-1].upper * self.omega < 2 * self.pi().lower, "the last hit is not before T")
        need(all(u.lower > 0 for u in claims["hit_speeds"]), "a hit speed is not positive")
        need(claims["least_speed"].lower > 0, "the least speed is not positive")
        need(contains(claims["determinant"], 1), "the determinant excludes 1")

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number at the precision of the certificate."""
        return Interval.enclosing(q, q, self.hints["bits"])

    def pi(self) -> Interval:
        """Return an enclosure of pi."""
        return pi(self.hints["bits"])

    def passage(self, box: Sequence[Interval], m: Sequence[Interval], order: int) -> Passage:
        """Return the orbits of a box over one period, with the itinerary of the hints."""
        windows = [(w.lower, w.upper) for w in self.hints["hit_times"]]
        return Mechanics(self.certificate.parameters, box, m, order).passage(windows)

    def confirm(self, name: str, computed: Any, unit: Any) -> None:
        """Compare a claim, or a list of claims, with what is computed."""
        self.compare(name, self.claims[name], computed, unit)

    def compare(self, name: str, claim: Any, computed: Any, unit: Any) -> None:
        """Check that the enclosure claimed contains the computed one and keeps the width rule."""
        if isinstance(claim, list):
            units = unit if isinstance(unit, list) else [unit] * len(claim)
            for n, parts in enumerate(zip(claim, computed, units, strict=True)):
                self.compare(f"{name}[{n}]", *parts)
            return
        contained = computed.lies_in(claim.lower, claim.upper)
        need(contained, f"{name} does not contain the enclosure computed")
        size = max(abs(claim.lower), abs(claim.upper), unit)
        narrow = (claim.upper - claim.lower) * 10**self.certificate.digits <= size
        need(narrow, f"{name} is wider than its digits allow")


def contains(claim: Enclosure, q: int) -> bool:
    """Return whether an enclosure contains a number."""
    return claim.lower <= q <= claim.upper
