"""exp(N d) by the eigenvalues of a rational matrix N that has a basis of eigenvectors.

It is the sum over its eigenvalues z of e^(zd) P, where P is the product of (N - y)/(z - y) over the
others; two that are conjugate, a ± iw, give 2 e^(ad) (cos wd Re P - sin wd Im P).  For d = m + s,
where D is the ball of d, Taylor's formula is

    exp(N d) = exp(N m) (1 + N s) + exp(N D) N² s²/2,

with one more term where D is long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from math import cos, exp, sin
from operator import mul
from typing import Generic, TypeVar

from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall, ComplexMatrix, Matrix
from cap.system.polynomial import Polynomial

SHORT = 1 / 32  # of a radius times the largest eigenvalue
ROOM = 64  # more bits for what is kept
LARGEST = 100  # entry of P: it is large where eigenvalues are close

T = TypeVar("T")


@dataclass(frozen=True)
class Rate(Generic[T]):
    """A real eigenvalue a, or two, a ± iw."""

    a: T
    w: T | None


@dataclass(frozen=True)
class Spectral:
    """Some entries of X = exp(N d), as products with the row u of e^(ad), and e^(ad) (cos, sin) wd.

    Those of X N^k are u times the k-th of the ``towers``.  Where a radius is ``short``, two terms
    of Taylor's formula are enough.
    """

    rates: list[Rate[Ball]]
    towers: list[Matrix]
    short: float

    def __call__(self, d: Ball) -> list[Ball]:
        """Return enclosures for all numbers in d."""
        middle = interval.point(d)
        u, s = self._row(middle), d - middle
        terms = (u * self.towers[0]).entries()
        if s.is_zero():
            return terms
        size = s.abs_upper()
        bend = interval.hull(interval.ZERO, size * size / 2)
        slopes, wide = (u * self.towers[1]).entries(), self._row(d)
        if size < self.short:
            bends = (wide * self.towers[2]).entries()
            return [x + y * s + z * bend for x, y, z in zip(terms, slopes, bends, strict=True)]
        bends, rest = (u * self.towers[2]).entries(), (wide * self.towers[3]).entries()
        cube = size * size * s / 6
        parts = zip(terms, slopes, bends, rest, strict=True)
        return [x + y * s + z * bend + r * cube for x, y, z, r in parts]

    def _row(self, d: Ball) -> Matrix:
        """Return u."""
        u = list[Ball]()
        for rate in self.rates:
            size = (rate.a * d).exp()
            if rate.w is None:
                u.append(size)
            else:
                s, c = (rate.w * d).sin_cos()
                u += [size * c, size * s]
        return interval.row(u)

    def near(self, d: float) -> list[float]:
        """Return doubles near the entries; nothing is rounded outwards."""
        rates, columns = self._doubles
        u = list[float]()
        for rate in rates:
            size = exp(rate.a * d)
            u += [size] if rate.w is None else [size * cos(rate.w * d), size * sin(rate.w * d)]
        return [sum(map(mul, u, column)) for column in columns]

    @cached_property
    def _doubles(self) -> tuple[list[Rate[float]], list[list[float]]]:
        """The rates, and the columns that give X."""
        rates = [Rate(float(r.a), None if r.w is None else float(r.w)) for r in self.rates]
        columns = self.towers[0].transpose().tolist()
        return rates, [[float(x) for x in column] for column in columns]


def spectral(rows: Sequence[Sequence[Polynomial]], size: int) -> Spectral | None:
    """Return the first entries of exp(N d), so many of them, row by row.

    None if N is not rational, if it has no basis of eigenvectors, or if its eigenvalues are close
    to each other.
    """
    if any(set(q.terms) - {()} for row in rows for q in row):
        return None
    N = [[q.terms.get((), Fraction(0)) for q in row] for row in rows]
    with interval.workprec(interval.working_bits() + ROOM):
        found = interval.spectrum(N)
        return None if found is None else _spectral(N, found, size)


def _spectral(
    N: Sequence[Sequence[Fraction]], eigenvalues: Sequence[ComplexBall], size: int
) -> Spectral | None:
    """Return the entries, or None if some P is large."""
    M = interval.matrix([[interval.ball(q) for q in row] for row in N])
    rates, parts = list[Rate[Ball]](), list[Matrix]()
    for z in eigenvalues:
        if z.imag < 0:
            continue
        P = _projection(M, z, [y for y in eigenvalues if y is not z])
        if not all(abs(x) < LARGEST for x in P.entries()):
            return None
        is_real = z.imag.is_zero()
        rates.append(Rate(z.real, None if is_real else z.imag))
        parts += [P.real] if is_real else [(P * 2).real, (P * ComplexBall(0, 2)).real]
    towers = list[Matrix]()
    for _ in range(4):
        towers.append(interval.matrix([X.entries()[:size] for X in parts]))
        parts = [X * M for X in parts]
    return Spectral(rates, towers, SHORT / max(1e-9, *(float(abs(z)) for z in eigenvalues)))


def _projection(M: Matrix, z: ComplexBall, others: Sequence[ComplexBall]) -> ComplexMatrix:
    """Return P of an eigenvalue."""
    one, N = (interval.complex_matrix(X) for X in (interval.identity(M.nrows()), M))
    return reduce(lambda P, y: P * (N - one * y) * (1 / (z - y)), others, one)
