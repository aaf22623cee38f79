"""Taylor models in one variable: a polynomial and a bound of the error, on a whole interval.

On a cell [m - r, m + r] of the variable, y = (x - m)/r runs over [-1, 1].  ``TaylorModel(c, e)`` is
the set of all functions g on the cell with

    |g - (c_0 + c_1 y + c_2 y^2 + ...)| <= e    everywhere on the cell,

all in units 2^-bits; the c_k are integers.  If g and h lie in G and H, then g o h lies in G o H,
because |y^k| <= 1.

*Product.*  With polynomials p, q and errors a, b, |gh - pq| <= |p| b + |q| a + ab, where |p| <= sum
of |p_k|.  The terms of pq of degree above ORDER count with their absolute values, and rounding a
coefficient to a unit costs at most one unit.

*Quotient.*  Let q be any polynomial and |1 - gq| <= t < 1.  Then g has no zero, and 1/g = q/(1 - (1
- gq)) differs from q by at most |q| t/(1 - t).  For q the first terms of the power series are
taken.

*Square root.*  Let q be any polynomial with q >= m > 0 and |g - q^2| <= t < m^2.  Then g > 0, and
|sqrt g - q| = |g - q^2| / (sqrt g + q) <= t/m.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import isqrt
from operator import mul

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

ORDER = 10


class TaylorModel:
    """Functions on a cell; operands must belong to the same cell and have the same bits."""

    __slots__ = ("bits", "coefficients", "error")

    def __init__(self, coefficients: Sequence[int], error: int, bits: int) -> None:
        n = len(coefficients)
        while n and not coefficients[n - 1]:
            n -= 1
        self.coefficients, self.error, self.bits = coefficients[:n], error, bits

    @classmethod
    def variable(cls, lower: Fraction, upper: Fraction, bits: int) -> TaylorModel:
        """Return x on the cell [lower, upper]."""
        scale = 1 << bits
        centre, radius = (lower + upper) / 2 * scale, (upper - lower) / 2 * scale
        return cls([round(centre), round(radius)], 1, bits)

    @classmethod
    def constant(cls, c: Interval) -> TaylorModel:
        """Return the constants in an interval."""
        middle = (c.lo + c.hi) >> 1
        return cls([middle], c.hi - middle, c.bits)

    def integer(self, n: int) -> TaylorModel:
        """Return the constant n."""
        return TaylorModel([n << self.bits], 0, self.bits)

    def _lifted(self, other: TaylorModel | int) -> TaylorModel:
        """Return the other operand as a Taylor model."""
        if isinstance(other, int):
            return self.integer(other)
        need(other.bits == self.bits, "Taylor models of different precision met")
        return other

    def __add__(self, other: TaylorModel | int) -> TaylorModel:
        other = self._lifted(other)
        short, long = sorted((self.coefficients, other.coefficients), key=len)
        total = [*map(int.__add__, short, long), *long[len(short) :]]
        return TaylorModel(total, self.error + other.error, self.bits)

    def __neg__(self) -> TaylorModel:
        return TaylorModel([-c for c in self.coefficients], self.error, self.bits)

    def __sub__(self, other: TaylorModel | int) -> TaylorModel:
        return self + -other

    def __mul__(self, other: TaylorModel | int) -> TaylorModel:
        if isinstance(other, int):
            scaled = [c * other for c in self.coefficients]
            return TaylorModel(scaled, self.error * abs(other), self.bits)
        need(other.bits == self.bits, "Taylor models of different precision met")
        product = convolution(self.coefficients, other.coefficients)
        low, high = product[: ORDER + 1], product[ORDER + 1 :]
        a, b = self.error, other.error
        lost = sum(map(abs, high)) + self.size() * b + other.size() * a + a * b
        error = -(-lost >> self.bits) + len(low)
        return TaylorModel([rounded(c, self.bits) for c in low], error, self.bits)

    def __truediv__(self, other: TaylorModel | int) -> TaylorModel:
        if isinstance(other, int):
            quotients = [c // other for c in self.coefficients]
            error = -(-self.error // abs(other)) + len(quotients)
            return TaylorModel(quotients, error, self.bits)
        return self * other.inverse()

    def inverse(self) -> TaylorModel:
        """Return 1/g; rejects if that is not certain to exist."""
        c, unit = self.coefficients, 1 << self.bits
        need(len(c) > 0 and c[0] != 0, "division by a function that may vanish")
        q = [unit * unit // c[0]]
        for k in range(1, ORDER + 1 if len(c) > 1 else 1):
            q.append(-sum(map(mul, c[1 : k + 1], q[::-1])) // c[0])
        guess = TaylorModel(q, 0, self.bits)
        defect = (self.integer(1) - self * guess).bound()
        need(defect < unit, "division by a function that may vanish")
        error = -(-guess.size() * defect // (unit - defect))
        return TaylorModel(q, error, self.bits)

    def sqrt(self) -> TaylorModel:
        """Return the square root; rejects if the function is not certainly positive."""
        c = self.coefficients
        need(len(c) > 0 and c[0] > 0, "square root of a function that may be negative")
        q = [isqrt(c[0] << self.bits)]
        for k in range(1, ORDER + 1 if len(c) > 1 else 1):
            c_k = c[k] if k < len(c) else 0
            q.append(((c_k << self.bits) - sum(map(mul, q[1:], q[:0:-1]))) // (2 * q[0]))
        guess = TaylorModel(q, 0, self.bits)
        least, defect = guess.range().lo, (self - guess * guess).bound()
        positive = least > 0 and least * least > defect << self.bits
        need(positive, "square root of a function that may be negative")
        return TaylorModel(q, -(-(defect << self.bits) // least), self.bits)

    def size(self) -> int:
        """Return a bound of the polynomial on the cell."""
        return sum(map(abs, self.coefficients))

    def bound(self) -> int:
        """Return a bound of the functions on the cell."""
        return self.size() + self.error

    def range(self) -> Interval:
        """Return an enclosure of all values on the cell: y^k lies in [-1, 1], or in [0, 1]."""
        c = self.coefficients
        low = high = c[0] if c else 0
        for k, c_k in enumerate(c[1:], start=1):
            low += min(c_k, -c_k if k % 2 else 0)
            high += max(c_k, -c_k if k % 2 else 0)
        return Interval(low - self.error, high + self.error, self.bits)


def convolution(a: Sequence[int], b: Sequence[int]) -> list[int]:
    """Return the coefficients of the product of two polynomials."""
    if len(a) < len(b):
        a, b = b, a
    product = [0] * (len(a) + len(b) - 1) if b else []
    for j, b_j in enumerate(b):
        for i, a_i in enumerate(a, start=j):
            product[i] += a_i * b_j
    return product


def rounded(c: int, bits: int) -> int:
    """Return the integer nearest to c 2^-bits."""
    return (c + (1 << bits - 1)) >> bits
