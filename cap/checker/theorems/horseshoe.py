"""The theorem about chaos of motions that never stop: an invariant set with positive entropy.

Let e = 1, mu = 0, 0 <= f < F, Phi the map of (x, v) over the period 2 pi/omega from t = 0.  sigma
is the flow over half a period, followed by the symmetry (x, v) -> -(x, v) (x from the middle
between the walls): sigma^2 = Phi (`half_period`, which also has where sigma is defined: for motions
whose velocity does not vanish, and which hit one wall in that time).

*Claimed:* there is a compact set Lambda with sigma(Lambda) = Lambda, so Phi(Lambda) = Lambda, all
motions from which never have the velocity 0, in the past and in the future.  The topological
entropy of Phi on Lambda is at least ``entropy``.  For each n, sigma^n has at least tr(A^n)/mu fixed
points in Lambda, A the matrix of the coverings, mu = ``together``.  If mu = 1, the sets are
disjoint, and sigma on Lambda is semiconjugate onto the subshift of A.

*Proof.*  The coverings hold (`covering`); sigma is continuous on the sets.  By `graph`, the entropy
of sigma on Lambda is at least log rho(A) >= log ``growth``; that of Phi = sigma^2 is twice as
large."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import Any

from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.graph import (
    confirm_entropy,
    confirm_growth,
    confirm_no_diamond,
    confirm_paths,
    overlaps,
)
from cap.checker.coverings.half_period import HalfPeriod
from cap.checker.kernel.citation import cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import MAX_SIZE, number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import Field, Many, Whole
from cap.checker.system.walls import SYSTEM, BetweenWalls

MOST_SETS, MOST_TARGETS = 6000, 12
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
TOGETHER = Field("together", Whole(1, MOST_SETS), "", "",
                 "1 if the sets are disjoint; else 1 + the most that overlap with one")  # fmt: skip


class Horseshoe(BetweenWalls):
    """Entropy of motions that never stop."""

    HINTS = (
        SETS._replace(meaning=f"{SETS.meaning}; in units F/omega^2, F/omega, x from the middle"),
        COVERINGS,
        VECTOR,
    )
    CLAIMS = (
        GROWTH,
        Field("entropy", number, "", "", "a lower bound of the entropy of Phi"),
        TOGETHER,
    )
    CITES = (
        cite(
            "Poincare-Miranda",
            "Miranda, Un'osservazione su un teorema di Brouwer, Boll. Un. Mat. Ital. 3, 1940",
            ("faces", "of 2n continuous functions on a product of 2n intervals the k-th has "
             "opposite signs on the two faces of the k-th interval", "growth"),
        ),
    )  # fmt: skip

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:  # noqa: ARG003
        """Bound what becomes a double, and the work."""
        small = all(abs(n) <= MAX_SIZE for numbers in hints["sets"] for n in numbers)
        need(small, "a number of a set is larger than 10^30")
        short = all(_PLACES % n.denominator == 0 for numbers in hints["sets"] for n in numbers)
        need(short, "a number of a set is no decimal of at most 40 places")
        need(len(hints["coverings"]) == len(hints["sets"]), "not one list for each set")
        need(all(v.denominator == 1 for v in hints["vector"]), "the vector is not of integers")

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
        g = self.half_period()
        weight = lambda i: float(len(edges[i]))  # noqa: E731
        boxes = work(partial(confirm_coverings, g, sets, edges), range(len(sets)), _CHECKED, weight)
        self.step(f"{count} coverings hold ({sum(boxes)} boxes)")
        confirm_growth(edges, [int(v) for v in self.hints["vector"]], self.claims["growth"])
        confirm_entropy(self.claims["entropy"], self.claims["growth"], 2)
        self.step("the matrix of the coverings grows as claimed, and the entropy follows")

    def half_period(self) -> HalfPeriod:
        """Return sigma, in natural units."""
        a = self.R * self.omega**2 / (2 * self.p.F)
        return HalfPeriod(self.p.f / self.p.F, a)

    def apart(self) -> str:
        """Return what is known of overlaps."""
        if self.claims["together"] == 1:
            return "the sets are pairwise disjoint"
        return "sets overlap, but two paths with the same ends are in disjoint sets at some time"

    def words(self) -> str:
        """Return the theorem in one line."""
        kind = _DISJOINT if self.claims["together"] == 1 else _OVERLAPPING
        edges = sum(map(len, self.hints["coverings"]))
        claimed = {name: decimal(self.claims[name]) for name in ("growth", "entropy")}
        text, sets = SYSTEM + _HORSESHOE + kind, len(self.hints["sets"])
        return self.told(text, sets=sets, edges=edges, **claimed)


def confirm_overlaps(sets: list[list[Fraction]], edges: list[list[int]]) -> int:
    """Check that there is no diamond; return a bound of how many sets overlap pairwise."""
    overlapping = overlaps(sets)
    confirm_no_diamond(edges, overlapping)
    return 1 + max(map(len, overlapping))


def confirm_coverings(g: Any, sets: list[list[Fraction]], edges: list[list[int]], i: int) -> int:
    """Check all coverings by a set; return the number of boxes."""
    return covers(g, Parallelogram(sets[i]), [Parallelogram(sets[j]) for j in edges[i]])


_CHECKED = "coverings are checked"
_PLACES = 10**40  # overlaps are computed over a common denominator
_HORSESHOE = (
    "sigma, the flow over half a period from t = 0 followed by the symmetry (x, v) -> (l + r - x, "
    "-v), whose square is the time-T map Phi, T = 2 pi/omega, has a compact invariant set Lambda "
    "of states whose motions never have the velocity 0, neither later nor before; the topological "
    "entropy of Phi on Lambda, per period T, is at least {entropy}: {sets} parallelograms and "
    "{edges} coverings between them, with a matrix A of a spectral radius of at least {growth}; "
)
_DISJOINT = (
    "the parallelograms are disjoint: sigma on Lambda is semiconjugate onto the subshift of A, and "
    "for each n sigma^n has at least tr(A^n) fixed points in Lambda"
)
_OVERLAPPING = (
    "some of them overlap, but without diamonds: for each n sigma^n has at least "
    "tr(A^n)/{together} fixed points in Lambda; no semiconjugacy onto a subshift is claimed"
)

THEOREM = Horseshoe
