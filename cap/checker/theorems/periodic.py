"""Periodic orbits with any events: type, multipliers, and a basin for those that attract.

*Determinant.*  ``events.determinant``; it is exactly 1 if e = 1, mu = 0 and all events are hits,
and exactly 0 if there is a stick or a capture.

*Multipliers* are the zeros of z^2 - trace z + det.  If trace^2 > 4 det they are real, and (trace +-
sqrt(trace^2 - 4 det))/2, with the sign of the trace, is the larger one in modulus; the other is det
divided by it.  If trace^2 < 4 det they are trace/2 +- i sqrt(det - trace^2/4).

*Type.*  Both multipliers lie inside the unit circle if and only if det < 1 and |trace| < 1 + det;
for trace > 1 + det one is real and > 1, for trace < -1 - det one is real and < -1, and the other
one lies inside the unit circle, for 0 <= det <= 1.

*Basin.*  Let E be the ellipse |W (z - P*)| <= 1.  From z - P* = W^-1 y, |y| <= 1: the components of
z - P* are at most the norms of the rows of W^-1.  So E lies in the rectangle B of these half-widths
around P*.  B is convex, so for z in B

    W (Phi^n(z) - P*) = N W (z - P*),      N = the mean of N(.) = W (Phi^n)'(.) W^-1 from P* to z,

and |W (Phi^n(z) - P*)| <= kappa |W (z - P*)| on E if the norm of each such N is at most kappa.  The
entries of N(.) are the derivatives of the rows of W Phi^n in the directions of the columns of W^-1.
With G an enclosure over B of the gradient of one of them,

    N(P* + s (z - P*)) in N(P*) + s G (z - P*),    mean in N(m) + G (P* - m) + G (z - P*)/2.

*The norm.*  A matrix ((a, b), (c, d)) is the sum of a similarity and a reflected one, of the norms
|(a + d, c - b)|/2 and |(a - d, b + c)|/2; its norm is their sum.  The norm of the rest, N minus the
matrix of its midpoints, is at most the root of the sum of squares.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.flow.capture import captures
from cap.checker.flow.events import (
    WORDS,
    LossyMap,
    determinant,
    in_order,
    limit_events,
    turning_factor,
)
from cap.checker.flow.itinerary import MAX_EVENTS, Passage, PeriodMap
from cap.checker.kernel.alternatives import OneOrOther
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, lift, raised
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Enclosure, Field, Many, Quantity, Table, Whole, Word
from cap.checker.maps.fixed_point import (
    KRAWCZYK_ORDER,
    WINDOWS,
    FixedPoint,
    Point,
    krawczyk_theorem,
)
from cap.checker.system.lossy import SYSTEM, WithLosses

MAX_PERIODS = 16
Matrix = list[list[Interval]]
SINKS = ("superstable", "sink focus", "sink node")
TYPES = (*SINKS, "elliptic", "saddle", "flip saddle")


class Periodic(WithLosses, FixedPoint):
    """An orbit of the period nT has the itinerary, the type and the basin claimed."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        *FixedPoint.HINTS,
        Field("events", WINDOWS, "", "", "every orbit from the box has its k-th event in the k-th"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("period", Whole(1, MAX_PERIODS), "", "n", "Phi is the map over n periods T here"),
        Field("itinerary", Many(Word(WORDS), 1, MAX_EVENTS), "", "",
              "all events of every orbit from the box in (0, nT), in their order"),
        *FixedPoint.CLAIMS,
        Field("event_times", Many(Quantity("omega^-1"), 1, MAX_EVENTS), "itinerary", "t_k",
              "of each event; of a capture, where the hits accumulate (then of any width)"),
        Field("turning_factors", Many(Quantity(), 0, MAX_EVENTS), "factor of turn",
              r"(|a_k| - f)/(|a_k| + f)", "(|a| - f)/(|a| + f) at each turn, a = F cos(omega t)"),
        Field("multipliers", [OneOrOther({"re": Quantity(), "im": Quantity()}, Quantity())] * 2,
              "multiplier", r"\lambda", "the eigenvalues: two enclosures, larger modulus first, "
              "if they are real; two objects, im > 0 first, if not"),
        Field("type", Word(TYPES), "", "", "by trace and determinant, as below"),
        Field("basin", Maybe({"matrix": [[number] * 2] * 2, "contraction": number}), "", "",
              "for sinks and superstable orbits only: W and kappa < 1 with |W (Phi(z) - P*)| <= "
              "kappa |W (z - P*)| for all z of the ellipse |W (z - P*)| <= 1, in the box"),
    )
    # fmt: on
    CITES = (
        krawczyk_theorem(
            "Phi^n, n the period, is continuously differentiable on the box: all hits and stops "
            "are transverse, and every stick and capture ends at a fixed time",
            "K(box) lies in the interior of the box",
        ),
    )

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        limit_events(hints, claims)

    @property
    def phi(self) -> PeriodMap:
        """The map over n periods."""
        windows = [w[:2] for w in self.hints["events"]]
        return LossyMap(self.p, windows, self.claims["itinerary"], self.claims["period"])

    def orbit(self, fixed_point: Point, orbit: Passage) -> None:
        """Compare the claims about P*, about the events, and the spectrum."""
        super().orbit(fixed_point, orbit)
        words = self.claims["itinerary"]
        times = zip(words, self.claims["event_times"], strict=True)
        claimed = [t._replace(unit=None) if w.startswith("capture") else t for w, t in times]
        self.compare("event_times", claimed, [e.moment.t.value for e in orbit.events])
        in_order(words, self.claims["event_times"])
        turns = [e for e in orbit.events if e.word.startswith("turn")]
        self.confirm(turning_factors=[turning_factor(orbit.mechanics, e) for e in turns])
        self.step("the claims about the orbit of P* contain what is computed")
        self.spectrum(orbit)

    def spectrum(self, orbit: Passage) -> None:
        """Compare trace, determinant and multipliers."""
        (a, b), (c, d) = orbit.jacobian
        trace, det, claim = a + d, determinant(orbit), self.claims["determinant"]
        exact = self.exact_determinant()
        if exact is not None:
            need(claim[:2] == (exact, exact), f"the determinant is exactly {exact}")
            det = self.number(exact)
        det = det.intersection(a * d - b * c)
        self.confirm(determinant=det)
        if isinstance(self.claims["multipliers"][0], Enclosure):
            larger = [trace, self.number(0)] if exact == 0 else real(trace, det)
            self.confirm(multipliers=larger)
        else:
            half = trace / 2
            im = (det - half.square()).sqrt()
            need(im.is_positive(), "the multipliers may be real")
            self.confirm(multipliers=[{"re": half, "im": y} for y in (im, -im)])
        self.step("so do trace, determinant and multipliers")

    def exact_determinant(self) -> Fraction | None:
        """Return the determinant if it is known to be exactly 0 or 1."""
        kinds = {word.split()[0] for word in self.claims["itinerary"]}
        if kinds & {"stick", "capture"}:
            return Fraction(0)
        conservative = self.p.e == 1 and self.p.mu == 0 and kinds == {"hit"}
        return Fraction(1) if conservative else None

    def conclude(self, fixed_point: Point, orbit: Passage) -> None:  # noqa: ARG002
        """Prove the type and, if the orbit attracts, the basin."""
        self.kind()
        attracts, found = self.claims["type"] in SINKS, "basin" in self.claims
        need(found or not attracts, "claims.basin is missing")
        need(attracts or not found, "claims.basin is unknown to this type")
        if attracts:
            self.basin(fixed_point)

    def kind(self) -> None:
        """Check that trace and determinant claimed have the type claimed."""
        trace, det, claim = self.claims["trace"], self.claims["determinant"], self.claims["type"]
        far = max(-trace.lower, trace.upper)
        near = max(trace.lower, -trace.upper, Fraction(0))
        attracts = det.lower > 0 and det.upper < 1 and far < 1 + det.lower
        holds = {
            "elliptic": det[:2] == (1, 1) and far < 2,
            "superstable": det[:2] == (0, 0) and far < 1,
            "sink focus": attracts and far**2 < 4 * det.lower,
            "sink node": attracts and near**2 > 4 * det.upper,
            "saddle": trace.lower > 1 + det.upper,
            "flip saddle": trace.upper < -1 - det.upper,
        }
        need(holds[claim], f"the type is not certainly: {claim}")
        self.step(f"the type is: {claim}")

    def basin(self, fixed_point: Point) -> None:
        """Prove that the ellipse lies in the box and is contracted."""
        (a, b), (c, d) = W = self.claims["basin"]["matrix"]
        kappa, det = self.claims["basin"]["contraction"], a * d - b * c
        need(det != 0, "the matrix of the basin is singular")
        need(kappa < 1, "the contraction is not below 1")
        inverse = [[d / det, -b / det], [-c / det, a / det]]
        rectangle = list[Interval]()
        for z, row in zip(fixed_point, inverse, strict=True):
            reach = self.number(row[0] ** 2 + row[1] ** 2).sqrt().hi
            rectangle.append(z + Interval(-reach, reach, z.bits))
        need(self.is_in_the_box(rectangle), "the basin does not certainly lie in the box")
        image = self.near(rectangle, fixed_point, KRAWCZYK_ORDER)
        N: Matrix = []
        for row in W:
            p, q = (self.number(w) for w in row)
            component = lift(lambda x, v, p=p, q=q: x * p + v * q, image.x, image.v)
            columns = [[self.number(w[j]) for w in inverse] for j in (0, 1)]
            derivatives = [lift(lambda u, w=w: slope_along(u, *w), component) for w in columns]
            N.append([mean(u, fixed_point) for u in derivatives])
        need(norm(N).upper <= kappa, "the basin may not be contracted as claimed")
        self.step("the basin lies in the box and is mapped into itself, contracted as claimed")

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told(f"{SYSTEM}{_PERIODIC}{_BASIN if 'basin' in self.claims else ''}")

    def told(self, sentence: str, **more: object) -> str:
        """Return a sentence with the numbers claimed."""
        claims, det = self.claims, self.claims["determinant"]
        words = {
            "itinerary": ", ".join(claims["itinerary"]),
            "captures": captures(claims["itinerary"]),
            "determinant": det.lower if det.lower == det.upper else f"in {det}",
            "multipliers": " and ".join(map(_multiplier, claims["multipliers"])),
        }
        if "basin" in claims:
            rows = [f"({p}, {q})" for p, q in claims["basin"]["matrix"]]
            words |= {"W": f"({', '.join(rows)})", "kappa": claims["basin"]["contraction"]}
        return super().told(sentence, **words, **more)


def slope_along(jet: RealJet, p: Interval, q: Interval) -> RealJet:
    """Return the derivative of a jet of two variables in the direction (p, q), one order less."""
    total = Jet[Interval](jet.order - 1, {})
    for (i, j), c in jet.coefficients.items():
        for power, factor in (((i - 1, j), p * i), ((i, j - 1), q * j)):
            if min(power) >= 0:
                total = total + Jet(total.order, {power: c * factor})
    return total


def mean(u: Centred, start: Point) -> Interval:
    """Return an enclosure of the means of a quantity on the segments from a point to the box."""
    total = u.centre.coefficients.get((0, 0), start[0].integer(0))
    for power, offset, z in zip(raised((0, 0)), u.offsets, start, strict=True):
        here = z - z.midpoint()
        total = total + u[power] * here + u[power] * ((offset - here) / 2)
    return total


def real(trace: Interval, det: Interval) -> list[Interval]:
    """Return the real zeros of z^2 - trace z + det, of positive product, the larger one first."""
    if trace.contains_zero():
        raise Rejected("the multipliers may be complex")
    root = (trace.square() - det * 4).sqrt()
    larger = (trace + (root if trace.is_positive() else -root)) / 2
    return [larger, det / larger]


def norm(N: Matrix) -> Interval:
    """Return an interval of which the upper end bounds the norm of every matrix in N."""
    (a, b), (c, d) = ([z.midpoint() for z in row] for row in N)
    similar = ((a + d).square() + (c - b).square()).sqrt()
    reflected = ((a - d).square() + (b + c).square()).sqrt()
    rest = a.integer(0)
    for z in (*N[0], *N[1]):
        rest = rest + (z - z.midpoint()).square()
    return (similar + reflected) / 2 + rest.sqrt()


def _multiplier(claim: Any) -> str:
    """Return where a multiplier lies."""
    return f"in {claim['re']} + i {claim['im']}" if isinstance(claim, dict) else f"in {claim}"


_PERIODIC = (
    "with Phi the time-T map of (x, v) from t = 0, T = 2 pi/omega, and n = {period}, Phi^n has one "
    "and only one fixed point P* in {box[x]} x {box[v]}, with x in {x}, v in {v}; all orbits from "
    "this box have in (0, nT) exactly these events, in this order: {itinerary}{captures}; the "
    "Jacobian of Phi^n at P* has its trace in {trace}, the determinant {determinant} and the "
    "multipliers {multipliers}: {type}"
)
_BASIN = (
    "; the ellipse |W (z - P*)| <= 1 with the matrix W = {W} lies in the box, and |W "
    "(Phi^n(z) - P*)| <= {kappa} |W (z - P*)| for all z in it: its orbits converge to that of P*"
)

THEOREM = Periodic
