"""Points on a curve of periodic orbits, at which a function changes its sign: in short cells.

What is seen in doubles, multipliers that cross the unit circle and turns of the curve, is enclosed
in cells of the length 4e-24 (`Point`).
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import combinations
from math import prod
from typing import NamedTuple

import numpy as np

from cap.errors import NotProved
from cap.orbits.cells import Cell, Cells, Line, decimal, in_units
from cap.orbits.periodic import outside
from cap.sets import interval
from cap.sets.interval import Ball

FINE = 224  # bits for points
PLACES, STEPS = 24, 40  # decimals of a point; steps of the secant method

Tell = Callable[[str, float | None], None]


class Point(NamedTuple):
    """A short cell on the cell of a number, over which ``kind`` happens.

    A multiplier passes -1 ("flip"), two pass the unit circle elsewhere ("pair"), or the curve turns
    back ("fold"): the sign of the test function changes.  So many multipliers are outside the unit
    circle at both ends, None if this is not clear: where area is preserved they are on it.
    """

    kind: str
    inside: int
    cell: Cell
    outside: tuple[int | None, int | None]


class Points:
    """Finds and proves points on the cells of a curve."""

    def __init__(self, cells: Cells, tell: Tell) -> None:
        self.cells, self.tell, self.size = cells, tell, cells.curve.size

    def __call__(self, cells: Sequence[Cell]) -> list[Point]:
        """Return points where a test function has opposite signs at the ends of a cell.

        A point that is not proved is left out.
        """
        found = list[Point]()
        for k, cell in enumerate(cells):
            self.tell("looking for bifurcations", k / len(cells))
            ends = [self._tests(cell, s) for s in cell.line.ends]
            for kind in ends[0]:
                if ends[0][kind] * ends[1][kind] < 0:
                    with suppress(NotProved), interval.workprec(FINE):
                        found.append(self._point(kind, k, cell))
        return found

    def _tests(self, cell: Cell, s: Fraction) -> dict[str, float]:
        """Return the test functions in doubles."""
        w = [float(x) for x in cell.at(s)]
        with interval.workprec(64):
            e = self.cells.multipliers(tuple(map(Ball, w)))
        found = {"flip": float(at_minus_one(e)), "pair": float(_of_pairs(e))}
        if cell.line.along != self.size:
            v = self.cells.tangent(w)
            found = {"fold": v[self.size] / v[cell.line.along], **found}
        return found

    def _point(self, kind: str, number: int, cell: Cell) -> Point:
        """Prove that the test function changes its sign over a short cell."""
        s = self._zero(kind, cell)
        unit = Fraction(1, 10**PLACES)
        middle = round(s, PLACES)
        low, high = cell.line.ends
        ends = max(middle - 2 * unit, low), min(middle + 2 * unit, high)
        short = self.cells.prove(self.fine(cell.line, ends))
        if not cell.holds(short, ends[0]) or not cell.holds(short, ends[1]):
            raise NotProved("point", "it is not certain to be on the curve")
        signs = [self.sign(kind, short, end) for end in ends]
        if signs[0] * signs[1] != -1:
            raise NotProved("point", f"no change of sign is certain: {kind}")
        counts = [outside(self.cells.multipliers(short.at(end))) for end in ends]
        before, after = counts
        if kind == "pair":
            if before is None or after is None:
                raise NotProved("point", "multipliers may be on the unit circle beside it")
            if abs(before - after) != 2:
                raise NotProved("point", "no pair of multipliers crosses the unit circle")
        return Point(kind, number, short, (before, after))

    def sign(self, kind: str, cell: Cell, s: Fraction) -> int:
        """Return the sign of a test function; 0 if it is not certain."""
        value = self._value(kind, cell, s)
        return 1 if value > 0 else -1 if value < 0 else 0

    def _value(self, kind: str, cell: Cell, s: Fraction) -> Ball:
        """Return an enclosure of a test function."""
        box = cell.at(s)
        if kind == "fold":
            return self.cells.rates(box, cell.line.along)[self.size]
        e = self.cells.multipliers(box)
        return at_minus_one(e) if kind == "flip" else _of_pairs(e)

    def fine(self, line: Line, ends: tuple[Fraction, Fraction]) -> Line:
        """Return a line through a point of the curve that is known to many digits."""
        middle, along, size = (ends[0] + ends[1]) / 2, line.along, self.size
        others = [k for k in range(size + 1) if k != along]
        C, start = line.preconditioner, line.at(interval.ball(middle - line.middle))
        w, of = [x.mid() for x in start], self.cells.balls
        w[along] = interval.ball(middle)
        for _ in range(STEPS):
            step = (C * interval.column(self.cells.curve.value(w, of))).entries()
            for k, d in zip(others, step, strict=True):
                w[k] = (w[k] - d).mid()
            if max(float(abs(d)) for d in step) < 1e-50:
                break
        rows = self.cells.slopes([float(x) for x in w])
        inverse = np.linalg.inv(rows[:, others])
        rates = np.ones(size + 1)
        rates[others] = -inverse @ rows[:, along]
        centre = [round(interval.midpoint(x), 2 * PLACES) for x in w]
        centre[along] = middle
        slope = [decimal(q, 8) for q in rates.tolist()]
        return Line(along, ends, centre, slope, in_units(inverse))

    def _zero(self, kind: str, cell: Cell) -> Fraction:
        """Return where the test function changes its sign, by the secant method; a guess."""

        def value(s: Fraction) -> Fraction:
            line = self.fine(cell.line, (s, s))
            exact = Cell(line, (), (interval.ZERO,) * (self.size + 1), [])
            return interval.midpoint(self._value(kind, exact, s))

        low, high = a, b = cell.line.ends
        f, g = value(a), value(b)
        for _ in range(STEPS):
            if f == g:
                break
            s = min(max(round(b - g * (b - a) / (g - f), PLACES + 8), low), high)
            a, f, b, g = b, g, s, value(s)
            if abs(b - a) < Fraction(1, 10 ** (PLACES + 3)):
                break
        return b


def at_minus_one(e: Sequence[Ball]) -> Ball:
    """Return the product of 1 + multiplier."""
    return interval.total([interval.ONE, *e])


def _of_pairs(e: Sequence[Ball]) -> Ball:
    """Return the product of 1 - the product of two multipliers, over all pairs; a guess."""
    p = [1.0] + [(-1) ** k * float(x) for k, x in enumerate(e, 1)]
    if len(e) == 2:
        return 1 - e[1]
    roots = np.roots(p)
    return Ball(float(np.real(prod(1 - a * b for a, b in combinations(roots.tolist(), 2)))))
