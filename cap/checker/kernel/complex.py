"""Complex intervals: rectangles of complex numbers."""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.interval import Interval


class Complex(NamedTuple):
    """The set of x + iy for x in re and y in im."""

    re: Interval
    im: Interval

    def __add__(self, other: Complex) -> Complex:  # type: ignore[override]
        return Complex(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        return Complex(self.re - other.re, self.im - other.im)

    def __neg__(self) -> Complex:
        return Complex(-self.re, -self.im)

    def __mul__(self, other: Complex) -> Complex:  # type: ignore[override]
        re = self.re * other.re - self.im * other.im
        return Complex(re, self.re * other.im + self.im * other.re)

    def __truediv__(self, other: Complex) -> Complex:
        norm = other.re.square() + other.im.square()
        quotient = self * other.conjugate()
        return Complex(quotient.re / norm, quotient.im / norm)

    def conjugate(self) -> Complex:
        """Return the set of conjugate numbers."""
        return Complex(self.re, -self.im)
