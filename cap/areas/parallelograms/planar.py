"""Compiled: planar maps and their derivatives, over boxes of states, in intervals of doubles."""

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from cap.areas.rings import half_periods
from cap.areas.rings.half_periods import Floats, Laws, column, first_hit, gap, hit
from cap.areas.rings.half_periods import image as at_the_end
from cap.sets.circular import PI, TURN, sin_cos
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, enclosing, is_positive, lower, upper
from cap.system.planar import Map
from cap.system.polynomial import COS, SIN, Polynomial
from cap.system.polynomial import PI as NUMBER

HALF_PERIOD, FORMULAS = range(2)


class Planar(NamedTuple):
    """A map: which kind, and its constants (N, 2) as intervals: midpoints and radii."""

    kind: int
    constants: Floats


class Columns(NamedTuple):
    """What a derivative makes of two vectors."""

    x0: Interval
    v0: Interval
    x1: Interval
    v1: Interval


def half_period(phi: Fraction, a: Fraction) -> Planar:
    """Return sigma of motions that never stop, in units F = ω = 1, for φ = f/F and walls ±a."""
    return Planar(HALF_PERIOD, _rows(half_periods.laws(phi, a)))


def formulas(given: Map) -> Planar:
    """Return a map given by formulas.

    Of each of six polynomials the constants give the number of terms, and of each term its
    coefficient and the powers of the coordinates, of cos, sin and pi.
    """
    names = *given.state, COS, SIN, NUMBER
    images = [given.image[z] for z in given.state]
    rows = [entry for row in given.derivative for entry in row]
    numbers = [enclosing(int(given.torus))]
    for q in (*images, *rows):
        numbers += _terms(q, names)
    return Planar(FORMULAS, _rows(numbers))


def _terms(q: Polynomial, names: tuple[str, ...]) -> list[Interval]:
    found = [enclosing(len(q.terms))]
    for monomial, c in q.terms.items():
        powers = dict(monomial)
        found += [enclosing(c), *(enclosing(powers.get(name, 0)) for name in names)]
    return found


def _rows(numbers: Iterable[Interval]) -> Floats:
    return np.array([(x.mid, x.rad) for x in numbers])


@kernel
def image(kind: int, y: Floats, x: Interval, v: Interval, axes: Columns) -> tuple[Any, Any, Any]:
    """Return the images (x, v) of a box, and what its derivative makes of two vectors.

    They are NaN where it is not certain that the map is defined.
    """
    if kind == HALF_PERIOD:
        return _half_period(y, x, v, axes)
    return _formulas(y, x, v, axes)


@kernel
def _nowhere() -> tuple[Any, Any, Any]:
    none = Interval(math.nan, math.nan)
    return none, none, Columns(none, none, none, none)


@kernel
def _half_period(y: Floats, x: Interval, v: Interval, axes: Columns) -> tuple[Any, Any, Any]:
    """Follow motions with one hit and no stop (`cap.checker.coverings.half_period`)."""
    given = Laws(_at(y, 0), _at(y, 1), _at(y, 2), _at(y, 3), _at(y, 4), _at(y, 5))
    inside = is_positive(given.a - x) and is_positive(given.a + x) and is_positive(v)
    guess = hit(x.mid, v.mid, given.alpha.mid, given.a.mid, 1.0)
    if not (inside and guess > 0):
        return _nowhere()
    t = Interval(guess, 0.0)
    beyond = gap(x, v, t, given, 1.0)
    found = first_hit(guess, beyond, v, given, 1.0)
    if not is_positive(found.u):
        return _nowhere()
    X, V = at_the_end(v, t - beyond / found.u, given, 1.0)
    if not (lower(V) > upper(given.c) and is_positive(given.a - X)):
        return _nowhere()
    x0, v0 = column(axes.x0, axes.v0, found.t, found.k, found.d)
    x1, v1 = column(axes.x1, axes.v1, found.t, found.k, found.d)
    return X, V, Columns(x0, v0, x1, v1)


@kernel
def _formulas(y: Floats, x: Interval, v: Interval, axes: Columns) -> tuple[Any, Any, Any]:
    """Evaluate six polynomials, one after the other in ``y``; on a torus within its cuts."""
    torus = y[0, 0] > 0
    if torus and not (_uncut(x) and _uncut(v)):
        return _nowhere()
    sin, cos = sin_cos(x)
    X, n = _evaluated(y, 1, x, v, cos, sin)
    V, n = _evaluated(y, n, x, v, cos, sin)
    a, n = _evaluated(y, n, x, v, cos, sin)
    b, n = _evaluated(y, n, x, v, cos, sin)
    c, n = _evaluated(y, n, x, v, cos, sin)
    d, n = _evaluated(y, n, x, v, cos, sin)
    if torus:
        X, V = _reduced(X), _reduced(V)
        if not (_uncut(X) and _uncut(V)):
            return _nowhere()
    columns = Columns(
        a * axes.x0 + b * axes.v0,
        c * axes.x0 + d * axes.v0,
        a * axes.x1 + b * axes.v1,
        c * axes.x1 + d * axes.v1,
    )
    return X, V, columns


@kernel
def _at(y: Floats, n: int) -> Any:
    """Return the constant at a place."""
    return Interval(y[n, 0], y[n, 1])


@kernel
def _uncut(x: Interval) -> bool:
    """Return whether -π < x < π is certain."""
    return is_positive(PI - x) and is_positive(PI + x)


@kernel
def _reduced(x: Interval) -> Any:
    """Return x less a multiple of 2π, its middle nearest to 0."""
    return x - TURN * float(math.floor(x.mid / TURN.mid + 0.5))


@kernel
def _evaluated(
    y: Floats, n: int, x: Interval, v: Interval, cos: Interval, sin: Interval
) -> tuple[Any, int]:
    """Return the sum of products that stands from the place n on, and the place after it."""
    total, count = Interval(0.0, 0.0), int(y[n, 0])
    n += 1
    for _ in range(count):
        term = _power(_at(y, n), x, y[n + 1, 0])
        term = _power(_power(term, v, y[n + 2, 0]), cos, y[n + 3, 0])
        term = _power(_power(term, sin, y[n + 4, 0]), PI, y[n + 5, 0])
        total = total + term
        n += 6
    return total, n


@kernel
def _power(product: Interval, x: Interval, power: float) -> Any:
    """Return a product times a power."""
    for _ in range(int(power)):
        product = product * x
    return product
