"""A number with its first derivatives: f and df/dx_i, enclosed; absent derivatives are zero.

(f g)' = f' g + f g',      (f/g)' = (f' - (f/g) g')/g
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Generic, Protocol, TypeVar

N = TypeVar("N", bound="Number")


class Number(Protocol):
    """What is enclosed: an interval, or what stands for one."""

    def __add__(self: N, other: N, /) -> N: ...
    def __sub__(self: N, other: N, /) -> N: ...
    def __neg__(self: N) -> N: ...
    def __mul__(self: N, other: N | Fraction, /) -> N: ...
    def __truediv__(self: N, other: N, /) -> N: ...
    def integer(self: N, n: int, /) -> N:
        """Return an integer."""


class Slope(Generic[N]):
    """An enclosure of a number, and of its derivatives by the variables of these indices."""

    __slots__ = ("by", "value")

    def __init__(self, value: N, by: Mapping[int, N]) -> None:
        self.value, self.by = value, by

    def derivatives(self, count: int) -> list[N]:
        """Return the first few derivatives."""
        zero = self.value.integer(0)
        return [self.by.get(i, zero) for i in range(count)]

    def __add__(self, other: Slope[N] | N) -> Slope[N]:
        if not isinstance(other, Slope):
            return Slope(self.value + other, self.by)
        total = dict(self.by)
        for i, x in other.by.items():
            total[i] = total[i] + x if i in total else x
        return Slope(self.value + other.value, total)

    def __neg__(self) -> Slope[N]:
        return Slope(-self.value, {i: -x for i, x in self.by.items()})

    def __sub__(self, other: Slope[N]) -> Slope[N]:
        return self + -other

    def __mul__(self, other: Slope[N] | N | Fraction) -> Slope[N]:
        if not isinstance(other, Slope):
            return Slope(self.value * other, {i: x * other for i, x in self.by.items()})
        total = {i: x * other.value for i, x in self.by.items()}
        for i, x in other.by.items():
            term = self.value * x
            total[i] = total[i] + term if i in total else term
        return Slope(self.value * other.value, total)

    def __truediv__(self, other: Slope[N]) -> Slope[N]:
        quotient = self.value / other.value
        rest = Slope(self.value, self.by) - other * quotient
        return Slope(quotient, {i: x / other.value for i, x in rest.by.items()})
