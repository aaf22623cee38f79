"""Krawczyk's operator for n equations: existence, uniqueness and enclosure of a zero of G.

For a point m of the box Z and any matrix C (Neumaier 1990, Section 5.1)

    K(Z) = m - C G(m) + (1 - C G'(Z)) (Z - m).

If K(Z) lies in the interior of Z, then G has exactly one zero in Z, and it lies in K(Z).
`cap.maps.krawczyk` has the same for fixed points in the plane, written out: there it is fast.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from operator import mul

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball, Exact

Box = tuple[Ball, ...]
Rows = Sequence[Sequence[Ball]]


@dataclass(frozen=True)
class Hint:
    """The point m and the rows of the matrix C, exact; neither needs trust."""

    centre: tuple[Fraction, ...]
    matrix: tuple[tuple[Fraction, ...], ...]

    @cached_property
    def _exact(self) -> list[list[Exact]]:
        return [[interval.exact(q) for q in row] for row in (self.centre, *self.matrix)]

    @property
    def point(self) -> Box:
        """m, enclosed."""
        return tuple(map(interval.ball, self._exact[0]))

    @property
    def rows(self) -> Rows:
        """C, enclosed."""
        return [list(map(interval.ball, row)) for row in self._exact[1:]]

    def box(self, reach: Sequence[Fraction]) -> Box:
        """Return a box that contains the points within ``reach`` of m."""
        return tuple(map(interval.around, self._exact[0], reach))


@dataclass(frozen=True)
class Problem:
    """G, of which zeros are looked for, and its derivative by rows, both on a box.

    If G depends on a parameter q in an interval, ``value`` is that at some q_0 of it, ``spread``
    encloses q - q_0 and ``by_q`` the derivative of G, for all q: then K is that of all q.
    """

    value: Callable[[Sequence[Ball]], Sequence[Ball]]
    slope: Callable[[Sequence[Ball]], Rows]
    spread: Ball = interval.ZERO
    by_q: Callable[[Sequence[Ball]], Sequence[Ball]] | None = None

    def operator(self, hint: Hint, box: Box) -> Box:
        """Return an enclosure of K(box), with G' also between the box and m.

        A zero of G in the box lies there.
        """
        m, rows = hint.point, hint.rows
        way = tuple(map(interval.hull, box, m))
        value, columns = self.value(m), list(zip(*self.slope(way), strict=True))
        offset = [z - c for z, c in zip(box, m, strict=True)]
        result = []
        for i, row in enumerate(rows):
            part = [-_dot(row, column) for column in columns]
            part[i] = 1 + part[i]
            result.append(m[i] - _dot(row, value) + _dot(part, offset))
        if self.by_q:
            vector, pairs = self.by_q(m), zip(result, rows, strict=True)
            return tuple(k - self.spread * _dot(row, vector) for k, row in pairs)
        return tuple(result)

    def velocity(self, hint: Hint, box: Box) -> Box:
        """Return an enclosure of dz/dq for the zeros z(q), which lie in the ``box``.

        z' = -C G_q + E z' with E = 1 - C G_z, so |z'| <= |C G_q|/(1 - |E|) in the maximum norm.
        Raises `NotProved` if |E| < 1 is not certain.
        """
        columns = list(zip(*self.slope(box), strict=True))
        vector = self.by_q(box) if self.by_q else [interval.ZERO] * len(box)
        forced, E = [], []
        for i, row in enumerate(hint.rows):
            part = [-_dot(row, column) for column in columns]
            part[i] = 1 + part[i]
            E.append(part)
            forced.append(-_dot(row, vector))
        norm = _largest([interval.total(map(abs, row)) for row in E])
        if not norm < 1:
            raise NotProved("velocity", "the zeros may not move with the parameter", {"|E|": norm})
        size = _largest([abs(q) for q in forced]) / (1 - norm)
        moving = [interval.symmetric(size)] * len(box)
        for _ in range(2):
            moving = [q + _dot(row, moving) for q, row in zip(forced, E, strict=True)]
        return tuple(moving)

    def isolate(self, hint: Hint, reach: Sequence[Fraction]) -> Box:
        """Prove that exactly one zero lies within ``reach`` of m; return a box that contains it.

        Raises `NotProved`: there may be none, or several.
        """
        box = hint.box(reach)
        k = self.operator(hint, box)
        for i, (inner, outer, m) in enumerate(zip(k, box, hint.point, strict=True)):
            if not interval.subset_interior(inner, outer):
                sets = {"K - m": inner - m, "box - m": outer - m}
                raise NotProved("Krawczyk", f"K(box) is not inside the box, unknown {i + 1}", sets)
        return k

    def tightened(self, hint: Hint, box: Box) -> Box:
        """Return a smaller box that contains the zero in ``box``, until little is gained."""
        while True:
            k = self.operator(hint, box)
            tighter = tuple(map(interval.intersection, k, box))
            if not any(
                10 * new.rad() < 9 * old.rad() for new, old in zip(tighter, box, strict=True)
            ):
                return box
            box = tighter


def _largest(sizes: Sequence[Ball]) -> Ball:
    """Return an upper bound of numbers that are at least 0."""
    return max((interval.upper(q) for q in sizes), key=float)


def _dot(a: Sequence[Ball], b: Sequence[Ball]) -> Ball:
    return interval.total(map(mul, a, b))


def refined(
    problem: Problem,
    guess: Sequence[Fraction],
    matrix: Sequence[Sequence[Fraction]],
    places: Sequence[int],
) -> Hint:
    """Return a point of ``places`` decimals near a zero, by Newton's iteration with one matrix.

    Nothing is proved here.
    """
    hint = Hint(tuple(guess), tuple(map(tuple, matrix)))
    last: Fraction | None = None
    while True:
        rows, value = hint.rows, problem.value(hint.point)
        steps = [interval.midpoint(_dot(row, value)) for row in rows]
        moved = zip(hint.centre, steps, places, strict=True)
        hint = Hint(tuple(round(c - s, p) for c, s, p in moved), hint.matrix)
        size = max(abs(s) * 10**p for s, p in zip(steps, places, strict=True))
        if size < 1:
            return hint
        if last and 2 * size > last:
            raise NotProved("Newton", "the iteration does not converge near the guess")
        last = size
