"""What theorems on coverings share: sets and coverings in a certificate, a bound of the entropy.

Let g be a planar map (`planar`).  *Claimed:* there is a compact set Lambda with g(Lambda) = Lambda,
on which the topological entropy of a map is at least ``entropy``: of g, or of g^2 if ``ITERATES``
is 2.  For each n, g^n has at least tr(A^n)/mu fixed points in Lambda, A the matrix of the
coverings, mu = ``together``.  If mu = 1, the sets are disjoint.  If ``orbits`` are claimed, these
periodic orbits are in Lambda, different saddles, each the only one in its box (`orbits`).  If
``cones`` are claimed, of disjoint sets, Lambda is hyperbolic, and g on the orbits in Lambda is
conjugate to the two-sided subshift of A (`cones`).

*Proof.*  The coverings hold (`covering`); g is continuous on the sets.  By `graph`, the entropy of
g on Lambda is at least log rho(A) >= log ``growth``; that of g^2 is twice as large.  With cones
orbits and paths correspond one to one, continuously, on compact spaces: by a homeomorphism."""

from __future__ import annotations

from abc import abstractmethod
from fractions import Fraction
from functools import partial
from typing import Any, ClassVar

from cap.checker.coverings.cones import UNITS, Cone, Rates, carried, cone, rates
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.graph import (
    confirm_entropy,
    confirm_no_diamond,
    confirm_paths,
    overlaps,
)
from cap.checker.coverings.orbits import LONGEST, MOST_ORBITS, confirm_orbits
from cap.checker.coverings.planar import Matrix, Planar
from cap.checker.kernel.citation import Citation, cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.growth import confirm_growth
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import MAX_SIZE, number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import Field, Many, Table, Whole, region
from cap.checker.kernel.theorem import Theorem

MOST_SETS, MOST_TARGETS = 12_000, 12
SETS = Field(
    "sets", Many([number] * 6, 1, MOST_SETS), "", "",
    "parallelograms c + p a + q b, |p|, |q| <= 1, each as the coordinates of c, a, b",
)  # fmt: skip
COVERINGS = Field(
    "coverings", Many(Many(Whole(0, MOST_SETS), 1, MOST_TARGETS), 1, MOST_SETS), "", "",
    "for each set the numbers, from 0, of sets that it covers",
)  # fmt: skip
VECTOR = Field(
    "vector", Many(number, 1, MOST_SETS), "", "",
    "integers v >= 0 with A v >= growth v, A the matrix of the coverings",
)  # fmt: skip
GROWTH = Field("growth", number, "", "", "a lower bound of the spectral radius of A")
ENTROPY = Field("entropy", number, "", "", "a lower bound of the entropy")
TOGETHER = Field("together", Whole(1, MOST_SETS), "", "",
                 "1 if the sets are disjoint; else 1 + the most that overlap with one")  # fmt: skip
ORBITS = Field(
    "orbits",
    Maybe(Many({"path": Many(Whole(0, MOST_SETS), 1, LONGEST), "box": [region, region]},
               1, MOST_ORBITS)), "", "",
    "periodic orbits: the sets of a closed path, and a box of states in the first of them",
)  # fmt: skip
CONES = Field(
    "cones", Maybe({"stretch": number, "shrink": number}), "", "",
    "cones are mapped into cones: a lower bound of what they are stretched by, in coordinates "
    "along the directions given, and an upper bound of what other vectors are shrunk by",
)  # fmt: skip
LEANING = Field(
    "cones",
    Maybe({
        "slope": number,
        "leaning": Many([number] * 2, 1, MOST_SETS),
        "units": Maybe(Many([number] * 3, 1, MOST_SETS)),
    }), "", "",
    "the slope L of all cones, and for each set sigma and tau: the directions (1, sigma) and "
    "(tau, 1) in its coordinates; for each set how much steeper than L its cone is, and the units "
    "of both coordinates (1, if not given)",
)  # fmt: skip


class Coverings(Theorem):
    """Entropy of a planar map, by coverings."""

    HINTS: ClassVar[Table] = (SETS, COVERINGS, VECTOR, LEANING)
    CLAIMS: ClassVar[Table] = (GROWTH, ENTROPY, TOGETHER, ORBITS, CONES)
    CITES: ClassVar[tuple[Citation, ...]] = (
        cite(
            "Poincare-Miranda",
            "Miranda, Un'osservazione su un teorema di Brouwer, Boll. Un. Mat. Ital. 3, 1940",
            ("faces", "of 2n continuous functions on a product of 2n intervals the k-th has "
             "opposite signs on the two faces of the k-th interval", "growth"),
        ),
    )  # fmt: skip
    ITERATES: ClassVar[int] = 1
    MAP: ClassVar[str] = "g"
    SHIFT: ClassVar[str] = "one-sided subshift"

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound what becomes a double, and the work."""
        small = all(abs(n) <= MAX_SIZE for numbers in hints["sets"] for n in numbers)
        need(small, "a number of a set is larger than 10^30")
        short = all(_PLACES % n.denominator == 0 for numbers in hints["sets"] for n in numbers)
        need(short, "a number of a set is no decimal of at most 40 places")
        need(len(hints["coverings"]) == len(hints["sets"]), "not one list for each set")
        need(all(v.denominator == 1 for v in hints["vector"]), "the vector is not of integers")
        boxes = [side for orbit in claims.get("orbits", ()) for side in orbit["box"]]
        small = all(abs(n) <= MAX_SIZE for side in boxes for n in (side.lower, side.upper))
        need(small, "an end of a box is larger than 10^30")
        need(("cones" in hints) == ("cones" in claims), "cones are not both claimed and given")
        if "cones" in hints:
            slope, leaning = hints["cones"]["slope"], hints["cones"]["leaning"]
            need(0 < slope <= STEEPEST, f"the slope of the cones is not in (0, {STEEPEST}]")
            need(len(leaning) == len(hints["sets"]), "not one pair of directions for each set")
            flat = all(abs(n) <= STEEPEST for pair in leaning for n in pair)
            need(flat, f"a direction of a set is steeper than {STEEPEST}")
            units = hints["cones"].get("units", [])
            need(len(units) in (0, len(leaning)), "not units for each set")
            given = all(0 < n <= LARGEST_UNIT for three in units for n in three)
            need(given, f"a unit of a set is not in (0, {LARGEST_UNIT}]")

    @abstractmethod
    def map(self) -> Planar:
        """Return g."""

    @in_doubles()
    def prove(self) -> None:
        """Prove the theorem."""
        sets, edges = self.hints["sets"], self.hints["coverings"]
        confirm_paths(edges)
        self.step(f"each of {len(sets)} sets covers some, and is covered by some")
        together = confirm_overlaps(sets, edges)
        need(together == self.claims["together"], f"together is not {together}")
        self.step(self.apart())
        count = sum(map(len, edges))
        work = Work(self.jobs, self.tell, {_CHECKED: float(count)})
        weight = lambda i: float(len(edges[i]))  # noqa: E731
        covered = partial(confirm_coverings, self.map(), sets, edges)
        boxes = work(covered, range(len(sets)), _CHECKED, weight)
        self.step(f"{count} coverings hold ({sum(boxes)} boxes)")
        vector, growth = [int(v) for v in self.hints["vector"]], self.claims["growth"]
        confirm_growth(edges, vector, [growth] * len(edges))
        confirm_entropy(self.claims["entropy"], growth, self.ITERATES)
        self.step("the matrix of the coverings grows as claimed, and the entropy follows")
        if orbits := self.claims.get("orbits"):
            confirm_orbits(self.map(), sets, edges, orbits)
            self.step(f"{len(orbits)} periodic orbits along paths are different saddles")
        if "cones" in self.claims:
            self.confirm_cones()

    def confirm_cones(self) -> None:
        """Check the cones of all coverings."""
        claimed, given = self.claims["cones"], self.hints["cones"]
        sets, edges = self.hints["sets"], self.hints["coverings"]
        need(self.claims["together"] == 1, "cones are claimed of sets that are not disjoint")
        work = Work(self.jobs, self.tell, {_CONES: float(sum(map(len, edges)))})
        weight = lambda i: float(len(edges[i]))  # noqa: E731
        matrices = work(
            partial(matrices_of, self.map(), sets, edges), range(len(sets)), _CONES, weight
        )
        found = cone_rates(matrices, edges, cones_of(given))
        stretch, shrink = map(Fraction, found)
        need(1 < claimed["stretch"] <= stretch, "cones may not be stretched as claimed")
        need(shrink <= claimed["shrink"] < 1, "what is outside may not be shrunk as claimed")
        self.step("cones are mapped into cones: each path of coverings has one orbit only")

    def apart(self) -> str:
        """Return what is known of overlaps."""
        if self.claims["together"] == 1:
            return "the sets are pairwise disjoint"
        return "sets overlap, but two paths with the same ends are in disjoint sets at some time"

    def bounded(self, sentence: str, after: str = "", **more: object) -> str:
        """Return a sentence with the bounds claimed, what is said of the sets, and what follows."""
        told: dict[str, object] = {"map": self.MAP, "shift": self.SHIFT}
        told |= {"sets": len(self.hints["sets"]), "edges": sum(map(len, self.hints["coverings"]))}
        told |= {name: decimal(self.claims[name]) for name in ("growth", "entropy")} | more
        kind = _DISJOINT if self.claims["together"] == 1 else _OVERLAPPING
        return self.told(sentence + _SETS + kind + after, **told) + self.besides()

    def besides(self) -> str:
        """Return what is claimed of periodic orbits and of cones."""
        words = ""
        if orbits := self.claims.get("orbits"):
            periods = sorted(len(orbit["path"]) for orbit in orbits)
            told = ", ".join(map(str, periods))
            words += _ORBITS.format(g=self.MAP, number=len(orbits), periods=told)
        if cones := self.claims.get("cones"):
            bounds = {name: decimal(cones[name]) for name in ("stretch", "shrink")}
            units = _UNITS if "units" in self.hints["cones"] else ""
            words += _CONES_HOLD.format(g=self.MAP, units=units, **bounds)
        return words


def confirm_overlaps(sets: list[list[Fraction]], edges: list[list[int]]) -> int:
    """Check that there is no diamond; return a bound of how many sets overlap pairwise."""
    overlapping = overlaps(sets)
    confirm_no_diamond(edges, overlapping)
    return 1 + max(map(len, overlapping))


def confirm_coverings(g: Planar, sets: list[list[Fraction]], edges: list[list[int]], i: int) -> int:
    """Check all coverings by a set; return the number of boxes."""
    return covers(g.on(i), Parallelogram(sets[i]), [Parallelogram(sets[j]) for j in edges[i]])


def matrices_of(
    g: Planar, sets: list[list[Fraction]], edges: list[list[int]], i: int
) -> list[Matrix]:
    """Return the matrices that carry coordinates along all coverings by a set."""
    return carried(g.on(i), Parallelogram(sets[i]), [Parallelogram(sets[j]) for j in edges[i]])


def cones_of(given: dict[str, Any]) -> list[Cone]:
    """Return the cones of all sets."""
    leaning, slope = given["leaning"], given["slope"]
    units = given.get("units", [UNITS] * len(leaning))
    return [cone(pair, slope, three) for pair, three in zip(leaning, units, strict=True)]


def cone_rates(matrices: list[list[Matrix]], edges: list[list[int]], cones: list[Cone]) -> Rates:
    """Check the cones of all coverings; return their rates."""
    found = [
        rates(A, cones[i], cones[j])
        for i, targets in enumerate(edges)
        for j, A in zip(targets, matrices[i], strict=True)
    ]
    return Rates(min(r.stretch for r in found), max(r.shrink for r in found))


STEEPEST, LARGEST_UNIT = 1000, 10**6
_CHECKED, _CONES = "coverings are checked", "cones are checked"
_SETS = (
    "{sets} parallelograms and {edges} coverings between them, with a matrix A of a spectral "
    "radius of at least {growth}; "
)
_DISJOINT = (
    "the parallelograms are disjoint: {map} on Lambda is semiconjugate onto the {shift} of A, and "
    "for each n {map}^n has at least tr(A^n) fixed points in Lambda"
)
_OVERLAPPING = (
    "some of them overlap, but without diamonds: for each n {map}^n has at least "
    "tr(A^n)/{together} fixed points in Lambda; no semiconjugacy onto a subshift is claimed"
)
_ORBITS = (
    "; {number} different periodic orbits of {g} in Lambda are saddles, of the least periods "
    "{periods}: each is the only one of its period that meets its box"
)
_CONES_HOLD = (
    "; along each bi-infinite path of coverings there is one orbit only, so {g}, on the orbits in "
    "Lambda, is conjugate to the two-sided subshift of A; Lambda is hyperbolic: in coordinates "
    "along two directions of each set{units} expanding vectors grow at least by the factor "
    "{stretch} each time, contracting ones shrink at least by the factor {shrink}"
)
_UNITS = ", in units of each,"
_PLACES = 10**40  # overlaps are computed over a common denominator
