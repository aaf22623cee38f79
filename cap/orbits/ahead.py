"""The curve beyond an end at which a number vanishes: the zeros of F go on.

One more cell, the *piece*, begins on a cell some way before the end, and ends beyond the zero of
the number; the zero lies in a *short* cell on it.
"""

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple, TypeVar

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.branch import Follower
from cap.orbits.cells import Cell
from cap.orbits.points import PLACES
from cap.sets import interval
from cap.sets.interval import Ball

STEPS = 40
BACK = 24, 16, 12, 9, 7, 5, 4, 3, 2, 1  # how many cells before the end the piece begins
BEYOND = Fraction(1, 4)  # of the way to the zero

T = TypeVar("T")
Number = Callable[[Box], Fraction]  # a guess of what vanishes, at a point


class Begin(NamedTuple):
    """Where a piece begins: the cell, its number, and its outer end."""

    number: int
    cell: Cell
    s: Fraction


class Ahead:
    """Looks beyond the ends of a curve; ``step`` says in exceptions what for."""

    def __init__(self, follower: Follower[Any], step: str) -> None:
        self.follower, self.cells, self.step = follower, follower.cells, step

    def begins(self, cells: list[Cell], *, last: bool) -> Iterator[Begin]:
        """Give where pieces may begin that go beyond the first or the last cell of a curve."""
        ordered = cells if last else cells[::-1]
        for back in BACK:
            if back < len(ordered):
                inside = len(ordered) - back
                s = _outer(ordered[inside], ordered[inside - 1])
                yield Begin(inside if last else back - 1, ordered[inside], s)

    def end(self, cells: list[Cell], *, last: bool) -> list[float]:
        """Return the first or the last point of a curve of two cells or more."""
        ordered = cells if last else cells[::-1]
        if len(ordered) < 2:
            raise NotProved(self.step, "the curve has one cell")
        return [float(x) for x in ordered[-1].at(_outer(ordered[-1], ordered[-2]))]

    def first(self, begins: Iterable[Begin], proved: Callable[[Begin], T], why: str) -> T:
        """Return what is proved on the first piece that will do; raise `NotProved`.

        ``why`` is the reason if no piece begins anywhere.
        """
        for begin in begins:
            try:
                return proved(begin)
            except NotProved as reason:
                why = str(reason)
        raise NotProved(self.step, why)

    def piece(self, begin: Begin, number: Number) -> Cell:
        """Return a cell from the outer end of another to beyond where a number vanishes."""
        _, before, s = begin
        w = [float(x) for x in before.at(s)]
        v = self.cells.tangent(w)
        along = self.follower.unknown(v)
        first = s if along == before.line.along else self.follower.begin(before, s, along)

        def at(value: Fraction) -> Box:
            near = [x + y * (float(value) - w[along]) / v[along] for x, y in zip(w, v, strict=True)]
            near[along] = float(value)
            return tuple(map(Ball, self.cells.newton(near, along)[0]))

        inward = 1 if s == max(before.line.ends) else -1
        step = inward * Fraction(1, 10**6) * (1 if along == before.line.along else 0)
        step = step or Fraction(1, 10**6)
        zero = self.zero(at, (first, first + step), number)
        end = round(zero + (zero - first) * BEYOND, 12)
        low, high = min(first, end), max(first, end)
        if not low < high:
            raise NotProved(self.step, "its piece is too short")
        middle = [float(x) for x in at((low + high) / 2)]
        piece = self.cells.zeros(self.cells.line(middle, along, (low, high)))
        if not piece.holds(before, s) and not before.holds(piece, first):
            raise NotProved(self.step, "its piece is not certain to go on from a cell")
        return piece

    def zero(
        self, at: Callable[[Fraction], Box], ends: tuple[Fraction, Fraction], number: Number
    ) -> Fraction:
        """Return where a number vanishes, by the secant method; a guess."""
        a, b = ends
        f = number(at(a))
        for _ in range(STEPS):
            g = number(at(b))
            if f == g or abs(b - a) < Fraction(1, 10 ** (PLACES + 3)):
                break
            new = round(b - g * (b - a) / (g - f), PLACES + 8)
            if abs(new - b) > 1:
                raise NotProved(self.step, "none is near the end of the curve")
            a, f, b = b, g, new
        return b

    def short(self, piece: Cell, number: Number) -> Cell:
        """Return a short cell on a piece, around where a number vanishes: its sign is a guess."""

        def at(s: Fraction) -> Box:
            return tuple(map(interval.ball, self.follower.points.fine(piece.line, (s, s)).centre))

        low, high = piece.line.ends
        near = (9 * low + high) / 10, (low + 9 * high) / 10
        unit, middle = Fraction(1, 10**PLACES), round(self.zero(at, near, number), PLACES)
        ends = middle - 2 * unit, middle + 2 * unit
        if not low < ends[0] < ends[1] < high:
            raise NotProved(self.step, "it is not on its piece")
        short = self.cells.zeros(self.follower.points.fine(piece.line, ends))
        if not all(piece.holds(short, s) for s in ends):
            raise NotProved(self.step, "it is not certain to be on its piece")
        return short


def _outer(cell: Cell, before: Cell) -> Fraction:
    """Return the end of a cell that is farther from another one."""
    centre = [float(x) for x in before.line.centre]

    def far(s: Fraction) -> float:
        return sum((float(x) - c) ** 2 for x, c in zip(cell.at(s), centre, strict=True))

    return max(cell.line.ends, key=far)
