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
import numpy.typing as npt

from cap.errors import NotProved
from cap.flow.event import TAYLOR_MODELS
from cap.flow.model import Oscillator
from cap.flow.windows import Itinerary, find_windows
from cap.maps.fixed_point import FixedPoint
from cap.maps.metric import metric
from cap.sets import bisection, interval, matrix
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.matrix import Matrix
from cap.sets.taylor_model import Domain, TaylorModel

Array = npt.NDArray[np.float64]
SLOW = 1e-3  # a spectral radius so near 1
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
    """Return a matrix W such that J = (Φⁿ)'(P*) contracts well in the norm |W z|; a hint.

    It is computed in the units of x and v in which P* is known equally well.  Raises `NotProved` if
    J is not that of a sink, as far as the digits of P* tell.
    """
    unit = interval.ball(_unit(point))
    (a, b), (c, d) = point.orbit.monodromy
    J = (a, b * unit), (c / unit, d)
    places, rows = 6 + _extra(point), (_normal_form(J) if _is_slow(J) else _metric(_floats(J)))
    (p, q), (r, s) = ((round(Fraction(entry), places) for entry in row) for row in rows)
    return (p, q / _unit(point)), (r, s / _unit(point))


def _floats(J: Matrix[Ball]) -> Array:
    return np.array([[float(entry.mid()) for entry in row] for row in J])


def _radius(J: Matrix[Ball]) -> float:
    """Return the spectral radius in floats."""
    floats = _floats(J)
    return float(max(abs(np.linalg.eigvals(floats)))) if np.isfinite(floats).all() else math.inf


def _is_slow(J: Matrix[Ball]) -> bool:
    """Return whether floats hardly tell the multipliers from 1 in size; raise if they are larger.

    The power iteration of `_metric` would not end.
    """
    radius = _radius(J)
    if not radius < 1 + SLOW:
        raise NotProved("basin", f"in floats P* is no sink: a spectral radius of {radius:.6g}")
    return radius > 1 - SLOW


def _extra(point: FixedPoint) -> int:
    """Return how many more digits of W it takes to tell the multipliers from 1."""
    if not _is_slow(point.orbit.monodromy):
        return 0
    slack = 1 - interval.midpoint(matrix.determinant(point.orbit.monodromy))
    if not slack > 0:
        raise NotProved("basin", "P* may be no sink: its determinant is 1, to all digits")
    return -interval.decade(slack)


def _normal_form(J: Matrix[Ball]) -> list[list[Fraction]]:
    """Return W such that W J W⁻¹ is a rotation times the square root of det J.

    q = c x² + (d - a) x v - b v² has q(Jz) = det J q(z); it is definite if the multipliers are not
    real, and then |W z|² = c q.
    """
    (a, b), (c, d) = J
    h = (d - a) / 2
    beta = (-b * c - h * h).sqrt()
    if not beta > 0:
        raise NotProved("basin", "P* attracts too slowly for a node", {"beta": beta})
    size = abs(c).max(abs(h)).max(beta)
    return [[interval.midpoint(q / size) for q in row] for row in ((c, h), (Ball(0), beta))]


def _unit(point: FixedPoint) -> Fraction:
    """Return the unit of v, that of x being 1."""
    return point.reach[1] / point.reach[0]


def _metric(J: Array) -> Array:
    """Return an upper triangular W, of largest entry 1, with c between the radius of J and 1."""
    radius = float(max(abs(np.linalg.eigvals(J))))
    W = metric(J, radius + (1 - radius) / 4, "basin")
    return np.asarray(W / np.abs(W).max())


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
    _, orbit = find_windows(osc, (x, v), events, TAYLOR_MODELS, n)
    product = matrix.product(matrix.product(rows, orbit.monodromy), inverse)
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
    if not math.isfinite(upper):
        raise NotProved("basin", "its ellipses are too thin for floats")
    size = bisection.largest(
        lambda size: contraction(osc, point, events, W, size), Fraction(f"{0.99 * upper:.3e}"), 4
    )
    if size is None:
        sets = {"spectral radius": _radius(point.orbit.monodromy)}
        raise NotProved("basin", "no ellipse around the fixed point is contracted", sets)
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
    units, digits = (Fraction(1), _unit(point)), 7 + _extra(point)
    (a, b), (c, d) = (
        (_decimal(q / size, 1 / (size * unit), digits) for q, unit in zip(row, units, strict=True))
        for row in W
    )
    smaller = (a, b), (c, d)
    bound = contraction(osc, point, events, smaller, Fraction(1))
    places = max(3, 2 - interval.decade(1 - bound))
    kappa = Fraction(math.ceil((bound + (1 - bound) / 4) * 10**places), 10**places)
    return Basin(smaller, kappa)


def _decimal(q: Fraction, size: Fraction, digits: int) -> Fraction:
    """Return a decimal near ``q``, to so many digits of ``size``."""
    return round(q, max(0, digits - interval.decade(size)))
