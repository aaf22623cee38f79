"""exp(N d) by the eigenvalues of a rational matrix N that has a basis of eigenvectors.

It is the sum over its eigenvalues z of e^(zd) P, where P is the product of (N - y)/(z - y) over the
others; two that are conjugate, a ± iw, give 2 e^(ad) (cos wd Re P - sin wd Im P).  For d = m + s,
where D is the ball of d, Taylor's formula is

    exp(N d) = exp(N m) (1 + N s) + exp(N D) N² s²/2.
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

    Those of X and X N are u ``here``, those of X N² are u ``further``.
    """

    rates: list[Rate[Ball]]
    here: Matrix
    further: Matrix

    def __call__(self, d: Ball) -> list[Ball]:
        """Return enclosures for all numbers in d."""
        size, middle = self.further.ncols(), interval.point(d)
        near, aside = (self._row(middle) * self.here).entries(), d - middle
        if aside.is_zero():
            return near[:size]
        bend = interval.hull(interval.ZERO, aside.abs_upper() ** 2 / 2)
        far = (self._row(d) * self.further).entries()
        return [
            x + y * aside + z * bend for x, y, z in zip(near[:size], near[size:], far, strict=True)
        ]

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
        columns = self.here.transpose().tolist()[: self.further.ncols()]
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
    rates, here, further = list[Rate[Ball]](), list[list[Ball]](), list[list[Ball]]()
    for z in eigenvalues:
        if z.imag < 0:
            continue
        P = _projection(M, z, [y for y in eigenvalues if y is not z])
        if not all(abs(x) < LARGEST for x in P.entries()):
            return None
        is_real = z.imag.is_zero()
        rates.append(Rate(z.real, None if is_real else z.imag))
        for part in [P] if is_real else [P * 2, P * ComplexBall(0, 2)]:
            X, first, second = (
                Y.entries()[:size] for Y in (part.real, part.real * M, part.real * M * M)
            )
            here.append([*X, *first])
            further.append([*second])
    return Spectral(rates, interval.matrix(here), interval.matrix(further))


def _projection(M: Matrix, z: ComplexBall, others: Sequence[ComplexBall]) -> ComplexMatrix:
    """Return P of an eigenvalue."""
    one, N = (interval.complex_matrix(X) for X in (interval.identity(M.nrows()), M))
    return reduce(lambda P, y: P * (N - one * y) * (1 / (z - y)), others, one)
