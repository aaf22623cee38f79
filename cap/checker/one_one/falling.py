"""The pairs of (1,1) orbits for delta in [0, D], in cells: f, trace and least speed decrease.

By ``pairs`` there is one pair for each delta in (0, pi/2) with S < 1, and f = F alpha strictly
decreases with delta.  On every cell, by Taylor models,

1. trace' < 0; on the first cell, where trace is even in delta, trace'' < 0; so trace decreases;
2. L' < 0 and u_2 > L: the least speed is L, and decreases.

So what f, trace and least speed take on a cell is known from their values at its ends.  If delta_0
is the greatest delta in view with L(delta_0) > 0, every f in [F alpha(delta_0), F alpha(0)) has
exactly one pair, and it is genuine.  delta_0 is D, or the lower end of a bracket of the zero of L.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import Any, NamedTuple

from cap.checker.kernel.arctangent import arccos, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Certificate
from cap.checker.one_one import pairs
from cap.checker.one_one.closed_form import birth
from cap.checker.one_one.scaled import Scaled
from cap.checker.one_one.taylor_model import TaylorModel

CELL_DIGITS = 6
Ends = tuple[Fraction, Fraction]


class Values(NamedTuple):
    """f, trace and L at one delta."""

    f: Interval
    trace: Interval
    least_speed: Interval


class Falling(Scaled):
    """The pairs from their birth to D, by the claims on cells, f_start, f_end and f_range."""

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        self.at, self.deepest = cache(self.evaluated), Fraction(0)

    @property
    def last(self) -> Fraction:
        """D, where the cells end."""
        return Fraction(self.claims["cells"][-1]["delta"].upper)

    def cover(self) -> None:
        """Check that the cells cover [0, D] and are in order."""
        cells = [cell["delta"] for cell in self.claims["cells"]]
        need(cells[0].lower == 0, "the first cell does not begin with 0")
        need(all(c.lower < c.upper for c in cells), "a cell is empty")
        joined = all(c.upper == d.lower for c, d in pairwise(cells))
        need(joined, "a cell does not begin where the last one ends")
        need(self.number(self.last).is_before(self.pi() / 2), "delta is not below pi/2")
        self.step(f"{len(cells)} cells cover the range of delta")

    def evaluated(self, delta: Fraction) -> Values:
        """Return f, trace and L at one delta."""
        pair = pairs.over_intervals(self.rho).at(self.number(delta))
        L = pairs.slowest(pair) * self.number(self.p.F / self.omega)
        f = pair.alpha.constant * self.number(self.p.F)
        return Values(f, pair.trace.constant, L)

    def f_start(self) -> None:
        """Compare the claim where the branch begins."""
        need(birth(self.rho) is not None, "R omega^2/F is not below (pi^2 - 4)/2: no pair is born")
        self.confirm(f_start=self.at(Fraction(0)).f)
        self.step("the pair is born at f_start")

    def end(self) -> Fraction:
        """Return the greatest delta in view with L > 0, and compare the claims of the end."""
        bracket, claims = self.hints["end"], self.claims
        for name in ("f_end", "trace_end"):
            there = claims[name] is not None
            need(
                there == (bracket is not None), f"claims.{name} is there, or not, against the hint"
            )
        if bracket is None:
            need(self.at(self.last).least_speed.is_positive(), "the least speed may vanish")
            self.step("the least speed is positive on all cells")
            return self.last
        low, high = bracket
        need(0 < low < high and high == self.last, "the cells do not end with the bracket")
        need(self.at(low).least_speed.is_positive(), "the least speed vanishes before the bracket")
        slow = (-self.at(high).least_speed).is_positive()
        need(slow, "the least speed does not vanish in the bracket")
        first, last = self.at(high), self.at(low)
        self.spans("f_end", claims["f_end"], (first.f, last.f))
        self.spans("trace_end", claims["trace_end"], (first.trace, last.trace))
        self.step("the least speed vanishes at f_end")
        return Fraction(low)

    def range(self) -> None:
        """Check that the range lies between the end and the beginning."""
        claim = self.claims["f_range"]
        need(claim.lower < claim.upper, "f_range is empty")
        below = self.number(claim.upper).is_before(self.at(Fraction(0)).f)
        need(below, "f_range does not end below f_start")
        inside = self.at(self.deepest).f.upper <= claim.lower
        need(inside, "f_range begins where the least speed may not be positive")
        self.step("every f in f_range has one genuine pair")

    def spans(
        self, name: str, claim: Enclosure, ends: tuple[Interval, Interval], digits: int = 0
    ) -> None:
        """Check that a claim is [first, last], rounded outwards at so many digits.

        With 0 digits it is an enclosure of a number, and has the digits of the certificate.
        """
        first, last = ends
        if not digits:
            self.narrow(name, claim)
        contained = claim.lower <= first.lower and last.upper <= claim.upper
        need(contained, f"{name} does not contain what is taken")
        unit = self.unit(claim.unit) if claim.unit else Fraction(0)
        size = max(abs(claim.lower), abs(claim.upper), unit)
        room = size / 10 ** (digits or self.certificate.digits)
        close = first.upper - claim.lower <= room and claim.upper - last.lower <= room
        need(close, f"{name} is wider than what is taken")

    def in_view(self, name: str, bracket: Enclosure) -> Ends:
        """Return the ends of a bracket, which must lie where the orbits are genuine."""
        inside = 0 < bracket.lower < bracket.upper <= self.deepest
        need(inside, f"the bracket of {name} is not where the orbits are genuine")
        return bracket.lower, bracket.upper

    def falls(self, n: int, claim: dict[str, Any]) -> pairs.Pair[TaylorModel]:
        """Prove that trace and least speed decrease on a cell; return the pairs there."""
        low, high = claim["delta"].lower, claim["delta"].upper
        x = TaylorModel.variable(low, high, self.hints["bits"])
        pair = pairs.over_cells(self.rho).at(x, 1 if n else 2)
        falling = -pair.trace.coefficients[1 if n else 2,].range()
        need(falling.is_positive(), f"cells[{n}]: the trace may not decrease")
        need((-steepness(pair)).is_positive(), f"cells[{n}]: the least speed may not decrease")
        u_2 = pair.speeds[1].constant.range() * self.number(self.p.F / self.omega)
        first = self.at(low).least_speed.is_before(u_2)
        need(first, f"cells[{n}]: the least speed may be that at a hit")
        for name in ("f", "trace", "least_speed"):
            ends = getattr(self.at(high), name), getattr(self.at(low), name)
            self.spans(f"cells[{n}].{name}", claim[name], ends, CELL_DIGITS)
        return pair


def steepness(pair: pairs.Pair[TaylorModel]) -> Interval:
    """Return an enclosure of L' on a cell."""
    alpha, S = (jet.constant.range() for jet in (pair.alpha, pair.S))
    angle = arccos(alpha) + arccos(S) - pi(S.bits) / 2
    d_alpha, d_S = (jet.coefficients[1,].range() for jet in (pair.alpha, pair.S))
    d_speed = (pair.W - pair.S * pair.sin).coefficients[1,].range()
    two = S.integer(2)
    return d_speed + d_alpha * angle - two / pi(S.bits) * pair.cos.constant.range() * d_S
