"""A number with its first derivatives: f and df/dx_i, enclosed; absent derivatives are zero.

(f g)' = f' g + f g',      (f/g)' = (f' - (f/g) g')/g
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from cap.checker.kernel.interval import Interval


class Slope:
    """An enclosure of a number, and of its derivatives by the variables of these indices."""

    __slots__ = ("by", "value")

    def __init__(self, value: Interval, by: Mapping[int, Interval]) -> None:
        self.value, self.by = value, by

    def derivatives(self, count: int) -> list[Interval]:
        """Return the first few derivatives."""
        zero = self.value.integer(0)
        return [self.by.get(i, zero) for i in range(count)]

    def __add__(self, other: Slope | Interval) -> Slope:
        if isinstance(other, Interval):
            return Slope(self.value + other, self.by)
        total = dict(self.by)
        for i, x in other.by.items():
            total[i] = total[i] + x if i in total else x
        return Slope(self.value + other.value, total)

    def __neg__(self) -> Slope:
        return Slope(-self.value, {i: -x for i, x in self.by.items()})

    def __sub__(self, other: Slope) -> Slope:
        return self + -other

    def __mul__(self, other: Slope | Interval) -> Slope:
        if isinstance(other, Interval):
            return Slope(self.value * other, {i: x * other for i, x in self.by.items()})
        total = {i: x * other.value for i, x in self.by.items()}
        for i, x in other.by.items():
            term = self.value * x
            total[i] = total[i] + term if i in total else term
        return Slope(self.value * other.value, total)

    def __truediv__(self, other: Slope) -> Slope:
        quotient = self.value / other.value
        rest = Slope(self.value, self.by) - other * quotient
        return Slope(quotient, {i: x / other.value for i, x in rest.by.items()})

    def scaled(self, c: Fraction) -> Slope:
        """Return the product with a rational number."""
        return Slope(self.value.scaled(c), {i: x.scaled(c) for i, x in self.by.items()})
