"""Ellipses around a sink that its map contracts.

Let P* be a fixed point of Φⁿ and W an invertible matrix.  For z in a convex set around P*,

    W(Φⁿ(z) - P*) = N W(z - P*),      N = W M W⁻¹, M the mean of (Φⁿ)' from P* to z.

If N has a norm of at most κ < 1 for all z of the set, then |W(Φⁿ(z) - P*)| <= κ |W(z - P*)|.  So
the ellipse |W(z - P*)| <= 1, if it lies in the set, is mapped into itself, and its points converge
to P*.  Over Taylor models in y = z - P* the mean is exact: a term of degree k is divided by k + 1.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from cap import bisection, interval, matrix
from cap.errors import NotProved
from cap.event import TAYLOR_MODELS
from cap.fixed_point import FixedPoint, Itinerary, find_windows
from cap.flow import strobe
from cap.interval import Ball
from cap.jet import Jet
from cap.matrix import Matrix
from cap.model import Oscillator
from cap.taylor_model import Domain, TaylorModel

Rows = tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]


@dataclass(frozen=True)
class Basin:
    """The ellipse |W(z - P*)| <= 1, W = ``matrix``, and a bound κ < 1 of its contraction."""

    matrix: Rows
    contraction: Fraction

    def reach(self) -> tuple[Fraction, Fraction]:
        """Return upper bounds of the half-widths of the ellipse: the norms of the rows of W⁻¹."""
        x, v = (interval.ends(half)[1] for half in _reach(self.matrix))
        return x, v


def shape(point: FixedPoint) -> Rows:
    """Return a matrix W in whose norm the derivative at P* contracts well; it only steers.

    WᵀW = Σ (Jᵀ/c)ᵏ (J/c)ᵏ with c between the spectral radius of J = (Φⁿ)'(P*) and 1.
    """
    J = np.array([[float(entry.mid()) for entry in row] for row in point.orbit.monodromy])
    radius = float(max(abs(np.linalg.eigvals(J))))
    scaled = J / (radius + (1 - radius) / 4)
    total, power = np.eye(2), np.eye(2)
    for _ in range(10000):
        power = scaled @ power
        term = power.T @ power
        total = total + term
        if np.abs(term).max() < 1e-6 * np.abs(total).max():
            break
    W = np.linalg.cholesky(total).T
    W = W / np.abs(W).max()
    (a, b), (c, d) = ((_short(q) for q in row) for row in W)
    return (a, b), (c, d)


def _short(q: float) -> Fraction:
    """Return a decimal of few digits near ``q``."""
    return Fraction(f"{q:.6f}")


def contraction(
    osc: Oscillator[Any], point: FixedPoint, events: Itinerary, W: Rows, size: Fraction
) -> Fraction:
    """Prove that the ellipse |W(z - P*)| <= ``size`` is contracted; return a bound κ < 1.

    ``events`` are the events expected, with windows near.  Raises `NotProved` if κ < 1 fails.
    """
    rows = _balls(W)
    inverse = matrix.inverse(rows)
    reach = [half * interval.ball(size) for half in _reach(W)]
    x, v = Domain(reach, 2).variables(point.box)
    n = point.periods
    expected = find_windows(osc, (x, v), events, TAYLOR_MODELS, n)
    slope = strobe(osc, (x, v), expected, TAYLOR_MODELS, n).monodromy
    product = matrix.product(matrix.product(rows, slope), inverse)
    norm = _norm([[TAYLOR_MODELS.bound(_mean(entry)) for entry in row] for row in product])
    if not norm < 1:
        raise NotProved("basin", "the ellipse is not certain to be contracted", {"norm": norm})
    return interval.ends(norm)[1]


def _reach(W: Rows) -> list[Ball]:
    return [(p * p + q * q).sqrt() for p, q in matrix.inverse(_balls(W))]


def _mean(model: Any) -> Any:
    """Return the means of the functions from 0 to y, as functions of y."""
    if not isinstance(model, TaylorModel):
        return model
    jet = model.polynomial
    degrees = map(sum, jet.space.exponents)
    means = [(c + Ball(0)) / (k + 1) for c, k in zip(jet.coefficients, degrees, strict=True)]
    return TaylorModel(model.domain, Jet(jet.space, means), model.remainder)


def _balls(W: Rows) -> Matrix[Any]:
    (a, b), (c, d) = W
    return (interval.ball(a), interval.ball(b)), (interval.ball(c), interval.ball(d))


def _norm(M: list[list[Ball]]) -> Ball:
    """Return a bound of the spectral norms of the matrices in M: that of the centre, plus the
    Frobenius norm of the rest.

    The largest singular value s of ((a, b), (c, d)) has 2s = |(a + d, b - c)| + |(a - d, b + c)|.
    """
    (a, b), (c, d) = ((interval.point(q) for q in row) for row in M)
    centre = _length(a + d, b - c) / 2 + _length(a - d, b + c) / 2
    rest = [interval.upper(abs(q - interval.point(q))) for row in M for q in row]
    return centre + sum((q * q for q in rest), Ball(0)).sqrt()


def _length(p: Ball, q: Ball) -> Ball:
    return (p * p + q * q).sqrt()


def largest(
    osc: Oscillator[Any], point: FixedPoint, events: Itinerary, room: tuple[Fraction, Fraction]
) -> tuple[Rows, Fraction]:
    """Return W and the largest size found; at most what fits into ±``room`` around P*."""
    W = shape(point)
    upper = min(float(half) / float(side) for half, side in zip(room, _reach(W), strict=True))
    size = bisection.largest(
        lambda size: contraction(osc, point, events, W, size), Fraction(f"{0.99 * upper:.3e}"), 4
    )
    if size is None:
        raise NotProved("basin", "no ellipse around the fixed point is contracted")
    return W, size


def scaled(
    osc: Oscillator[Any],
    point: FixedPoint,
    events: Itinerary,
    found: tuple[Rows, Fraction],
    margin: Fraction,
) -> Basin:
    """Return the ellipse that is smaller by ``margin``, with a contraction nearer to 1."""
    W, size = found
    size = interval.short(size * margin)
    scale = 10 ** max(0, 7 - interval.decade(1 / size))
    (a, b), (c, d) = ((Fraction(round(q / size * scale), scale) for q in row) for row in W)
    smaller = (a, b), (c, d)
    bound = contraction(osc, point, events, smaller, Fraction(1))
    places = max(3, 2 - interval.decade(1 - bound))
    kappa = Fraction(math.ceil((bound + (1 - bound) / 4) * 10**places), 10**places)
    return Basin(smaller, kappa)
