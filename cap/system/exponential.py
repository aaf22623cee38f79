"""The flights of any mode in balls, where there is no closed form (springs), or in resonance.

y = (state, cos wt, sin wt, 1) has y' = M y, so y(t_0 + d) = exp(M d) y(t_0).

*By eigenvalues.*  If a rational N has a basis of eigenvectors, exp(N d) is the sum over its
eigenvalues of e^(λd) P, where P is the product of (N - μ)/(λ - μ) over the others; two that are
conjugate, a ± iw, give 2 e^(ad) (cos wd Re P - sin wd Im P).  For d = m + s, D the ball of d,

    exp(N d) = exp(N m) (1 + N s) + exp(N D) N² s²/2      (Taylor's formula).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from typing import NamedTuple

from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall, ComplexMatrix, Matrix
from cap.system.polynomial import Polynomial

ROOM = 64  # more bits for what is kept
LARGEST = 100  # of P, where eigenvalues are near to each other


def enclosed(rows: Sequence[Sequence[Polynomial]]) -> Matrix:
    """Return an enclosure of a matrix of numbers."""
    return interval.matrix([[number(q) for q in row] for row in rows])


def exponential(A: Matrix, d: Ball) -> Matrix:
    """Return an enclosure of exp(A t) for all t in d.

    With d = m + [-r, r] it is exp(A m) exp(A [-r, r]), which is narrower than exp(A d) at once.
    """
    middle = interval.point(d)
    at_middle, aside = (A * middle).exp(), d - middle
    return at_middle if aside.is_zero() else at_middle * (A * aside).exp()


def number(q: Polynomial) -> Ball:
    """Return a ball that contains a number, a sum of rationals times powers of pi."""
    value: Ball = q.evaluated({}, interval.ball, interval.pi())
    return value


class Exponential:
    """The first rows of exp(N d), entry by entry, as a function of balls d."""

    def __init__(self, rows: Sequence[Sequence[Polynomial]], count: int) -> None:
        """Take N, and how many of its rows are wanted."""
        self._size = count * len(rows)
        with interval.workprec(interval.working_bits() + ROOM):
            self._matrix = enclosed(rows)
            self._modes = _modes(rows, self._matrix, self._size)

    def __call__(self, d: Ball) -> Sequence[Ball]:
        """Return enclosures of the entries for all numbers in d."""
        size = self._size
        if self._modes is None:
            return exponential(self._matrix, d).entries()[:size]
        rates, here, further = self._modes
        middle = interval.point(d)
        near, aside = (_functions(rates, middle) * here).entries(), d - middle
        if aside.is_zero():
            return near[:size]
        far = (_functions(rates, d) * further).entries()
        square = aside.abs_upper() ** 2 / 2
        bend = interval.hull(interval.ZERO, square)
        return [
            x + y * aside + z * bend for x, y, z in zip(near[:size], near[size:], far, strict=True)
        ]


class _Modes(NamedTuple):
    """Exponentials of d as a row u, of X = exp(N d) the entries; those of X and X N are u ``here``.

    Those of X N² are u ``further``.  Of an eigenvalue a there is e^(ad) in u, of a ± iw e^(ad) cos
    wd and e^(ad) sin wd.
    """

    rates: Sequence[tuple[Ball, Ball | None]]  # a and w, or a
    here: Matrix
    further: Matrix


def _modes(rows: Sequence[Sequence[Polynomial]], N: Matrix, size: int) -> _Modes | None:
    """Return what exp(N d) is by eigenvalues; None if N is not rational, or that would be wide."""
    if any(set(q.terms) - {()} for row in rows for q in row):
        return None
    found = interval.spectrum([[q.terms.get((), Fraction(0)) for q in row] for row in rows])
    if found is None:
        return None
    rates, here, further = list[tuple[Ball, Ball | None]](), list[list[Ball]](), list[list[Ball]]()
    for z in found:
        if z.imag < 0:
            continue
        P = _projection(N, z, [y for y in found if y is not z])
        if not all(abs(x) < LARGEST for x in P.entries()):
            return None
        is_real = z.imag.is_zero()
        rates.append((z.real, None if is_real else z.imag))
        parts = [_real(P)] if is_real else [_real(P + P), _real(ComplexBall(0, 1) * (P + P))]
        for part in parts:
            towers = [X.entries()[:size] for X in (part, part * N, part * N * N)]
            here.append(towers[0] + towers[1])
            further.append(towers[2])
    return _Modes(rates, interval.matrix(here), interval.matrix(further))


def _projection(N: Matrix, z: ComplexBall, others: Sequence[ComplexBall]) -> ComplexMatrix:
    """Return P of an eigenvalue."""
    one, M = (interval.complex_matrix(X) for X in (interval.identity(N.nrows()), N))
    return reduce(lambda P, y: P * (M - one * y) * (1 / (z - y)), others, one)


def _real(P: ComplexMatrix) -> Matrix:
    """Return the real parts."""
    rows = P.tolist()
    return interval.matrix([[x.real for x in row] for row in rows])


def _functions(rates: Sequence[tuple[Ball, Ball | None]], d: Ball) -> Matrix:
    """Return the row of the exponentials."""
    found = list[Ball]()
    for a, w in rates:
        size = (a * d).exp()
        if w is None:
            found.append(size)
        else:
            s, c = (w * d).sin_cos()
            found += [size * c, size * s]
    return interval.row(found)
