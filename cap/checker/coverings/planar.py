"""A planar map, as coverings see it: enclosures of its values and of its derivative.

To add a map: a class with ``image``.  Nothing else in this folder knows which map it is.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import NamedTuple

from cap.checker.kernel.doubles import Double

Row = tuple[Double, Double]
Matrix = tuple[Row, Row]


class Image(NamedTuple):
    """Enclosures of g = (x, y) and of its derivative over a rectangle."""

    x: Double
    y: Double
    derivative: Matrix


class Planar(ABC):
    """A map g, continuously differentiable where it is defined."""

    def on(self, i: int) -> Planar:  # noqa: ARG002
        """Return the map as it is looked at on the i-th set, where more may be asked of it."""
        return self

    @abstractmethod
    def image(self, x: Double, y: Double) -> Image:
        """Enclose g and Dg on a rectangle; reject unless g is defined on a neighbourhood of it."""


def applied(A: Matrix, u: Row) -> Row:
    """Return A u."""
    (a, b), (c, d) = A
    return a * u[0] + b * u[1], c * u[0] + d * u[1]


def product(A: Matrix, B: Matrix) -> Matrix:
    """Return A B."""
    (p, r), (q, s) = (applied(A, column) for column in zip(*B, strict=True))
    return (p, q), (r, s)


def inverse(A: Matrix) -> Matrix:
    """Return the inverse; a matrix that may be singular rejects."""
    (a, b), (c, d) = A
    det = a * d - b * c
    return (d / det, -b / det), (-c / det, a / det)
