"""A curve of periodic orbits over a range of a parameter, followed from one orbit, cell by cell.

It ends where the parameter leaves the range, or where a cell fails however short it is: where the
orbit grazes a guard, say.  What happens on the way is then looked for (`cap.orbits.points`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.cells import Cell, Cells
from cap.orbits.periodic import outside
from cap.orbits.points import Point, Points, Tell, at_minus_one
from cap.sets import interval

FIRST, LONG, GROWTH = 1 / 100, 1 / 20, 1.4  # half lengths of cells, of the range
SHORT = 1e-4  # of the longest cell, along the curve: a shorter one is not tried
CLEAR = 1 / 500  # a longer cell should tell how many multipliers are outside the unit circle
MOST = 1500
STEEP = 0.03  # of the parameter in the tangent, so that a cell goes along it

Legs = TypeVar("Legs")


class Shown(NamedTuple, Generic[Legs]):
    """A cell, and what shows that nothing else happens on its orbits."""

    cell: Cell
    legs: Legs


@dataclass
class Branch(Generic[Legs]):
    """Cells in order along the curve, points on it, and why it ends where it does (or nothing).

    Of each cell it is known how many multipliers are outside the unit circle, or not (None).
    """

    cells: list[Shown[Legs]] = field(default_factory=list)
    counts: list[int | None] = field(default_factory=list)
    points: list[Point] = field(default_factory=list)
    ends: tuple[str, str] = ("", "")


Quiet = Callable[[Box], Legs]


class Follower(Generic[Legs]):
    """Follows curves in a range of the parameter."""

    def __init__(
        self, cells: Cells, ends: tuple[Fraction, Fraction], quiet: Quiet[Legs], tell: Tell
    ) -> None:
        self.cells, self.quiet, self.tell = cells, quiet, tell
        self.low, self.high = ends
        self.points = Points(cells, tell)
        self.size = cells.curve.size  # the parameter is the unknown of this number

    def branch(self, w: Sequence[float]) -> Branch[Legs]:
        """Return the curve through an orbit, to both sides."""
        start = [float(x) for x in w]
        v = self.cells.tangent(start)
        v = v if v[self.size] > 0 else -v
        before, first = self._followed(start, -v, None)
        after, last = self._followed(start, v, before[0] if before else None)
        if not before and not after:
            raise NotProved("branch", f"no cell is proved where it begins: {last or first}")
        shown = [*reversed(before), *after]
        cells = [each.cell for each in shown]
        return Branch(shown, self.counts(cells), self.points(cells), (first, last))

    def _followed(
        self, z: Sequence[float], v: Any, beside: Shown[Legs] | None
    ) -> tuple[list[Shown[Legs]], str]:
        """Return cells from an orbit on in one direction, and why they end.

        The first has an orbit in common with the cell that is ``beside`` it.
        """
        found, last = list[Shown[Legs]](), beside.cell if beside else None
        along = self.unknown(v)
        s, part = _exactly(z[along]) if along == self.size else _rounded(z[along]), FIRST
        longest = 0.0
        while len(found) < MOST:
            self.tell("following the branch", None)
            if self._is_over(s if along == self.size else _exactly(z[self.size]), v[self.size]):
                return found, ""
            new = self.unknown(v)
            far = self._far(new, v)
            begin = s if new == along else self.begin(found[-1].cell, s, new)
            end = self._end(new, begin, v[new], part)
            try:
                shown = self._shown(z, v, new, (begin, end))
                clear = self._is_clear(shown.cell)
                if not clear and part > CLEAR:
                    raise NotProved("branch", "multipliers may be on the unit circle on it")
                if last and not shown.cell.holds(last, s) and not last.holds(shown.cell, begin):
                    raise NotProved("branch", "cells are not certain to be one curve")
            except NotProved as reason:
                why, part = str(reason), part / 2
                if part * far < SHORT * (longest or FIRST * far):
                    return found, why
                continue
            found.append(shown)
            longest = max(longest, part * far)
            last, along, s = shown.cell, new, end
            z = [float(x) for x in last.at(end)]
            ahead = self.cells.tangent(z)
            v = ahead if ahead @ v > 0 else -ahead
            part = min(part * GROWTH, LONG) if clear else part
        return found, f"after {MOST} cells, the most in one direction: another can begin there"

    def unknown(self, v: Any) -> int:
        """Return along which unknown a cell goes: the parameter, if the curve is not too steep."""
        return self.size if abs(v[self.size]) > STEEP * max(abs(v)) else int(np.argmax(abs(v)))

    def _far(self, along: int, v: Any) -> float:
        """Return how far on the curve, of the tangent v, a cell goes whose part is 1."""
        return (float(self.high - self.low) if along == self.size else 1.0) / abs(float(v[along]))

    def _is_over(self, p: Fraction, rate: float) -> bool:
        """Return whether the parameter is at an end of its range, and leaves it."""
        return p >= self.high if rate > 0 else p <= self.low

    def _is_clear(self, cell: Cell) -> bool:
        """Return whether it is known how many multipliers are outside, or that these stay so."""
        return outside(cell.multipliers) is not None or self._steady(cell)

    def begin(self, cell: Cell, s: Fraction, new: int) -> Fraction:
        """Return where a cell along another unknown begins: somewhat before the last one ends."""
        inward = s + (cell.line.middle - s) / 5
        w = [float(x) for x in cell.line.at(interval.ball(inward - cell.line.middle))]
        return _rounded(self.cells.newton(w, cell.line.along)[0][new])

    def _end(self, along: int, begin: Fraction, rate: float, part: float) -> Fraction:
        """Return where a cell ends; one along the parameter in its range."""
        long = part * (float(self.high - self.low) if along == self.size else 1)
        end = _rounded(float(begin) + (2 * long if rate > 0 else -2 * long))
        return min(max(end, self.low), self.high) if along == self.size else end

    def _shown(
        self, z: Sequence[float], v: Any, along: int, ends: tuple[Fraction, Fraction]
    ) -> Shown[Legs]:
        """Prove a cell, and that nothing else happens on its orbits."""
        low, high = sorted(ends)
        if not low < high:
            raise NotProved("branch", "a cell is too short for decimals")
        step = (float(low + high) / 2 - z[along]) / v[along]
        line = self.cells.line(
            [x + step * y for x, y in zip(z, v, strict=True)], along, (low, high)
        )
        cell = self.cells.prove(line)
        return Shown(cell, self.quiet(cell.wider))

    # multipliers

    def _steady(self, cell: Cell) -> bool:
        """Return whether no multiplier can pass the unit circle on a cell: of two, and along p.

        1 is none as the derivative of F is not singular; -1 is none, nor is a pair on the circle.
        """
        e = cell.multipliers
        if len(e) != 2 or cell.line.along != self.size:
            return False
        total, size = at_minus_one(e), abs(e[1])
        return bool(not total.contains(0) and (size < 1 or size > 1))

    def counts(self, cells: Sequence[Cell]) -> list[int | None]:
        """Return how many multipliers are outside the unit circle on each cell, None if unclear.

        Where none can pass the circle, they are as many as on a cell next to it.
        """
        known = [outside(cell.multipliers) for cell in cells]
        for order in (range(1, len(cells)), range(len(cells) - 2, -1, -1)):
            for k in order:
                if known[k] is None and self._steady(cells[k]):
                    known[k] = known[k - order.step]
        return known


def _exactly(x: float) -> Fraction:
    return Fraction(Decimal(repr(x)))


def _rounded(x: float) -> Fraction:
    return Fraction(Decimal(f"{x:.9f}"))
