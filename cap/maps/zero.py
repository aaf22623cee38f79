"""Krawczyk's operator for n equations: existence, uniqueness and enclosure of a zero of G.

For a point m of the box Z and any matrix C (Neumaier 1990, Section 5.1)

    K(Z) = m - C G(m) + (1 - C G'(Z)) (Z - m).

If K(Z) lies in the interior of Z, then G has exactly one zero in Z, and it lies in K(Z).
`cap.maps.krawczyk` has the same for fixed points in the plane, written out: there it is fast.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from operator import mul
from typing import Any

import numpy as np

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball, Exact, Matrix

Box = tuple[Ball, ...]
Rows = Sequence[Sequence[Ball]]

_identity = lru_cache(interval.identity)
_exactly = lru_cache(maxsize=8)(interval.matrix)
RESIDUAL = 64  # bits of 1 - C G'
AGAIN = 3
ENOUGH = 1e-3  # units of the last place, of the step that need not be made


def _ball(q: Fraction | float) -> Ball:
    return Ball(q) if isinstance(q, float) else interval.ball(q)


@dataclass(frozen=True)
class Hint:
    """The point m and the rows of the matrix C, of fractions or doubles; neither needs trust."""

    centre: tuple[Fraction, ...]
    matrix: tuple[tuple[Any, ...], ...]

    @cached_property
    def _exact(self) -> list[Exact]:
        return [interval.exact(q) for q in self.centre]

    @cached_property
    def _enclosed(self) -> dict[int, Matrix]:
        return {}

    @cached_property
    def _doubles(self) -> Matrix | None:
        """C, if it is one of doubles: then it is exact at any precision."""
        doubles = all(isinstance(q, float) for row in self.matrix for q in row)
        return _exactly(self.matrix) if doubles else None

    @property
    def point(self) -> Box:
        """m, enclosed."""
        return tuple(map(interval.ball, self._exact))

    @property
    def rows(self) -> Matrix:
        """C, enclosed."""
        if self._doubles is not None:
            return self._doubles
        bits = interval.working_bits()
        if bits not in self._enclosed:
            self._enclosed[bits] = interval.matrix([[*map(_ball, row)] for row in self.matrix])
        return self._enclosed[bits]

    def moved(self, centre: Sequence[Fraction]) -> "Hint":
        """Return another point with the same C, which is not read again."""
        found = Hint(tuple(centre), self.matrix)
        vars(found)["_doubles"] = self._doubles
        return found

    def box(self, reach: Sequence[Fraction]) -> Box:
        """Return a box that contains the points within ``reach`` of m."""
        return tuple(map(interval.around, self._exact, reach))


def operator(hint: Hint, value: Sequence[Ball], slope: Matrix, box: Box) -> Box:
    """Return an enclosure of K(box), from ``value`` ∋ G(m) and ``slope`` ⊇ G'(box).

    A zero of G in the box lies in K, if ``slope`` encloses G' also between there and m.
    """
    m, C = hint.point, hint.rows
    offset = interval.column([z - c for z, c in zip(box, m, strict=True)])
    moved = (_identity(len(m)) - C * slope) * offset - C * interval.column(value)
    return tuple(c + q for c, q in zip(m, moved.entries(), strict=True))


def residual(hint: Hint, slope: Matrix) -> Matrix:
    """Return an enclosure of 1 - C G', which is small, in few bits."""
    with interval.workprec(RESIDUAL):
        return _identity(len(hint.centre)) - hint.rows * slope


def contracted(hint: Hint, value: Sequence[Ball], E: Matrix, box: Box) -> Box:
    """Prove that exactly one zero of G lies in the ``box``, which contains m; return K(K(K(box))).

    Assumes G is C¹ on the box, ``value`` encloses G(m) and ``E`` encloses 1 - C G' on the box.
    Raises `NotProved`: there may be no zero, or several.
    """
    m = hint.point
    newton = (hint.rows * interval.column(value)).entries()
    K = box
    for k in range(AGAIN):
        far = (E * interval.column([z - c for z, c in zip(K, m, strict=True)])).entries()
        K = tuple(c - v + q for c, v, q in zip(m, newton, far, strict=True))
        if not k:  # then the zero lies in K, and in K of whatever contains it
            _inside(K, hint, box)
    return K


def _inside(k: Box, hint: Hint, box: Box) -> Box:
    """Return K(box) if it lies in the interior of the box."""
    for i, (inner, outer) in enumerate(zip(k, box, strict=True)):
        if not interval.subset_interior(inner, outer):
            m = hint.point[i]
            sets = {"K - m": inner - m, "box - m": outer - m}
            raise NotProved("Krawczyk", f"K(box) is not inside the box, unknown {i + 1}", sets)
    return k


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
        m = hint.point
        slope = interval.matrix(self.slope(tuple(map(interval.hull, box, m))))
        k = operator(hint, self.value(m), slope, box)
        if self.by_q is None:
            return k
        moved = (hint.rows * interval.column(self.by_q(m))).entries()
        return tuple(c - self.spread * q for c, q in zip(k, moved, strict=True))

    def velocity(self, hint: Hint, box: Box) -> Box:
        """Return an enclosure of dz/dq for the zeros z(q), which lie in the ``box``.

        z' = -C G_q + E z' with E = 1 - C G_z, so |z'| <= |C G_q|/(1 - |E|) in the maximum norm.
        Raises `NotProved` if |E| < 1 is not certain.
        """
        vector = self.by_q(box) if self.by_q else [interval.ZERO] * len(box)
        forced = (-hint.rows * interval.column(vector)).entries()
        E = (_identity(len(box)) - hint.rows * interval.matrix(self.slope(box))).tolist()
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
        return _inside(self.operator(hint, box), hint, box)

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


def inverse_of(rows: Rows) -> list[list[Fraction]]:
    """Return decimals of about ten digits near the inverse of a matrix."""
    try:
        inverse = np.linalg.inv(np.array([[float(q) for q in row] for row in rows]))
    except np.linalg.LinAlgError:
        inverse = np.full((1, 1), np.nan)
    if not np.isfinite(inverse).all():
        raise NotProved("preconditioner", "it is beyond floats: the zero may be double")
    return [[Fraction(f"{q:.9e}") for q in row] for row in inverse]


def refined(
    problem: Problem,
    guess: Sequence[Fraction | float],
    matrix: Sequence[Sequence[Fraction | float]],
    places: Sequence[int],
) -> Hint:
    """Return a point of ``places`` decimals near a zero, by Newton's iteration with one matrix.

    Nothing is proved here.
    """
    hint = Hint((), tuple(map(tuple, matrix)))
    C, point, last = hint.rows, [*map(_ball, guess)], math.inf
    while True:
        steps = (C * interval.column(problem.value(point))).entries()
        point = [interval.point(c - s) for c, s in zip(point, steps, strict=True)]
        size = max(abs(float(s)) * 10.0**p for s, p in zip(steps, places, strict=True))
        if size < 1 or size * size < ENOUGH * last < math.inf:  # the next one: size (size/last)
            decimals = [interval.nearest(c, p) for c, p in zip(point, places, strict=True)]
            return hint.moved(decimals)
        if not 2 * size <= last:
            raise NotProved("Newton", "the iteration does not converge near the guess")
        last = size
