"""What the theorems about a fixed point share: it exists, and the claims contain what is computed.

Here Phi is the map of the theorem: over one period, or over n of them.

1. *Existence.*  For a point m of a box Z and a matrix C, with Phi' enclosed over Z, let

       K(Z) = m - C (Phi(m) - m) + (1 - C (Phi'(Z) - 1)) (Z - m).

   If K(Z) lies in the interior of Z, Phi has exactly one fixed point in Z, and it lies in K(Z)
   [Krawczyk].  C need not be close to anything: the inclusion proves that it is regular.  The
   rows of C Phi are put in mean value form once more: what their terms have in common cancels.
   If Phi depends on parameters in intervals, this is done for all their values q at once: Phi(m; q)
   lies in Phi(m; q_0) + (the derivatives in q over the box and the intervals) (q - q_0).
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
from typing import Any

from cap.checker.flow.itinerary import Passage, PeriodMap
from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.certificate import Certificate
from cap.checker.kernel.elementary import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import lift
from cap.checker.kernel.reading import Enclosure
from cap.checker.kernel.rejection import need

Point = tuple[Interval, Interval]

KRAWCZYK_ORDER = 4  # of the jets over the box: the higher, the larger the box may be


def krawczyk(
    phi: PeriodMap, region: Sequence[Ends], hints: dict[str, Any], bits: int, order: int
) -> Point:
    """Return K(region) if it lies in the interior of the region, which contains the centre m.

    Every orbit from the region has the itinerary of the map.
    """
    inside = zip(region, hints["centre"], strict=True)
    need(all(z[0] <= m <= z[1] for z, m in inside), "the centre is not in the box")
    box = [Interval.enclosing(*z, bits) for z in region]
    centre = [Interval.enclosing(m, m, bits) for m in hints["centre"]]
    image = phi.over(box, centre, order)
    K = list[Interval]()
    for i, row in enumerate(hints["preconditioner"]):
        p, q = (Interval.enclosing(entry, entry, bits) for entry in row)
        image_row = lift(lambda x, v, p=p, q=q: x * p + v * q, image.x, image.v)  # of C Phi
        value, offsets = image_row.centre.constant, image_row.offsets
        for n in range(2, len(offsets)):  # the variables e and mu
            value = value + image_row.slope(n) * offsets[n]
        defect = value - (p * centre[0] + q * centre[1])
        left, right = p - image_row.slope(0) + int(i == 0), q - image_row.slope(1) + int(i == 1)
        K.append(centre[i] - defect + left * offsets[0] + right * offsets[1])
        need(K[i].lies_inside(*region[i]), "K does not lie in the interior of its box")
    return K[0], K[1]


class Proof(ABC):
    """The proof of one certificate.  Each step either succeeds or rejects, and is then reported."""

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        self.certificate, self.step = certificate, step
        self.p, self.claims = certificate.parameters, certificate.claims
        self.hints = certificate.hints
        self.R, self.omega = self.p.r - self.p.l, self.p.omega

    @abstractmethod
    def prove(self) -> None:
        """Prove the theorem, or reject."""

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number at the precision of the certificate."""
        return Interval.enclosing(q, q, self.hints["bits"])

    def pi(self) -> Interval:
        """Return an enclosure of pi."""
        return pi(self.hints["bits"])

    def confirm(self, name: str, computed: Any, unit: Any) -> None:
        """Compare a claim, or a list of claims, with what is computed; no unit: no width rule."""
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
        if unit is not None:
            self.narrow(name, claim, unit)

    def narrow(self, name: str, claim: Enclosure, unit: Fraction) -> None:
        """Check that an enclosure is as narrow as the digits that are claimed."""
        size = max(abs(claim.lower), abs(claim.upper), unit)
        narrow = (claim.upper - claim.lower) * 10**self.certificate.digits <= size
        need(narrow, f"{name} is wider than its digits allow")


class FixedPoint(Proof):
    """The proof of a theorem about a fixed point."""

    orbit_order = 2  # of the jets at P*: the Jacobian in mean value form

    def prove(self) -> None:
        """Prove the theorem."""
        self.existence()
        fixed_point = self.localisation()
        orbit = self.near(fixed_point, fixed_point, self.orbit_order)
        self.orbit(fixed_point, orbit)
        self.conclude(fixed_point, orbit)

    @property
    @abstractmethod
    def phi(self) -> PeriodMap:
        """The map, with its itinerary and time windows."""

    @abstractmethod
    def orbit(self, fixed_point: Point, orbit: Passage) -> None:
        """Compare the claims about P* with what is computed."""

    @abstractmethod
    def conclude(self, fixed_point: Point, orbit: Passage) -> None:
        """Prove what the theorem says about the fixed point and its orbit."""

    def existence(self) -> None:
        """Prove that Phi has exactly one fixed point in the box claimed."""
        self.krawczyk([ends(self.claims["box"][z]) for z in ("x", "v")])
        self.step(f"all orbits from the box have the itinerary: {', '.join(self.phi.itinerary)}")
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

    def krawczyk(self, region: Sequence[Ends]) -> Point:
        """Return K(region) if it lies in the interior of the region."""
        return krawczyk(self.phi, region, self.hints, self.hints["bits"], KRAWCZYK_ORDER)

    def near(self, box: Sequence[Interval], point: Point, order: int) -> Passage:
        """Return the orbits of a box around an enclosure of a point."""
        return self.phi.over(box, [z.midpoint() for z in point], order)


def ends(claim: Enclosure) -> Ends:
    """Return the ends of an enclosure."""
    return claim.lower, claim.upper


def contains(claim: Enclosure, q: int) -> bool:
    """Return whether an enclosure contains a number."""
    return claim.lower <= q <= claim.upper


def in_order(words: Sequence[str], times: Sequence[Enclosure]) -> None:
    """Check that the times claimed are in the order of the events, from 0 on.

    The enclosure for a capture may begin before its hit, but after the event before that.
    """
    for n, (word, t) in enumerate(zip(words, times, strict=True)):
        captured = word.startswith("capture")
        before = times[: max(0, n - captured)]
        later = not before or before[-1].upper < t.lower
        need(later, f"the time of event {n + 1} is not after that of the event before")
        need(t.lower >= 0, "the time of the first event may be negative")
        need(n == 0 or times[n - 1].upper <= t.upper, "a capture may end before its hit")
