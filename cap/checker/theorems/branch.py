"""The theorem about the branch: the pairs of (1,1) orbits for a whole range of f.

1, 2. On cells that cover [0, D] f, trace and least speed decrease with delta, so every f in [F
   alpha(delta_0), F alpha(0)) has exactly one pair, and it is genuine (``falling``).
3. A rotation number p/q is met where trace = 2 cos(2 pi p/q), so exactly once if
   trace(delta_0) is below, and not at all for delta <= delta_0 if it is above.
4. On the cells with a sign, N has it (``twist``), and |trace| < 2.  At a zero of N with trace
   != -1, tau_1 = 0; between two cells of opposite sign there is one.
5. Let f be in the range, trace > -2 there, and f not in an exception.  Then its delta lies in a
   cell with a sign, since the f of all other cells with trace > -2 somewhere are in exceptions; and
   no e^(ik Theta) is 1 for k = 1, ..., 4.  Hence tau_1 != 0 and [Moser].

The mirror (x, v, t) -> (l + r - x, -v, t + T/2) preserves dx^dv and makes the maps Phi at the two
orbits of a pair conjugate: they have the same trace and the same tau_1.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from itertools import pairwise
from math import gcd
from typing import Any

from cap.checker.kernel.choices import OrNone
from cap.checker.kernel.citation import cite
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure, Field, Many, Quantity, Word, enclosure, region
from cap.checker.kernel.taken import Taken
from cap.checker.kernel.theorem import BITS
from cap.checker.kernel.twist_theorem import MOSER
from cap.checker.one_one import pairs
from cap.checker.one_one.falling import CELL_DIGITS, Ends, Falling
from cap.checker.one_one.scaled import SYSTEM
from cap.checker.one_one.twist import regularised_twist
from cap.checker.system import all_f

MAX_CELLS = 512
MAX_WORK = 1 << 27  # bits^2 times cells and zeros of the twist
MAX_RESONANCES = 16
MAX_ZEROS = 64
_MOST = 8  # the largest denominator of the rotation numbers
TWIST_DIGITS = 1
RATIOS = sorted(
    Fraction(p, q) for q in range(2, _MOST + 1) for p in range(1, q // 2 + 1) if gcd(p, q) == 1
)
LOW_ORDER = [q for q in RATIOS if q.denominator <= 4 and q < Fraction(1, 2)]
RESONANCE = {"ratio": Word([str(q) for q in RATIOS]), "f": Quantity("F")}
CELL = {
    "delta": region,
    "f": Taken("F", CELL_DIGITS),
    "trace": Taken("", CELL_DIGITS),
    "least_speed": Taken("R omega", CELL_DIGITS),
    "twist": OrNone(Word(("+", "-"))),
    "regular_twist": OrNone(Taken(None, TWIST_DIGITS)),
}
# fmt: off
MOSER_ON_A_BRANCH = cite(
    *MOSER,
    ("H1", "for every f in f_range, both orbits of the pair hit each wall once in a period, "
     "transversely, and never turn or stick", "f_range, cells"),
    ("H2", "the map from one hit of r to the next, in time and energy, to which Phi is conjugate, "
     "is exact symplectic near the fixed point: flights and hits preserve dx^dv, and a disk is "
     "simply connected", "f_range, cells"),
    ("H3", "this map is real analytic near the fixed point: the hit times are, by the implicit "
     "function theorem", "f_range, cells"),
    ("H4", "trace > -2 is assumed and trace < 2 is proved: the eigenvalues of the Jacobian are "
     "exp(+-i Theta), 0 < |Theta| < pi", "cells, resonances"),
    ("H5", "no resonance of order at most four, for f outside the exceptions",
     "resonances, exceptions"),
    ("H6", "the first Birkhoff twist coefficient does not vanish, for f outside the exceptions",
     "cells, twist_zeros, exceptions"),
)
# fmt: on


class Branch(all_f.ForAllF, Falling):
    """The pairs of (1,1) orbits, from their birth on."""

    # fmt: off
    HINTS = (
        BITS,
        Field("end", OrNone([number] * 2), "", "", "[lower, upper], upper = D: L(lower) > 0 > "
              'L(upper); "none" if f_end is'),
        Field("resonances", Many(enclosure, 0, MAX_RESONANCES), "", "", "as in the claims: "
              "between the ends of each, in (0, delta_0], trace crosses 2 cos(2 pi p/q)"),
        Field("twist_zeros", Many(enclosure, 0, MAX_ZEROS), "", "", "ascending: at the ends of "
              "each, in (0, delta_0], N has opposite signs, and in between the trace is not -1"),
    )
    CLAIMS = (
        Field("f_start", Quantity("F"), "born at", "f_0", "F alpha(0)"),
        Field("f_end", OrNone(Quantity("F")), "least speed vanishes at", r"f_{\mathrm{end}}",
              'f where L = 0; "none" if L(D) > 0'),
        Field("trace_end", OrNone(Quantity()), "  with trace", r"\operatorname{tr} D\Phi",
              'the trace there; "none" if f_end is'),
        Field("f_range", region, "", "", "for every f in it there is exactly one pair, and it is "
              "genuine; below F alpha(0), not below F alpha(delta_0)"),
        Field("resonances", Many(RESONANCE, 0, MAX_RESONANCES), "trace = 2 cos(2 pi p/q), p/q =",
              "f_{p/q}", "all p/q in lowest terms, 0 < p/q <= 1/2, q <= 8, ascending, for which "
              "trace = 2 cos(2 pi p/q) at a delta < delta_0, with that f"),
        Field("twist_zeros", Many(Taken("F", CELL_DIGITS), 0, MAX_ZEROS), "twist vanishes at",
              r"f_{\tau_1 = 0}", "f descending: in each there is an f with tau_1 = 0"),
        Field("exceptions", Many(region, 0, MAX_CELLS + MAX_RESONANCES), "but perhaps not in", "",
              "ascending, disjoint: the f in f_range with trace > -2 for which Moser's theorem may "
              "fail; larger by at most 10^-6 F if not cut"),
        Field("cells", Many(CELL, 1, MAX_CELLS), "", "", "delta from 0 to D < pi/2, each cell "
              "beginning where the last one ends; what f, trace and least speed take on it; the "
              'sign of N and what N takes, or "none"'),
    )
    # fmt: on
    CITES = (MOSER_ON_A_BRANCH,)

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        needed = hints["bits"] ** 2 * (len(claims["cells"]) + len(hints["twist_zeros"]))
        need(needed <= MAX_WORK, f"bits and cells are too much: {needed} > {MAX_WORK}")
        for name in ("resonances", "twist_zeros"):
            count = len(hints[name])
            need(len(claims[name]) == count, f"claims.{name} is not a list of {count}")

    def prove(self) -> None:
        """Prove the theorem."""
        self.cover()
        self.f_start()
        self.deepest = self.end()
        self.range()
        self.resonances()
        for n, cell in enumerate(self.claims["cells"]):
            self.cell(n, cell)
        self.step("on every cell f, trace and least speed decrease; the twist has the sign claimed")
        self.twist_zeros()
        self.exceptions()

    def resonances(self) -> None:
        """Check that the rotation numbers claimed are all that are met, and where."""
        claims = self.claims["resonances"]
        met = [ratio for ratio in RATIOS if self.is_met(ratio)]
        listed = [claim["ratio"] for claim in claims]
        expected = [str(q) for q in met]
        need(listed == expected, f"the rotation numbers are: {', '.join(expected)}")
        for ratio, claim, bracket in zip(met, claims, self.hints["resonances"], strict=True):
            name = f"resonances.{ratio}"
            low, high = self.in_view(name, bracket)
            level = self.level(ratio)
            crossed = self.at(high).trace.is_before(level) and level.is_before(self.at(low).trace)
            need(crossed, f"{name}: the trace does not cross its value in the bracket")
            self.spans(name, claim["f"], (self.at(high).f, self.at(low).f))
        self.step(f"the rotation numbers met, up to denominator {_MOST}: {', '.join(listed)}")

    def level(self, ratio: Fraction) -> Interval:
        """Return 2 cos(2 pi p/q)."""
        return cos_sin(self.pi() * 2 * self.number(ratio))[0] * 2

    def is_met(self, ratio: Fraction) -> bool:
        """Return whether the trace falls below its value for a rotation number."""
        level, trace = self.level(ratio), self.at(self.deepest).trace
        decided = trace.is_before(level) or level.is_before(trace)
        need(decided, f"whether the rotation number {ratio} is met is not decided")
        return trace.is_before(level)

    def cell(self, n: int, claim: dict[str, Any]) -> None:
        """Prove that trace and least speed decrease on a cell, and the sign of N."""
        pair = self.falls(n, claim)
        named = (claim["twist"] is None) == (claim["regular_twist"] is None)
        need(named, f"cells[{n}]: of sign and value of the twist one is missing")
        if claim["twist"] is not None:
            N = regularised_twist(pairs.over_cells(self.rho), pair).range()
            signed = (N if claim["twist"] == "+" else -N).is_positive()
            need(signed, f"cells[{n}]: the twist may not have the sign claimed")
            self.twist_value(f"cells[{n}].regular_twist", claim["regular_twist"], N)

    def twist_value(self, name: str, claim: Enclosure, N: Interval) -> None:
        """Compare the claim on N, per |z|^2: areas are in units F^2/omega^3."""
        N = N * self.number(self.p.omega**3 / self.p.F**2)
        ends = (Interval(end, end, N.bits) for end in (N.lo, N.hi))
        self.spans(name, claim, (next(ends), next(ends)), TWIST_DIGITS)
        need(claim.lower > 0 or claim.upper < 0, f"{name} contains 0")

    def twist_zeros(self) -> None:
        """Prove that the twist vanishes in each bracket, and that none is missing."""
        claims, brackets = self.claims["twist_zeros"], self.hints["twist_zeros"]
        for n, (claim, bracket) in enumerate(zip(claims, brackets, strict=True)):
            low, high = self.in_view(f"twist_zeros[{n}]", bracket)
            signs = [self.twist_at(low).is_positive(), self.twist_at(high).is_positive()]
            need(signs[0] != signs[1], f"twist_zeros[{n}]: the twist does not change its sign")
            traces = [self.at(delta).trace + 1 for delta in (low, high)]
            apart = traces[1].is_positive() or (-traces[0]).is_positive()
            need(apart, f"twist_zeros[{n}]: the trace may be -1")
            ends = self.at(high).f, self.at(low).f
            self.spans(f"twist_zeros[{n}]", claim, ends, CELL_DIGITS)
        need(all(a.upper <= b.lower for a, b in pairwise(brackets)), "twist_zeros are not in order")
        signed = [cell for cell in self.claims["cells"] if cell["twist"] is not None]
        for a, b in pairwise(signed):
            gap = a["delta"].upper, b["delta"].lower
            found = any(gap[0] <= z.lower and z.upper <= gap[1] for z in brackets)
            need(a["twist"] == b["twist"] or found, "a zero of the twist is missing")
        self.step(f"the twist vanishes in {len(brackets)} brackets")

    def twist_at(self, delta: Fraction) -> Interval:
        """Return N at one delta, where it must not vanish."""
        over = pairs.over_intervals(self.rho)
        N = regularised_twist(over, over.at(self.number(delta)))
        need(not N.contains_zero(), "the twist may vanish at the end of a bracket")
        return N

    def exceptions(self) -> None:
        """Prove that the exceptions are the f of the range for which Moser's theorem may fail."""
        claims, where = self.claims["exceptions"], self.where()
        low, high = self.claims["f_range"][:2]
        if "1/2" in where:
            low = max(low, where["1/2"].lower)  # trace > -2 only above it
        needed = united([within(f, low, high) for f in self.excluded(where)])
        apart = all(c.upper < d.lower for c, d in pairwise(claims))
        need(apart, "the exceptions are not disjoint and ascending")
        need(len(claims) == len(needed), f"there are {len(needed)} exceptions")
        room, cells = self.p.F / 10**CELL_DIGITS, self.claims["cells"]
        for n, (claim, (first, last)) in enumerate(zip(claims, needed, strict=True)):
            need(claim.lower <= first and last <= claim.upper, f"exceptions[{n}] is too small")
            narrow = first - max(claim.lower, low) <= room and min(claim.upper, high) - last <= room
            on_cells = cells[-1]["f"].lower <= claim.lower and claim.upper <= cells[0]["f"].upper
            need(narrow and on_cells, f"exceptions[{n}] is larger than needed")
        self.step("all other f in f_range with trace > -2 satisfy Moser's hypotheses")

    def where(self) -> dict[str, Enclosure]:
        """Return the f of the rotation numbers."""
        return {claim["ratio"]: claim["f"] for claim in self.claims["resonances"]}

    def excluded(self, where: dict[str, Enclosure]) -> list[Enclosure]:
        """Return the f of unsigned cells with trace > -2 somewhere, and of low resonances."""
        unsigned = [
            cell["f"]
            for cell in self.claims["cells"]
            if cell["twist"] is None and cell["trace"].upper > -2
        ]
        return unsigned + [where[str(q)] for q in LOW_ORDER if str(q) in where]

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told("".join(self.sentences()))

    def sentences(self) -> Iterable[str]:
        """Yield the sentences."""
        claims = self.claims
        yield all_f.told(SYSTEM)
        yield _BRANCH
        if claims["f_end"] is not None:
            yield _END
        if claims["resonances"]:
            met = ", ".join(f"{q['ratio']} at f in {q['f']}" for q in claims["resonances"])
            yield f"; {_MET} {met}; {_COMPLETE}"
        if any(q["ratio"] == "1/2" for q in claims["resonances"]):
            yield "; for f in the range below that of 1/2 both are saddles, with trace < -2"
        for zero in claims["twist_zeros"]:
            yield f"; the first twist coefficient vanishes at an f in {zero}"
        exceptions = ", ".join(map(str, claims["exceptions"]))
        outside = f", but perhaps those in {exceptions}" if exceptions else ""
        yield (
            f"; for all f in the range with trace > -2{outside}, both orbits are elliptic, without "
            "resonance of order at most four, with a twist that is not zero: hence (Moser) they "
            "are stable, and every neighbourhood of them contains invariant closed curves around "
            "them"
        )


def within(claim: Enclosure, low: Fraction, high: Fraction) -> Ends:
    """Return the part of an interval in [low, high]; it is empty if its ends are in wrong order."""
    return max(claim.lower, low), min(claim.upper, high)


def united(intervals: list[Ends]) -> list[Ends]:
    """Return the components of the union of closed intervals, in ascending order."""
    result = list[Ends]()
    for low, high in sorted(interval for interval in intervals if interval[0] <= interval[1]):
        if result and low <= result[-1][1]:
            low, high = result[-1][0], max(high, result.pop()[1])  # noqa: PLW2901
        result.append((low, high))
    return result


_BRANCH = (
    "for every f in {f_range} there are exactly two (1,1) orbits that are not symmetric, mirror "
    "images of each other under (x, v, t) -> (l + r - x, -v, t + T/2); with them the trace and "
    "the least speed decrease as f decreases; they are born at f in {f_start}, with trace 2"
)
_MET = (
    "as f decreases the trace passes 2 cos(2 pi p/q), where an elliptic orbit has the rotation "
    "number p/q, for p/q ="
)
_COMPLETE = (
    "for no other p/q with 0 < p/q <= 1/2 and q <= 8 is it 2 cos(2 pi p/q) at an f in the range"
)
_END = "; the least speed vanishes at f in {f_end}, with trace in {trace_end}"

THEOREM = Branch
