"""Intervals of real numbers with integer ends.

``Interval(lo, hi, bits)`` is the set of the real numbers t with lo <= 2^bits t <= hi.  The
inclusion principle holds for every operation: if x lies in X and y in Y, then x o y lies in X o Y,
because

    floor(a) <= a <= ceil(a),    ceil(a) = -floor(-a),    and Python's ``//`` and ``>>`` are floor.

Sums and products by an integer are exact, products by a fraction are rounded once.  The product of
two integers in units 2^-bits has the unit 2^-2bits; one shift brings it back.  The extrema of x y
over X x Y are at the corners; if X has one sign, the sign of an end of Y tells at which end of X.
Those of x / y with y > 0 are at x = lo for the least and at x = hi for the greatest value.
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from cap.checker.kernel.rejection import Rejected, need


class Interval:
    """The set of real numbers [lo, hi] 2^-bits; operands must have the same bits."""

    __slots__ = ("bits", "hi", "lo")

    def __init__(self, lo: int, hi: int, bits: int) -> None:
        self.lo, self.hi, self.bits = lo, hi, bits

    @classmethod
    def enclosing(cls, lower: Fraction | int, upper: Fraction | int, bits: int) -> Interval:
        """Return the least interval in units 2^-bits that contains [lower, upper]."""
        lo = (lower.numerator << bits) // lower.denominator
        hi = -((-upper.numerator << bits) // upper.denominator)
        need(lo <= hi, "the ends of an interval are not in order")
        return cls(lo, hi, bits)

    @property
    def lower(self) -> Fraction:
        """The lower end, exactly."""
        return Fraction(self.lo, 1 << self.bits)

    @property
    def upper(self) -> Fraction:
        """The upper end, exactly."""
        return Fraction(self.hi, 1 << self.bits)

    @property
    def width(self) -> int:
        """The width in units 2^-bits."""
        return self.hi - self.lo

    def midpoint(self) -> Interval:
        """Return one point of the interval, near its middle."""
        middle = (self.lo + self.hi) >> 1
        return Interval(middle, middle, self.bits)

    def integer(self, n: int) -> Interval:
        """Return the integer n in the unit of this interval."""
        return Interval(n << self.bits, n << self.bits, self.bits)

    def with_bits(self, bits: int) -> Interval:
        """Return the interval in units 2^-bits: the same set, or a larger one if bits decrease."""
        lo, hi = self.lo << bits, -self.hi << bits
        return Interval(lo >> self.bits, -(hi >> self.bits), bits)

    def _ends(self, other: Interval | int) -> tuple[int, int]:
        """Return the ends of the other operand in the unit of this one."""
        if isinstance(other, int):
            return other << self.bits, other << self.bits
        if other.bits != self.bits:
            raise Rejected("intervals of different precision met")
        return other.lo, other.hi

    def __add__(self, other: Interval | int) -> Interval:
        c, d = self._ends(other)
        return Interval(self.lo + c, self.hi + d, self.bits)

    def __sub__(self, other: Interval | int) -> Interval:
        c, d = self._ends(other)
        return Interval(self.lo - d, self.hi - c, self.bits)

    def __neg__(self) -> Interval:
        return Interval(-self.hi, -self.lo, self.bits)

    def __mul__(self, other: Interval | Fraction | int) -> Interval:
        a, b = self.lo, self.hi
        if not isinstance(other, Interval):
            n, d = other.as_integer_ratio()
            a, b = (a, b) if n >= 0 else (b, a)
            return Interval(a * n // d, -(-b * n // d), self.bits)
        c, d = self._ends(other)
        if a >= 0:
            least, most = (a if c >= 0 else b) * c, (b if d >= 0 else a) * d
        elif b <= 0:
            least, most = (a if d >= 0 else b) * d, (b if c >= 0 else a) * c
        else:
            least, most = min(a * d, b * c), max(a * c, b * d)
        return Interval(least >> self.bits, -(-most >> self.bits), self.bits)

    def __truediv__(self, other: Interval | int) -> Interval:
        c, d = self._ends(other)
        need(c > 0 or d < 0, "division by an interval that contains zero")
        if d < 0:
            return -self / -other
        a, b = self.lo << self.bits, -self.hi << self.bits
        return Interval(min(a // c, a // d), -min(b // c, b // d), self.bits)

    def square(self) -> Interval:
        """Return an enclosure of x^2 for x in the interval; its lower end is not negative."""
        size = self.magnitude()
        return size * size

    def sqrt(self) -> Interval:
        """Return an enclosure of the square roots; an interval with negative numbers rejects."""
        need(self.lo >= 0, "square root of an interval that contains negative numbers")
        lo, hi = self.lo << self.bits, self.hi << self.bits
        root = isqrt(hi)
        return Interval(isqrt(lo), root + (root * root < hi), self.bits)

    def magnitude(self) -> Interval:
        """Return the set of |x| for x in the interval."""
        far = max(-self.lo, self.hi)
        return Interval(max(self.lo, -self.hi, 0), far, self.bits)

    def intersection(self, other: Interval) -> Interval:
        """Return the intersection; two enclosures of one number cannot be disjoint."""
        c, d = self._ends(other)
        lo, hi = max(self.lo, c), min(self.hi, d)
        need(lo <= hi, "two enclosures of one quantity are disjoint")
        return Interval(lo, hi, self.bits)

    def is_positive(self) -> bool:
        """Return whether every number in the interval is positive."""
        return self.lo > 0

    def is_before(self, other: Interval | int) -> bool:
        """Return whether x < y for every x in this interval and every y in the other one."""
        c, _ = self._ends(other)
        return self.hi < c

    def contains_zero(self) -> bool:
        """Return whether 0 lies in the interval."""
        return self.lo <= 0 <= self.hi

    def lies_in(self, lower: Fraction, upper: Fraction) -> bool:
        """Return whether the interval is a subset of [lower, upper]."""
        return lower <= self.lower and self.upper <= upper

    def lies_inside(self, lower: Fraction, upper: Fraction) -> bool:
        """Return whether the interval is a subset of the open interval (lower, upper)."""
        return lower < self.lower and self.upper < upper
