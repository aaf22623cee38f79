"""A planar map, as coverings see it: enclosures of its values and of its derivative.

To add a map: a class with ``image``.  Nothing else in this folder knows which map it is.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import NamedTuple

from cap.checker.kernel.doubles import Double

Row = tuple[Double, Double]


class Image(NamedTuple):
    """Enclosures of g = (x, y) and of its derivative over a rectangle."""

    x: Double
    y: Double
    derivative: tuple[Row, Row]


class Planar(ABC):
    """A map g, continuously differentiable where it is defined."""

    def on(self, i: int) -> Planar:  # noqa: ARG002
        """Return the map as it is looked at on the i-th set, where more may be asked of it."""
        return self

    @abstractmethod
    def image(self, x: Double, y: Double) -> Image:
        """Enclose g and Dg on a rectangle; reject unless g is defined on a neighbourhood of it."""
