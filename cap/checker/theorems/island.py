"""The theorem about an island: an invariant curve around an elliptic point, and what is inside.

Units F = omega = 1, x measured from the middle between the walls at -a and a.  Let e = 1, mu = 0, 0
< f < F, alpha = f/F.  sigma is the map of half a period with one hit (cap.checker.tori.half_period
has it, and why it preserves area); G is sigma, or sigma sigma = Phi, the map over a period.

1. *The set U*, a parallelogram around P*: a cover by small ones shows that from all its states
   half a period, or two, have one hit each, and the velocity never vanishes.  So G is defined,
   analytic and injective on U, which is simply connected, with det DG = 1.
2. *The center* P* of G, by Krawczyk's inclusion: C (G - 1) is near the identity.
3. *The curve*: K with the frame N, and the hits, are trigonometric polynomials that are given.  The
   a-posteriori theorem (cap.checker.tori.invariant_curve) has an invariant curve C within a
   distance of K; G turns it by the rotation number.
4. *The disk* D inside C, a Jordan curve in U.  U is convex, so D is in U.  G(D) is open, connected,
   bounded, disjoint from C = G(C), and its boundary is in C: so G(D) = D.  So from all states of D,
   for all times, forward and backward, half periods with one hit follow each other, and the
   velocity never vanishes.  The curve winds around P* once: P* is in D.
5. *Area* = |the integral of x dv over C|; of K it is 4 pi |sum of k Im(v_k conj x_k)|, k > 0, and
   the integral over C differs by at most 2 pi RK (2 l0 + s), by integration by parts.
   If G = sigma sigma, sigma(D) is another such disk; it is disjoint from D if sigma(U) is from U.
6. *Periodic orbits* in D, if they are claimed: P* is elliptic, its rotation number is another than
   that of C, both in the sense of C (cap.checker.tori.between).  By Franks' theorem each fraction
   p/q between both, in lowest terms, is the rotation number of two orbits at least, of period q.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence
from fractions import Fraction
from math import isqrt
from typing import Any

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.citation import Citation, cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.elementary import hull
from cap.checker.kernel.fourier import Circle, Function
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Whole, Word, bound, enclosure
from cap.checker.kernel.theorem import Certificate
from cap.checker.system.lossy import SYSTEM
from cap.checker.system.walls import BetweenWalls
from cap.checker.tori import between, rotation, told
from cap.checker.tori.centre import HINTS as CENTRE
from cap.checker.tori.centre import fixed_point
from cap.checker.tori.half_period import Hit, Motion, Passage, cells
from cap.checker.tori.invariant_curve import Near, Setting, Shift, Vector, beside, norm
from cap.checker.tori.written import COARSE, QUOTIENTS, function

MAX_DEGREE = 4096
MAX_WORK = 4096 * 100  # degree times places
PER_SECOND = 16_000  # digits of functions, for half a period
ROUGH = 96  # bits, for boxes
MATRIX = [[number] * 2] * 2


class Island(BetweenWalls):
    """An invariant curve around an elliptic point."""

    # fmt: off
    HINTS = (
        Field("places", Whole(20, 200), "", "", "coefficients are integers in units 10^-places"),
        Field("degree", Whole(8, MAX_DEGREE), "", "N", "functions are kept up to exp(iN theta)"),
        Field("rho", number, "", r"\rho", "of the norm"),
        Field("reach", number, "", "r", "the map is bounded on functions within r of K"),
        Field("frame", {"x": text, "v": text}, "", "N", "det(K', N) is nearly 1; in units "
              "10^-20"),
        Field("hits", Many({"time": text, "inverse": text}, 1, 2), "", "", "times of hits along "
              "K; inverse speeds there, in units 10^-20"),
        *CENTRE,
        Field("axes", MATRIX, "", "M", "U = middle + M [-h, h]^2"),
        Field("half", number, "", "h", "half the width of U"),
        Field("cells", Whole(1, 256), "", "", "U is covered by cells^2 parallelograms"),
        Field("ray", Maybe({"place": Whole(0, 15), "pieces": Whole(1, 1000)}), "", "", "if "
              "`orbits` is claimed: a segment from P* to the point of the curve at theta = 2 pi "
              "place/16, cut into pieces"),
    )
    CLAIMS = (
        Field("map", Word(("sigma", "Phi")), "", "", "sigma: half a period and the symmetry; Phi"),
        Field("x", Quantity("R"), "x", "x", "P*"),
        Field("v", Quantity("R omega"), "v", "v", "P*"),
        Field("rotation_number", {"head": QUOTIENTS, "period": QUOTIENTS}, "", r"\alpha",
              "[0; head, period, period, ...]"),
        Field("diophantine", bound, "", r"\gamma", "k dist(k alpha, Z) is at least this"),
        Field("curve", {"x": text, "v": text}, "", "K", "coefficients 0, 1, ... of x omega^2/F "
              "(from the middle between the walls) and v omega/F: re im, re im, ..."),
        Field("distance", bound, "", "", "the curve is within this of K, in these units"),
        Field("winding", Word(("1", "-1")), "", "", "how often the curve winds around P*"),
        Field("area", enclosure, "area", "", "of the disk D inside the curve"),
        Field("disks", Whole(1, 2), "", "", "2 if the image of D by the symmetry is disjoint"),
        Field("orbits", Maybe({"centre": enclosure}), "", "", "the rotation number at P*, in the "
              "sense in which that of the curve is alpha: for each p/q between both, in lowest "
              "terms, there are two periodic orbits at least in D, of minimal period q"),
    )
    CITES = (
        cite("Jordan curve theorem", "any textbook of topology",
             ("curve", "the curve is closed and has no double points", "curve, distance")),
        cite("best approximation", "Khinchin, Continued Fractions, 1964, Theorem 17",
             ("quotients", "the quotients are positive integers", "rotation_number")),
        cite("Franks: a fixed point of positive index",
             "Franks, Generalizations of the Poincare-Birkhoff theorem, Annals of Mathematics 128 "
             "(1988), Theorem 2.1",
             ("annulus", "the map is a homeomorphism of the open "
              "annulus D without P*, homotopic to the identity, as it keeps orientation and ends",
              "curve, winding"),
             ("nonwandering", "every point is nonwandering: the map preserves area, and D has a "
              "finite one", "area"),
             ("returning disks", "the lift of the q-th power, by -p, moves angles near P* and near "
              "the curve in opposite directions, as rotations do: disks return on either side",
              "orbits.centre, rotation_number"),
             ("finitely many", "this lift has finitely many fixed points, else there are more than "
              "two orbits; on a cover of the annulus with enough sheets it has all that there are",
              "orbits.centre, rotation_number")),
    )
    # fmt: on

    @classmethod
    def cited(cls, claims: Container[str]) -> list[Citation]:
        """Return what is cited; Franks only for periodic orbits."""
        return list(cls.CITES if "orbits" in claims else cls.CITES[:-1])

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        work = hints["degree"] * hints["places"]
        need(work <= MAX_WORK, f"degree times places is more than {MAX_WORK}")
        need(0 < hints["rho"] <= 1, "0 < rho <= 1 does not hold")
        need(("ray" in hints) is ("orbits" in claims), "orbits without a ray, or a ray without")

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        hints = self.hints
        self.circle = Circle(hints["degree"], hints["rho"], hints["places"])
        self.done = 0  # parts of the proof

    def seconds(self) -> int:
        """Return about how long a proof takes: products of functions are most of it."""
        hints = self.hints
        return int(hints["degree"] * hints["places"] * len(hints["hits"])) // PER_SECOND

    def prove(self) -> None:
        """Prove the theorem."""
        p = self.p
        need(p.f > 0, "0 < f does not hold")
        self.half_periods = 2 if self.claims["map"] == "Phi" else 1
        self.laws = p.f / p.F, self.R * p.omega**2 / p.F / 2
        K, N, hits = self.polynomials()
        need(len(hits) == self.half_periods, "there is not one hit for each half period")
        speeds = self.region()
        centre = self.centre()
        close = self.theorem(K, N, hits)
        self.around(K, close, centre)
        self.area(K, close)
        self.disks(*speeds)
        if "orbits" in self.claims:
            self.orbits(K, close, centre)

    def polynomials(self) -> tuple[Vector, Vector, list[tuple[Function, Function]]]:
        """Return K, N, and for each hit its time and the inverse speed."""
        hits = [
            (self.function(hit["time"]), self.function(hit["inverse"], self.coarse))
            for hit in self.hints["hits"]
        ]
        frame = self.pair(self.hints["frame"], self.coarse)
        return self.pair(self.claims["curve"]), frame, hits

    def function(self, words: str, unit: int = 1) -> Function:
        """Return a trigonometric polynomial; its numbers are in so many units of the circle."""
        return function(self.circle, words, unit)

    def pair(self, words: dict[str, str], unit: int = 1) -> Vector:
        """Return two."""
        return self.function(words["x"], unit), self.function(words["v"], unit)

    @property
    def coarse(self) -> int:
        """10^-20, the unit of what need not be sharp, in units of the circle."""
        places: int = self.hints["places"]
        return int(10 ** (places - COARSE))

    # the set U

    def region(self) -> tuple[Interval, Interval]:
        """Prove that motions from U never stop for as many half periods; return v there and after.

        And det M != 0, h > 0: U is a parallelogram.
        """
        hints, motion = self.hints, Motion(*self.laws, ROUGH)
        M, h = hints["axes"], hints["half"]
        need(determinant(M) != 0 and h > 0, "U is no parallelogram")
        before, after = list[Interval](), list[Interval]()
        for states in cells(hints["middle"], M, h, hints["cells"], ROUGH):
            z = motion.after(states)
            before.append(states.range(1))
            after.append(z.range(1))
            if self.half_periods == 2:
                motion.after(z)
        self.step(
            f"from U motions never stop, with one hit in each half period ({len(after)} cells)"
        )
        return hull(before), hull(after)

    def centre(self) -> tuple[Interval, Interval]:
        """Prove that there is a fixed point in a rectangle, and compare it."""
        found = fixed_point(Motion(*self.laws, self.circle.bits), self.half_periods, self.hints)
        length, speed = (self.number_at(self.p.F / self.p.omega**k) for k in (2, 1))
        base = self.number_at((self.p.l + self.p.r) / 2)
        self.confirm(x=base + found.x * length, v=found.v * speed)
        self.step("P* is a fixed point, at the place claimed")
        self.trace = found.trace
        return found.x, found.v

    def number_at(self, q: Fraction) -> Interval:
        """Return a number at the precision of coefficients."""
        return Interval.enclosing(q, q, self.circle.bits)

    # the curve

    def theorem(self, K: Vector, N: Vector, given: list[tuple[Function, Function]]) -> Near:
        """Prove that there is an invariant curve near K."""
        circle, r = self.circle, self.circle.above(self.hints["reach"])
        quotients = self.claims["rotation_number"]
        gamma = self.claims["diophantine"]
        need(gamma <= rotation.constant(**quotients), "the Diophantine constant is smaller")
        self.step("the rotation number is as far from rationals as claimed")
        alpha = rotation.value(**quotients, bits=circle.bits)
        ahead = Shift(circle, alpha, pi(circle.bits))
        self.confirm_reach(K, r)
        hits = list[Hit]()
        for hit in given:
            self.told_part()
            hits.append(Hit.of(*hit))
        exactly = self.passages(hits, K)
        near_by = self.passages(hits, (K[0].with_error(r), K[1].with_error(r)))
        self.step("the map is defined for all functions near K")
        (x, v), (X, V) = exactly[-1][:2], near_by[-1][:2]
        L = K[0].derivative(), K[1].derivative()

        def tangent(w: Vector) -> Vector:
            for passage in exactly:
                w = passage.tangent(w)
            return w

        setting = Setting(K, L, N, ahead, gamma, self.hints["reach"])
        defect, spread = (x - ahead(K[0]), v - ahead(K[1])), (X - x, V - v)
        found = beside(setting, defect, spread, tangent)
        self.tangent_size = norm(L)
        need(found.distance <= self.claims["distance"], "the curve may be farther from K")
        self.step("there is an invariant curve near K, with the rotation number")
        return found

    def passages(self, hits: list[Hit], K: Vector) -> list[Passage]:
        """Return the half periods of functions."""
        motion, found = Motion(*self.laws, self.circle.bits), list[Passage]()
        for hit in hits:
            self.told_part()
            found.append(motion.passage(hit, *K))
            K = found[-1][:2]
        return found

    def told_part(self) -> None:
        """Tell how far the proof is: most of it is their sines, and as many half periods, twice."""
        self.tell("functions on the circle are multiplied", self.done / (3 * self.half_periods))
        self.done += 1

    def in_axes(self, K: Vector, at: list[Interval]) -> Vector:
        """Return M^-1 (K - at)."""
        (a, b), (c, d) = self.hints["axes"]
        x, v = (u - self.circle.constant(c) for u, c in zip(K, at, strict=True))
        D = determinant(self.hints["axes"])
        rows = ((d / D, -b / D), (-c / D, a / D))
        p, q = (x * self.number_at(row[0]) + v * self.number_at(row[1]) for row in rows)
        return p, q

    def stretch(self) -> Fraction:
        """Return the norm of M^-1."""
        rows: list[list[Fraction]] = self.hints["axes"]
        (a, b), (c, d) = rows
        return max(abs(d) + abs(b), abs(c) + abs(a)) / abs(determinant(rows))

    def confirm_reach(self, K: Vector, r: int) -> None:
        """Prove that real curves within r of K lie in U."""
        need(r > 0, "the reach is not positive")
        middle = [self.number_at(q) for q in self.hints["middle"]]
        far = self.circle.above(self.stretch() * self.hints["reach"])
        half = self.hints["half"] * self.circle.unit
        for y in self.in_axes(K, middle):
            need(abs(y.mean) + y.swing + y.error + far < half, "a curve near K may leave U")
        self.step("real curves near K lie in U")

    def around(self, K: Vector, close: Near, centre: tuple[Interval, Interval]) -> None:
        """Prove that the curve is embedded, and winds around P* once, as claimed.

        With w = y_1 + i y_2, y = M^-1 (K - P*): a term w_s exp(is theta), s = 1 or -1, is larger
        than all others together, and what C differs from K; so C winds s times, in these axes.
        """
        y = self.in_axes(K, list(centre))
        terms = {}
        for k, ((a, b), (c, d)) in enumerate(zip(*(u.coefficients for u in y), strict=True)):
            terms[k], terms[-k] = (a - d, b + c), (a + d, c - b)
        sizes = {k: isqrt(re * re + im * im) + 1 for k, (re, im) in terms.items()}
        moved = self.circle.above(2 * self.stretch() * close.distance)
        s = 1 if sizes[1] > sizes[-1] else -1
        others = sum(y_k for k, y_k in sizes.items() if k != s)
        errors = y[0].error + y[1].error + moved
        need(sizes[s] - 1 > others + errors, "the curve may not wind around P*")
        turns = s if determinant(self.hints["axes"]) > 0 else -s
        need(int(self.claims["winding"]) == turns, "the curve winds the other way")
        unit = self.circle.unit
        first = max(abs(part) for u in K for part in u.coefficients[1])
        need(first > close.distance * unit, "the curve may not be embedded")
        self.step("the curve is a circle without double points, and winds around P*")

    def area(self, K: Vector, close: Near) -> None:
        """Compare the area with what is claimed."""
        x, v = (u.coefficients for u in K)
        pairs = enumerate(zip(x, v, strict=True))
        total = sum(k * (d * a - c * b) for k, ((a, b), (c, d)) in pairs)
        unit = self.circle.unit
        twice = self.number_at(Fraction(abs(2 * total), unit**2))
        error = 2 * Fraction(self.tangent_size, unit) + close.slope
        reach = self.number_at(close.distance * error)
        both = twice * 2 + Interval(-reach.hi, reach.hi, reach.bits) * 2
        scale = self.number_at(self.p.F**2 / self.p.omega**3)
        self.confirm(area=both * pi(self.circle.bits) * scale)
        need(self.claims["area"].lower > 0, "the area is not positive")
        self.step("the area inside the curve is the one claimed")

    def disks(self, before: Interval, after: Interval) -> None:
        """Prove that there are two disks, if two are claimed."""
        if self.claims["disks"] == 1:
            return
        need(self.half_periods == 2, "the disk is its own image by sigma")
        apart = before.is_before(after) or after.is_before(before)
        need(apart, "the disk and its image may meet")
        self.step("the image of the disk by the symmetry is another one")

    def orbits(self, K: Vector, close: Near, centre: tuple[Interval, Interval]) -> None:
        """Prove that there are periodic orbits with the rotation numbers claimed."""
        place, pieces = self.hints["ray"]["place"], self.hints["ray"]["pieces"]
        far = self.circle.above(close.distance)
        x, v = (between.value(u, place, far, ROUGH) for u in K)
        start = centre[0].with_bits(ROUGH), centre[1].with_bits(ROUGH)
        motion = Motion(*self.laws, ROUGH)
        s = between.sense(motion, self.half_periods, (start, (x, v)), pieces)
        alpha = rotation.value(**self.claims["rotation_number"], bits=self.circle.bits)
        found = between.at_centre(self.trace, s == int(self.claims["winding"]), alpha)
        self.compare("orbits", self.claims["orbits"], {"centre": found})
        need(
            told.gap(self.claims) is not None,
            "the rotation numbers at P* and on the curve may be equal",
        )
        self.step("the rotation number at P* is the one claimed, another than on the curve")

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        every = _PHI if claims["map"] == "Phi" else _SIGMA
        two = _TWO if claims["disks"] == 2 else ""
        more = {name: decimal(claims[name]) for name in ("diophantine", "distance")}
        more |= {"alpha": told.turns(claims), "orbits": told.orbits(claims)}
        return self.told(SYSTEM + _CURVE, every=every, two=two, **more)


def determinant(M: Sequence[Sequence[Fraction]]) -> Fraction:
    """Return the determinant."""
    return M[0][0] * M[1][1] - M[0][1] * M[1][0]


_PHI = "the map Phi over a period T = 2 pi/omega from t = 0"
_SIGMA = (
    "the map sigma over half a period pi/omega from t = 0, followed by (x, v) -> (l + r - x, -v)"
)
_CURVE = (
    "{every} has a fixed point P*, x in {x}, v in {v}, and an invariant analytic closed curve "
    "without double points around P*, on which it is conjugate to the rotation by alpha = {alpha} "
    "turns (dist(k alpha, Z) >= {diophantine}/k for k = 1, 2, ...); the curve is within "
    "{distance} of the trigonometric polynomial of the certificate, in units F/omega^2 and "
    "F/omega; the open disk inside it is invariant, and has an area in {area}; every motion that "
    "starts in the disk at t = 0 has a velocity that never vanishes, for all times, forward and "
    "backward, and hits the right wall once in each (nT, nT + T/2) and the left wall once in each "
    "(nT + T/2, nT + T){two}{orbits}"
)
_TWO = (
    "; the images of these motions by (x, v, t) -> (l + r - x, -v, t + T/2) start at t = 0 in "
    "another disk, disjoint from it, of the same area, with the same property"
)

THEOREM = Island
