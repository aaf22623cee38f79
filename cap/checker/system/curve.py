"""Curves of periodic orbits over a parameter p: pieces, and how they are one curve.

The last variable of the state is p; nothing moves it.  The unknowns w are the times and the other
variables just before the contacts, and p: one more than the equations F(w) = 0 (``contacts``).

*A cell.*  One unknown s of w, ``along`` it, goes from s_a to s_b, s_0 between them; the others are
looked for at w_0 + w_1 (s - s_0) + b, |b| <= r, where w_1 is 1 along s, b and r are 0.  Let A
enclose the derivative of F by the others, D that along w_1, over all these w, and C be a matrix,

    K = -C F(w_0) - C D (s - s_0) + (1 - C A) [-r, r].

By Taylor's formula K contains b - C F for all such b and s.  If K lies in the interior of [-r, r],
F has for each s exactly one zero b there, and it lies in K [Krawczyk]; A is not singular, so b is
an analytic function of s.

*One curve.*  If for an end of one cell the zero there lies among the w of another cell, it is the
other's zero at its s: the two pieces have a point in common.

*Rates.*  Along a cell w' = dw/ds solves A w' = -(the derivative of F by s), and is 1 along s.
Where p' changes its sign p turns.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from operator import mul
from typing import Any, NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.contacts import (
    SHIFT,
    Equations,
    Matrix,
    leg_maps,
    product,
    symmetric,
    times,
)
from cap.checker.system.legs import solved
from cap.checker.system.model import Model
from cap.checker.system.passage import Step

Box = list[Interval]
MINORS = 5  # rows of a matrix of which all minors are taken


class Line(NamedTuple):
    """What a certificate says of a cell."""

    along: int
    ends: tuple[Fraction, Fraction]
    centre: Sequence[Fraction]
    slope: Sequence[Fraction]
    reach: Sequence[Fraction]

    @classmethod
    def of(cls, given: Mapping[str, Any]) -> Line:
        """Return that of a certificate."""
        low, high = given["ends"]
        return cls(given["along"], (low, high), given["centre"], given["slope"], given["reach"])

    @property
    def middle(self) -> Fraction:
        """s_0."""
        return self.centre[self.along]

    def confirm(self, size: int) -> None:
        """Reject what is no cell for so many equations."""
        rows = self.centre, self.slope, self.reach
        need(all(len(row) == size + 1 for row in rows), f"a cell has not {size + 1} unknowns")
        need(self.along <= size, "a cell goes along no unknown")
        low, high = self.ends
        need(low < high and low <= self.middle <= high, "the ends of a cell are not in order")
        plain = self.slope[self.along] == 1 and self.reach[self.along] == 0
        need(plain, "the slope of a cell is not 1 along it, or its reach not 0")
        wide = all(r > 0 for k, r in enumerate(self.reach) if k != self.along)
        need(wide, "the reach of a cell is not positive")


class Cell(NamedTuple):
    """A cell with its zeros: b lies in ``error``."""

    line: Line
    error: Box

    def over(self, offset: Interval) -> Box:
        """Return an enclosure of w for s - s_0 in an interval."""
        parts = zip(self.line.centre, self.line.slope, self.error, strict=True)
        return [exact(c, b) + offset * q + b for c, q, b in parts]

    @property
    def box(self) -> Box:
        """Return an enclosure of all w of the curve on this cell."""
        return self.over(spread(self.line, self.error[0].bits))

    def at(self, s: Fraction) -> Box:
        """Return an enclosure of the zero at s."""
        return self.over(exact(s - self.line.middle, self.error[0]))

    def meets(self, other: Cell) -> bool:
        """Return whether the zero at an end of one of the cells is certainly one of the other."""
        pairs = (self, other), (other, self)
        return any(a.holds(b.line, s, b.at(s)) for a, b in pairs for s in b.line.ends)

    def holds(self, line: Line, s: Fraction, w: Box) -> bool:
        """Return whether w, the zero of another line at its s, is among the w of this cell."""
        along, (low, high) = self.line.along, self.line.ends
        if line.along == along:
            inside, offset = low <= s <= high, exact(s - self.line.middle, w[0])
        else:
            inside = low <= w[along].lower and w[along].upper <= high
            offset = w[along] - exact(self.line.middle, w[0])
        sides = enumerate(zip(w, self.line.centre, self.line.slope, self.line.reach, strict=True))
        return inside and all(
            (x - exact(c, x) - offset * q).lies_inside(-r, r)
            for k, (x, c, q, r) in sides
            if k != along
        )


def minors(D: Matrix, k: int) -> Interval:
    """Return the sum of the principal minors of this size, which is e_k of the eigenvalues."""
    chosen = combinations(range(len(D)), k)
    found = [determinant([[D[i][j] for j in some] for i in some]) for some in chosen]
    return sum(found[1:], found[0])


def determinant(D: Matrix) -> Interval:
    """Return the determinant, by first rows; each minor of the last rows is computed once.

    For n rows these are n 2^(n-1) products at most.
    """
    zero, size = D[0][0].integer(0), len(D)
    found: dict[tuple[int, ...], Interval] = {(j,): x for j, x in enumerate(D[-1])}
    for k, row in enumerate(reversed(D[:-1]), 2):
        below, found = found, {}
        for columns in combinations(range(size), k):
            total = zero
            for i, j in enumerate(columns):
                if row[j].lo or row[j].hi:
                    total = total + row[j] * below[columns[:i] + columns[i + 1 :]] * (-1) ** i
            found[columns] = total
    return found[*range(size),]


def residual(row: Sequence[int], slope: Sequence[Mapping[int, Interval]], i: int) -> list[int]:
    """Return bounds of the i-th row of |1 - C A|; ``row`` is that of C in units 2^-`SHIFT`.

    Each entry by itself: on a long cell those of A have very different widths.
    """
    bits = next(iter(slope[0].values())).bits
    low, high = [0] * len(row), [0] * len(row)
    low[i] = high[i] = 1 << bits + SHIFT
    for c, entries in zip(row, slope, strict=True):
        for j, x in entries.items():
            a, b = (x.lo, x.hi) if c >= 0 else (x.hi, x.lo)
            low[j] -= c * b
            high[j] -= c * a
    return [(max(-a, b) >> SHIFT) + 1 for a, b in zip(low, high, strict=True)]


def exact(q: Fraction, like: Interval) -> Interval:
    """Return an enclosure of a number."""
    return Interval.enclosing(q, q, like.bits)


def spread(line: Line, bits: int) -> Interval:
    """Return the interval of all s - s_0."""
    low, high = line.ends
    return Interval.enclosing(low - line.middle, high - line.middle, bits)


class Curve:
    """The equations in w, at a precision."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        self.step = equations.n  # time and state of a contact, without p
        self.size = self.step * len(equations.orbit.contacts)

    @staticmethod
    def confirm(model: Model) -> None:
        """Reject a system whose last variable moves."""
        p = model.state[-1]
        still = all(not mode.field[p].terms for mode in model.modes.values())
        need(still, f"{p} is no parameter: it moves in a mode")
        guards = [guard for mode in model.modes.values() for guard in mode.guards.values()]
        need(all(p not in guard.reset for guard in guards), f"{p} is no parameter: it jumps")
        need(len(model.state) > 1, "there is no variable but the parameter")

    def expanded(self, w: Sequence[Interval]) -> Box:
        """Return the times and states with p."""
        found = Box()
        for k in range(0, self.size, self.step):
            found += [*w[k : k + self.step], w[self.size]]
        return found

    def steps(self, w: Sequence[Interval]) -> list[Step]:
        """Return the steps over a box."""
        return self.equations.steps(self.expanded(w))

    def value(self, w: Sequence[Interval]) -> Box:
        """Return F; the equation that p is what it was is left out."""
        width = self.step + 1
        found = self.equations.value(self.expanded(w))
        return [x for k, x in enumerate(found) if (k + 1) % width]

    def slope(self, steps: Sequence[Step]) -> list[dict[int, Interval]]:
        """Return the rows of F' by w, without zeros.

        In each p occurs once: as that of the contact, never as that of the next one.
        """
        width = self.step + 1
        found = list[dict[int, Interval]]()
        for k, row in enumerate(self.equations.slope(steps)):
            if (k + 1) % width:
                found.append(
                    {j - j // width if (j + 1) % width else self.size: x for j, x in row.items()}
                )
        return found

    def multipliers(self, steps: Sequence[Step]) -> list[Interval]:
        """Return the elementary symmetric functions of the multipliers."""
        n, total = self.step, Matrix()
        for part in leg_maps(steps, n):
            D = [row[:-1] for row in part[:-1]]  # p is the same before and after
            total = product(D, total) if total else D
        if self.equations.autonomous:
            total = [row[1:] for row in total[1:]]
        if len(total) > MINORS:
            return symmetric(total, n - 1)
        return [minors(total, k) for k in range(1, n)]

    def cell(self, line: Line, preconditioner: Sequence[Sequence[int]]) -> Cell:
        """Prove that a cell has one zero for each s."""
        line.confirm(self.size)
        bits, along = self.equations.bits, line.along
        square = all(len(row) == self.size for row in preconditioner)
        need(square and len(preconditioner) == self.size, "a preconditioner of another size")
        reach = [Interval.enclosing(-r, r, bits) for r in line.reach]
        around = Cell(line, reach)
        steps = self.steps(around.box)
        rows, offset = self.slope(steps), spread(line, bits)
        value = self.value([exact(c, offset) for c in line.centre])
        forced = [self._along(row, line.slope) for row in rows]
        others = [{k - (k > along): x for k, x in row.items() if k != along} for row in rows]
        far = [r.hi for k, r in enumerate(reach) if k != along]
        error = Box()
        rest = [residual(row, others, i) for i, row in enumerate(preconditioner)]
        parts = zip(times(preconditioner, value), times(preconditioner, forced), rest, strict=True)
        for f, g, row in parts:
            sides = (sum(map(mul, row, far)) >> bits) + 1
            error.append(-f - g * offset + Interval(-sides, sides, bits))
        error.insert(along, offset.integer(0))
        inner = all(
            x.lies_inside(-r, r)
            for k, (x, r) in enumerate(zip(error, line.reach, strict=True))
            if k != along
        )
        need(inner, "K does not lie in the interior of the box of a cell")
        return Cell(line, error)

    def _along(self, row: Mapping[int, Interval], slope: Sequence[Fraction]) -> Interval:
        """Return a row of F' times the slope of a line."""
        parts = [x * slope[k] for k, x in row.items()]
        return sum(parts[1:], parts[0])

    def rate(self, steps: Sequence[Step], along: int) -> Interval:
        """Return dp/ds."""
        return self.rates(steps, along)[self.size]

    def rates(self, steps: Sequence[Step], along: int) -> Box:
        """Return dw/ds."""
        zero = self.equations.pi.integer(0)
        others = [k for k in range(self.size + 1) if k != along]
        rows = [
            [*(row.get(k, zero) for k in others), -row.get(along, zero)]
            for row in self.slope(steps)
        ]
        found = solved(rows)
        if found is None:
            raise Rejected("dw/ds is not found: F' may be singular")
        found.insert(along, zero.integer(1))
        return found
