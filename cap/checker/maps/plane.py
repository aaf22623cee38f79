"""Vectors and matrices of the plane, with intervals as entries."""

from __future__ import annotations

from collections.abc import Sequence

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

Vector = tuple[Interval, Interval]
Matrix = tuple[Vector, Vector]


def applied(a: Matrix, vector: Sequence[Interval]) -> Vector:
    """Return the product with a column."""
    x, y = vector
    return a[0][0] * x + a[0][1] * y, a[1][0] * x + a[1][1] * y


def product(a: Matrix, b: Matrix) -> Matrix:
    """Return the product of two matrices."""
    (p, r), (q, s) = (applied(a, column) for column in zip(*b, strict=True))
    return (p, q), (r, s)


def adjugate(a: Matrix) -> Matrix:
    """Return the determinant times the inverse."""
    (p, q), (r, s) = a
    return (s, -q), (-r, p)


def inverse(a: Matrix) -> Matrix:
    """Return the inverse; a matrix that may be singular rejects."""
    (p, q), (r, s) = a
    determinant = p * s - q * r
    need(not determinant.contains_zero(), "a frame may be singular")
    (a11, a12), (a21, a22) = adjugate(a)
    return (a11 / determinant, a12 / determinant), (a21 / determinant, a22 / determinant)


def plus(a: Sequence[Interval], b: Sequence[Interval]) -> Vector:
    """Return the sum of two vectors."""
    return a[0] + b[0], a[1] + b[1]


def minus(a: Sequence[Interval], b: Sequence[Interval]) -> Vector:
    """Return the difference of two vectors."""
    return a[0] - b[0], a[1] - b[1]


def midpoint(a: Sequence[Interval]) -> Vector:
    """Return one point of a box, near its middle."""
    return a[0].midpoint(), a[1].midpoint()


def symmetric(x: Interval) -> Interval:
    """Return the interval from -max |x| to max |x|."""
    far = x.magnitude().hi
    return Interval(-far, far, x.bits)
